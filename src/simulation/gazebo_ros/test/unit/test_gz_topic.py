"""gz topic -p: bytes after protobuf's own description of its encoding, without a simulator; and what gz does not know or do is one line."""

import pytest
from gazebo_ros.commands import gz, gz_publish, wire
from gazebo_ros.commands.command_line import Failure


def test_numbers_and_words_as_protobuf_writes_them():
    """150 in field 1, and "testing" in field 2: the examples of protobuf's documentation."""
    assert wire.field(1, 150) == bytes.fromhex("089601")
    assert wire.field(2, "testing") == bytes.fromhex("120774657374696e67")
    assert wire.fields(bytes.fromhex("089601120774657374696e671901020304050607080d01020304")) == {
        1: [150, bytes([1, 2, 3, 4])],
        2: [b"testing"],
        3: [bytes(range(1, 9))],
    }


@pytest.mark.parametrize("noise", ["08", "0f", "12ff"])
def test_noise_is_no_message(noise):
    with pytest.raises(ValueError):
        wire.fields(bytes.fromhex(noise))


def test_messages_in_words():
    assert gz_publish.encode("gazebo.msgs.WorldControl", "pause: true multi_step: 3", "-m") == bytes.fromhex("08011803")
    assert gz_publish.encode("gazebo.msgs.GzString", 'data: "testing"', "-m") == bytes.fromhex("0a0774657374696e67")


@pytest.mark.parametrize(
    "kind, text, said",
    [
        ("WorldControl", "pause true", "f.txt is no gazebo.msgs.WorldControl: 1:"),
        ("WorldControl", "paus: 1", 'no field named "paus"'),
        ("GzString", "", "required fields:  data"),
        ("Mine", "", "none of Gazebo's own"),
    ],
)
def test_what_is_no_message(kind, text, said):
    with pytest.raises(Failure, match=said.replace(".", r"\.")):
        gz_publish.encode("gazebo.msgs." + kind, text, "f.txt")


def test_messages_need_their_compiler(monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(Failure, match="protobuf-compiler"):
        gz_publish.encode("gazebo.msgs.GzString", "", "-m")


@pytest.mark.parametrize(
    "uri, place", [("", ("localhost", 11345)), ("http://localhost:22850/", ("localhost", 22850)), ("10.0.0.2:7", ("10.0.0.2", 7))]
)
def test_where_the_master_is(monkeypatch, uri, place):
    monkeypatch.setenv("GAZEBO_MASTER_URI", uri)
    assert wire.master() == place


@pytest.mark.parametrize(
    "words, said, code",
    [
        ("sdf -d", "sdformat.org", 1),
        ("sdf -o -v 1.6", "sdformat.org", 1),
        ("sdf -c robot.sdf", "gz sdf -p robot.sdf", 1),
        ("marker -a -t cube -n mine", "RViz", 1),
        ("debug", "--verbose", 1),
        ("log -d 1", "rosbag", 1),
        ("log -e -f state.log", "rosbag", 1),
        ("joint -q", "what is -q? gz help joint", 2),
        ("physics -o fast", "what is -o? gz help physics", 2),
        ("topic -l -q", "what is -q? gz help topic", 2),
    ],
)
def test_what_gz_does_not_do_is_one_line(capsys, words, said, code):
    assert gz.main(words.split()) == code
    text, line = capsys.readouterr()
    assert not text and line.startswith(f"gz {words.split()[0]}: ") and line.count("\n") == 1 and said in line

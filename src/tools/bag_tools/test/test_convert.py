"""Every message comes through, with its time, its publisher, its definition; what cannot be read is one line."""

import struct
import subprocess

import genpy
import pytest
import rosbag
from bag_tools import command
from bag_tools.convert import convert
from bag_tools.files import BagError
from mcap.reader import make_reader
from mcap.well_known import MessageEncoding, Profile, SchemaEncoding
from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Reader, Writer
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import CompressedImage, JointState
from std_msgs.msg import String

NOWHERE = "MSG: nowhere/Part\nfloat32[3] corners\n"
HEADER = "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
OWN = f"nowhere/Part[] parts\nuint8[] raw\nHeader header\n{'=' * 80}\n{NOWHERE}{'=' * 80}\n{HEADER}"
OWN_MD5 = genpy.dynamic.generate_dynamic("nowhere/Thing", OWN)["nowhere/Thing"]._md5sum


def bytes_of(message):
    import io

    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


@pytest.fixture
def bag(tmp_path):
    """Two publishers of /chat, one of them latched; a type that no package has; 300 kB of noise; messages at one time."""
    path = tmp_path / "in.bag"
    with Writer(path) as out:
        store = get_typestore(Stores.ROS1_NOETIC)
        chat = [
            out.add_connection("/chat", "std_msgs/msg/String", typestore=store, callerid=name, latching=latched)
            for name, latched in (("/anna", 1), ("/ben", None))
        ]
        joints = out.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store, callerid="/robot")
        image = out.add_connection("/image", "sensor_msgs/msg/CompressedImage", typestore=store)
        own = out.add_connection("/own", "nowhere/msg/Thing", msgdef=OWN, md5sum=OWN_MD5, callerid="/x")
        for i in range(200):
            at = 1_700_000_000_000_000_001 + i // 2 * 10**7
            out.write(chat[i % 2], at, bytes_of(String(f"ä{i}")))
            state = JointState(name=["a"], position=[i / 7])
            state.header.seq, state.header.stamp = i, genpy.Time(5, i)
            out.write(joints, at, bytes_of(state))
            out.write(own, at, struct.pack("<I3fI2B3II1s", 1, i, 2, 3, 2, 7, i, i, 5, 6, 1, b"f"))
            if i % 50 == 0:
                out.write(image, at, bytes_of(CompressedImage(format="png", data=bytes(range(256)) * 300)))
    return path


def content(path):
    """[(topic, type, md5sum, definition, publisher, latched, time, bytes)], of a bag, in order of time, then of the rest"""
    with Reader(path) as reader:
        return sorted(
            (c.topic, c.msgtype, c.digest, c.msgdef.data.strip(), c.ext.callerid, bool(c.ext.latching), at, bytes(data))
            for c, at, data in reader.messages()
        )


@pytest.mark.parametrize("there, back", (("zstd", "none"), ("lz4", "bz2"), ("none", "none")))
def test_to_mcap_and_back_every_bit_is_the_same(bag, tmp_path, there, back):
    assert convert(bag, tmp_path / "a.mcap", there) == 604
    assert convert(tmp_path / "a.mcap", tmp_path / "b.bag", back) == 604
    assert content(tmp_path / "b.bag") == content(bag)
    with rosbag.Bag(str(tmp_path / "b.bag")) as again:  # rosbag's own reader
        assert again.get_message_count() == 604
        assert [message.data for _, message, _ in again.read_messages("/chat")] == [f"ä{i}" for i in range(200)]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.mcap", "b.bag", "in.bag"]


def test_the_mcap_file_says_what_its_readers_want(bag, tmp_path):
    """The registry of the format: profile ros1."""
    convert(bag, tmp_path / "a.mcap")
    with open(tmp_path / "a.mcap", "rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        assert reader.get_header().profile == Profile.ROS1 and summary.statistics.message_count == 604
        channels = {(c.topic, c.metadata.get("callerid")): c for c in summary.channels.values()}
        assert set(channels) == {("/chat", "/anna"), ("/chat", "/ben"), ("/joint_states", "/robot"), ("/image", None), ("/own", "/x")}
        assert {c.message_encoding for c in channels.values()} == {MessageEncoding.ROS1}
        assert channels["/chat", "/anna"].metadata["latching"] == "true" and channels["/chat", "/ben"].metadata["latching"] == "false"
        schema = summary.schemas[channels["/own", "/x"].schema_id]
        assert (schema.name, schema.encoding, schema.data.decode().strip()) == ("nowhere/Thing", SchemaEncoding.ROS1, OWN.strip())
        times = [message.log_time for _, _, message in reader.iter_messages()]
        assert times == sorted(times) and times[0] == 1_700_000_000_000_000_001
        assert len(next(reader.iter_messages(topics="/image"))[2].data) == len(bytes_of(CompressedImage(format="png", data=bytes(76800))))


@pytest.mark.parametrize("storage", ("mcap", "sqlite3"))
@pytest.mark.parametrize("by", ("bag", "mcap"))
def test_ros_2_reads_the_same_values(bag, tmp_path, storage, by):
    source = bag
    if by == "mcap":
        source = tmp_path / "in.mcap"
        convert(bag, source)
    convert(source, tmp_path / "two", storage=storage)
    assert (tmp_path / "two" / "metadata.yaml").exists()
    with AnyReader([tmp_path / "two"]) as reader:
        assert reader.is2
        read = [(c.topic, at, reader.deserialize(data, c.msgtype)) for c, at, data in reader.messages()]
    assert len(read) == 604
    states = [(at, state) for topic, at, state in read if topic == "/joint_states"]
    assert [(at, state.position[0], state.header.stamp.nanosec) for at, state in states] == [
        (1_700_000_000_000_000_001 + i // 2 * 10**7, i / 7, i) for i in range(200)
    ]
    assert [said.data for topic, _, said in read if topic == "/chat"] == [f"ä{i}" for i in range(200)]
    convert(tmp_path / "two", tmp_path / f"back.{by}")
    if by == "mcap":
        convert(tmp_path / "back.mcap", tmp_path / "back.bag")
    with rosbag.Bag(str(tmp_path / "back.bag")) as again:
        assert [(state.position[0], stamp.to_nsec()) for _, state, stamp in again.read_messages("/joint_states")] == [
            (i / 7, 1_700_000_000_000_000_001 + i // 2 * 10**7) for i in range(200)
        ]
        latched = {c.topic for c in again._get_connections() if c.header.get("latching") in ("1", b"1")}
    assert latched == {"/chat"}


def test_bags_of_rosbag_itself(tmp_path):
    """With its own writer's headers, compressed."""
    with rosbag.Bag(str(tmp_path / "in.bag"), "w", compression="bz2") as out:
        for i in range(10):
            out.write("/chat", String(str(i)), genpy.Time(1, i))
    assert convert(tmp_path / "in.bag", tmp_path / "a.mcap") == convert(tmp_path / "a.mcap", tmp_path / "b.bag") == 10
    assert content(tmp_path / "b.bag") == content(tmp_path / "in.bag")


def cut(path, of, part):
    data = of.read_bytes()
    path.write_bytes(data[: int(len(data) * part)])
    return path


@pytest.mark.parametrize(
    "source, target, said",
    (
        ("none.bag", "out.mcap", "there is no"),
        ("in.bag", "out.txt", "it should end in .bag or .mcap"),
        ("in.bag", "in.bag", "is there already"),
        ("in.bag", "no/out.mcap", "there is no folder"),
        ("text.txt", "out.bag", "or be the folder of a bag of ROS 2"),
        ("text.bag", "out.mcap", "no bag"),
        ("text.mcap", "out.bag", "no MCAP file"),
        ("empty.bag", "out.mcap", "no bag"),
        ("empty.mcap", "out.bag", "no MCAP file"),
        ("cut.bag", "out.mcap", "rosbag reindex"),
        ("folder", "out.bag", "without metadata.yaml"),
        ("cut.mcap", "out.bag", "cut off"),
        ("text.bag", "out", "no bag"),
    ),
)
def test_what_cannot_be_done_is_one_line(bag, tmp_path, capsys, source, target, said):
    convert(bag, tmp_path / "whole.mcap")
    for name in ("text.txt", "text.bag", "text.mcap"):
        (tmp_path / name).write_text("not a bag\n" * 50)
    for name in ("empty.bag", "empty.mcap"):
        (tmp_path / name).write_text("")
    (tmp_path / "folder").mkdir()
    cut(tmp_path / "cut.bag", bag, 0.6)
    cut(tmp_path / "cut.mcap", tmp_path / "whole.mcap", 0.6)
    before = sorted(path.name for path in tmp_path.iterdir())
    assert command.main([str(tmp_path / source), str(tmp_path / target)]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and said in lines[0] and "Traceback" not in lines[0], lines
    assert sorted(path.name for path in tmp_path.iterdir()) == before


@pytest.mark.parametrize("at", (30, 4200, 20000, 60000, -3000, -100))
@pytest.mark.parametrize("kind", ("bag", "mcap"))
def test_flipped_bytes_end_in_one_line_or_a_file(bag, tmp_path, capsys, kind, at):
    source = bag
    if kind == "mcap":
        source = tmp_path / "in.mcap"
        convert(bag, source, "none")
    data = bytearray(source.read_bytes())
    for i in range(40):
        data[at + i] ^= 0x5A
    broken = tmp_path / f"broken.{kind}"
    broken.write_bytes(data)
    target = tmp_path / ("out.mcap" if kind == "bag" else "out.bag")
    code = command.main([str(broken), str(target), "-q"])
    output = capsys.readouterr()
    assert "Traceback" not in output.err and len(output.err.splitlines()) == (1 if code else 0)
    assert target.exists() == (code == 0)


def test_compression_that_a_target_does_not_have(bag, tmp_path):
    with pytest.raises(BagError, match="cannot be compressed by bz2, but by lz4, none, zstd"):
        convert(bag, tmp_path / "a.mcap", "bz2")


@pytest.mark.slow
def test_as_typed(bag, tmp_path):
    def typed(*words):
        return subprocess.run(["rosrun", "bag_tools", "convert", *words], cwd=tmp_path, capture_output=True, text=True, timeout=60)

    done = typed("in.bag", "out.mcap")
    assert (done.returncode, done.stdout.strip(), done.stderr) == (0, "out.mcap: 604 messages", "")
    assert typed("in.bag", "out.mcap").returncode == 1
    assert "for ros2 bag play" in typed("--help").stdout

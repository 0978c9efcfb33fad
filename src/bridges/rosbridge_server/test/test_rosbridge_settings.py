"""Parameters and options."""

import pytest
from rosbridge_library.internal.globs import allowed
from rosbridge_server.settings import SettingError, Settings


def read(values=None, words=(), told=None):
    values = values or {}
    return Settings.read(lambda name, default: values.get(name, default), list(words), ([] if told is None else told).append)


def test_nothing_said_is_this_machine_alone():
    settings = read()
    assert (settings.address, settings.port, settings.topics_glob, settings.authenticate) == ("127.0.0.1", 9090, (), False)
    assert read({"address": ""}).address == "0.0.0.0"  # as upstream has it


def test_as_launch_files_and_command_lines_say_it():
    settings = read(
        {
            "port": 1,
            "max_message_size": "None",
            "topics_glob": "[/a, '/b*', ]",
            "websocket_external_port": "None",
            "services_glob": "[]",
            "fragment_timeout": 600,
            "use_compression": "true",
        },
        ["--port", "9091", "--delay_between_messages", "0.5", "--bson_only_mode", "--params_glob", "None"],
    )
    assert (settings.port, settings.max_message_size, settings.fragment_timeout, settings.delay_between_messages) == (9091, 0, 600.0, 0.5)
    assert settings.bson_only_mode and settings.use_compression
    assert (settings.topics_glob, settings.services_glob, settings.params_glob) == (("/a", "/b*"), (), ())
    assert read({"services_glob": "[/a]"}).services_glob == ("/a", "/rosapi/*")
    assert read(words=["--max_message_size", "100"]).max_message_size == 100


@pytest.mark.parametrize(
    "values, words, said",
    [
        ({"port": "x"}, [], "port should be a whole number"),
        ({"port": 1.5}, [], "port should be a whole number"),
        ({"port": -1}, [], "out of range"),
        ({"port": True}, [], "port should be"),
        ({"fragment_timeout": "long"}, [], "fragment_timeout should be a number"),
        ({"fragment_timeout": float("nan")}, [], "should be a number"),
        ({"retry_startup_delay": 0}, [], "out of range"),
        ({"authenticate": "perhaps"}, [], "authenticate should be true or false"),
        ({"authenticate": 1.0}, [], "authenticate should be true"),
        ({"address": 5}, [], "address should be a text"),
        ({"topics_glob": [1]}, [], "list of patterns"),
        ({"keyfile": "x"}, [], "give both"),
        ({}, ["--port", "1e3"], "port should be a whole number, not '1e3'"),
        ({}, ["--websocket_ping_interval", "-1"], "out of range"),
    ],
)
def test_what_cannot_be_used_is_one_line(values, words, said):
    with pytest.raises(SettingError) as error:
        read(values, words)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_what_has_no_effect_is_told():
    told = []
    read({"binary_encoder": "bson"}, ["--fast"], told)
    assert len(told) == 2 and "--fast" in told[0] and "~binary_encoder" in told[1]


def test_a_token_is_the_first_line_of_a_file(tmp_path):
    (tmp_path / "token").write_text("word\nmore\n")
    assert read({"token_file": str(tmp_path / "token")}).token() == "word" and read().token() == ""
    (tmp_path / "empty").write_text("\n")
    (tmp_path / "bytes").write_bytes(b"\xff\xfe")
    for name, said in (("empty", "is empty"), ("bytes", "it is no text"), ("none", "No such file"), ("", "directory")):
        with pytest.raises(SettingError, match=said):
            read({"token_file": str(tmp_path / name)}).token()


def test_patterns_are_the_shells():
    assert allowed("/anything", ()) and allowed("/a/b", ("/x", "/a/*")) and not allowed("/a", ("/a/*",)) and not allowed("/A/b", ("/a/*",))

"""The node's parameters and the files that it gives away."""

import pytest
from foxglove_bridge import assets
from foxglove_bridge.settings import MESHES, SettingError, Settings, allowed, unknown


def read(values, told=None):
    return Settings.read(lambda name, default: values.get(name, default), (told if told is not None else []).append)


def test_nothing_said_is_this_machine_alone():
    settings = read({})
    assert (settings.address, settings.port) == ("127.0.0.1", 8765)
    assert allowed("/any/topic", settings.topic_whitelist)


@pytest.mark.parametrize(
    "values, said",
    [
        ({"port": "x"}, "~port should be a whole number"),
        ({"port": 70000}, "~port is 70000: out of range"),
        ({"port": True}, "~port"),
        ({"address": 5}, "~address should be a text"),
        ({"topic_whitelist": [1]}, "~topic_whitelist should be a list of texts"),
        ({"param_whitelist": ["(", "a"]}, "is no regular expression"),
        ({"max_update_ms": 0}, "out of range"),
        ({"service_type_retrieval_timeout_ms": 0}, "out of range"),
    ],
)
def test_what_cannot_be_used_is_one_line(values, said):
    with pytest.raises(SettingError) as error:
        read(values)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_what_has_no_effect_is_told():
    told = []
    assert read({"tls": True, "certfile": "", "topic_whitelist": "/one"}, told).topic_whitelist == ("/one",)
    assert len(told) == 1 and "~tls has no effect" in told[0]
    assert unknown(("services", "timeTravel")) == ["timeTravel"]


def test_patterns_are_of_whole_names():
    assert allowed("/a/b", ("/a/.*",)) and not allowed("/x/a/b", ("/a/.*",)) and not allowed("/ab", ("/a",))


@pytest.mark.parametrize(
    "uri",
    [
        "package://foxglove_bridge/package.xml",
        "package://foxglove_bridge/../x/a.stl",
        "file:///etc/passwd",
        "package://foxglove_bridge/%2e%2e/%2e%2e/x.stl",
        "package://no_such/a.stl",
        "package:///a.stl",
        "",
    ],
)
def test_no_file_but_meshes_of_packages(uri):
    assert assets.fetch(uri, (MESHES,)) is None


def test_a_link_out_of_its_package_is_not_followed(tmp_path, monkeypatch):
    home = tmp_path / "box"
    (home / "meshes").mkdir(parents=True)
    (tmp_path / "secret.stl").write_bytes(b"secret")
    (home / "meshes" / "in.stl").write_bytes(b"mesh")
    (home / "meshes" / "out.stl").symlink_to(tmp_path / "secret.stl")
    monkeypatch.setattr(assets.rospkg.RosPack, "get_path", lambda self, name: str(home))
    assert assets.fetch("package://box/meshes/in.stl", (MESHES,)) == b"mesh"
    assert assets.fetch("package://box/meshes/out.stl", (MESHES,)) is None

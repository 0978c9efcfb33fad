import os

import rospkg
from gazebo_ros.node import make_finder


def package(folder, name, export, depend="<exec_depend>gazebo_ros</exec_depend>"):
    path = folder / name
    (path / "models" / "cup").mkdir(parents=True)
    (path / "package.xml").write_text(
        f"<package format='2'><name>{name}</name><version>0.0.1</version><description>d</description>"
        f"<maintainer email='a@b.c'>m</maintainer><license>BSD</license>{depend}"
        f"<export><gazebo_ros {export}/></export></package>"
    )
    return path


def test_exports_and_environment(tmp_path, monkeypatch):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", "/my/models:/more/models")
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", "/my/worlds")
    one = package(tmp_path, "one", 'gazebo_model_path="${prefix}/models:${prefix}/extra" gazebo_media_path="${prefix}"')
    package(tmp_path, "two", 'gazebo_model_path="${prefix}/models"', "<build_depend>gazebo_ros</build_depend>")
    finder = make_finder(rospkg.RosPack(ros_paths=[str(tmp_path)]))
    exported = [f"{one}/models", f"{one}/extra"]
    assert [path for path in finder.model_paths if path.startswith(str(tmp_path))] == exported
    assert finder.model_paths.index("/my/models") < finder.model_paths.index(exported[0])
    assert finder.resource_paths.index("/my/worlds") < finder.resource_paths.index(str(one))
    assert finder.find("model://cup") == os.path.join(one, "models", "cup")
    assert finder.find("package://two/models") == os.path.join(tmp_path, "two", "models")
    assert finder.find("package://three/models") is None


def test_uris_stay_in_the_packages_and_folders_they_name(tmp_path, monkeypatch):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", "")
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", "")
    one = package(tmp_path / "ws", "one", 'gazebo_model_path="${prefix}/models" gazebo_media_path="${prefix}"')
    (tmp_path / "secret.txt").write_text("x")
    finder = make_finder(rospkg.RosPack(ros_paths=[str(tmp_path / "ws")]))
    assert finder.find("package://one/x/../models") == os.path.join(one, "models")
    for uri in (
        "package://one/../../secret.txt",
        "package://../secret.txt",
        "package://..",
        "package:///secret.txt",
        f"package://one/{tmp_path}/secret.txt",
        "package://one/%2e%2e/%2e%2e/secret.txt",
        "model://../../../secret.txt",
        "model://cup/../../../../secret.txt",
        f"model://{tmp_path}/secret.txt",
        "file://../../secret.txt",
        "file://models/../../../secret.txt",
    ):
        assert finder.find(uri) is None, uri

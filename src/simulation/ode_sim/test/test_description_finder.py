"""Where files are looked for, and in which order."""
import pytest

from ode_sim.description.finder import ResourceFinder, find_ros_package


def touch(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("<model><sdf version='1.6'>model.sdf</sdf></model>" if path.name == "model.config" else "x")
    return str(path)


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH", "ODE_SIM_STOCK_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_model_paths_in_gazebos_order(home, monkeypatch):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", f"{home}/first::{home}/second")
    finder = ResourceFinder([home / "exported"], stock=str(home / "stock"))
    assert finder.model_paths == [f"{home}/home/.gazebo/models", f"{home}/first", f"{home}/second", f"{home}/exported",
                                  f"{home}/stock/models"]
    for folder in ("stock/models", "exported", "second", "first", "home/.gazebo/models"):
        expected = touch(home / folder / "m/mesh.dae")
        assert finder.find("model://m/mesh.dae") == expected  # each new one hides the ones before


def test_a_model_uri_with_three_slashes(home):
    expected = touch(home / "models/m/a.dae")
    assert ResourceFinder([home / "models"], stock="").find("model:///m/a.dae") == expected


def test_files_by_path_by_resource_path_and_beside_the_file_that_names_them(home, monkeypatch):
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", f"{home}/r")
    finder = ResourceFinder(stock="")
    absolute = touch(home / "elsewhere/a.world")
    assert finder.find(absolute) == finder.find("file://" + absolute) == absolute
    assert finder.find("worlds/b.world") is None
    in_media = touch(home / "r/media/models/worlds/b.world")
    assert finder.find("worlds/b.world") == in_media
    in_resources = touch(home / "r/worlds/b.world")
    assert finder.find("file://worlds/b.world") == in_resources
    here = touch(home / "worlds/b.world")
    assert finder.find_world("worlds/b.world") == here
    beside = touch(home / "elsewhere/worlds/b.world")
    assert finder.find("worlds/b.world", base=str(home / "elsewhere")) == beside


def test_packages(home, monkeypatch):
    touch(home / "ws/src/group/pkg/package.xml")
    mesh = touch(home / "ws/src/group/pkg/meshes/a b.stl")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{home}/nothing:{home}/ws/src")
    assert find_ros_package("pkg") == f"{home}/ws/src/group/pkg" and find_ros_package("other") is None
    finder = ResourceFinder(stock="")
    assert finder.find("package://pkg/meshes/a%20b.stl") == mesh
    assert finder.find("package://other/meshes/a.stl") is None
    assert finder.explain("package://other/meshes/a.stl") == "there is no ROS package 'other'"
    given = ResourceFinder(stock="", package_path={"other": str(home / "ws/src/group/pkg")}.get)
    assert given.find("package://other/meshes/a%20b.stl") == mesh


def test_packages_may_be_models(home):
    expected = touch(home / "models/pkg/a.stl")
    assert ResourceFinder([home / "models"], stock="").find("package://pkg/a.stl") == expected


def test_model_directories(home):
    touch(home / "models/m/model.config")
    finder = ResourceFinder([home / "models"], stock="")
    with pytest.raises(ValueError, match="names 'model.sdf', which is not there"):
        finder.find_model_sdf("model://m")
    expected = touch(home / "models/m/model.sdf")
    assert finder.find_model_sdf("model://m") == expected == finder.find_model_sdf("model://m/model.sdf")
    assert finder.find_model_sdf("model://n") is None


def test_stock_directory_from_the_environment(home, monkeypatch):
    touch(home / "s/worlds/empty.world")
    touch(home / "s/models/cone/model.config")
    monkeypatch.setenv("ODE_SIM_STOCK_PATH", str(home / "s"))
    finder = ResourceFinder()
    assert finder.stock_worlds() == ["worlds/empty.world"] and finder.stock_models() == ["cone"]
    assert finder.find_world("worlds/empty.world") == str(home / "s/worlds/empty.world")

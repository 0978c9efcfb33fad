"""Displays whose library nobody has built."""

import os
import shutil
import subprocess
import sys

import pytest

MANIFEST = (
    "<package format='2'><name>my_displays</name><version>0.0.1</version><description>d</description><maintainer email='a@b.cd'>a"
    "</maintainer><license>BSD</license><depend>rviz</depend><export><rviz plugin='${prefix}/plugins.xml'/></export></package>"
)
LIBRARY = (
    "<library path='{path}'><class name='my_displays/Arc' type='my::Arc' base_class_type='rviz::Display'/>"
    "<class type='my::Pick' base_class_type='rviz::Tool'/><class name='x' type='y' base_class_type='other::Kind'/></library>"
)


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = tmp_path / "src" / "my_displays"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(MANIFEST)
    for name, value in (
        ("ROS_PACKAGE_PATH", f"{folder.parent}:/usr/share"),
        ("CMAKE_PREFIX_PATH", str(tmp_path / "devel")),
        ("ROS_HOME", str(tmp_path)),
        ("LD_LIBRARY_PATH", str(tmp_path / "libraries")),
    ):
        monkeypatch.setenv(name, value)
    return folder


def told():
    return subprocess.run([sys.executable, "-m", "node_signals.rviz_displays"], capture_output=True, text=True, timeout=120).stderr


@pytest.mark.parametrize("path", ["lib/libmy_displays", "libmy_displays"])
@pytest.mark.parametrize("wrapped", [False, True])
def test_one_line_says_what_to_build(package, path, wrapped):
    text = LIBRARY.format(path=path)
    (package / "plugins.xml").write_text(f"<class_libraries>{text}</class_libraries>" if wrapped else text)
    assert told() == (
        "rviz: my_displays/Arc, my::Pick of the package my_displays cannot be added, its library libmy_displays is not "
        "built: catkin build my_displays\n"
    )


@pytest.mark.parametrize(
    "start",
    [
        ["-m", "node_signals.rviz_start"],
        ["-c", "from node_signals import programs as p; p.run(['rosrun', 'rviz', 'rviz', '-d', 'none.rviz'])"],
    ],
)
def test_whoever_starts_rviz_has_it_told(package, tmp_path, start):
    (package / "plugins.xml").write_text(LIBRARY.format(path="lib/libmy_displays"))
    words = [shutil.which("true")] if start[0] == "-m" else []
    environment = {**os.environ, "DISPLAY": "nowhere:77"}  # RViz itself gets no further
    answer = subprocess.run([sys.executable, *start, *words], env=environment, capture_output=True, text=True, timeout=120)
    assert "catkin build my_displays" in answer.stderr


@pytest.mark.parametrize("place", ["devel/lib", "libraries", "src/my_displays/lib"])
def test_what_is_built_is_not_told(package, tmp_path, place):
    (package / "plugins.xml").write_text(LIBRARY.format(path="lib/libmy_displays"))
    (tmp_path / place).mkdir(parents=True)
    (tmp_path / place / "libmy_displays.so").write_text("")
    assert told() == ""


def test_debians_own_are_built_and_a_broken_description_is_rvizs_matter(package):
    (package / "plugins.xml").write_text("<library")
    assert told() == ""

"""What roslaunch reads once, in its own process, is what it would have read."""

import os
import subprocess
import sys

import pytest
from catkin_pkg.package import InvalidPackage
from catkin_pkg.packages import find_packages
from node_signals import quick_start
from rospkg import rospack

MANIFEST = (
    "<package><!-- <name>other</name> --><name> {} </name><version>0.0.1</version><description>A.</description>"
    "<maintainer email='a@b.org'>a</maintainer><license>BSD</license></package>"
)
DEBIAN = "/usr/bin/roslaunch"


def package(folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(MANIFEST.format(name))


def names(found):
    return {path: each.name for path, each in found.items()}


def test_packages_are_those_that_catkin_finds(tmp_path):
    package(tmp_path / "alone", "one")
    package(tmp_path / "alone" / "below", "never")
    package(tmp_path / "many" / "first", "two")
    package(tmp_path / "many" / "deep" / "second", "three")
    package(tmp_path / "ignored", "four")
    (tmp_path / "ignored" / "CATKIN_IGNORE").touch()
    (tmp_path / "many" / "deep" / "empty").mkdir()
    for folder in ("alone", "many", "ignored", "nowhere"):
        assert names(quick_start.packages_below(str(tmp_path / folder))) == names(find_packages(str(tmp_path / folder))), folder
    assert names(quick_start.packages_below(str(tmp_path / "alone"))) == {".": "one"}


@pytest.mark.parametrize("text", ["<package>", "<package><name/></package>", "", "no XML"])
def test_a_broken_manifest_is_for_catkin_to_judge(tmp_path, text):
    (tmp_path / "package.xml").write_text(text)
    with pytest.raises(Exception) as expected:
        find_packages(str(tmp_path))
    with pytest.raises(type(expected.value)):
        quick_start.packages_below(str(tmp_path))


def test_a_manifest_that_lacks_something_else_has_a_name(tmp_path):
    (tmp_path / "package.xml").write_text("<package><name>half_done</name><version>x</version></package>")
    with pytest.raises(InvalidPackage):  # which ends Debian's roslaunch, for whichever package it looks
        find_packages(str(tmp_path))
    assert names(quick_start.packages_below(str(tmp_path))) == {".": "half_done"}


@pytest.mark.parametrize("command", ["rosversion roslaunch", "rosversion -d", "rosversion -s roscpp", "rosversion node_signals"])
def test_versions_are_those_of_the_command(command):
    assert quick_start.version_asked_for(command) == subprocess.run(command.split(), capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("command", [None, "", "echo rosversion", "rosversion", "rosversion no_such_package", "rosversion --no-such"])
def test_what_fails_or_is_no_version_is_left_to_roslaunch(command, capfd):
    arguments = list(sys.argv)
    assert quick_start.version_asked_for(command) is None
    assert sys.argv == arguments and capfd.readouterr() == ("", "")


def test_places_are_remembered_for_every_caller(tmp_path):
    package(tmp_path / "a", "one")
    listed = quick_start._remembering(rospack.list_by_path)
    first, second = {}, {"zero": "/"}
    assert listed("package.xml", str(tmp_path), first) == ["one"]
    package(tmp_path / "b", "two")
    assert listed("package.xml", str(tmp_path), second) == ["one"] == listed("package.xml", str(tmp_path), None)
    assert first == {"one": str(tmp_path / "a")} and second == {"zero": "/", **first}


LAUNCH = """<launch>
  <param name="distribution" command="rosversion -d"/>
  <param name="version" type="str" command="rosversion roslaunch"/>
  <param name="said" command="echo rosversion"/>
  <param name="file" textfile="$(find node_signals)/package.xml"/>
  <param name="value" value="$(find rosgraph)"/>
</launch>"""


@pytest.mark.skipif(not os.path.exists(DEBIAN), reason="Debian's roslaunch is elsewhere")
def test_parameters_of_a_launch_file_are_those_of_debians(tmp_path):
    (tmp_path / "a.launch").write_text(LAUNCH)

    def dumped(program):
        return subprocess.run([program, "--dump-params", str(tmp_path / "a.launch")], capture_output=True, text=True, check=True).stdout

    ours = dumped("roslaunch")
    assert ours == dumped(DEBIAN) and "\\n" in next(line for line in ours.splitlines() if "version" in line)


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="distutils is setuptools' own")
def test_no_time_goes_into_setuptools():
    code = "from node_signals import quick_start; quick_start.prepare(); import roslaunch, sys; print('setuptools' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"


def test_nodes_are_told_where_their_logs_are_configured(tmp_path, monkeypatch):
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "python_logging.yaml").touch()
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    monkeypatch.setenv("ROS_PYTHON_LOG_CONFIG_FILE", "/of/the/user")
    quick_start._configuration_of_logs()
    assert os.environ["ROS_PYTHON_LOG_CONFIG_FILE"] == "/of/the/user"
    monkeypatch.delenv("ROS_PYTHON_LOG_CONFIG_FILE")
    quick_start._configuration_of_logs()
    assert os.environ["ROS_PYTHON_LOG_CONFIG_FILE"] == str(tmp_path / "config" / "python_logging.yaml")

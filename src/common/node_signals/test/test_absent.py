"""What is said of packages that are not there."""

import pytest
import rospkg
from node_signals import launching
from node_signals.absent import in_one_line, of_program
from roslaunch import node_args
from roslaunch.core import Node


def told(name):
    text = in_one_line(rospkg.ResourceNotFound(name, ros_paths=["/usr/share"] * 100))
    assert "\n" not in text and "ROS path" not in text
    return text


def test_known():
    assert told("amcl").startswith("the package 'amcl' is not here. It belongs to the navigation stack, which is not")
    assert "ros-planning/navigation" in told("map_server")
    assert "\\" not in told("gmapping")
    assert told("smach_ros").endswith("build it from source in your workspace (ros/executive_smach, branch noetic-devel).")


def test_of_debian():
    assert "sudo apt install" in told("octomap")


def test_unknown():
    assert told("my_robot").endswith("`rosdep resolve my_robot` says whether Debian has it.")


def test_other_texts_stay():
    assert told("a file was not found in x.launch") == "a file was not found in x.launch"


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = tmp_path / "my_arm"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='2'><name>my_arm</name><version>0.0.1</version><description>d</description>"
        "<maintainer email='a@b.cd'>a</maintainer><license>BSD</license></package>"
    )
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return folder


def program(path, mode=0o755):
    path.write_text("#!/bin/sh\n")
    path.chmod(mode)


def test_a_program_that_noetic_calls_otherwise():
    assert of_program("robot_state_publisher", "state_publisher") == "Noetic calls it robot_state_publisher"


@pytest.mark.parametrize(
    "where, name, instead",
    [
        ("moveit_kinematics", "create_ikfast_moveit_plugin.py", "kinematics.yaml"),
        ("moveit_kinematics", "auto_create_ikfast_moveit_plugin.sh", "kinematics.yaml"),
        ("moveit_ros_planning", "moveit_evaluate_collision_checking_speed", "scripts/bench motion"),
        ("moveit_ros_planning", "moveit_compare_collision_checking_speed_fcl_bullet", "FCL"),
        ("moveit_ros_planning", "moveit_visualize_robot_collision_volume", "Collision Enabled"),
        ("moveit_ros_occupancy_map_monitor", "moveit_ros_occupancy_map_server", "sensors_3d.yaml"),
    ],
)
def test_a_program_that_is_not_supplied_names_what_takes_its_place(where, name, instead):
    assert instead in of_program(where, name)


def test_a_script_that_is_not_executable(package):
    program(package / "scripts/move.py", 0o644)
    assert of_program("my_arm", "move.py") == f"Such a file is there and is not executable: chmod +x {package}/scripts/move.py"


@pytest.mark.parametrize(
    "name, told",
    [
        ("arm.launch", "That is a launch file: roslaunch my_arm arm.launch"),
        ("arm", "That is a launch file: roslaunch my_arm arm.launch"),
        ("arm.test", "That is a test: rostest my_arm arm.test"),
        ("room.world", "world_name:={path}"),
        ("arm.rviz", "rviz -d {path}"),
        ("arm.urdf", "check_urdf {path}; into a simulation: rosrun gazebo_ros spawn_model -urdf -file {path}"),
        ("arm.urdf.xacro", "xacro {path}"),
        ("Move.srv", "rossrv show my_arm/Move"),
        ("Pose.msg", "rosmsg show my_arm/Pose"),
        ("Grip.action", "rosmsg show my_arm/GripGoal"),
        ("gains.yaml", "rosparam load {path}"),
        ("arm.launch.py", "a launch file of ROS 2; this is ROS 1"),
        ("move.py", "Such a file is there and is not executable: chmod +x {path}"),
    ],
)
def test_a_file_that_is_no_program(package, name, told):
    path = package / "scripts" / (name if "." in name else name + ".launch")
    program(path, 0o644)
    assert told.format(path=path) in of_program("my_arm", name)
    assert "chmod" not in of_program("my_arm", name) or name == "move.py"


def test_a_program_in_cpp_that_is_not_built(package):
    (package / "CMakeLists.txt").write_text("# add_executable(old old.cpp)\nadd_executable( arm_node src/arm.cpp)\n")
    (package / "scripts/arm_node.launch").write_text("<launch/>")
    assert of_program("my_arm", "arm_node").endswith("is not built: catkin build my_arm")
    assert of_program("my_arm", "old") == of_program("my_arm", "arm") == "The package has no programs at all"


def test_what_there_is_instead(package):
    for name in ("move_arm.py", "grip.py", *(f"n{number:02}" for number in range(20))):
        program(package / "scripts" / name)
    ten = ", ".join(f"n{number:02}" for number in range(10))
    assert of_program("my_arm", "move.py") == f"The package has grip.py, move_arm.py, {ten} and 10 more"


@pytest.mark.parametrize("name", ["", "/usr/bin/move", "../move", "[", "mo*"])
def test_a_name_that_is_no_files_name(package, name):
    program(package / "scripts/move")
    assert of_program("my_arm", name) == "The package has move"


def test_nothing_of_a_package_that_is_not_there():
    assert of_program("no_such_package", "x") == ""


def test_roslaunch_adds_it_to_its_own_line(package):
    def missing(node, machine, env):
        raise node_args.NodeParamsException("Cannot locate node of type [a] in package [my_arm]")

    with pytest.raises(node_args.NodeParamsException) as told:
        launching.arguments_of(missing)(Node("my_arm", "a"), None)
    assert str(told.value) == "Cannot locate node of type [a] in package [my_arm]. The package has no programs at all"

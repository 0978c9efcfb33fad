"""What is said of packages that are not there."""
import rospkg

from node_signals.absent import in_one_line


def told(name):
    text = in_one_line(rospkg.ResourceNotFound(name, ros_paths=["/usr/share"] * 100))
    assert "\n" not in text and "ROS path" not in text
    return text


def test_known():
    assert told("amcl").startswith("the package 'amcl' is not here. It belongs to the navigation stack, which is not")
    assert "ros-planning/navigation" in told("map_server")
    assert "\\" not in told("gmapping")


def test_of_debian():
    assert "sudo apt install" in told("octomap")


def test_unknown():
    assert told("my_robot").endswith("`rosdep resolve my_robot` says whether Debian has it.")


def test_other_texts_stay():
    assert told("a file was not found in x.launch") == "a file was not found in x.launch"

"""Sliders that follow the robot, and a robot that follows the sliders."""

import math

import pytest
import rospy
from control_msgs.msg import JointTrajectoryControllerState
from rqt_joint_trajectory_controller.controllers import ControllerFinder, Found
from rqt_joint_trajectory_controller.joint_limits_urdf import DescriptionError, JointLimits, joint_limits
from rqt_joint_trajectory_controller.joint_trajectory_controller import JointTrajectoryController, duration
from rqt_testing.in_process import FakeContext, errors, open_plugin, rospy_without_master, wait_until

URDF = """<robot name="r">
  <joint name="a" type="revolute"><limit lower="-1" upper="2" velocity="0.5" effort="1"/>
    <safety_controller soft_lower_limit="-0.5" soft_upper_limit="3" k_velocity="1"/></joint>
  <joint name="b" type="continuous"><limit velocity="2" effort="1"/></joint>
  <joint name="c" type="revolute"><limit lower="-1" upper="1" effort="1"/></joint>
  <joint name="d" type="prismatic"><limit lower="0" upper="0.1" velocity="1"/><mimic joint="a"/></joint>
  <joint name="e" type="fixed"/><joint name="f" type="revolute"><limit lower="x" upper="1" velocity="1"/></joint>
</robot>"""


def test_limits():
    assert joint_limits(URDF) == {"a": JointLimits(-0.5, 2, 0.5), "b": JointLimits(-math.pi, math.pi, 2)}
    for text in ("", "<robot", "no xml", None):
        with pytest.raises(DescriptionError, match="is no XML"):
            joint_limits(text)


def test_a_description_that_tinyxml_takes_is_read():
    odd = URDF.replace('<joint name="a"', "<link name='R&D'/><gazebo>a & b<topic>x?a=1&b=2</topic></gazebo><joint name='a'", 1)
    assert joint_limits(odd) == joint_limits(URDF)


def test_duration():
    assert duration([0, 0], [1, 1], [0.5, 2], 0.5) == 4.0
    assert duration([0], [0.01], [1], 0.01) == 50.0


class Finder:
    def __init__(self):
        self.names = ["/arm/controller_manager"]
        self.found = Found({"arm_controller": joint_limits(URDF)}, ("other: no limits",))

    def managers(self):
        return self.names

    def controllers(self, manager):
        if not self.names:
            raise rospy.ServiceException("gone")
        return self.found


@pytest.fixture
def plugin():
    rospy_without_master()
    context, finder = FakeContext(), Finder()
    plugin = JointTrajectoryController(context, finder)
    wait_until(lambda: plugin.joints)
    plugin.sent = []
    plugin._publisher.publish = plugin.sent.append
    yield plugin
    plugin.shutdown_plugin()


def state(a, b):
    message = JointTrajectoryControllerState(joint_names=["b", "a"])
    message.actual.positions = [b, a]
    return message


def test_off_the_sliders_follow(plugin):
    assert plugin._publisher.name == "/arm/arm_controller/command" and not plugin.enable_button.isEnabled()
    assert plugin.status_label.text() == "other: no limits"
    plugin.state_received(state(math.nan, 0))
    plugin._show_positions()
    assert not plugin.enable_button.isEnabled()
    plugin.state_received(state(0.75, -math.pi))
    wait_until(lambda: plugin.enable_button.isEnabled())
    assert (plugin.joints["a"].value(), plugin.joints["a"].slider.value(), plugin.joints["b"].slider.value()) == (0.75, 50, 0)
    plugin.command()
    assert plugin.sent == []


def test_on_the_robot_follows(plugin):
    plugin.state_received(state(0.0, 0.0))
    wait_until(lambda: plugin.enable_button.isEnabled())
    plugin.enable_button.click()
    plugin.joints["a"].slider.setValue(100)
    plugin.joints["b"].spin_box.setValue(1.0)
    plugin.state_received(state(0.1, 0.0))
    plugin._show_positions()
    plugin.command()
    command = plugin.sent[-1]
    assert list(command.joint_names) == ["a", "b"] and command.points[0].positions == [2.0, 1.0]
    assert command.points[0].time_from_start.to_sec() == pytest.approx(1.9 / 0.5 / 0.5)


def test_manager_goes_away(plugin):
    plugin.state_received(state(0.0, 0.0))
    wait_until(lambda: plugin.enable_button.isEnabled())
    plugin.enable_button.click()
    plugin._finder.names = []
    plugin.poll()
    wait_until(lambda: not plugin.joints)
    assert not plugin.enable_button.isChecked() and not plugin.enable_button.isEnabled()
    assert plugin.status_label.text() == "there is no controller manager"
    plugin._finder.names = ["/arm/controller_manager"]
    plugin.poll()
    wait_until(lambda: plugin.joints)


def test_the_reason_of_an_empty_list_is_said(monkeypatch):
    from controller_manager_msgs.msg import ControllerState, HardwareInterfaceResources
    from rqt_joint_trajectory_controller import controllers

    parameters = {"/arm/robot_description": URDF, "/arm/arm/joints": ["c", "a"]}
    answer = type(
        "Answer",
        (),
        {
            "controller": [
                ControllerState(
                    "arm", "running", "effort_controllers/JointTrajectoryController", [HardwareInterfaceResources("x", ["a", "c"])]
                )
            ]
        },
    )
    monkeypatch.setattr(controllers.rospy, "ServiceProxy", lambda name, kind: lambda: answer)
    monkeypatch.setattr(controllers.rospy, "has_param", lambda name: name == "/arm/robot_description")
    monkeypatch.setattr(controllers.rospy, "get_param", lambda name, default=None: parameters.get(name, default))
    finder = ControllerFinder()
    assert finder.controllers("/arm/controller_manager") == Found(
        {}, ("arm: robot_description has no limits of position and velocity for c",)
    )
    answer.controller[0].claimed_resources[0].resources = ["a", "b"]
    assert list(finder.controllers("/arm/controller_manager").usable["arm"]) == ["a", "b"]
    parameters["/arm/arm/joints"] = ["b", "a"]
    assert list(finder.controllers("/arm/controller_manager").usable["arm"]) == ["b", "a"]
    monkeypatch.setattr(controllers.rospy, "has_param", lambda name: False)
    assert "there is no parameter /arm/robot_description" in finder.controllers("/arm/controller_manager").reasons[0]


def test_in_the_window():
    rospy_without_master()
    with open_plugin("rqt_joint_trajectory_controller"):
        pass
    assert errors == []

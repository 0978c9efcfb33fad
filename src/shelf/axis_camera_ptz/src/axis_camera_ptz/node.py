"""The node: commands of ``robotnik_msgs/ptz`` for the head, positions for the controllers of its joints."""

from __future__ import annotations

import sys
from typing import Any

import node_signals
import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import Empty, EmptyResponse

from axis_camera_ptz.head import DEFAULTS, Head


class Node:
    """:param values: parameters, see :data:`axis_camera_ptz.head.DEFAULTS`. :param messages: the module robotnik_msgs.msg."""

    def __init__(self, values: dict[str, Any], messages: Any):
        self.values = values
        self.head = Head.from_parameters(values)
        self.now: dict[str, float] = {}
        self.told: rospy.Time | None = None
        self.state = messages.Axis
        self.states = rospy.Publisher("~camera_params", messages.Axis, queue_size=10)
        self.joints = [rospy.Publisher(values[f"{name}_joint_command"], Float64, queue_size=10) for name in ("pan", "tilt")]
        rospy.Subscriber(values["joint_states_topic"], JointState, self._where, queue_size=1)
        rospy.Subscriber("~ptz_command", messages.ptz, self._go, queue_size=10)
        rospy.Service("~home_ptz", Empty, self._home)

    def _where(self, message: JointState) -> None:
        self.now.update(zip(message.name, message.position))

    def _go(self, command: Any) -> None:
        self.told = rospy.Time.now()
        self.head.go(command.pan, command.tilt, command.zoom, command.relative)

    def _home(self, _: Any) -> EmptyResponse:
        self.told = rospy.Time.now()
        self.head.go(self.values["home_pan_value"], self.values["home_tilt_value"], 0.0)
        return EmptyResponse()

    def turn(self) -> None:
        """Publish where the head is, and where its joints are to go; the joints are left alone until somebody has told."""
        values = self.values
        self.states.publish(
            self.state(pan=self.now.get(values["pan_joint"], 0.0), tilt=self.now.get(values["tilt_joint"], 0.0), zoom=self.head.zoom)
        )
        late = (
            values["use_control_timeout"]
            and self.told is not None
            and ((rospy.Time.now() - self.told).to_sec() > values["control_timeout_value"])
        )
        if self.told is not None and not late:
            for publisher, value in zip(self.joints, (self.head.pan, self.head.tilt)):
                publisher.publish(value)


def main() -> int:
    """Exit code 1: messages or parameters are not as they must be."""
    node_signals.init_node("axis_camera")
    try:
        import robotnik_msgs.msg as messages
    except ImportError:
        print(
            "axis_camera_ptz: the messages of robotnik_msgs are not here; build it in your workspace "
            "(https://github.com/RobotnikAutomation/robotnik_msgs)",
            file=sys.stderr,
        )
        return 1
    values = {name: rospy.get_param(name, value) for name, value in DEFAULTS.items()}
    try:
        node = Node(values, messages)
        rate = rospy.Rate(float(values["ptz_rate"]))
    except (TypeError, ValueError, ZeroDivisionError) as error:
        rospy.logerr("axis_camera_ptz: %s", error)
        return 1
    while not rospy.is_shutdown():
        node.turn()
        try:
            rate.sleep()
        except rospy.ROSTimeMovedBackwardsException:
            continue
        except rospy.ROSInterruptException:
            break
    return 0

"""The node arbotix: joints, controllers and pins of one board."""

import sys

import node_signals
import rospy
from arbotix_msgs.srv import SetupChannel, SetupChannelResponse

from . import channels
from .arbotix import ArbotiX, ArbotiXException
from .diff_controller import DiffController
from .follow_controller import FollowController
from .linear_controller import LinearControllerAbsolute, LinearControllerIncremental, LinearJoint
from .parameters import ParameterError, number
from .publishers import DiagnosticsPublisher, JointStatePublisher
from .servo_controller import ServoController
from .servos import DynamixelServo, HobbyServo

JOINT_TYPES = {"dynamixel": DynamixelServo, "hobby_servo": HobbyServo, "calibrated_linear": LinearJoint}
CONTROLLER_TYPES = {
    "diff_controller": DiffController,
    "follow_controller": FollowController,
    "linear_controller": LinearControllerAbsolute,
    "linear_controller_i": LinearControllerIncremental,
}


class Driver:
    def __init__(self):
        self.fake = rospy.get_param("~sim", False)
        self.board: ArbotiX | None = None
        if self.fake:
            rospy.loginfo("ArbotiX being simulated.")
        else:
            self.board = ArbotiX(
                rospy.get_param("~port", "/dev/ttyUSB0"),
                int(number("~baud", 115200, above=0)),
                float(number("~timeout", 0.1, above=0)),
                open_port=False,
            )
            self._connect(self.board)
        self._rate = number("~rate", 100.0, above=0)
        self._joint_states, self._diagnostics = JointStatePublisher(), DiagnosticsPublisher()
        self.joints: dict = {}
        self._make(self.joints, "joint", JOINT_TYPES, "dynamixel")
        self.controllers = {"servos": ServoController(self, "servos")}
        self._make(self.controllers, "controller", CONTROLLER_TYPES)
        self._channels = {}

    @staticmethod
    def _connect(board):
        tries = 0
        while not rospy.is_shutdown():
            try:
                board.openPort()
                rospy.loginfo("Started ArbotiX connection on port %s.", rospy.get_param("~port", "/dev/ttyUSB0"))
                return
            except ArbotiXException as error:
                if tries % 4 == 0:
                    rospy.logerr("Unable to connect to ArbotiX: %s. Trying again.", error)
            tries += 1
            rospy.sleep(0.5)

    def _make(self, made, kind, types, default=None):
        """Makes what the parameters ~<kind>s name; what cannot be made is one error, and the rest goes on."""
        named = rospy.get_param("~%ss" % kind, {})
        if not isinstance(named, dict):
            raise ParameterError("parameter %s must be a map of names" % rospy.resolve_name("~%ss" % kind))
        for name, parameters in named.items():
            type_name = parameters.get("type", default) if isinstance(parameters, dict) else default
            if type_name not in types:
                rospy.logerr("Unrecognized %s: %s has type %s, known are %s.", kind, name, type_name, sorted(types))
                continue
            try:
                made[name] = types[type_name](self, name)
            except ParameterError as error:
                rospy.logerr("%s %s left out: %s.", kind.capitalize(), name, error)

    @staticmethod
    def _wait_for_board(board):
        while board.getDigital(1) == -1 and not rospy.is_shutdown():
            rospy.loginfo("ArbotiX: waiting for response...")
            rospy.sleep(0.25)
        rospy.loginfo("ArbotiX connected.")

    def _start_channels(self):
        for service, kind in channels.SERVICES.items():
            rospy.Service(service, SetupChannel, lambda request, kind=kind: self._setup_channel(kind, request))
        if self.fake:
            return
        for group, kind in channels.PARAMETERS.items():
            for name in rospy.get_param("~" + group, {}):
                prefix = "~%s/%s/" % (group, name)
                try:
                    pin, value, length = (int(number(prefix + key, default)) for key, default in (("pin", 1), ("value", 0), ("length", 1)))
                    self._channels[name] = kind(self.board, name, pin, value, number(prefix + "rate", 10, above=0), length)
                except ParameterError as error:
                    rospy.logerr("Pin %s left out: %s.", name, error)

    def _setup_channel(self, kind, request):
        if not self.fake:
            self._channels[request.topic_name] = kind(self.board, request.topic_name, request.pin, request.value, max(1, request.rate))
        return SetupChannelResponse()

    def run(self):
        pins = any(rospy.has_param("~" + group) for group in channels.PARAMETERS)
        if self.board is not None and (pins or any(controller.pause for controller in self.controllers.values())):
            self._wait_for_board(self.board)
        for controller in self.controllers.values():
            controller.startup()
        self._start_channels()
        rate = rospy.Rate(self._rate)
        while not rospy.is_shutdown():
            try:
                self._turn(rospy.Time.now())
            except ArbotiXException as error:
                rospy.logerr("ArbotiX error: %s", error)
                self._connect(self.board)
            rate.sleep()

    def _turn(self, now):
        for controller in self.controllers.values():
            controller.update(now)
        for channel in list(self._channels.values()):
            channel.update(now)
        for publish in (self._joint_states.update, self._diagnostics.update):
            publish(self.joints.values(), self.controllers.values())

    def shutdown(self):
        try:
            for controller in self.controllers.values():
                controller.shutdown()
        except ArbotiXException as error:
            rospy.logerr("ArbotiX error: %s", error)
        if self.board:
            self.board.closePort()


def main():
    node_signals.init_node("arbotix")
    try:
        driver = Driver()
    except ParameterError as error:
        rospy.logfatal("arbotix cannot start: %s.", error)
        sys.exit(1)
    try:
        driver.run()
    except rospy.ROSException:
        if not rospy.core.is_shutdown_requested():  # at shutdown topics close and sleeps end under the loop
            raise
    finally:
        driver.shutdown()

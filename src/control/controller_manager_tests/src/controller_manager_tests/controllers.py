"""Controllers that claim joints in every way there is, and one that breaks on demand."""

from typing import ClassVar

from controller_interface import Controller, MultiInterfaceController
from hardware_interface import (
    EffortJointInterface,
    HardwareInterface,
    JointCommandInterface,
    PositionJointInterface,
    VelocityJointInterface,
)
from std_msgs.msg import Bool


class EffortTestController(Controller):
    """Claims hiDOF_joint1 and hiDOF_joint2, or the parameter ``joints``; counts what is called."""

    interface = EffortJointInterface

    def init(self, hw, root_nh, controller_nh):
        joints = controller_nh.param("joints", ["hiDOF_joint1", "hiDOF_joint2"])
        self.joints = [hw.get_handle(name) for name in joints]

    def update(self, time, period):
        for joint in self.joints:
            joint.command = 1.0

    def stopping(self, time):
        for joint in self.joints:
            joint.command = 0.0


class _TwoInterfaces(MultiInterfaceController):
    """Claims the parameters ``<prefix>_joints`` through the interfaces of the class."""

    joints: dict[type, tuple[str, list[str]]] = {}

    def init(self, hw, root_nh, controller_nh):
        for interface in self.interfaces:
            offered = hw.get(interface)
            if offered is not None:
                for name in controller_nh.param(*self.joints[interface]):
                    offered.get_handle(name)


class VelEffController(_TwoInterfaces):
    interfaces = (VelocityJointInterface, EffortJointInterface)
    joints = {
        VelocityJointInterface: ("velocity_joints", ["test_joint1", "test_joint2"]),
        EffortJointInterface: ("effort_joints", ["test_joint4"]),
    }


class PosEffController(_TwoInterfaces):
    interfaces = (PositionJointInterface, EffortJointInterface)
    joints = {
        PositionJointInterface: ("position_joints", ["test_joint2", "test_joint3"]),
        EffortJointInterface: ("effort_joints", ["test_joint4"]),
    }


class PosEffOptController(PosEffController):
    optional = True


class SelfConflictController(_TwoInterfaces):
    interfaces = (VelocityJointInterface, EffortJointInterface)
    joints = {VelocityJointInterface: ("velocity_joints", ["test_joint1"]), EffortJointInterface: ("effort_joints", ["test_joint1"])}


class NoSuchInterface(HardwareInterface):
    """Offered by no robot here."""


class MyDummyController(Controller):
    interface = NoSuchInterface


class ExtensibleController(MultiInterfaceController):
    """A controller that others derive from: takes effort joints."""

    interfaces: ClassVar[tuple[type, ...]] = (EffortJointInterface,)

    def init(self, hw, root_nh, controller_nh):
        self.take(hw.get(EffortJointInterface), "hiDOF_joint1")

    @staticmethod
    def take(interface: JointCommandInterface, joint: str):
        """Claim ``joint`` through ``interface``. :return: its handle"""
        return interface.get_handle(joint)


class DerivedController(ExtensibleController):
    """Adds a velocity joint to what its base takes."""

    interfaces = ExtensibleController.interfaces + (VelocityJointInterface,)

    def init(self, hw, root_nh, controller_nh):
        super().init(hw, root_nh, controller_nh)
        self.take(hw.get(VelocityJointInterface), "hiDOF_joint2")


class BrokenController(Controller):
    """Raises in the method that its parameter ``fail_in`` names; with ``on_demand`` once its topic ``fail`` says true."""

    interface = EffortJointInterface

    def init(self, hw, root_nh, controller_nh):
        self.joint = hw.get_handle(controller_nh.param("joint", "hiDOF_joint3"))
        self.fail_in = controller_nh.param("fail_in", "update")
        self.failing = not controller_nh.param("on_demand", False)
        controller_nh.subscriber("fail", Bool, lambda message: setattr(self, "failing", message.data), queue_size=1)
        self.maybe_fail("init")

    def maybe_fail(self, method):
        if self.failing and method == self.fail_in:
            raise ZeroDivisionError(f"on purpose in {method}")

    def starting(self, time):
        self.joint.command = 5.0
        self.maybe_fail("starting")

    def update(self, time, period):
        self.joint.command = 7.0
        self.maybe_fail("update")

    def stopping(self, time):
        self.joint.command = 0.0
        self.maybe_fail("stopping")

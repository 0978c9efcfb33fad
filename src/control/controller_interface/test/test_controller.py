"""The life-cycle of controllers, and what they claim."""

import pytest
from controller_interface import Controller, ControllerState, InitError, MultiInterfaceController
from hardware_interface import (
    EffortJointInterface,
    InterfaceResources,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    ResourceError,
    RobotHW,
    VelocityJointInterface,
)


@pytest.fixture
def robot():
    hw = RobotHW()
    states = [JointStateHandle(name) for name in ("a", "b", "c")]
    hw.register_interface(JointStateInterface(*states))
    hw.register_interface(PositionJointInterface(*map(JointHandle, states)))
    hw.register_interface(EffortJointInterface(*map(JointHandle, states)))
    return hw


class Recorder(Controller):
    interface = PositionJointInterface
    joints = ("b", "a")

    def init(self, hw, root_nh, controller_nh):
        self.calls = []
        self.handles = [hw.get_handle(name) for name in self.joints]

    def starting(self, time):
        self.calls.append(("starting", time, self.state))

    def stopping(self, time):
        self.calls.append(("stopping", time, self.state))

    def waiting(self, time):
        self.calls.append(("waiting", time, self.state))

    def aborting(self, time):
        self.calls.append(("aborting", time, self.state))


def initialized(robot, kind=Recorder):
    controller = kind()
    controller.init_request(robot, None, None)
    return controller


def test_claims_are_sorted_and_do_not_stay_in_the_interface(robot):
    controller = Recorder()
    assert controller.init_request(robot, None, None) == (InterfaceResources("hardware_interface::PositionJointInterface", ("a", "b")),)
    assert robot.get(PositionJointInterface).claims == set()
    assert controller.state is ControllerState.INITIALIZED


def test_states(robot):
    controller = initialized(robot)
    assert controller.start_request(1.0) and controller.is_running
    assert controller.stop_request(3.0) and controller.state is ControllerState.STOPPED
    assert controller.wait_request(4.0) and controller.state is ControllerState.WAITING
    assert controller.abort_request(5.0) and controller.state is ControllerState.ABORTED
    assert controller.start_request(6.0) and controller.is_running
    assert controller.calls == [
        ("starting", 1.0, ControllerState.INITIALIZED),  # the method comes first, then the state changes
        ("stopping", 3.0, ControllerState.RUNNING),
        ("waiting", 4.0, ControllerState.STOPPED),
        ("aborting", 5.0, ControllerState.WAITING),
        ("starting", 6.0, ControllerState.ABORTED),
    ]


@pytest.mark.parametrize("request_name", ["start_request", "stop_request", "wait_request", "abort_request"])
def test_nothing_happens_before_init(request_name):
    controller = Recorder()
    assert getattr(controller, request_name)(1.0) is False
    assert controller.state is ControllerState.CONSTRUCTED


def test_init_only_once(robot):
    controller = initialized(robot)
    with pytest.raises(InitError, match="before"):
        controller.init_request(robot, None, None)


def test_a_missing_interface_is_named_with_those_that_exist(robot):
    class Velocity(Recorder):
        interface = VelocityJointInterface

    with pytest.raises(InitError, match="hardware_interface::VelocityJointInterface.*it has: .*PositionJointInterface"):
        Velocity().init_request(robot, None, None)


def test_a_missing_joint_passes_through_and_leaves_no_claims(robot):
    class Wrong(Recorder):
        joints = ("a", "nope")

    controller = Wrong()
    with pytest.raises(ResourceError, match="nope"):
        controller.init_request(robot, None, None)
    assert robot.get(PositionJointInterface).claims == set()
    assert controller.state is ControllerState.CONSTRUCTED


def test_init_may_refuse(robot):
    class Refusing(Recorder):
        def init(self, hw, root_nh, controller_nh):
            return False

    with pytest.raises(InitError, match="False"):
        Refusing().init_request(robot, None, None)


class Two(MultiInterfaceController):
    interfaces = (VelocityJointInterface, EffortJointInterface)

    def init(self, hw, root_nh, controller_nh):
        self.velocity, self.effort = hw.get(VelocityJointInterface), hw.get(EffortJointInterface)
        self.others = hw.get(PositionJointInterface)
        self.effort.get_handle("c")


def test_several_interfaces_in_the_order_of_the_class(robot):
    robot.register_interface(VelocityJointInterface(JointHandle(JointStateHandle("a"))))
    controller = Two()
    assert controller.init_request(robot, None, None) == (
        InterfaceResources("hardware_interface::VelocityJointInterface", ()),
        InterfaceResources("hardware_interface::EffortJointInterface", ("c",)),
    )
    assert controller.others is None, "only what the class asks for"


def test_a_missing_one_of_several_refuses_unless_optional(robot):
    with pytest.raises(InitError, match="needs the hardware interface hardware_interface::VelocityJointInterface,"):
        Two().init_request(robot, None, None)

    class Optional(Two):
        optional = True

    controller = Optional()
    claimed = controller.init_request(robot, None, None)
    assert controller.velocity is None
    assert claimed == (InterfaceResources("hardware_interface::EffortJointInterface", ("c",)),)

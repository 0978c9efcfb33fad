"""Several robots as one, without ROS."""

from combined_robot_hw import CombinedRobotHW
from hardware_interface import (
    ControllerInfo,
    EffortJointInterface,
    InterfaceResources,
    JointHandle,
    JointStateHandle,
    PositionJointInterface,
    RobotHW,
    SwitchState,
)

EFFORT, POSITION = EffortJointInterface.type_name, PositionJointInterface.type_name


class Part(RobotHW):
    def __init__(self, *joints):
        super().__init__()
        self.register_interface(EffortJointInterface(*(JointHandle(JointStateHandle(name)) for name in joints)))
        self.heard = []
        self.result = SwitchState.DONE
        self.feasible = True

    def read(self, time, period):
        self.heard.append("read")

    def write(self, time, period):
        self.heard.append("write")

    def prepare_switch(self, start, stop):
        self.heard.append(("prepare", start, stop))
        return self.feasible

    def do_switch(self, start, stop):
        self.heard.append(("do", start, stop))

    def switch_result(self, controller=None):
        return self.result


def robot():
    combined, left, right = CombinedRobotHW(), Part("l1", "l2"), Part("r1")
    combined.add(left)
    combined.add(right)
    return combined, left, right


def info(name, *claims):
    return ControllerInfo(name, "t", tuple(InterfaceResources(*claim) for claim in claims))


def test_joints_of_all_parts():
    combined, left, _ = robot()
    interface = combined.get(EffortJointInterface)
    assert interface.names() == ["l1", "l2", "r1"]
    assert interface.get_handle("l1") is left.get(EffortJointInterface).get_handle("l1")
    assert combined.get(PositionJointInterface) is None


def test_read_and_write_reach_all_parts():
    combined, left, right = robot()
    combined.read(0.0, 0.1)
    combined.write(0.0, 0.1)
    assert left.heard == right.heard == ["read", "write"]


def test_each_part_hears_of_its_own_joints_only():
    combined, left, right = robot()
    both = info("both", (EFFORT, ("l2", "r1")))
    of_left = info("of_left", (EFFORT, ("l1",)), (POSITION, ("r1",)))
    reader = info("reader", ("hardware_interface::JointStateInterface", ()))
    assert combined.prepare_switch([both, reader], [of_left])
    combined.do_switch([both], [of_left])
    assert left.heard == [
        ("prepare", [info("both", (EFFORT, ("l2",))), reader], [info("of_left", (EFFORT, ("l1",)))]),
        ("do", [info("both", (EFFORT, ("l2",)))], [info("of_left", (EFFORT, ("l1",)))]),
    ]
    assert right.heard == [("prepare", [info("both", (EFFORT, ("r1",))), reader], []), ("do", [info("both", (EFFORT, ("r1",)))], [])]


def test_one_part_can_refuse():
    combined, _, right = robot()
    right.feasible = False
    assert not combined.prepare_switch([], [])


def test_the_worst_result_counts():
    combined, left, right = robot()
    controller = info("c", (EFFORT, ("l1",)))
    assert combined.switch_result() is SwitchState.DONE
    right.result = SwitchState.ONGOING
    assert combined.switch_result() is SwitchState.ONGOING
    assert combined.switch_result(controller) is SwitchState.DONE, "it does not concern the right part"
    left.result = SwitchState.ERROR
    assert combined.switch_result() is SwitchState.ERROR
    assert combined.switch_result(controller) is SwitchState.ERROR

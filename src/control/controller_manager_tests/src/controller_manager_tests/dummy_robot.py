"""A robot whose joints stay where they are, with the loop of a real one."""

import rospy
from controller_manager import ControllerManager
from hardware_interface import (
    EffortJointInterface,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    RobotHW,
    VelocityJointInterface,
)

JOINTS = ("hiDOF_joint1", "hiDOF_joint2", "hiDOF_joint3")
TEST_JOINTS = ("test_joint1", "test_joint2", "test_joint3", "test_joint4", "test_joint5")


class DummyRobot(RobotHW):
    """States, efforts and velocities for all joints.

    :param with_positions: position commands too; a commanded position is reached at once.
    """

    def __init__(self, with_positions=False):
        super().__init__()
        states = [JointStateHandle(name) for name in JOINTS + TEST_JOINTS]
        self.register_interface(JointStateInterface(*states))
        self._efforts = EffortJointInterface(*map(JointHandle, states))
        self.register_interface(self._efforts)
        self.register_interface(VelocityJointInterface(*map(JointHandle, states)))
        self._positions = PositionJointInterface(*map(JointHandle, states))
        if with_positions:
            self.register_interface(self._positions)

    def read(self, time, period):
        """Efforts commanded are efforts measured, so that a test can see them."""
        for handle in self._efforts.handles():
            handle.state.effort = handle.command
        for handle in self._positions.handles():
            handle.state.position = handle.command


def run(rate=100.0):
    """Spin the loop at ``rate`` Hz until shutdown."""
    rospy.init_node("dummy_robot")
    robot = DummyRobot(rospy.get_param("~with_positions", False))
    manager = ControllerManager(robot)
    period = 1.0 / rate
    sleeper = rospy.Rate(rate)
    while not rospy.is_shutdown():
        now = rospy.get_time()
        robot.read(now, period)
        manager.update(now, period)
        robot.write(now, period)
        try:
            sleeper.sleep()
        except rospy.ROSInterruptException:
            break
    manager.shutdown()

"""A RobotHW plugin: one part of a combined robot."""

from hardware_interface import EffortJointInterface, JointHandle, JointStateHandle, RobotHW


class PartialRobot(RobotHW):
    """Effort joints, named by the parameter ``joints``; refuses to have none."""

    def init(self, root_nh, robot_hw_nh):
        names = robot_hw_nh.get_param("joints", list)
        self.register_interface(EffortJointInterface(*(JointHandle(JointStateHandle(name)) for name in names)))
        return bool(names)

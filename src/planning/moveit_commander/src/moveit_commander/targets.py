"""The target of a group and the goals made of it, as clients of move_group send them."""

from __future__ import annotations

from collections.abc import Sequence

import motion
import rospy
from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import BoundingVolume, Constraints, JointConstraint, OrientationConstraint, PositionConstraint
from shape_msgs.msg import SolidPrimitive

JOINT, POSE, POSITION, ORIENTATION = "joint", "pose", "position", "orientation"


class Targets:
    """What ``group`` of ``model`` is to reach: joint values, or poses of links.

    :param joint_tolerance: of each joint, rad or m. :param position_tolerance: radius of a ball, m.
    :param orientation_tolerance: about each axis, rad.
    """

    def __init__(
        self,
        model: motion.RobotModel,
        group: str,
        joint_tolerance: float = 1e-4,
        position_tolerance: float = 1e-4,
        orientation_tolerance: float = 1e-3,
    ):
        self._model = model
        self._group = group
        self.kind = JOINT
        self.state = model.state()
        self.poses: dict[str, list[PoseStamped]] = {}
        self.joint_tolerance = joint_tolerance
        self.position_tolerance = position_tolerance
        self.orientation_tolerance = orientation_tolerance

    def set_joints(self, values) -> bool:
        """Take joint values (a dict); False when they are out of bounds, which are taken all the same."""
        self.kind = JOINT
        self.state.set(values)
        wrong = self.state.violations(self._group, self.joint_tolerance)
        for name, value, low, high in wrong:
            rospy.logwarn("joint '%s' is to go to %g, which is outside its limits [%g, %g]", name, value, low, high)
        return not wrong

    def set_poses(self, link: str, poses: Sequence[PoseStamped], kind: str = POSE) -> None:
        """Take ``poses`` of ``link``, any of which will do; ``kind``: what of them counts, POSE, POSITION or ORIENTATION."""
        self.kind = kind
        self.poses[link] = list(poses)

    def pose(self, link: str) -> PoseStamped:
        """The first target pose of ``link``; an empty one if there is none."""
        return self.poses[link][0] if self.poses.get(link) else PoseStamped()

    def constraints(self) -> list[Constraints]:
        """The goal_constraints of a request: alternatives."""
        if self.kind == JOINT:
            return [self._joint_goal()]
        count = max((len(poses) for poses in self.poses.values()), default=0)
        goals = []
        for index in range(count):
            goal = Constraints()
            for link, poses in self.poses.items():
                if index < len(poses):
                    self._add_pose(goal, link, poses[index])
            goals.append(goal)
        return goals

    def _joint_goal(self) -> Constraints:
        goal = Constraints()
        for joint in self._model.group(self._group).active_joints:
            for variable in self._model.joint(joint).variables:
                goal.joint_constraints.append(
                    JointConstraint(variable, self.state.get(variable), self.joint_tolerance, self.joint_tolerance, 1.0)
                )
        return goal

    def _add_pose(self, goal: Constraints, link: str, pose: PoseStamped) -> None:
        if self.kind in (POSE, POSITION):
            region = BoundingVolume(primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [self.position_tolerance])], primitive_poses=[Pose()])
            region.primitive_poses[0].position = pose.pose.position
            region.primitive_poses[0].orientation.w = 1.0
            position = PositionConstraint(link_name=link, constraint_region=region, weight=1.0)
            position.header = pose.header
            goal.position_constraints.append(position)
        if self.kind in (POSE, ORIENTATION):
            orientation = OrientationConstraint(link_name=link, orientation=pose.pose.orientation, weight=1.0)
            orientation.absolute_x_axis_tolerance = orientation.absolute_y_axis_tolerance = self.orientation_tolerance
            orientation.absolute_z_axis_tolerance = self.orientation_tolerance
            orientation.header = pose.header
            goal.orientation_constraints.append(orientation)

"""The targets of a group, as MoveGroupCommander sets them."""

from __future__ import annotations

from collections.abc import Sequence

import motion
import numpy as np
import rospy
from geometry_msgs.msg import Pose, PoseStamped
from moveit_core import convert
from sensor_msgs.msg import JointState
from tf.transformations import euler_from_quaternion, quaternion_from_euler

from . import conversions, targets
from .exception import MoveItCommanderException
from .session import Session
from .targets import Targets

_BOUNDS = "Error setting joint target. Is the target within bounds?"


class TargetCommands:
    """Joint values, poses and names as targets of one group; the part of MoveGroupCommander that sends nothing."""

    _session: Session
    _model: motion.RobotModel
    _group: motion.Group
    _name: str
    _targets: Targets
    _remembered: dict[str, list[float]]
    _reference: str
    _eef: str

    def get_current_joint_values(self) -> list[float]:
        """In the group's order; [] when no state newer than now comes within a second."""
        state = self._session.state()
        return [] if state is None else [float(value) for value in state.get_group(self._name)]

    def _link(self, name: str, problem: str = "There is no end effector to set the pose for") -> str:
        if not name and not self._eef:
            raise MoveItCommanderException(problem)
        link = name or self._eef
        if not self._model.has_link(link):
            held = self._session.hold(self._model.state())
            if not held.has_frame(link):
                holds = ", ".join(f"'{body.id}'" for body in held.attached) or "nothing"
                raise MoveItCommanderException(f"The robot '{self._model.name}' has no link '{link}', and it holds {holds}")
        return link

    def _state(self, frame: str) -> motion.RobotState | None:
        """The present state, in which ``frame`` may be a thing that is held or a subframe of it; None: none comes."""
        state = self._session.state()
        return state if state is None or self._model.has_link(frame) else self._session.hold(state)

    def _current_pose(self, link: str) -> list[float]:
        state = self._state(link)
        if state is None or not state.has_frame(link):
            return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
        pose = state.pose(link)
        return [float(value) for value in (*pose.position, *pose.quaternion)]

    def get_joint_value_target(self) -> list[float]:
        return [float(value) for value in self._targets.state.get_group(self._name)]

    def set_joint_value_target(self, arg1, arg2=None, arg3=None) -> None:
        """A target of joint values, rad or m: a list or a dict or a JointState (``arg1``); a joint name and its value (or values:
        ``arg1``, ``arg2``); or a Pose or PoseStamped with, optionally, a link and whether an approximate solution will do
        (``arg2``, ``arg3``): its inverse kinematics is computed here.

        :raises MoveItCommanderException: not understood, or out of bounds (the target is changed all the same).
        """
        if isinstance(arg1, (Pose, PoseStamped)):
            self._set_from_pose(arg1, arg2, arg3)
            return
        if isinstance(arg1, str):
            if arg2 is None:
                raise MoveItCommanderException("Joint value expected when joint name specified")
            if arg3 is not None:
                raise MoveItCommanderException("Too many arguments specified")
            self._set_joints(self._named_values(arg1, arg2))
            return
        if arg2 is not None or arg3 is not None:
            raise MoveItCommanderException("Too many arguments specified")
        if isinstance(arg1, JointState):
            if len(arg1.name) != len(arg1.position):
                raise MoveItCommanderException(f"{_BOUNDS} It has {len(arg1.name)} names and {len(arg1.position)} positions")
            self._set_joints(dict(zip(arg1.name, arg1.position)))
        elif isinstance(arg1, dict):
            self._set_joints(arg1)
        elif hasattr(arg1, "__iter__"):
            values = list(arg1)
            if len(values) != len(self._group.variables):
                raise MoveItCommanderException(
                    f"{_BOUNDS} Provided joint value list has length {len(values)} but "
                    f"group {self._name} has "
                    f"{len(self._group.variables)} joints"
                )
            self._set_joints(dict(zip(self._group.variables, values)))
        else:
            raise MoveItCommanderException(f"Unsupported argument of type {type(arg1)}")

    def _named_values(self, joint: str, value) -> dict[str, float]:
        if not self._model.has_joint(joint):
            raise MoveItCommanderException(f"Error setting joint target. The robot has no joint '{joint}'")
        variables = list(self._model.joint(joint).variables)
        values = list(value) if hasattr(value, "__iter__") else [value]
        if len(values) != len(variables):
            raise MoveItCommanderException(f"Error setting joint target. Joint '{joint}' has {len(variables)} values, not {len(values)}")
        return dict(zip(variables, values))

    def _set_joints(self, values: dict[str, float]) -> None:
        try:
            numbers = {str(name): float(value) for name, value in values.items()}
        except (TypeError, ValueError) as error:
            raise MoveItCommanderException(f"Error setting joint target: {error}") from error
        unknown = [name for name in numbers if name not in self._model.variables]
        if unknown:
            raise MoveItCommanderException(f"Error setting joint target. The robot has no joint '{unknown[0]}'")
        if not all(np.isfinite(list(numbers.values()))):
            raise MoveItCommanderException(f"{_BOUNDS} Not a number: {numbers}")
        if not self._targets.set_joints(numbers):
            raise MoveItCommanderException(_BOUNDS)

    def _set_from_pose(self, pose: Pose | PoseStamped, *options) -> None:
        link, approximate = "", False
        for option in options:
            if isinstance(option, str):
                link = option
            elif isinstance(option, bool):
                approximate = option
            elif option is not None:
                raise MoveItCommanderException("Unexpected type")
        stamped = pose if isinstance(pose, PoseStamped) else self._stamped(pose)
        link = self._link(link)
        state = self._state(link) or self._model.state()
        try:
            target = self._in_model_frame(state, stamped)
            found = motion.ik(self._model, self._name, target, link=link, seed=state, timeout=0.1, return_approximate=approximate)
        except (motion.MotionError, ValueError) as error:
            raise MoveItCommanderException(f"Error setting joint target: {error}") from error
        if not found and not (approximate and len(found.solutions)):
            raise MoveItCommanderException(
                f"Error setting joint target. Is the IK solver functional? No joint values bring '{link}' there: {found.message}"
            )
        self._targets.set_joints(dict(zip(self._group.variables, (float(value) for value in found.solutions[0]))))

    def _in_model_frame(self, state: motion.RobotState, stamped: PoseStamped) -> motion.Pose:
        pose = convert.pose(stamped.pose, "the target", empty_is_identity=False)
        frame = convert.strip(stamped.header.frame_id)
        if frame in ("", self._model.frame):
            return pose
        if not self._model.has_link(frame):
            raise ValueError(f"frame '{frame}' is no link of the robot '{self._model.name}'; poses in other frames are for set_pose_target")
        return state.pose(frame) * pose

    def _stamped(self, pose: Pose) -> PoseStamped:
        message = PoseStamped(pose=pose)
        message.header.frame_id = self._reference
        return message

    def set_rpy_target(self, rpy: Sequence[float], end_effector_link: str = "") -> None:
        """Only an orientation: ``rpy`` [roll, pitch, yaw], radians, in the pose reference frame.

        ``end_effector_link``: "" is the group's; so it is in the methods below.
        """
        link = self._link(end_effector_link)
        if len(rpy) != 3:
            raise MoveItCommanderException("Expected [roll, pitch, yaw]")
        self._set_part(link, targets.ORIENTATION, orientation=quaternion_from_euler(*rpy))

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Only an orientation of ``end_effector_link``: ``q`` [qx, qy, qz, qw], in the pose reference frame."""
        link = self._link(end_effector_link)
        if len(q) != 4:
            raise MoveItCommanderException("Expected [qx, qy, qz, qw]")
        self._set_part(link, targets.ORIENTATION, orientation=q)

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Only a position of ``end_effector_link``: ``xyz`` [x, y, z], metres, in the pose reference frame."""
        self._set_part(self._link(end_effector_link), targets.POSITION, position=xyz)

    def _set_part(self, link: str, kind: str, position=None, orientation=None) -> None:
        pose = self._targets.pose(link)
        present = conversions.pose_to_list(pose.pose)
        if not any(present[3:]):
            present[6] = 1.0
        values = [*(position if position is not None else present[:3]), *(orientation if orientation is not None else present[3:])]
        self._targets.set_poses(link, [self._stamped(conversions.list_to_pose(values))], kind)

    def set_pose_target(self, pose, end_effector_link: str = "") -> None:
        """A ``pose`` of ``end_effector_link``: PoseStamped, Pose, or a list [x y z r p y] or [x y z qx qy qz qw] in the pose reference
        frame.
        """
        link = self._link(end_effector_link)
        self._targets.set_poses(link, [self._pose_target(pose)])

    def _pose_target(self, pose) -> PoseStamped:
        if isinstance(pose, PoseStamped):
            message = PoseStamped(pose=pose.pose)
            message.header.frame_id = pose.header.frame_id or self._reference
            return message
        return self._stamped(pose if isinstance(pose, Pose) else conversions.list_to_pose(pose))

    def set_pose_targets(self, poses: Sequence, end_effector_link: str = "") -> None:
        """Of ``poses`` of ``end_effector_link``, as for :meth:`set_pose_target`, any one will do."""
        link = self._link(end_effector_link, "There is no end effector to set poses for")
        if not poses:
            raise MoveItCommanderException("Unable to set target poses")
        self._targets.set_poses(link, [self._pose_target(pose) for pose in poses])

    def shift_pose_target(self, axis: int, value: float, end_effector_link: str = "") -> None:
        """The present pose of ``end_effector_link``, shifted by ``value`` along ``axis``: 0 1 2 for x y z (m), 3 4 5 for roll pitch yaw
        (rad).
        """
        link = self._link(end_effector_link, "There is no end effector to set poses for")
        if not 0 <= axis < 6:
            raise MoveItCommanderException("An axis value between 0 and 5 expected")
        pose = self._current_pose(link)
        if axis > 2:
            pose = pose[:3] + list(euler_from_quaternion(pose[3:]))
        pose[axis] += value
        self.set_pose_target(pose, link)

    def clear_pose_target(self, end_effector_link: str) -> None:
        """Forget the pose of ``end_effector_link`` ("": the group's)."""
        self._targets.poses.pop(end_effector_link or self._eef, None)

    def clear_pose_targets(self) -> None:
        self._targets.poses.clear()

    def set_random_target(self) -> None:
        """Joint values anywhere within the limits."""
        self._targets.state.randomize()
        self._targets.kind = targets.JOINT

    def get_named_targets(self) -> list[str]:
        """Names that :meth:`set_named_target` knows: of the SRDF, and remembered ones."""
        return [*self._group.named_states, *(name for name in self._remembered if name not in self._group.named_states)]

    def set_named_target(self, name: str) -> None:
        """Joint values that were remembered as ``name``, or the state of that name in the SRDF.

        :raises MoveItCommanderException: there is neither.
        """
        if name in self._remembered:
            self.set_joint_value_target(self._remembered[name])
        elif name in self._group.named_states:
            self._targets.state.set_named(self._name, name)
            self._targets.kind = targets.JOINT
        else:
            raise MoveItCommanderException(
                f"Unable to set target {name}. Is the target within bounds? Group "
                f"'{self._name}' has the named "
                f"targets: {', '.join(self.get_named_targets()) or 'none'}"
            )

    def get_named_target_values(self, target: str) -> dict[str, float]:
        """Joint values of a named target; {} if there is none of that name."""
        if target in self._remembered:
            return dict(zip(self._group.variables, self._remembered[target]))
        if target not in self._group.named_states:
            rospy.logwarn("The requested named target '%s' does not exist, returning empty values.", target)
            return {}
        return {joint: float(values[0]) for joint, values in self._group.named_state(target).items() if len(values) == 1}

    def remember_joint_values(self, name: str, values: Sequence[float] | None = None) -> None:
        """Give values (default: the present ones) a name."""
        self._remembered[name] = [float(value) for value in (self.get_current_joint_values() if values is None else values)]

    def get_remembered_joint_values(self) -> dict[str, list[float]]:
        return {name: list(values) for name, values in self._remembered.items()}

    def forget_joint_values(self, name: str) -> None:
        """Forget what was remembered as ``name``."""
        self._remembered.pop(name, None)

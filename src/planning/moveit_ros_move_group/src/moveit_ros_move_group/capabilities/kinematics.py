"""The services ``compute_ik`` and ``compute_fk``."""

from __future__ import annotations

import motion
import rospy
from moveit_core import convert, states
from moveit_core.errors import PlanningError
from moveit_core.scene_messages import attach_to_state
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GetPositionFK, GetPositionIK
from moveit_ros_planning.robot_model import Kinematics as Solver

from ..capability import Capability, serve


class Kinematics(Capability):
    """Inverse and forward kinematics."""

    title = "KinematicsService"

    def __init__(self, context):
        super().__init__(context)
        self._services = [serve("compute_ik", GetPositionIK, self._ik), serve("compute_fk", GetPositionFK, self._fk)]

    # --- inverse ---

    def _ik(self, request, response) -> None:
        wanted = request.ik_request
        group = self.context.group(wanted.group_name)
        settings = self._settings(wanted.group_name, len(wanted.pose_stamped_vector))
        scene = self.context.monitor.copy()
        state = scene.state
        merge_state(scene, state, wanted.robot_state)
        scene.set_state(state)
        poses = self._targets(scene, wanted, group)
        limits = convert.path_constraints(wanted.constraints, scene, rospy.logwarn)
        link, pose = next(iter(poses.items()))
        found = motion.ik(
            scene,
            wanted.group_name,
            pose if len(poses) == 1 else poses,
            link=link if len(poses) == 1 else "",
            seed=state,
            timeout=wanted.timeout.to_sec() or settings.timeout,
            tolerance=settings.epsilon,
            position_only=settings.position_only,
            avoid_collisions=wanted.avoid_collisions,
            constraints=None if limits.empty() else limits,
        )
        if not found:
            rospy.logdebug("compute_ik: %s", found.message)
            response.error_code.val = MoveItErrorCodes.NO_IK_SOLUTION
            return
        state.set_group(wanted.group_name, found.solutions[0])
        response.solution = states.robot_state_message(state, attached=False)
        response.error_code.val = MoveItErrorCodes.SUCCESS

    def _settings(self, name: str, poses: int) -> Solver:
        """What kinematics.yaml says of the group; several poses may be shared out among the groups in it that have solvers.

        :raises PlanningError: NO_IK_SOLUTION, nobody solves for it.
        """
        known = self.context.description.kinematics
        if name in known:
            return known[name]
        parts = [known[part] for part in self.context.description.solved_parts(name)]
        if poses < 2 or len(parts) < poses:
            also = f"; {len(parts)} of the groups in it have one, for {poses} poses" if parts and poses > 1 else ""
            raise PlanningError(
                MoveItErrorCodes.NO_IK_SOLUTION, f"group '{name}' has no kinematics solver: kinematics.yaml names none for it{also}"
            )
        return Solver(
            parts[0].solver,
            timeout=sum(part.timeout for part in parts),
            epsilon=min(part.epsilon for part in parts),
            position_only=all(part.position_only for part in parts),
        )

    def _targets(self, scene, wanted, group) -> dict[str, motion.Pose]:
        stamped, links = list(wanted.pose_stamped_vector), list(wanted.ik_link_names)
        if len(stamped) < 2:
            stamped, links = stamped or [wanted.pose_stamped], [wanted.ik_link_name]
        if len(stamped) != len(links):
            raise PlanningError(
                MoveItErrorCodes.INVALID_LINK_NAME, f"{len(stamped)} poses and {len(links)} links were given; each pose needs its link"
            )
        result = {}
        for message, link in zip(stamped, links):
            try:
                if link:
                    scene.state.frame_link(link)  # a link, an attached object or its subframe
            except motion.UnknownNameError as error:
                raise PlanningError(MoveItErrorCodes.INVALID_LINK_NAME, f"the robot has no link '{link}'") from error
            pose = convert.pose(message.pose, "the pose", empty_is_identity=False)
            result[link or (group.tips[0] if group.tips else group.tip_link)] = self._in_model(scene, message.header.frame_id, pose)
        return result

    @staticmethod
    def _in_model(scene, frame: str, pose) -> motion.Pose:
        try:
            return convert.in_model_frame(scene, frame, pose)
        except motion.UnknownNameError as error:
            raise PlanningError(MoveItErrorCodes.FRAME_TRANSFORM_FAILURE, f"frame '{frame}': {error}") from error

    # --- forward ---

    def _fk(self, request, response) -> None:
        codes = MoveItErrorCodes
        if not request.fk_link_names:
            raise PlanningError(codes.INVALID_LINK_NAME, "no link was asked for")
        scene = self.context.monitor.copy()
        state = scene.state
        merge_state(scene, state, request.robot_state)
        frame = convert.strip(request.header.frame_id) or scene.frame
        to_frame = motion.Pose.identity()
        if frame != scene.frame:
            try:
                to_frame = scene.frame_pose(frame, state).inverse()
            except motion.UnknownNameError as error:
                raise PlanningError(codes.FRAME_TRANSFORM_FAILURE, f"frame '{frame}': {error}") from error
        response.error_code.val = codes.SUCCESS
        now = rospy.Time.now()
        for link in request.fk_link_names:
            if not self.context.model.has_link(link):
                rospy.logerr("compute_fk: the robot has no link '%s'", link)
                response.error_code.val = codes.INVALID_LINK_NAME
                continue
            response.pose_stamped.append(convert.pose_stamped(frame, to_frame * state.pose(link), now))
            response.fk_link_names.append(link)


def merge_state(scene, state, message) -> None:
    """Put ``message``, the RobotState of a request, over ``state``, that of ``scene``; an empty one changes nothing.

    :raises PlanningError: it cannot be used.
    """
    if states.is_empty(message):
        return
    try:
        states.apply_robot_state(scene, state, message, attach_to_state(scene))
    except (ValueError, motion.MotionError) as error:
        raise PlanningError(MoveItErrorCodes.INVALID_ROBOT_STATE, str(error)) from error

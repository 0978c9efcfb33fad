"""The service ``compute_cartesian_path``."""

from __future__ import annotations

import motion
import rospy
from moveit_core import convert, states
from moveit_core.errors import PlanningError
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GetCartesianPath

from ..capability import Capability, serve
from .kinematics import merge_state


class CartesianPath(Capability):
    """Straight lines through way points, as far as they can be followed."""

    title = "CartesianPathService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("compute_cartesian_path", GetCartesianPath, self._compute)

    def _compute(self, request, response) -> None:
        codes = MoveItErrorCodes
        rospy.loginfo("Received request to compute Cartesian path")
        group = self.context.group(request.group_name)
        scene = self.context.monitor.copy()
        state = scene.state
        merge_state(scene, state, request.start_state)
        scene.set_state(state)
        link = request.link_name or (group.links[-1] if group.links else "")
        try:
            state.frame_link(link)  # a link, an attached object or its subframe
        except motion.UnknownNameError as error:
            raise PlanningError(codes.FAILURE, f"the robot has no link '{link}' to move along a line") from error
        response.start_state = states.robot_state_message(state)
        if request.max_step < 1e-9:
            raise PlanningError(
                codes.FAILURE,
                "Maximum step to take between consecutive configurations along "
                "Cartesian path was not "
                "specified (this value needs to be > 0): give eef_step, for example 0.01 m",
            )
        if not request.waypoints:
            response.fraction, response.error_code.val = 0.0, codes.SUCCESS
            return
        frame = convert.strip(request.header.frame_id)
        relative = frame == link and frame != scene.frame
        poses = [self._pose(scene, "" if relative else frame, message) for message in request.waypoints]
        limits = convert.path_constraints(request.path_constraints, scene, rospy.logwarn)
        rospy.loginfo(
            "Attempting to follow %d waypoints for link '%s' using a step of %f m and jump threshold %f (in %s reference frame)",
            len(poses),
            link,
            request.max_step,
            request.jump_threshold,
            "link" if relative else "global",
        )
        settings = self.context.description.kinematics.get(request.group_name)
        found = motion.cartesian_path(
            scene,
            request.group_name,
            poses,
            link=link,
            start=state,
            max_step=request.max_step,
            jump_threshold=request.jump_threshold,
            prismatic_jump=request.prismatic_jump_threshold,
            revolute_jump=request.revolute_jump_threshold,
            avoid_collisions=request.avoid_collisions,
            constraints=None if limits.empty() else limits,
            relative=relative,
            position_only=settings is not None and settings.position_only,
        )
        response.fraction, response.error_code.val = found.fraction, codes.SUCCESS
        self._finish(request, response, found, link)

    @staticmethod
    def _pose(scene, frame: str, message) -> motion.Pose:
        pose = convert.pose(message, "a way point", empty_is_identity=False)
        try:
            return convert.in_model_frame(scene, frame, pose)
        except motion.UnknownNameError as error:
            raise PlanningError(MoveItErrorCodes.FRAME_TRANSFORM_FAILURE, f"frame '{frame}': {error}") from error

    def _finish(self, request, response, found, link: str) -> None:
        if found.message:
            rospy.loginfo("%s", found.message)
        trajectory = found.trajectory
        if trajectory is None or not len(trajectory):
            return
        timed = motion.time_parameterize(self.context.model, trajectory, "iterative_parabolic")
        if request.max_cartesian_speed > 0:
            timed = motion.limit_cartesian_speed(timed, request.cartesian_speed_limited_link or link, request.max_cartesian_speed)
        response.solution = states.trajectory_message(timed)
        rospy.loginfo("Computed Cartesian path with %d points (followed %f%% of requested trajectory)", len(timed), found.fraction * 100.0)
        self.context.display.trajectories([timed])

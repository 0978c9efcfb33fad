"""The actions ``pickup`` and ``place``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

import motion
import rospy
from dynamic_parameters import Parameter, Server
from moveit_core import states
from moveit_core.errors import PlanningError
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    Grasp,
    JointConstraint,
    MotionPlanRequest,
    MoveItErrorCodes,
    PickupAction,
    PlaceAction,
    PlaceLocation,
    RobotState,
)
from moveit_ros_move_group.capability import ActionCapability, Capability, result_text
from moveit_ros_planning.plan_execution import Plan
from moveit_ros_planning.robot_model import scaling_factors
from trajectory_msgs.msg import JointTrajectoryPoint

from .planner import Manipulation, Outcome, Settings, Task, allowing, check_motion, check_posture, hand_pose

_PARAMETERS = [
    Parameter("max_attempted_states_per_pose", int, 5, 1, 100, "Joint configurations that are tried per pose"),
    Parameter(
        "max_consecutive_fail_attempts",
        int,
        3,
        1,
        10,
        "Poses in a row without a configuration after which the search for more ends (all poses are tried here)",
    ),
    Parameter("cartesian_motion_step_size", float, 0.02, 0.005, 0.1, "Step of straight approaches and retreats, m"),
    Parameter(
        "jump_factor",
        float,
        2.0,
        0.0,
        10.0,
        "A straight motion ends before a step above this many times its mean one in joint space; 0 allows any",
    ),
]


class PickPlace(Capability):
    """Both actions, and the dynamic_reconfigure server ``~pick_place``."""

    title = "PickPlaceAction"

    def __init__(self, context):
        super().__init__(context)
        self._settings = Settings()
        self._server = Server("~pick_place", _PARAMETERS, self._reconfigure)
        self._actions = [Pickup(context, self._settings), Place(context, self._settings)]

    def _reconfigure(self, config, _level) -> None:
        self._settings.tries = int(config["max_attempted_states_per_pose"])
        self._settings.step = float(config["cartesian_motion_step_size"])
        self._settings.jump = float(config["jump_factor"])

    def shutdown(self) -> None:
        for action in self._actions:
            action.preempt()


class _Manipulate(ActionCapability):
    """What picking and placing have in common."""

    def __init__(self, context, settings: Settings):
        self._settings = settings
        super().__init__(context)

    def serve(self, goal, result) -> str:
        self.feedback("PLANNING")
        self.context.monitor.wait_for_state()
        options = goal.planning_options
        plan_only = options.plan_only or self.context.execution is None
        if plan_only:
            plan = self.plan(self.context.monitor.copy(options.planning_scene_diff), goal, result)
        else:
            plan = self.plan_execution.plan_and_execute(
                lambda scene: self.plan(scene, goal, result),
                options.planning_scene_diff,
                self.stop,
                options.replan,
                options.replan_attempts,
                options.replan_delay,
                before=lambda: self.feedback("MONITOR"),
                stops=self.stops,
            )
        result.error_code.val, result.planning_time = plan.code, plan.planning_time
        stages = [(segment.trajectory, segment.description) for segment in plan.segments if segment.trajectory is not None]
        trajectories = [trajectory for trajectory, _ in stages]
        if trajectories:
            result.trajectory_start = states.robot_state_message(trajectories[0].start)
        result.trajectory_stages = [states.trajectory_message(trajectory) for trajectory in trajectories]
        result.trajectory_descriptions = [description for _, description in stages]
        return result_text(plan.code, plan.message, not trajectories, options.plan_only)

    def plan(self, scene, goal, result) -> Plan:
        """Plan the ``goal`` in ``scene``; what is tried goes into ``result``.

        :raises PlanningError: it cannot be done.
        """
        raise NotImplementedError

    def effector(self, name: str, group: str) -> tuple[str, str, str]:
        """(group of the arm, group of the hand, link) of an end effector, by its name or the arm that carries it.

        :raises PlanningError: there is none, or several.
        """
        model = self.context.model
        if group:
            self.context.group(group)
        found = [
            eef
            for eef in model.end_effectors
            if (name and name in (eef.name, eef.group))
            or (not name and group and (eef.parent_group == group or eef.name in model.group(group).attached_end_effectors))
        ]
        if not found or not (group or found[0].parent_group):
            known = ", ".join(f"{eef.name} (on {eef.parent_group or 'no group'})" for eef in model.end_effectors) or "none"
            raise PlanningError(
                MoveItErrorCodes.INVALID_GROUP_NAME,
                f"which hand is meant by end effector '{name}' and group '{group}' is not clear; the SRDF has the end effectors: {known}",
            )
        eef = found[0]
        if len(found) > 1:
            rospy.logwarn(
                "group '%s' has the end effectors %s: '%s' is taken; name another in end_effector",
                group,
                ", ".join(each.name for each in found),
                eef.name,
            )
        return (group or eef.parent_group), eef.group, eef.parent_link

    def manipulation(self, goal) -> Manipulation:
        """A planner for the time that the goal allows."""
        seconds = goal.allowed_planning_time if goal.allowed_planning_time > 0 else 5.0
        return Manipulation(
            lambda scene, group, values, left: self._free(scene, goal, group, values, left), seconds, self.stop.is_set, self._settings
        )

    def _free(self, scene, goal, group: str, values, seconds: float) -> motion.PlanResult:
        request = MotionPlanRequest(
            group_name=group,
            planner_id=goal.planner_id,
            allowed_planning_time=seconds,
            num_planning_attempts=1,
            path_constraints=goal.path_constraints,
            start_state=RobotState(is_diff=True),
        )
        velocity, acceleration = scaling_factors(self.context.description)
        request.max_velocity_scaling_factor, request.max_acceleration_scaling_factor = velocity, acceleration
        names = list(self.context.model.group(group).variables)
        request.goal_constraints = [
            Constraints(joint_constraints=[JointConstraint(name, float(value), 1e-4, 1e-4, 1.0) for name, value in zip(names, values)])
        ]
        return self.context.pipelines.find("").generate(scene, request, self.stop.token)

    def first_that_works(self, scene, goal, entries: Sequence, make: Callable, result, field: str) -> Plan:
        """Try entries (grasps, places) in order; that which works goes into ``field`` of the result.

        :param make: the Task of an entry; an entry that it refuses by PlanningError is left out.
        """
        planner, last = self.manipulation(goal), Outcome(message="no way to do it was given")
        started = planner.left
        for entry in entries:
            last = self._try(planner, scene, make, entry)
            if last.segments:
                setattr(result, field, entry)
                self.context.display.trajectories([segment.trajectory for segment in last.segments if segment.trajectory is not None])
                return Plan(MoveItErrorCodes.SUCCESS, "", last.segments, started - planner.left)
            rospy.loginfo("%s: %s", entry.id or "one way", last.message)
            if planner.left <= 0 or self.stop.is_set():
                last.code = planner.ended().code
                break
        return Plan(last.code, f"none of the {len(entries)} ways can be planned; the last one: {last.message}", [], started - planner.left)

    @staticmethod
    def _try(planner: Manipulation, scene, make: Callable, entry) -> Outcome:
        try:
            return planner.plan(scene, make(entry))
        except PlanningError as error:
            return Outcome(code=error.code, message=str(error))
        except motion.UnknownNameError as error:  # the frame of a direction
            return Outcome(code=MoveItErrorCodes.FRAME_TRANSFORM_FAILURE, message=str(error))

    def check(self, motions: Sequence, postures: Sequence) -> None:
        """Of a grasp or a place: pairs (GripperTranslation or posture, what it is).

        :raises PlanningError: one holds what cannot be.
        """
        for move, what in motions:
            check_motion(move, what)
        for posture, what in postures:
            check_posture(self.context.model, posture, what)


class Pickup(_Manipulate):
    """Picks up an object of the scene."""

    action_name = "pickup"
    action = PickupAction

    def plan(self, scene, goal, result) -> Plan:
        if goal.target_name and goal.target_name not in scene.objects:
            raise PlanningError(
                MoveItErrorCodes.INVALID_OBJECT_NAME,
                f"the scene has no object '{goal.target_name}' to pick; it has: " + (", ".join(scene.objects) or "none"),
            )
        arm, hand, link = self.effector(goal.end_effector, goal.group_name)
        closer = goal.minimize_object_distance or not goal.possible_grasps
        grasps = sorted(goal.possible_grasps or [self._default(scene, goal.target_name, hand)], key=lambda grasp: -grasp.grasp_quality)
        return self.first_that_works(
            scene, goal, grasps, lambda grasp: self._task(scene, goal, grasp, (arm, hand, link), closer), result, "grasp"
        )

    def _task(self, scene, goal, grasp: Grasp, effector: tuple[str, str, str], closer: bool) -> Task:
        arm, hand, link = effector
        target = goal.target_name
        self.check(
            [(grasp.pre_grasp_approach, "pre_grasp_approach"), (grasp.post_grasp_retreat, "post_grasp_retreat")],
            [(grasp.pre_grasp_posture, "pre_grasp_posture"), (grasp.grasp_posture, "grasp_posture")],
        )
        links = sorted({*self.context.model.group(hand).links, link})
        touch = sorted({*goal.attached_object_touch_links}) or links
        support = [goal.support_surface_name] if goal.support_surface_name else []
        others = allowing(
            links, [*goal.allowed_touch_objects, *grasp.allowed_touch_objects, *(support if goal.allow_gripper_support_collision else [])]
        )
        gripping = allowing([target], [*touch, *support]) if target else allowing([], [])

        def both(matrix) -> None:
            others(matrix)
            gripping(matrix)

        # With no target named the hand goes through the motions and nothing is attached, as upstream has it.
        def change(other) -> None:
            if target:
                other.attach_object(target, link, touch)

        def effect() -> bool:
            return not target or self._attach(target, link, touch, grasp)

        return Task(
            arm,
            link,
            hand,
            hand_pose(scene, grasp.grasp_pose, target),
            grasp.pre_grasp_approach,
            grasp.post_grasp_retreat,
            grasp.pre_grasp_posture,
            grasp.grasp_posture,
            both,
            both,
            change,
            effect,
            others if closer else None,
        )

    def _attach(self, name: str, link: str, touch: list[str], grasp: Grasp) -> bool:
        message = AttachedCollisionObject(link_name=link, touch_links=touch, detach_posture=grasp.pre_grasp_posture)
        message.object.id, message.object.operation = name, CollisionObject.ADD
        return self.context.monitor.process_attached(message)

    def _default(self, scene, target: str, hand: str) -> Grasp:
        """One grasp along x, when none is given."""
        grasp = Grasp(id="default")
        grasp.grasp_pose.header.frame_id = target
        grasp.grasp_pose.pose.position.x, grasp.grasp_pose.pose.orientation.w = -0.2, 1.0
        for move, axis in ((grasp.pre_grasp_approach, "x"), (grasp.post_grasp_retreat, "z")):
            move.direction.header.frame_id = scene.frame
            setattr(move.direction.vector, axis, 1.0)
            move.min_distance, move.desired_distance = 0.1, 0.2
        joints = list(self.context.model.group(hand).active_joints)
        for posture, sign in ((grasp.pre_grasp_posture, 1.0), (grasp.grasp_posture, -1.0)):
            posture.joint_names = joints
            posture.points = [JointTrajectoryPoint(positions=[sign * sys.float_info.max] * len(joints))]
        return grasp


class Place(_Manipulate):
    """Puts an attached object down."""

    action_name = "place"
    action = PlaceAction

    def plan(self, scene, goal, result) -> Plan:
        body = self._body(scene, goal)
        if not goal.place_locations:
            raise PlanningError(MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS, f"no place for '{body.id}' was given")
        effector = self._hand(goal, body)
        locations = sorted(goal.place_locations, key=lambda location: -location.quality)
        return self.first_that_works(
            scene, goal, locations, lambda location: self._task(scene, goal, location, body, effector), result, "place_location"
        )

    def _body(self, scene, goal):
        """The held object that the goal names; without a name, the only one that its group holds.

        :raises PlanningError: there is none, or several.
        """
        held = {body.id: body for body in scene.state.attached}
        named = goal.attached_object_name
        if named:
            found = [held[named]] if named in held else []
        else:
            hands = {body.id: self._holder(body) for body in held.values()}
            found = [
                body
                for body in held.values()
                if hands[body.id] is not None
                and goal.group_name in (hands[body.id].name, hands[body.id].group, hands[body.id].parent_group)
            ] or list(held.values())
        if len(found) != 1:
            what = f"no object '{named}' is held" if named else "which object is to be placed is not clear"
            raise PlanningError(MoveItErrorCodes.INVALID_OBJECT_NAME, f"{what}; held are: {', '.join(held) or 'none'}")
        return found[0]

    def _holder(self, body):
        """The end effector that holds a body; None if none does."""
        model = self.context.model
        return next((eef for eef in model.end_effectors if body.link == eef.parent_link or body.link in model.group(eef.group).links), None)

    def _hand(self, goal, body) -> tuple[str, str, str]:
        """The hand that holds the body."""
        model, group = self.context.model, goal.group_name
        eef = self._holder(body)
        if eef is not None:
            arm = group if model.has_group(group) and group not in (eef.name, eef.group) else eef.parent_group
            return arm, eef.group, eef.parent_link
        if not model.has_group(group):
            raise PlanningError(MoveItErrorCodes.INVALID_GROUP_NAME, f"no end effector holds '{body.id}' (it hangs on '{body.link}')")
        return group, "", body.link

    def _task(self, scene, goal, location: PlaceLocation, body, effector: tuple[str, str, str]) -> Task:
        arm, hand, link = effector
        self.check(
            [(location.pre_place_approach, "pre_place_approach"), (location.post_place_retreat, "post_place_retreat")],
            [(location.post_place_posture, "post_place_posture")],
        )
        state = scene.state
        target = hand_pose(scene, location.place_pose)
        if not goal.place_eef:  # the pose is where the object goes; the hand is where it holds it
            target = target * state.pose(body.id).inverse() * state.pose(link)
        links = sorted({*(self.context.model.group(hand).links if hand else ()), link})
        support = [goal.support_surface_name] if goal.support_surface_name else []
        others = [*goal.allowed_touch_objects, *location.allowed_touch_objects]
        gripper = allowing(links, [body.id, *others, *(support if goal.allow_gripper_support_collision else [])])
        standing = allowing([body.id], [*support, *others, *body.touch_links])

        def both(matrix) -> None:
            gripper(matrix)
            standing(matrix)

        posture = location.post_place_posture
        if not posture.points and body.detach_posture is not None:
            posture = body.detach_posture
        return Task(
            arm,
            link,
            hand,
            target,
            location.pre_place_approach,
            location.post_place_retreat,
            type(posture)(),
            posture,
            both,
            both,
            lambda other: other.detach_object(body.id),
            lambda: self._detach(body.id, body.link),
        )

    def _detach(self, name: str, link: str) -> bool:
        message = AttachedCollisionObject(link_name=link)
        message.object.id, message.object.operation = name, CollisionObject.REMOVE
        return self.context.monitor.process_attached(message)

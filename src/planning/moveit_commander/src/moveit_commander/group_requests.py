"""The goals that a MoveGroupCommander sends, and what it asks services for."""

from __future__ import annotations

import time
from collections.abc import Sequence

import rospy
from moveit_core.errors import code_name
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    ExecuteTrajectoryAction,
    ExecuteTrajectoryGoal,
    MotionPlanRequest,
    MoveGroupAction,
    MoveGroupGoal,
    MoveGroupResult,
    MoveItErrorCodes,
    PickupAction,
    PickupGoal,
    PlaceAction,
    PlaceGoal,
    PlanningOptions,
    RobotState,
    RobotTrajectory,
    TrajectoryConstraints,
)
from moveit_msgs.srv import GetCartesianPath, GetCartesianPathRequest, QueryPlannerInterfaces
from moveit_ros_planning import robot_model
from std_msgs.msg import String

from .session import Action, Session, publish
from .targets import Targets


class GroupRequests:
    """Settings of one group, and its conversation with move_group. Times in s."""

    def __init__(self, session: Session, group: str, targets: Targets):
        self.session = session
        self.group = group
        self.targets = targets
        self.planning_time = 5.0
        self.attempts = 1
        self.planner_id = ""
        self.pipeline_id = ""
        self.velocity, self.acceleration = robot_model.scaling_factors(session.description)
        self.start_state: RobotState | None = None
        self.path_constraints: Constraints | None = None
        self.trajectory_constraints: TrajectoryConstraints | None = None
        self.workspace: tuple[float, ...] = (0.0,) * 6  # low x, y, z, high x, y, z
        self.replan = False
        self.look = False
        self.replan_delay = 2.0
        self.speed_link, self.speed = "", 0.0
        self.support_surface = ""
        self.end_effector = ""
        self._move = Action(session.name("move_group"), MoveGroupAction)
        self._execute = Action(session.name("execute_trajectory"), ExecuteTrajectoryAction)
        self._pick: Action | None = None
        self._place: Action | None = None
        self._stop = rospy.Publisher(session.name("trajectory_execution_event"), String, queue_size=1)
        self._attach = rospy.Publisher(session.name("attached_collision_object"), AttachedCollisionObject, queue_size=10)

    def wait(self, seconds: float) -> None:
        """Wait for the servers (wall seconds; 0: for ever).

        :raises RuntimeError: they did not come.
        """
        end = time.monotonic() + seconds
        for action in (self._move, self._execute):
            left = max(0.01, end - time.monotonic()) if seconds > 0 else 0.0
            if not action.wait(left):
                raise RuntimeError(
                    f"Unable to connect to move_group action server '{rospy.resolve_name(action.name)}' "
                    f"within allotted "
                    f"time ({seconds:g}s): is move_group running (its launch file says 'You can start "
                    f"planning now!')?"
                )

    # --- requests ---

    def request(self) -> MotionPlanRequest:
        """What is asked of the planner now."""
        message = MotionPlanRequest(
            group_name=self.group,
            num_planning_attempts=self.attempts,
            planner_id=self.planner_id,
            pipeline_id=self.pipeline_id,
            allowed_planning_time=self.planning_time,
            max_velocity_scaling_factor=self.velocity,
            max_acceleration_scaling_factor=self.acceleration,
            cartesian_speed_limited_link=self.speed_link,
            max_cartesian_speed=self.speed,
        )
        low, high = message.workspace_parameters.min_corner, message.workspace_parameters.max_corner
        (low.x, low.y, low.z), (high.x, high.y, high.z) = self.workspace[:3], self.workspace[3:]
        message.workspace_parameters.header.frame_id = self.session.model.frame
        message.workspace_parameters.header.stamp = rospy.Time.now()
        message.start_state = self.start_state if self.start_state is not None else RobotState(is_diff=True)
        message.goal_constraints = self.targets.constraints()
        if self.path_constraints is not None:
            message.path_constraints = self.path_constraints
        if self.trajectory_constraints is not None:
            message.trajectory_constraints = self.trajectory_constraints
        return message

    def _options(self, plan_only: bool) -> PlanningOptions:
        options = PlanningOptions(
            plan_only=plan_only,
            look_around=self.look and not plan_only,
            replan=self.replan and not plan_only,
            replan_delay=self.replan_delay,
        )
        options.planning_scene_diff.is_diff = True
        options.planning_scene_diff.robot_state.is_diff = True
        return options

    def _goal(self, plan_only: bool) -> MoveGroupGoal:
        return MoveGroupGoal(request=self.request(), planning_options=self._options(plan_only))

    def plan(self):
        """The MoveGroupResult of planning; with FAILURE when move_group does not answer."""
        result = self._move.call(self._goal(True))
        if result is None:
            return MoveGroupResult(error_code=MoveItErrorCodes(MoveItErrorCodes.FAILURE))
        self._tell("Planning", result.error_code.val, self._move)
        return result

    def move(self, wait: bool) -> bool:
        """Plan and execute; True when it succeeded (or, without ``wait``, was sent)."""
        self.session.outlast_stop()
        goal = self._goal(False)
        if not wait:
            self._move.send(goal)
            return True
        result = self._move.call(goal)
        return result is not None and self._tell("Moving", result.error_code.val, self._move)

    def execute(self, trajectory: RobotTrajectory, wait: bool) -> bool:
        """Execute a ``trajectory``; True when it has ended well or, without ``wait``, at once."""
        self.session.outlast_stop()
        goal = ExecuteTrajectoryGoal(trajectory=trajectory)
        if not wait:
            self._execute.send(goal)
            return True
        result = self._execute.call(goal)
        return result is not None and self._tell("Execution", result.error_code.val, self._execute)

    @staticmethod
    def _tell(what: str, code: int, action: Action) -> bool:
        if code == MoveItErrorCodes.SUCCESS:
            return True
        name, text = code_name(code), action.text()
        rospy.logwarn("%s failed: %s", what, text if text.startswith(name) else f"{name}: {text}" if text else name)
        return False

    def stop(self) -> None:
        """Stop what moves, or was told to."""
        publish(self._stop, String("stop"), 1.0)
        self.session.note_stop()

    # --- services ---

    def call(self, name: str, kind: type, request):
        """Call the service ``name`` of move_group, of class ``kind``, with ``request``.

        :return: its response; None (and an error line) when it cannot be reached within 5 s.
        """
        full = self.session.name(name)
        try:
            rospy.wait_for_service(full, timeout=5.0)
            return rospy.ServiceProxy(full, kind)(request)
        except (rospy.ROSException, rospy.ServiceException) as error:
            rospy.logerr("service %s does not answer: %s", rospy.resolve_name(full), error)
            return None

    def interface(self):
        """The PlannerInterfaceDescription of the planner; None if unknown."""
        response = self.call("query_planner_interface", QueryPlannerInterfaces, QueryPlannerInterfaces._request_class())
        return response.planner_interfaces[0] if response is not None and response.planner_interfaces else None

    def default_pipeline(self) -> str:
        """The pipeline that move_group uses when none is named."""
        node = self.session.name("move_group").rstrip("/")
        return rospy.get_param(f"{node}/default_planning_pipeline", "")

    def cartesian(self, waypoints: Sequence, step: float, jump: float, avoid: bool, constraints: Constraints | None, frame: str, link: str):
        """The response of compute_cartesian_path; None if it does not answer.

        :param waypoints: poses of ``link`` in ``frame``. :param step: m between two points.
        :param jump: as GetCartesianPath's ``jump_threshold``. :param avoid: collisions. :param constraints: to be kept all the way.
        """
        request = GetCartesianPathRequest(
            group_name=self.group,
            waypoints=list(waypoints),
            max_step=step,
            jump_threshold=jump,
            avoid_collisions=avoid,
            link_name=link,
            cartesian_speed_limited_link=self.speed_link,
            max_cartesian_speed=self.speed,
        )
        request.header.frame_id, request.header.stamp = frame, rospy.Time.now()
        request.start_state = self.start_state if self.start_state is not None else RobotState(is_diff=True)
        if constraints is not None:
            request.path_constraints = constraints
        return self.call("compute_cartesian_path", GetCartesianPath, request)

    # --- objects ---

    def attach(self, name: str, link: str, touch_links: Sequence[str]) -> bool:
        """Ask move_group to attach the object ``name`` of the scene to ``link``, where it may touch ``touch_links`` (none: that link)."""
        message = AttachedCollisionObject(link_name=link, touch_links=list(touch_links) or [link])
        message.object.id, message.object.operation = name, CollisionObject.ADD
        publish(self._attach, message)
        return True

    def detach(self, name: str, links: Sequence[str]) -> bool:
        """Ask move_group to detach ``name``, an object or a link with all that it bears; "" is what ``links`` bear."""
        targets: list[AttachedCollisionObject] = []
        if name and self.session.model.has_link(name):
            targets.append(AttachedCollisionObject(link_name=name))
        elif name:
            targets.append(AttachedCollisionObject(object=CollisionObject(id=name)))
        else:
            targets += [AttachedCollisionObject(link_name=link) for link in links]
        for message in targets:
            message.object.operation = CollisionObject.REMOVE
            publish(self._attach, message)
        return bool(targets)

    def pick(self, name: str, grasps: Sequence, plan_only: bool) -> int:
        """Pick the object ``name`` by one of ``grasps`` (none: move_group finds some), with ``plan_only`` without moving; the error
        code.
        """
        goal = PickupGoal(
            target_name=name,
            group_name=self.group,
            end_effector=self._effector(),
            support_surface_name=self.support_surface,
            possible_grasps=list(grasps),
            allowed_planning_time=self.planning_time,
            planner_id=self.planner_id,
            planning_options=self._options(plan_only),
            allow_gripper_support_collision=bool(self.support_surface),
        )
        if self.path_constraints is not None:
            goal.path_constraints = self.path_constraints
        self._pick = self._pick or Action(self.session.name("pickup"), PickupAction)
        return self._manipulate(self._pick, goal, "Pick")

    def place(self, name: str, locations: Sequence, plan_only: bool) -> int:
        """Place the attached object ``name`` at one of ``locations``, with ``plan_only`` without moving; the error code."""
        goal = PlaceGoal(
            attached_object_name=name,
            group_name=self.group,
            place_locations=list(locations),
            support_surface_name=self.support_surface,
            allowed_planning_time=self.planning_time,
            planner_id=self.planner_id,
            planning_options=self._options(plan_only),
            allow_gripper_support_collision=bool(self.support_surface),
        )
        if self.path_constraints is not None:
            goal.path_constraints = self.path_constraints
        self._place = self._place or Action(self.session.name("place"), PlaceAction)
        return self._manipulate(self._place, goal, "Place")

    def _manipulate(self, action: Action, goal, what: str) -> int:
        if not action.wait(5.0):
            rospy.logerr("%s action server not connected: %s", what, rospy.resolve_name(action.name))
            return MoveItErrorCodes.FAILURE
        self.session.outlast_stop()
        result = action.call(goal)
        if result is None:
            return MoveItErrorCodes.FAILURE
        self._tell(what, result.error_code.val, action)
        return result.error_code.val

    def _effector(self) -> str:
        """Name of the end effector that hangs on this group's tip."""
        attached = self.session.model.group(self.group).attached_end_effectors
        return attached[0] if attached else ""

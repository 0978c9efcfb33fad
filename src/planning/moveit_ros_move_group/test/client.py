"""What the tests of move_group ask it with."""

import threading

import actionlib
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from moveit_msgs.msg import (
    CollisionObject,
    Constraints,
    JointConstraint,
    MotionPlanRequest,
    MoveGroupAction,
    MoveGroupGoal,
    PlanningScene,
    RobotState,
)
from moveit_msgs.srv import ApplyPlanningScene, GetMotionPlan
from shape_msgs.msg import SolidPrimitive

PATIENCE = 60.0  # s, for a busy machine
JOINTS = [f"joint_{number}" for number in range(1, 7)]
HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]
LEFT = [1.2, -0.6, 1.6, 0.0, 1.0, 0.0]


def call(name, kind, *arguments):
    """The answer of a service."""
    rospy.wait_for_service(name, timeout=PATIENCE)
    return rospy.ServiceProxy(name, kind)(*arguments)


def joint_goal(values, names=JOINTS):
    """Goal constraints of joint values."""
    return Constraints(joint_constraints=[JointConstraint(name, value, 1e-4, 1e-4, 1.0) for name, value in zip(names, values)])


def request(values=None, **fields):
    """A MotionPlanRequest for the arm, to joint values."""
    message = MotionPlanRequest(
        group_name="manipulator",
        allowed_planning_time=5.0,
        num_planning_attempts=1,
        start_state=RobotState(is_diff=True),
        max_velocity_scaling_factor=1.0,
        max_acceleration_scaling_factor=1.0,
    )
    message.goal_constraints = [joint_goal(values)] if values is not None else []
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def plan(*arguments, **fields):
    """The MotionPlanResponse of plan_kinematic_path."""
    return call("plan_kinematic_path", GetMotionPlan, request(*arguments, **fields)).motion_plan_response


def pose(x=0.0, y=0.0, z=0.0):
    return Pose(Point(x, y, z), Quaternion(0, 0, 0, 1))


def box(name, x, y, z, size=(0.1, 0.1, 0.1)):
    """An ADD message of a box."""
    return CollisionObject(id=name, primitives=[SolidPrimitive(SolidPrimitive.BOX, list(size))], pose=pose(x, y, z))


def apply(*objects, **fields):
    """Apply a diff to the scene."""
    diff = PlanningScene(is_diff=True)
    diff.robot_state.is_diff = True
    diff.world.collision_objects = list(objects)
    for name, value in fields.items():
        setattr(diff, name, value)
    return call("apply_planning_scene", ApplyPlanningScene, diff).success


def clear():
    """Remove all objects."""
    apply(CollisionObject(operation=CollisionObject.REMOVE))


class Goal:
    """A goal of an action on its way."""

    def __init__(self, name, kind, goal):
        self._client = actionlib.ActionClient(name, kind)
        if not self._client.wait_for_server(rospy.Duration(PATIENCE)):
            raise AssertionError(f"no action server {name}")
        self.states, self._done = [], threading.Event()
        self._handle = self._client.send_goal(goal, self._changed, lambda _handle, feedback: self.states.append(feedback.state))

    def _changed(self, handle):
        if handle.get_comm_state() == actionlib.CommState.DONE:
            self._done.set()

    def cancel(self):
        self._handle.cancel()

    def result(self):
        """(status, result, text) of its end."""
        if not self._done.wait(PATIENCE):
            raise AssertionError("the goal does not end")
        return self._handle.get_goal_status(), self._handle.get_result(), self._handle.get_goal_status_text()


def move(values, plan_only=False, **fields):
    """A goal of the action move_group."""
    goal = MoveGroupGoal(request=request(values, **fields))
    goal.planning_options.plan_only = plan_only
    goal.planning_options.planning_scene_diff.is_diff = True
    goal.planning_options.planning_scene_diff.robot_state.is_diff = True
    return Goal("move_group", MoveGroupAction, goal)


def wait_until(condition, what):
    """Wait until ``condition()`` holds."""
    end = rospy.get_time() + PATIENCE
    while not condition():
        if rospy.get_time() > end:
            raise AssertionError(f"waited in vain for {what}")
        rospy.sleep(0.02)

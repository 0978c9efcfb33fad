"""What the clients of one process share: the robot and its current state, per description and namespace."""

from __future__ import annotations

import threading
import time

import actionlib
import motion
import rospy
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from moveit_core import action_links
from moveit_core.scene_messages import attach_to_state
from moveit_msgs.msg import PlanningSceneComponents
from moveit_msgs.srv import GetPlanningScene, GetPlanningSceneRequest
from moveit_ros_planning import robot_model
from moveit_ros_planning.state_monitor import CurrentStateMonitor
from rosgraph.names import ns_join

from .roscpp_initializer import ensure_node

#: wall s: a goal that comes to move_group this soon after a stop may have been sent before it
_STOP_HOLDS = 0.1
_sessions: dict[tuple[str, str], Session] = {}
_lock = threading.Lock()


class Session:
    """The robot of one description, and where its move_group is."""

    def __init__(self, description: str, ns: str):
        self.ns = ns
        try:
            self.description = robot_model.load(description, meshes=False, own_namespace=None)
        except robot_model.DescriptionError as error:
            raise RuntimeError(str(error)) from error
        self.model: motion.RobotModel = self.description.model
        self._monitor: CurrentStateMonitor | None = None
        self._listener: tf2_ros.TransformListener | None = None
        self._stopped = -_STOP_HOLDS

    def name(self, relative: str) -> str:
        """``relative`` in the namespace of the move_group."""
        return ns_join(self.ns, relative) if self.ns else relative

    def note_stop(self) -> None:
        """A stop has just been sent."""
        self._stopped = time.monotonic()

    def outlast_stop(self) -> None:
        """Wait until a stop that this process has sent cannot be taken for one of the motion that it asks for next."""
        time.sleep(max(0.0, self._stopped + _STOP_HOLDS - time.monotonic()))

    @property
    def monitor(self) -> CurrentStateMonitor:
        """Listens from the first use on."""
        with _lock:
            if self._monitor is None:
                self._monitor = CurrentStateMonitor(self.model, self._frames(), self.name("joint_states"))
            return self._monitor

    def _frames(self) -> tf2_ros.Buffer | None:
        """TF, which says where a planar or floating base stands; None for robots without one."""
        if not any(self.model.joint(name).type in ("planar", "floating") for name in self.model.active_joints):
            return None
        buffer = tf2_ros.Buffer(rospy.Duration(10.0), debug=False)
        self._listener = tf2_ros.TransformListener(buffer)
        return buffer

    def state(self, timeout: float = 1.0) -> motion.RobotState | None:
        """The state now; None (and an error line saying why) when none newer than this call comes within ``timeout``
        wall s."""
        monitor, now = self.monitor, rospy.Time.now()
        if not monitor.wait_for_current(now, timeout):
            rospy.logerr("Failed to fetch current robot state. %s", monitor.explain(timeout, now))
            return None
        return monitor.state()

    def hold(self, state: motion.RobotState) -> motion.RobotState:
        """``state``, holding what move_group says that the robot holds: its things are frames then, their subframes, too."""
        wanted = GetPlanningSceneRequest(PlanningSceneComponents(PlanningSceneComponents.ROBOT_STATE_ATTACHED_OBJECTS))
        try:
            answer = rospy.ServiceProxy(self.name("get_planning_scene"), GetPlanningScene)(wanted)
            attach = attach_to_state(motion.PlanningScene(self.model))
            for held in answer.scene.robot_state.attached_collision_objects:
                attach(state, held)
        except (rospy.ServiceException, rospy.ROSException, ValueError) as error:
            rospy.logerr("What the robot holds is not known: %s", error)
        return state


def session(description: str, ns: str = "") -> Session:
    """The session of ``description``, a parameter's name, and the namespace ``ns`` of move_group, made at the first call.

    :raises RuntimeError: the robot cannot be loaded.
    """
    ensure_node()
    key = (robot_model.resolve(description), ns)
    with _lock:
        found = _sessions.get(key)
    if found is None:
        found = Session(description, ns)
        with _lock:
            found = _sessions.setdefault(key, found)
    return found


class Action:
    """A client of one action: waits in wall time, so that a stopped simulation cannot make it wait for ever."""

    def __init__(self, name: str, kind: type):
        self.name = name
        self._client = actionlib.ActionClient(name, kind)
        self._goal: actionlib.ClientGoalHandle | None = None

    def connected(self) -> bool:
        """Whether a server is there."""
        return action_links.is_connected(self._client)

    def wait(self, timeout: float) -> bool:
        """Wait up to ``timeout`` wall seconds (0: for ever) for the server."""
        end = time.monotonic() + timeout if timeout > 0 else float("inf")
        while not self.connected():
            if time.monotonic() > end or rospy.is_shutdown():
                return False
            time.sleep(0.01)
        return True

    def send(self, goal) -> threading.Event:
        """Send a goal and return; the event is set at its end."""
        done = threading.Event()

        def changed(handle: actionlib.ClientGoalHandle) -> None:
            if handle.get_comm_state() == actionlib.CommState.DONE:
                done.set()

        self._goal = self._client.send_goal(goal, changed)
        return done

    def call(self, goal):
        """Send a goal and wait for its result; None when the server is gone or the program ends."""
        done, gone = self.send(goal), 0.0
        while not done.wait(0.05):
            if rospy.is_shutdown():
                return None
            gone = gone + 0.05 if not self.connected() else 0.0
            if gone > 2.0:
                rospy.logerr("the action server %s has gone away", rospy.resolve_name(self.name))
                return None
        return self._goal.get_result() if self._goal is not None else None

    def text(self) -> str:
        """What the server said about the last goal, unless it succeeded."""
        if self._goal is None or self._goal.get_goal_status() == GoalStatus.SUCCEEDED:
            return ""
        return " ".join(self._goal.get_goal_status_text().split())


def publish(publisher: rospy.Publisher, message, patience: float = 5.0) -> None:
    """Publish ``message`` once somebody listens, or after ``patience`` wall seconds: what is sent before is lost. To a publisher that
    was closed and made again, rospy comes back half a second, one and two seconds after it has noticed.
    """
    end = time.monotonic() + patience
    while publisher.get_num_connections() == 0 and time.monotonic() < end and not rospy.is_shutdown():
        time.sleep(0.01)
    publisher.publish(message)

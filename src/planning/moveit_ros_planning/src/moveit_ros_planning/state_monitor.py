"""The current state of the robot, from joint states and TF, and what is wrong when it is not known."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

import motion
import numpy as np
import rosgraph
import rospy
from moveit_core import convert, states
from moveit_core.errors import one_line
from sensor_msgs.msg import JointState

from . import _execution  # type: ignore[attr-defined]  # compiled


class CurrentStateMonitor:
    """Listens to joint states (and TF, for joints with several variables); the newest value of each joint counts.

    :param tf_buffer: a tf2 buffer, for planar and floating joints.
    """

    def __init__(self, model: motion.RobotModel, tf_buffer=None, topic: str = "joint_states", dynamics: bool = False):
        self._model = model
        self._buffer = tf_buffer
        self._lock = threading.Lock()
        self._news = threading.Condition(self._lock)
        self._state = model.state()
        self._stamps: dict[str, rospy.Time] = {}
        self._told: set[str] = set()
        self._dynamics = dynamics
        self._callbacks: list[Callable[[], None]] = []
        single = set(states.one_variable_joints(model))
        self._single = {name for name in single if model.joint(name).mimic is None}
        self._index = {name: model.variable_index(name) for name in self._single}
        self._multi = [name for name in model.active_joints if model.joint(name).type in ("planar", "floating")]
        self._bounds = {name: model.joint(name).limits[0] for name in self._single}
        self.topic = rospy.resolve_name(topic)
        self._subscriber = rospy.Subscriber(topic, JointState, self._received, queue_size=25)

    def shutdown(self) -> None:
        """Stop listening."""
        self._subscriber.unregister()

    def on_update(self, callback: Callable[[], None]) -> None:
        """Call ``callback()`` after every joint state that said something new."""
        self._callbacks.append(callback)

    def _received(self, message: JointState) -> None:
        if len(message.name) != len(message.position):
            rospy.logerr_throttle(
                1,
                "State monitor received invalid joint state (number of joint names does not match "
                "number of "
                f"positions): {len(message.name)} names, {len(message.position)} positions on "
                f"{self.topic}",
            )
            return
        stamp = message.header.stamp
        if stamp.is_zero():
            rospy.logwarn_once("joint states on %s carry no time; the time of their arrival is used instead", self.topic)
            stamp = rospy.Time.now()
        with self._lock:
            changed = self._take(message, stamp)
            self._news.notify_all()
        if changed:
            for callback in self._callbacks:
                callback()

    def _take(self, message: JointState, stamp: rospy.Time) -> bool:
        now = rospy.Time.now()
        values = {}
        for i, name in enumerate(message.name):
            if name not in self._single:
                continue  # of another robot
            if not np.isfinite(message.position[i]):
                rospy.logerr_throttle(5, f"joint '{name}' has the position {message.position[i]} on {self.topic}: ignored")
                continue
            if not self._is_news(name, stamp, now):
                continue
            self._stamps[name] = stamp
            values[name] = self._bounded(name, message.position[i])
        if not values:
            return False
        changed = any(self._state.positions[self._index[name]] != value for name, value in values.items())
        self._state.set(values)
        if self._dynamics:
            self._take_dynamics(message, values)
        return changed

    def _is_news(self, name: str, stamp: rospy.Time, now: rospy.Time) -> bool:
        """Whether the stamp is that of a state to be taken. Where time jumped back, what is known is forgotten first."""
        known = self._stamps.get(name)
        if known is None:
            return True
        order = _execution.stamp_order(known.to_sec(), stamp.to_sec(), now.to_sec())
        if order == _execution.StampOrder.JUMPED_BACK:
            rospy.logwarn("New joint state for joint '%s' is not newer than the previous state. Assuming your rosbag looped.", name)
            self._stamps.clear()
        return order != _execution.StampOrder.REPEATED

    def _bounded(self, name: str, value: float) -> float:
        """Values a rounding error beyond a limit are put on the limit, so that the state is not refused for it."""
        limit = self._bounds[name]
        if limit.has_position and limit.min_position - 1e-9 <= value <= limit.max_position + 1e-9:
            return min(max(value, limit.min_position), limit.max_position)
        return value

    def _take_dynamics(self, message: JointState, values) -> None:
        for field, values_of in (("velocities", message.velocity), ("efforts", message.effort)):
            if len(values_of) == len(message.name):
                array = (
                    np.array(getattr(self._state, field))
                    if getattr(self._state, field) is not None
                    else np.zeros(len(self._model.variables))
                )
                for i, name in enumerate(message.name):
                    if name in values:
                        array[self._index[name]] = values_of[i]
                setattr(self._state, field, array)

    # --- asking ---

    def state(self) -> motion.RobotState:
        """A copy of what is known now; joints not heard of have their default."""
        with self._lock:
            self._look_up_multi_dof()
            return self._state.copy()

    def _look_up_multi_dof(self) -> dict[str, str]:
        """Take the joints with several variables from TF; for each that cannot be, why."""
        failed = {}
        for name in self._multi if self._buffer is not None else ():
            joint = self._model.joint(name)
            parent = joint.parent_link or self._model.frame
            try:
                found = self._buffer.lookup_transform(parent, joint.child_link, rospy.Time(0))
                pose = convert.pose(found.transform, f"joint '{name}'")
            except Exception as error:  # tf2 has many kinds; none of them may stop the monitor
                failed[name] = f"from '{parent}' to '{joint.child_link}': {one_line(error)}"
                continue
            states.set_multi_dof(self._state, name, pose)
            self._stamps[name] = found.header.stamp
        return failed

    def missing(self, since: rospy.Time | None = None, group: str = "") -> list[str]:
        """Joints never heard of, or (``since``) not newer than that; of one group or of the whole robot."""
        wanted = self._wanted(group)
        with self._lock:
            return [name for name in wanted if name not in self._stamps or (since is not None and self._stamps[name] < since)]

    def _frames_missing(self, group: str) -> dict[str, str]:
        """Joints with several variables that TF has never told of, and why, but for those that were waited for already."""
        names = self._model.group(group).active_joints if group else self._multi
        with self._lock:
            failed = self._look_up_multi_dof()
            known = {*self._stamps, *self._told}
            return {name: why for name, why in failed.items() if name in names and name not in known}

    def _wanted(self, group: str) -> list[str]:
        names = self._model.group(group).active_joints if group else self._model.active_joints
        passive = set(self._model.passive_joints)
        return [name for name in names if name in self._single and name not in passive]

    def wait_for_current(self, since: rospy.Time | None = None, timeout: float = 1.0, group: str = "") -> bool:
        """Wait until every joint of ``group`` ("": all) was heard of at ``since`` (default: now) or later; ``timeout`` in wall seconds.

        Joints that nobody publishes are waited for once and told of; from then on they have their default values, and
        the state is current without them.
        """
        since = rospy.Time.now() if since is None else since
        end = time.monotonic() + timeout
        while True:
            late = [name for name in self.missing(since, group) if name not in self._told or name in self._stamps]
            frames = self._frames_missing(group)
            if not late and not frames:
                return True
            left = end - time.monotonic()
            if left <= 0 or rospy.is_shutdown():
                for name, why in frames.items():
                    rospy.logwarn(
                        "Unable to update multi-DOF joint '%s': TF has no transform %s. It is taken to be where a state begins by default",
                        name,
                        why,
                    )
                self._told.update(frames)
                heard = any(name in self._stamps for name in self._single)
                return not late or (heard and self._excuse(late))
            with self._lock:
                self._news.wait(min(left, 0.05))

    def _excuse(self, late: list[str]) -> bool:
        """Whether ``late`` are joints never heard of, which are told of once, while the others are current."""
        if any(name in self._stamps for name in late):
            return False
        rospy.logwarn("Nobody publishes the %s on %s: taken to be where a state begins by default", _names(late), self.topic)
        self._told.update(late)
        return True

    def wait_for_next(self, joints: Sequence[str], timeout: float = 1.0) -> bool:
        """Wait (up to ``timeout`` wall seconds) until each of ``joints`` was heard of anew."""
        end = time.monotonic() + timeout
        with self._lock:
            before = {name: self._stamps.get(name) for name in joints if name in self._single}
            while any(self._stamps.get(name) == stamp for name, stamp in before.items()):
                left = end - time.monotonic()
                if left <= 0 or rospy.is_shutdown():
                    return False
                self._news.wait(min(left, 0.05))
        return True

    def explain(self, timeout: float = 1.0, since: rospy.Time | None = None) -> str:
        """Why the state is not current: which joints are missing or older than ``since`` (default: now), who publishes, whose clock is
        another.

        :param timeout: wall seconds that were waited, for the text.
        """
        since = rospy.Time.now() if since is None else since
        text = f"Didn't receive robot state (joint angles) with recent timestamp within {timeout:g} seconds. "
        never, late = self.missing(), self.missing(since)
        publishers = self._publishers()
        if publishers == []:
            others = self._other_topics()
            if others:
                return (
                    text + f"Nobody publishes {self.topic}, but there is {' and '.join(others[:3])}: remap it "
                    f"(joint_states:={others[0]} on the command line)"
                )
            return text + f"Nobody publishes {self.topic}: start the robot, its joint_state_controller or joint_state_publisher"
        by = f" ({self.topic} comes from {', '.join(publishers)})" if publishers else ""
        if never:
            return text + f"Never heard of {_names(never)}{by}"
        with self._lock:
            oldest = min(late, key=lambda name: self._stamps[name], default=None)
            behind = (rospy.Time.now() - self._stamps[oldest]).to_sec() if oldest else 0.0
        if abs(behind) > 1e6:
            mode = "simulated (/use_sim_time is true)" if rospy.get_param("/use_sim_time", False) else "wall time"
            return text + (
                f"The stamps of {_names(late)} and the clock of this node, which is {mode}, are not of the "
                f"same kind: start "
                f"both with the same /use_sim_time{by}"
            )
        return text + (
            f"Newest value of {_names(late)} is {behind:.2f} s old{by}. Check clock synchronization if you "
            f"are running "
            f"ROS across multiple machines"
        )

    def _publishers(self) -> list[str] | None:
        try:
            published = rosgraph.Master(rospy.get_name()).getSystemState()[0]
        except (OSError, rosgraph.MasterException):
            return None
        return sorted(next((nodes for topic, nodes in published if topic == self.topic), []))

    def _other_topics(self) -> list[str]:
        """Where joint states are published instead; not what move_group pretends for a joint_state_publisher."""
        master = rosgraph.Master(rospy.get_name())
        try:
            published = {topic for topic, nodes in master.getSystemState()[0] if nodes}
            states = {topic for topic, kind in master.getTopicTypes() if kind == JointState._type}
        except (OSError, rosgraph.MasterException):
            return []
        return sorted(topic for topic in states & published if not topic.endswith("/fake_controller_joint_states"))


def _names(names: list[str]) -> str:
    shown = ", ".join(f"'{name}'" for name in names[:6])
    return ("joint " if len(names) == 1 else "joints ") + shown + (f" and {len(names) - 6} more" if len(names) > 6 else "")

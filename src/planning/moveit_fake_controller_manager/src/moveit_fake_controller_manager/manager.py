"""Controllers that only publish the joint states which a robot would have, for joint_state_publisher's source_list."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import rospy
from moveit_core.controller_manager import Completion, ControllerHandle, ExecutionStatus
from moveit_msgs.msg import RobotTrajectory
from moveit_simple_controller_manager.manager import ListedControllers, read_controller_list
from node_signals.parameters import number_or
from sensor_msgs.msg import JointState

_LAST_POINT_TIME = 0.5


class FakeHandle(ControllerHandle):
    """Moves its joints at once or along the trajectory, by its type: ``interpolate``, ``via points`` or ``last
    point``."""

    def __init__(self, name: str, joints: Sequence[str], publisher: rospy.Publisher, kind: str, rate: float):
        super().__init__(name)
        self.joints = list(joints)
        self._publisher = publisher
        self._kind = kind
        self._rate = rate
        self._completion = Completion()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    def send(self, trajectory: RobotTrajectory) -> bool:
        self.cancel()
        if self._thread is not None:
            self._thread.join(1.0)
        self._stop, self._completion = threading.Event(), Completion()
        self._completion.begin()
        run = {"interpolate": self._interpolate, "via points": self._via_points, "last point": self._last_point}[self._kind]
        self._thread = threading.Thread(
            target=self._run, args=(run, trajectory.joint_trajectory, self._stop, self._completion), name=self.name, daemon=True
        )
        rospy.loginfo("Fake execution of trajectory")
        self._thread.start()
        return True

    def _run(self, run, trajectory, stop, completion) -> None:
        if trajectory.points:
            run(trajectory, stop)
        completion.finish(ExecutionStatus.PREEMPTED if stop.is_set() else ExecutionStatus.SUCCEEDED)
        rospy.logdebug("Fake execution of trajectory: done")

    def cancel(self) -> bool:
        self._stop.set()
        self._completion.finish(ExecutionStatus.PREEMPTED)
        return True

    def wait(self, timeout: float | None = None) -> bool:
        return self._completion.wait(timeout)

    @property
    def status(self) -> ExecutionStatus:
        return self._completion.status

    def _publish(self, names, positions, velocities=(), effort=()) -> None:
        message = JointState(name=list(names), position=list(positions), velocity=list(velocities), effort=list(effort))
        message.header.stamp = rospy.Time.now()
        self._publisher.publish(message)

    def _point(self, trajectory, point) -> None:
        self._publish(trajectory.joint_names, point.positions)

    def _last_point(self, trajectory, stop) -> None:
        self._point(trajectory, trajectory.points[-1])
        self._until(rospy.Time.now() + rospy.Duration(_LAST_POINT_TIME), stop)

    def _via_points(self, trajectory, stop) -> None:
        start = rospy.Time.now()
        for point in trajectory.points:
            if not self._until(start + point.time_from_start, stop):
                return
            self._point(trajectory, point)

    def _interpolate(self, trajectory, stop) -> None:
        start, period, index, points = rospy.Time.now(), 1.0 / self._rate, 0, trajectory.points
        end = points[-1].time_from_start.to_sec()
        step = 1
        while step * period < end:
            if not self._until(start + rospy.Duration.from_sec(step * period), stop):
                return
            now = (rospy.Time.now() - start).to_sec()
            step = max(step + 1, int(now / period) + 1)
            if now >= end:
                break
            while index + 1 < len(points) and points[index + 1].time_from_start.to_sec() <= now:
                index += 1
            self._between(trajectory, index, now)
        if self._until(start + points[-1].time_from_start, stop):
            self._point(trajectory, points[-1])

    def _between(self, trajectory, index: int, now: float) -> None:
        a = trajectory.points[index]
        b = trajectory.points[min(index + 1, len(trajectory.points) - 1)]
        span = (b.time_from_start - a.time_from_start).to_sec()
        share = (now - a.time_from_start.to_sec()) / span if span > 0 else 0.0
        self._publish(trajectory.joint_names, [x + (y - x) * share for x, y in zip(a.positions, b.positions)])

    @staticmethod
    def _until(when: rospy.Time, stop: threading.Event) -> bool:
        """Wait in ROS time; False when stopped."""
        while not rospy.is_shutdown():
            left = (when - rospy.Time.now()).to_sec()
            if left <= 0:
                return not stop.is_set()
            if stop.wait(min(left, 0.02)):
                return False
        return False


class FakeControllerManager(ListedControllers):
    """The controllers of ``controller_list``; all are active, whatever is asked."""

    def __init__(self, model, namespace: str = "~"):
        super().__init__(model, namespace)
        self._publisher = rospy.Publisher(namespace + "fake_controller_joint_states", JointState, queue_size=100, latch=True)
        name = namespace + "fake_interpolating_controller_rate"
        rate = number_or(name, rospy.get_param(name, 10.0), 10.0)
        for entry in read_controller_list(namespace):
            kind = str(entry.get("type", "last point"))
            if kind not in ("interpolate", "via points", "last point"):
                rospy.logerr(
                    "Unknown fake controller type: %s of '%s'; there are: interpolate, via points, last point. last point is used",
                    kind,
                    entry["name"],
                )
                kind = "last point"
            self.add(entry, FakeHandle(entry["name"], entry["joints"], self._publisher, kind, rate))
        self._initial()

    def _initial(self) -> None:
        """Publish the poses that ``initial`` names, so that the robot has a state before it moves."""
        values: dict[str, float] = {}
        state = self.model.state()
        entries = rospy.get_param(self.namespace + "initial", [])
        for entry in entries if isinstance(entries, list) else ():
            group, pose = (str(entry.get("group", "")), str(entry.get("pose", ""))) if isinstance(entry, dict) else ("", "")
            if not self.model.has_group(group):
                rospy.logwarn("initial: the robot has no group '%s'", group)
            elif not state.set_named(group, pose):
                rospy.logwarn(
                    "initial: group '%s' has no pose '%s'; it has: %s",
                    group,
                    pose,
                    ", ".join(self.model.group(group).named_states) or "none",
                )
            else:
                rospy.loginfo("Set joints of group '%s' to pose '%s'.", group, pose)
                for joint in self.model.group(group).named_state(pose):
                    if len(self.model.joint(joint).variables) == 1:
                        values[joint] = float(state.get_joint(joint)[0])
        if values:
            message = JointState(name=sorted(values), position=[values[joint] for joint in sorted(values)])
            message.header.stamp = rospy.Time.now()
            self._publisher.publish(message)

    def switch(self, activate: Sequence[str], deactivate: Sequence[str]) -> bool:
        return True

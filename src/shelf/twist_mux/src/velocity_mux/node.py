"""The node twist_mux: passes the twist of the source that has the word on to ``cmd_vel_out``."""

import threading

import diagnostic_updater
import node_signals
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool

from .choice import Lock, Source, chosen, lock_priority, read_inputs


class Mux:
    def __init__(self):
        self._mutex = threading.Lock()
        self._output = rospy.Publisher("cmd_vel_out", Twist, queue_size=1)
        self.sources = _inputs("topics", Source)
        self.locks = _inputs("locks", Lock, [])
        for source in self.sources:
            rospy.Subscriber(source.topic, Twist, self._take_twist, callback_args=source, queue_size=1)
        for lock in self.locks:
            rospy.Subscriber(lock.topic, Bool, self._take_lock, callback_args=lock, queue_size=1)

    def _take_twist(self, twist: Twist, source: Source) -> None:
        with self._mutex:
            source.stamp = now = rospy.get_time()
            if chosen(self.sources, self.locks, now) is source:
                self._output.publish(twist)

    def _take_lock(self, message: Bool, lock: Lock) -> None:
        with self._mutex:
            lock.stamp, lock.closed = rospy.get_time(), message.data

    def report(self, status):
        """Fill in a diagnostic status: who is masked, which lock is closed."""
        now = rospy.get_time()
        with self._mutex:
            priority = lock_priority(self.locks, now)
            status.summary(DiagnosticStatus.OK, "ok")
            for source in self.sources:
                status.add(f"velocity {source.name}", _row("masked" if source.masked(priority, now) else "unmasked", source))
            for lock in self.locks:
                status.add(f"lock {lock.name}", _row("locked" if lock.locked(now) else "free", lock))
            status.add("current priority", str(priority))
        return status


def _row(word: str, entry) -> str:
    return f" {word} (listening to {entry.topic} @ {entry.timeout:f}s with priority #{entry.priority})"


def _inputs(name: str, kind, default=None) -> list:
    """As upstream, a node whose parameters are wrong says so and goes on without them."""
    parameter = rospy.resolve_name("~" + name)
    try:
        value = rospy.get_param(parameter, default)
        if value is None:
            raise ValueError(f'parameter {parameter} is not set; load its file by <rosparam command="load"> inside the <node>')
        inputs = read_inputs(value, kind, parameter)
    except ValueError as error:
        rospy.logfatal("Error parsing params: %s", error)
        return []
    for entry in inputs:
        rospy.loginfo(
            "Topic handler '%s' subscribed to topic '%s': timeout = %s, priority = %d",
            entry.name,
            entry.topic,
            f"{entry.timeout:f}s" if entry.timeout else "None",
            entry.priority,
        )
    return inputs


def main() -> None:
    node_signals.init_node("twist_mux")
    mux = Mux()
    updater = diagnostic_updater.Updater()
    updater.setHardwareID("none")
    updater.add("Twist mux status", mux.report)
    timer = rospy.Timer(rospy.Duration(1.0), lambda _: updater.update(), reset=True)
    node_signals.spin()
    timer.shutdown()

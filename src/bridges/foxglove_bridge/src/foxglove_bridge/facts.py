"""What runs on this master, as a layout is made of it."""

from __future__ import annotations

import threading

import rosgraph
import rospy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from foxglove_bridge.layout import Running, described

_PATIENCE = 1.0  # wall s for a first message


class Facts:
    """Listens to transforms and joints from now on."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._parents: dict[str, str] = {}  # frame -> frame
        self._joints: dict[str, float] = {}
        self._orders: set[tuple[str, ...]] = set()
        self._velocities = False
        self._told = threading.Event()
        for topic in ("/tf", "/tf_static"):
            rospy.Subscriber(topic, TFMessage, self._transforms, queue_size=100)
        rospy.Subscriber("/joint_states", JointState, self._states, queue_size=10)

    def running(self) -> Running:
        """What there is now; a message of joints is waited for a little, where somebody publishes them."""
        master = rosgraph.Master(rospy.get_name())
        try:
            publishers, subscribers, _ = master.getSystemState()
            types = dict(master.getTopicTypes())
            urdf = rospy.get_param("/robot_description", "")
        except (rosgraph.MasterException, OSError):
            return Running()
        own = rospy.get_name()
        published = {name: types[name] for name, nodes in publishers if name in types and nodes != [own]}
        subscribed = {name: types[name] for name, nodes in subscribers if name in types and nodes != [own]}
        if "/joint_states" in published:
            self._told.wait(_PATIENCE)
        name, root, reach = described(urdf) if isinstance(urdf, str) and urdf else ("robot", "", 1.0)
        commands = [topic for topic, kind in subscribed.items() if kind == "trajectory_msgs/JointTrajectory"]
        with self._lock:
            return Running(
                name=name,
                frame=self._fixed(root),
                reach=reach,
                joints=dict(self._joints),
                one_order=len(self._orders) < 2,
                velocities=self._velocities,
                published=published,
                subscribed=subscribed,
                described=bool(urdf),
                moved={topic: joints for topic, joints in ((topic, _joints_of(topic)) for topic in commands) if joints},
            )

    def _fixed(self, frame: str) -> str:
        """What ``frame`` hangs from in the end, or any frame's, where it is ''."""
        frame = frame or next(iter(self._parents), "")
        for _ in range(len(self._parents)):
            frame = self._parents.get(frame, frame)
        return frame

    def _transforms(self, message: TFMessage) -> None:
        with self._lock:
            for each in message.transforms:
                self._parents[each.child_frame_id.lstrip("/")] = each.header.frame_id.lstrip("/")

    def _states(self, message: JointState) -> None:
        with self._lock:
            self._joints.update(zip(message.name, message.position))
            self._orders.add(tuple(message.name))
            self._velocities |= bool(message.velocity)
        self._told.set()


def _joints_of(topic: str) -> list[str]:
    """Of the controller that takes commands on ``topic``, by its parameters."""
    joints = rospy.get_param(topic.rsplit("/", 1)[0] + "/joints", [])
    return joints if isinstance(joints, list) and all(isinstance(name, str) for name in joints) else []

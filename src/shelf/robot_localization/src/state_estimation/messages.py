"""Messages as arrays and arrays as messages, and transforms between frames, as the nodes of this package use them."""

import numpy as np
import rospy
import tf2_ros

from .sensors import IDENTITY, FrameMissing, Transform, quaternion_matrix


def vector(message) -> np.ndarray:
    """(3,) of ``message``, a Vector3 or Point."""
    return np.array([message.x, message.y, message.z])


def transform(pose) -> Transform:
    """Of ``pose``, a message. :raises ValueError: its orientation is none"""
    turn = pose.orientation
    return Transform(quaternion_matrix(turn.x, turn.y, turn.z, turn.w), vector(pose.position))


def fill(message, values, names: str = "xyz") -> None:
    """Sets the fields ``names`` of ``message``, a letter each, to ``values``."""
    for name, value in zip(names, values):
        setattr(message, name, float(value))


def quaternion(turn: np.ndarray) -> np.ndarray:
    """(4,): x, y, z, w of ``turn``, a rotation matrix, w not below 0."""
    w = np.sqrt(max(0.0, 1 + turn[0, 0] + turn[1, 1] + turn[2, 2])) / 2
    if w > 1e-3:
        x, y, z = (turn[2, 1] - turn[1, 2]), (turn[0, 2] - turn[2, 0]), (turn[1, 0] - turn[0, 1])
        return np.array([x / (4 * w), y / (4 * w), z / (4 * w), w])
    values, axes = np.linalg.eigh(turn + turn.T)
    return np.append(axes[:, -1], 0.0)


class Lookup:
    """Callable: (target frame, source frame, stamp) -> Transform. Frames may have a slash in front.

    :param wait: rospy.Duration to wait for one of that stamp
    """

    def __init__(self, wait: rospy.Duration):
        self._wait = wait
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)

    def __call__(self, target: str, source: str, stamp) -> Transform:
        """:raises FrameMissing: there is none, neither then nor at any time"""
        target, source = target.lstrip("/"), source.lstrip("/")
        if target == source:
            return IDENTITY
        for when in (stamp, rospy.Time(0)):  # the newest there is, where that of the measurement is not there
            try:
                wait = self._wait if when is stamp else rospy.Duration(0)
                found = self._buffer.lookup_transform(target, source, when, wait)
                break
            except tf2_ros.TransformException as error:
                missing = error
        else:
            raise FrameMissing(f"no transform from {source} to {target}: {missing}; its measurements are left out until there is")
        turn, at = found.transform.rotation, found.transform.translation
        return Transform(quaternion_matrix(turn.x, turn.y, turn.z, turn.w), vector(at))

    def clear(self) -> None:
        """Forget what was before."""
        self._buffer.clear()


def every(period: float, work) -> rospy.Timer:
    """Calls ``work()`` each ``period`` s of ROS time, until the node ends."""

    def tick(_event) -> None:
        try:
            work()
        except rospy.ROSException:
            if not rospy.is_shutdown():  # topics close while the node ends
                raise

    return rospy.Timer(rospy.Duration(period), tick, reset=True)

"""Poses and transforms as lists, and messages as strings."""

from __future__ import annotations

import io
from collections.abc import Sequence

import rospy
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Transform, Vector3
from tf.transformations import quaternion_from_euler

from .exception import MoveItCommanderException


def msg_to_string(msg) -> bytes:
    """``msg``, serialised."""
    buffer = io.BytesIO()
    msg.serialize(buffer)
    return buffer.getvalue()


def msg_from_string(msg, data: bytes) -> None:
    """Fill ``msg`` from ``data``, its serialised form."""
    msg.deserialize(data)


def pose_to_list(pose_msg: Pose) -> list[float]:
    """[x, y, z, qx, qy, qz, qw] of ``pose_msg``."""
    at, turn = pose_msg.position, pose_msg.orientation
    return [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]


def list_to_pose(pose_list: Sequence[float]) -> Pose:
    """A Pose of ``pose_list``: [x, y, z, roll, pitch, yaw] or [x, y, z, qx, qy, qz, qw]; metres and radians.

    :raises MoveItCommanderException: another number of elements.
    """
    values = [float(value) for value in pose_list]
    if len(values) == 7:
        return Pose(Point(*values[:3]), Quaternion(*values[3:]))
    if len(values) == 6:
        return Pose(Point(*values[:3]), Quaternion(*quaternion_from_euler(*values[3:])))
    raise MoveItCommanderException(f"Expected either 6 or 7 elements in list: (x,y,z,r,p,y) or (x,y,z,qx,qy,qz,qw), not {len(values)}")


def list_to_pose_stamped(pose_list: Sequence[float], target_frame: str) -> PoseStamped:
    """A PoseStamped of ``pose_list`` (x y z m, then qx qy qz qw or roll pitch yaw in rad) in ``target_frame``, stamped now."""
    message = PoseStamped(pose=list_to_pose(pose_list))
    message.header.frame_id = target_frame
    message.header.stamp = rospy.Time.now()
    return message


def transform_to_list(trf_msg: Transform) -> list[float]:
    """[x, y, z, qx, qy, qz, qw] of ``trf_msg``."""
    at, turn = trf_msg.translation, trf_msg.rotation
    return [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]


def list_to_transform(trf_list: Sequence[float]) -> Transform:
    """A Transform of ``trf_list``: [x, y, z, qx, qy, qz, qw]."""
    values = [float(value) for value in trf_list]
    return Transform(Vector3(*values[:3]), Quaternion(*values[3:7]))

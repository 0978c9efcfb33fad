"""geometry_msgs to and from poses and vectors; frames named by entities."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point, Quaternion, Twist, Vector3
from geometry_msgs.msg import Pose as PoseMsg
from ode_sim import CollisionHandle, ModelHandle, math3
from ode_sim.description.model import FARTHEST, Pose, Vec3

from gazebo_ros.api.handlers import Refused, finite, worded

WORLD_NAMES = ("", "world", "map", "/map")  # when no entity has that name


def pose_msg(pose: Pose) -> PoseMsg:
    """``pose`` as geometry_msgs/Pose."""
    return PoseMsg(Point(*pose.p), Quaternion(*pose.q))


def pose_of(message: PoseMsg, what: str = "pose") -> Pose:
    """The pose in ``message``, its quaternion normalised; all zeros mean no rotation.

    :param what: it is, for the error
    :raises Refused: a number is not finite, or the place beyond what can be simulated
    """
    p, q = message.position, message.orientation
    finite(what, p.x, p.y, p.z, q.x, q.y, q.z, q.w)
    if max(abs(p.x), abs(p.y), abs(p.z)) > FARTHEST:
        raise Refused(f"{what} lies {max(abs(p.x), abs(p.y), abs(p.z)):g} m from the origin; stay within {FARTHEST:g} m")
    return Pose((p.x, p.y, p.z), math3.quat_normalize((q.x, q.y, q.z, q.w)))


def vector_of(message: Any, what: str) -> Vec3:
    """x, y, z of ``message``, a Vector3 or Point.

    :param what: it is, for the error
    :raises Refused: a number is not finite
    """
    finite(what, message.x, message.y, message.z)
    return (message.x, message.y, message.z)


def twist_msg(linear: Vec3, angular: Vec3) -> Twist:
    """A Twist of ``linear`` (m/s) and ``angular`` (rad/s)."""
    return Twist(Vector3(*linear), Vector3(*angular))


def entity_twist(entity: Any) -> tuple[Vec3, Vec3]:
    """(linear m/s, angular rad/s), world axes, of ``entity``: of a link handle at its origin; of a model, its first link's; of a
    collision, its link's.
    """
    if isinstance(entity, ModelHandle):
        link = entity.canonical_link
    else:
        link = entity.link if isinstance(entity, CollisionHandle) else entity
    if link is None:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    return link.linear_velocity(), link.angular_velocity()


def frame_entity(world: Any, name: str, gazebo: str) -> Any:
    """The entity that ``name`` stands for, None for the world.

    :param gazebo: how Gazebo's own service says that there is none
    :raises Refused: there is none
    """
    entity = world.find_entity(name) if name else None
    if entity is None and name not in WORLD_NAMES:
        raise worded(gazebo, f"'{name}' names no model, no link (as model::link), nor is it 'world'")
    return entity

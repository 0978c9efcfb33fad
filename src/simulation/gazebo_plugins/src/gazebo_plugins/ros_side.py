"""What most plugins share towards ROS: topics in the plugin's namespace, rate gates, noise, messages from poses."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from typing import Any

import rospy
import tf2_ros
from gazebo_ros import SdfElement, names
from geometry_msgs.msg import Point, Quaternion, Transform, TransformStamped, Vector3
from geometry_msgs.msg import Pose as PoseMsg
from node_signals import offers
from ode_sim.description.model import Pose
from plugin_loader import PluginError
from rosgraph.names import is_legal_name

_NS = 1_000_000_000


class Topics:
    """Publishers, subscribers and services of one plugin; :meth:`close` unregisters them all.

    :param sdf: the plugin's element. :param model_name: of its model
    :param rule: namespace rule A, B, C or D of :mod:`gazebo_ros.names`
    """

    def __init__(self, sdf, model_name: str, rule: str):
        self.namespace = names.robot_namespace(sdf, model_name, rule)
        self._prefix: str | None = None
        self._made: list[Any] = []

    def resolve(self, name: str) -> str:
        """The absolute name of ``name`` in the plugin's namespace.

        :raises PluginError: ROS knows no such names
        """
        resolved = names.join(self.namespace, name)
        if not is_legal_name(resolved):
            raise PluginError(f"'{resolved}' is no name in ROS; those have letters, digits, _ and /, and begin with a letter")
        return resolved

    def frame(self, name: str) -> str:
        """``name`` with the namespace's tf_prefix."""
        if self._prefix is None:
            self._prefix = names.tf_prefix(self.namespace)
        return names.resolve_frame(self._prefix, name)

    def publisher(self, name: str, kind: type, queue_size: int = 1, latch: bool = False) -> rospy.Publisher:
        """A publisher of messages ``kind`` on ``name``; ``queue_size`` and ``latch`` as for ``rospy.Publisher``."""
        return self._keep(offers.publisher(self.resolve(name), kind, queue_size=queue_size, latch=latch))

    def subscriber(self, name: str, kind: type, callback: Callable[[Any], None], queue_size: int = 1) -> rospy.Subscriber:
        """Call ``callback``, in a thread of rospy, with each message of class ``kind`` on ``name``; the newest ``queue_size`` may wait."""
        return self._keep(offers.subscriber(self.resolve(name), kind, callback, queue_size=queue_size, tcp_nodelay=True))

    def service(self, name: str, kind: type, handler: Callable[[Any], Any]) -> rospy.Service:
        """A service ``name`` of class ``kind``, answered by ``handler`` in a thread of rospy."""
        return self._keep(offers.service(self.resolve(name), kind, handler))

    def close(self) -> None:
        for thing in self._made:
            if hasattr(thing, "shutdown"):
                thing.shutdown("the plugin is unloaded")
            else:
                thing.unregister()
        self._made.clear()

    def _keep(self, thing: Any) -> Any:
        self._made.append(thing)
        return thing


def subscribed(publisher: rospy.Publisher) -> Callable[[], bool]:
    """Whether anybody listens to ``publisher``, as a function; for sensors that only measure then."""
    return lambda: publisher.get_num_connections() > 0


def told_namespace(sdf, model_name: str, kind: str) -> str:
    """The namespace as Gazebo's sensor plugins name it on the terminal, which is said here in their words.

    :param sdf: the plugin's element. :param model_name: the namespace where the element has an empty one
    :param kind: ``Camera``, ``Laser``
    """
    given = sdf.get("robotNamespace", None)
    if given is None:
        rospy.loginfo("%s Plugin: The 'robotNamespace' param did not exit", kind)  # upstream's spelling
    elif not given:
        rospy.loginfo("%s Plugin: The 'robotNamespace' param was empty", kind)
        return model_name
    else:
        rospy.loginfo("%s Plugin: Using the 'robotNamespace' param: '%s'", kind, given)
    return given or ""


class Noise:
    """Zero-mean Gaussian noise, the same in every run of the same world and seed.

    :param rng: of ``world.rng(name)``
    :param sigma: standard deviation, in the unit of what it is added to
    """

    def __init__(self, rng, sigma: float):
        self._rng = rng
        self.sigma = sigma

    def __call__(self, value: float) -> float:
        return value + self.sigma * self._rng.standard_normal() if self.sigma else value

    def vector(self, values: Sequence[float]) -> tuple:
        """``values``, each with noise of its own."""
        return tuple(self(v) for v in values)


class TfBroadcaster:
    """The process's one publisher on /tf."""

    _shared: tf2_ros.TransformBroadcaster | None = None

    @classmethod
    def send(cls, stamp: rospy.Time, parent: str, child: str, pose: Pose) -> None:
        """Send that ``child`` (a frame) is at ``pose`` in ``parent`` at the time ``stamp``."""
        if cls._shared is None:
            cls._shared = tf2_ros.TransformBroadcaster()
        message = TransformStamped()
        message.header.stamp, message.header.frame_id, message.child_frame_id = stamp, parent, child
        message.transform = Transform(Vector3(*pose.p), Quaternion(*pose.q))
        cls._shared.sendTransform(message)


def pose_msg(pose: Pose) -> PoseMsg:
    """``pose`` as geometry_msgs/Pose."""
    return PoseMsg(Point(*pose.p), Quaternion(*pose.q))


def find_joint(model, sdf, tag: str, default: str) -> Any:
    """The joint of ``model`` named by ``<tag>`` of the plugin's element ``sdf``, or ``default`` without one.

    :raises PluginError: the model has no such joint; says which it has
    """
    return joint_named(model, sdf.text_or(tag, default), tag)


def joint_named(model, name: str, tag: str) -> Any:
    """The joint ``name``, which ``<tag>`` gives, of ``model``: ``joint`` or ``model::joint``.

    :raises PluginError: the model has no such joint; says which it has
    """
    joint = model.joints.get(name.removeprefix(model.name + "::"))
    if joint is None:
        raise PluginError(f"<{tag}> names the joint '{name}', which model {model.name} does not have; it has {_listed(model.joints)}")
    return joint


def find_link(model, world, sdf, tag: str = "bodyName") -> Any:
    """The link named by ``<tag>`` of the element ``sdf``: of ``model``, or of any in ``world`` (Gazebo's scoped-or-unscoped look-up).

    :raises PluginError: tag missing, or no such link
    """
    name = sdf.get(tag, "")
    if not name:
        raise PluginError(f"<{tag}> is missing: it must name a link of model {model.name}")
    link = model.links.get(name) or world.find_link(name)
    if link is None:
        raise PluginError(
            f"<{tag}> names the link '{name}', which does not exist; model {model.name} has "
            f"{_listed(model.links)}. A link behind a fixed joint is merged into its parent "
            "(<preserveFixedJoint> keeps it)"
        )
    return link


def sensor_element(sensor) -> SdfElement:
    """The ``<sensor>`` element of ``sensor``; values that cannot be read are warned about in its name."""
    return SdfElement(sensor.description.element, lambda line: rospy.logwarn("sensor %s: %s", sensor.scoped_name, line))


def required(sdf, tag: str) -> str:
    """The text of ``<tag>`` of the element ``sdf``.

    :raises PluginError: missing or empty
    """
    value = sdf.get(tag, "")
    if not value:
        raise PluginError(f"<{tag}> is missing")
    return value


def length(sdf, tag: str, default: float) -> float:
    """``<tag>`` of the element ``sdf``, by which a plugin divides; ``default`` without one; m.

    :raises PluginError: zero, or not finite
    """
    value = float(sdf.get(tag, default))
    if value == 0.0 or not math.isfinite(value):
        raise PluginError(f"<{tag}> is {value:g} m: a length other than 0 is needed")
    return value


def diagonal(values: Collection[float]) -> list[float]:
    """Row-major covariance matrix with the diagonal ``values``."""
    size = len(values)
    matrix = [0.0] * (size * size)
    for i, value in enumerate(values):
        matrix[i * (size + 1)] = value
    return matrix


def _listed(things: dict[str, Any]) -> str:
    return ", ".join(things) if things else "none"

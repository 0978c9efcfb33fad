"""Places of a world: libContainPlugin.so tells whether something is in a box, libTransporterPlugin.so takes models from pad to pad."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import rospy
from gazebo_ros.plugin import PluginError, WorldPlugin
from ode_sim import math3
from ode_sim.description.model import Pose, Vec3
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, SetBoolResponse

from gazebo_plugins.ros_side import Topics, required

if TYPE_CHECKING:
    from gazebo_ros.protocols import Connection


def _pose(sdf, where: str) -> Pose:
    """The pose in ``<pose>`` of the element ``sdf``. :raises PluginError: it is not there or not finite; ``where`` names the element"""
    if not sdf.has("pose"):
        raise PluginError(f"{where}: <pose> is missing")
    x, y, z, *rpy = sdf.get("pose", (0.0,) * 6)
    if not all(map(math.isfinite, (x, y, z, *rpy))):
        raise PluginError(f"{where}: <pose> has to be six finite numbers")
    return Pose((x, y, z), math3.quat_from_rpy(*rpy))


class Contain(WorldPlugin):
    """Publishes ``/<namespace>/contain`` (std_msgs/Bool, latched) whenever the origin of ``<entity>``, a model, link or collision, comes
    into or leaves the box at ``<pose>``, which stands in the world or moves with the entity in the pose's ``frame``. The service
    ``/<namespace>/enable`` (std_srvs/SetBool) switches it."""

    def load(self, server, sdf) -> None:
        self.world = server.world
        self.entity, namespace = required(sdf, "entity"), required(sdf, "namespace").strip("/")
        self.pose = _pose(sdf, "the plugin")
        pose = sdf.child("pose")
        self.frame = pose.attrib.get("frame") or pose.attrib.get("relative_to") or ""
        geometry = sdf.child("geometry")
        box = geometry.child("box") if geometry else None
        size = box.get("size", (0.0, 0.0, 0.0)) if box else ()
        if not size or not all(0.0 < length < math.inf for length in size):
            raise PluginError("<geometry><box><size> has to be three lengths in metres; other shapes are not known to this plugin")
        self.half: Vec3 = (size[0] / 2, size[1] / 2, size[2] / 2)
        self.topics = Topics(sdf, "", "C")
        self.publisher = self.topics.publisher(f"/{namespace}/contain", Bool, 10, latch=True)
        self.server = server
        self.connection: Connection | None = None
        self.known: bool | None = None
        self.topics.service(f"/{namespace}/enable", SetBool, lambda request: server.call(lambda: self._switch(request.data)))
        if sdf.get("enabled", True):
            self._switch(True)

    def _switch(self, on: bool) -> SetBoolResponse:
        if on == (self.connection is not None):
            return SetBoolResponse(False, f"it is {'enabled' if on else 'disabled'} already")
        if self.connection is None:
            self.connection = self.server.before_step(self.step)
        else:
            self.connection.disconnect()
            self.connection = self.known = None
        return SetBoolResponse(True, "enabled" if on else "disabled")

    def step(self) -> None:
        contains = self._contains()
        if contains != self.known:
            self.known = contains
            self.publisher.publish(contains)

    def _contains(self) -> bool:
        entity = self.world.find_entity(self.entity)
        frame = self.world.find_entity(self.frame) if self.frame else None
        if entity is None or (self.frame and frame is None):
            return False
        box = math3.compose(frame.pose, self.pose) if frame else self.pose
        place = math3.relative(box, entity.pose).p
        return all(abs(way) <= half for way, half in zip(place, self.half))

    def reset(self) -> None:
        self.known = None

    def shutdown(self) -> None:
        self.topics.close()


@dataclass
class Pad:
    """One of a transporter's: models whose origin is between ``low`` and ``high`` (m, in the world) go to the pad ``destination``, to its
    ``incoming`` pose. ``asked``: a pad that is not ``automatic`` was activated."""

    destination: str
    automatic: bool
    low: Vec3
    high: Vec3
    incoming: Pose
    asked: bool = False

    def holds(self, p: Vec3) -> bool:
        return all(low <= value <= high for low, value, high in zip(self.low, p, self.high))


class Transporter(WorldPlugin):
    """``<pad name="">`` elements with ``<destination>``, ``<outgoing>`` ``<min>`` and ``<max>``, ``<incoming><pose>``, ``<activation>``
    auto or manual. A manual one takes a model for each message of its name on ``<activation_topic>`` (std_msgs/String; ``~/`` is
    /gazebo/)."""

    def load(self, server, sdf) -> None:
        self.server = server
        self.pads: dict[str, Pad] = {}
        for element in sdf.children("pad"):
            self._read(element)
        if not self.pads:
            raise PluginError("<pad> is missing: there is nothing to go from or to")
        for name, pad in self.pads.items():
            if pad.destination not in self.pads:
                rospy.logwarn("TransporterPlugin: pad '%s' leads to '%s', which is none of %s", name, pad.destination, ", ".join(self.pads))
        self.topics = Topics(sdf, "", "C")
        topic = sdf.get("activation_topic", "")
        if topic:
            topic = rospy.resolve_name("~" + topic[2:]) if topic.startswith("~/") else topic
            self.topics.subscriber(topic, String, lambda message: server.call(lambda: self._activate(message.data)), 10)
        elif not all(pad.automatic for pad in self.pads.values()):
            rospy.logwarn("TransporterPlugin: a pad is manual and there is no <activation_topic>: nothing can activate it")
        server.before_step(self.step)

    def _read(self, element) -> None:
        name = element.attrib.get("name", "")
        where = f"<pad name='{name}'>"
        if not name or name in self.pads:
            raise PluginError(f"{where}: each pad has to have a name of its own")
        outgoing, incoming = element.child("outgoing"), element.child("incoming")
        if outgoing is None or incoming is None:
            raise PluginError(f"{where}: <{'incoming' if outgoing else 'outgoing'}> is missing")
        corners = outgoing.get("min", (0.0, 0.0, 0.0)), outgoing.get("max", (0.0, 0.0, 0.0))
        automatic = element.text_or("activation", "auto") == "auto"
        self.pads[name] = Pad(element.get("destination", ""), automatic, *corners, _pose(incoming, f"{where}: <incoming>"))

    def _activate(self, name: str) -> None:
        if name in self.pads:
            self.pads[name].asked = True
        else:
            rospy.logwarn("TransporterPlugin: there is no pad '%s'; there are %s", name, ", ".join(self.pads))

    def step(self) -> None:
        for model in list(self.server.world.models.values()):
            if model.static:
                continue
            place = model.pose.p
            for pad in self.pads.values():
                target = self.pads.get(pad.destination)
                if target and (pad.automatic or pad.asked) and pad.holds(place):
                    model.pose = target.incoming
                    pad.asked = False

    def reset(self) -> None:
        for pad in self.pads.values():
            pad.asked = False

    def shutdown(self) -> None:
        self.topics.close()

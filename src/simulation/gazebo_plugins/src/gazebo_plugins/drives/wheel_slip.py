"""libgazebo_ros_wheel_slip.so: wheels that slip in proportion to the force, adjustable while they roll."""

from __future__ import annotations

from typing import Any

import rospy
from dynamic_parameters import Parameter
from dynamic_parameters import Server as Reconfigure
from gazebo_ros import names
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from ode_sim.description.model import Cylinder, Sphere

_UNCHANGED = -1.0
_TAGS = {"lateral": "slip_compliance_lateral", "longitudinal": "slip_compliance_longitudinal"}
_TABLE = [
    Parameter(
        f"slip_compliance_unitless_{way}",
        float,
        _UNCHANGED,
        _UNCHANGED,
        20.0,
        f"{way} slip per friction force over normal force; -1 leaves what it is",
    )
    for way in _TAGS
]


class _Wheel:
    """One ``<wheel link_name="...">``; without ``<wheel_radius>`` it has that of its cylinder or sphere.

    :raises PluginError: a link that is missing or does not turn on a joint
    """

    def __init__(self, model, sdf):
        name = sdf.attrib.get("link_name", "")
        link = model.links.get(name)
        if link is None:
            raise PluginError(f"<wheel link_name='{name}'>: model {model.name} has {', '.join(model.links)}")
        joint = next((joint for joint in model.joints.values() if joint.child is link and joint.axis_count), None)
        if joint is None:
            raise PluginError(f"<wheel link_name='{name}'>: the link does not turn on a joint")
        self.joint = joint
        self.radius, self.force = sdf.get("wheel_radius", 0.0), sdf.get("wheel_normal_force", 0.0)
        if self.radius <= 0.0:
            shapes = [collision.description.geometry for collision in link.collisions.values()]
            self.radius = next((shape.radius for shape in shapes if isinstance(shape, (Cylinder, Sphere))), 0.0)
        if self.radius <= 0.0 or self.force <= 0.0:
            raise PluginError(f"<wheel link_name='{name}'>: <wheel_radius> (m) and <wheel_normal_force> (N) must be positive")
        self.compliance = {way: sdf.get(tag, 0.0) for way, tag in _TAGS.items()}
        self.surfaces = [collision.surface for collision in link.collisions.values()]
        for collision in link.collisions.values():  # slip1 is to mean sideways
            axis = self.joint.world_axis()
            collision.surface.fdir1 = math3.quat_rotate(math3.quat_inverse(collision.pose.q), axis)

    def update(self) -> None:
        speed = abs(self.joint.velocity()) * self.radius
        for surface in self.surfaces:
            surface.slip1 = speed * self.compliance["lateral"] / self.force
            surface.slip2 = speed * self.compliance["longitudinal"] / self.force


class WheelSlip(ModelPlugin):
    """Parameters ``slip_compliance_unitless_lateral`` and ``_longitudinal`` of all wheels at once, in ``<model>/wheel_slip``, or in
    ``<model>/<robotNamespace>``."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.wheels = []
        for wheel in sdf.children("wheel"):
            try:
                self.wheels.append(_Wheel(model, wheel))
            except PluginError as error:
                rospy.logerr("%s: libgazebo_ros_wheel_slip.so: %s; the other wheels slip", model.name, error)
        if not self.wheels:
            raise PluginError("no <wheel link_name='...'> that can slip")
        given = sdf.text_or("robotNamespace", "").strip("/")
        namespace = names.join(rospy.get_namespace(), f"{model.name}/{given or 'wheel_slip'}")
        self.reconfigure = Reconfigure(namespace, _TABLE, self._changed)
        server.before_step(self.step)

    def _changed(self, config: dict[str, Any], _level: int) -> None:
        def apply() -> None:  # server.call runs it at once while the plugin is being loaded
            for way in _TAGS:
                value = config[f"slip_compliance_unitless_{way}"]
                for wheel in self.wheels if value >= 0.0 else ():
                    wheel.compliance[way] = value

        self.server.call(apply)

    def step(self) -> None:
        for wheel in self.wheels:
            wheel.update()

    def shutdown(self) -> None:
        self.reconfigure.shutdown()

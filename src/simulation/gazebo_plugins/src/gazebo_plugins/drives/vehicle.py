"""libVehiclePlugin.so: a car whose pedals and steering wheel are joints, as a driver or a humanoid moves them."""

from __future__ import annotations

import math
from typing import Any

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3

from gazebo_plugins.ros_side import find_joint, required

_FRONT, _BACK = ("front_left", "front_right"), ("back_left", "back_right")
_NUMBERS = ("max_speed", "aero_load", "tire_angle_range", "front_power", "rear_power")
_PEDAL = -0.1  # N m or N that pushes a pedal back
_STEERED = 1e-5  # rad of a wheel that are worth a change of its limits


class Vehicle(ModelPlugin):
    """Wheels hang on joints of two axes (revolute2): the first steers, the second rolls. ``<gas>``, ``<brake>`` and ``<steering>`` name the
    joints that drive them.

    ``<front_power>`` and ``<rear_power>``: N m on each wheel with a pedal at its upper limit. Both pedals push ahead, as upstream; without
    more gas than brake, or with a ``<max_speed>`` of 0, only wheels that turn backwards are pushed. ``<tire_angle_range>``: rad between
    both ends of the front wheels' turn, which those of the steering wheel's go with. ``<aero_load>``: N upwards on the chassis for each
    m^2/s^2. The topic ``vel_cmd`` does nothing upstream and is not here. Wheels have no springs here, and so nothing sways.
    """

    def load(self, server, model, sdf) -> None:
        for tag in (*_FRONT, *_BACK, "gas", "brake", "steering"):
            required(sdf, tag)
        self.front, self.back = ([find_joint(model, sdf, tag, "") for tag in tags] for tags in (_FRONT, _BACK))
        for joint in (*self.front, *self.back):
            if joint.axis_count < 2:
                raise PluginError(f"joint '{joint.name}' of a wheel has no second axis to roll about; make it type='revolute2'")
        self.gas, self.brake, self.steering = (find_joint(model, sdf, tag, "") for tag in ("gas", "brake", "steering"))
        self.most = self._range("gas", self.gas, 0.0)
        steering_range = self._range("steering", self.steering, self.steering.limits()[0])
        for tag in _NUMBERS:
            if not sdf.has(tag):
                rospy.logwarn("VehiclePlugin of model %s: <%s> is missing and counts as 0", model.name, tag)
        self.max_speed, self.aero_load, tires, *powers = (sdf.get(tag, 0.0) for tag in _NUMBERS)
        self.powers = [*((joint, powers[0]) for joint in self.front), *((joint, powers[1]) for joint in self.back)]
        self.tires_per_turn = tires / steering_range
        self.chassis: Any = self.front[0].parent
        if self.chassis is None:
            raise PluginError(f"joint '{self.front[0].name}' hangs from the world; its parent has to be the chassis")
        self.radius = self._radius(self.front[0].child)
        self.angle = math.nan
        server.drives(*self.front, *self.back)
        server.before_step(self.step)

    @staticmethod
    def _range(tag: str, joint: Any, lower: float) -> float:
        """From ``lower`` to the joint's upper limit. :raises PluginError: there is none"""
        length = joint.limits()[1] - lower
        if not 0.0 < length < math.inf:
            raise PluginError(f"<{tag}>: joint '{joint.name}' needs <limit>s to say how far it goes; its <upper> has to be above {lower:g}")
        return length

    @staticmethod
    def _radius(wheel: Any) -> float:
        """m, of the link ``wheel``: half the longest side of the box round it. :raises PluginError: it has no collision"""
        boxes = [collision.bounding_box() for collision in wheel.collisions.values()]
        sides = [max(high[i] for _, high in boxes) - min(low[i] for low, _ in boxes) for i in range(3)] if boxes else [0.0]
        if not 0.0 < max(sides) < math.inf:
            raise PluginError(f"wheel '{wheel.name}' has no collision that would say how large it is")
        return max(sides) / 2

    def step(self) -> None:
        gas, brake = self.gas.position() / self.most, self.brake.position() / self.most
        for pedal in (self.gas, self.brake):
            pedal.add_force(_PEDAL)
        free = max(0.0, gas - brake) * self.max_speed / self.radius > 0.0
        for joint, power in self.powers:
            force = (gas + brake) * power
            if free or force * joint.velocity(1) <= 0.0:
                joint.add_force(force, 1)
        angle = self.steering.position() * self.tires_per_turn
        if not abs(angle - self.angle) < _STEERED:
            self.angle = angle
            for joint in self.front:
                joint.set_limits(angle, angle)
        speed = math3.norm(self.chassis.linear_velocity())
        self.chassis.add_force((0.0, 0.0, self.aero_load * speed * speed))

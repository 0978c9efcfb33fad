"""Physics parameters: the services and dynamic_reconfigure."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import rospy
from dynamic_parameters import Parameter
from dynamic_parameters import Server as ParameterServer
from gazebo_msgs.msg import ODEPhysics
from gazebo_msgs.srv import GetPhysicsProperties, SetPhysicsProperties
from ode_sim.physics import BOUNDS

from gazebo_ros.api.geometry import vector_of
from gazebo_ros.api.handlers import Refused, advertise
from gazebo_ros.server import Server

#: name in messages and parameters -> in ode_sim
_SETTINGS = {
    "time_step": "max_step_size",
    "max_update_rate": "real_time_update_rate",
    "sor_pgs_precon_iters": "precon_iters",
    "sor_pgs_iters": "iters",
    "sor_pgs_w": "sor",
    **{name: name for name in ("cfm", "erp", "contact_surface_layer", "contact_max_correcting_vel", "max_contacts")},
}

PARAMETERS = (
    Parameter("time_step", float, 0.001, 0.0, 10.0, "Length of a physics step, s"),
    Parameter("max_update_rate", float, 60.0, 0.0, 1000.0, "Steps per wall second, 0 = as fast as possible"),
    Parameter("gravity_x", float, 0.0, -100.0, 100.0, "m/s^2"),
    Parameter("gravity_y", float, 0.0, -100.0, 100.0, "m/s^2"),
    Parameter("gravity_z", float, -9.8, -100.0, 100.0, "m/s^2"),
    Parameter("auto_disable_bodies", bool, False, description="Let resting bodies sleep"),
    Parameter("sor_pgs_precon_iters", int, 0, 0, 10000, "Preconditioning iterations of the quick solver"),
    Parameter("sor_pgs_iters", int, 20, 0, 10000, "Iterations of the quick solver"),
    Parameter("sor_pgs_w", float, 1.3, 0.0, 5.0, "Over-relaxation of the quick solver"),
    Parameter("sor_pgs_rms_error_tol", float, -1.0, -1.0, 10000.0, "Not used by ODE's quick solver"),
    Parameter("cfm", float, 0.0, 0.0, 10.0, "Global constraint force mixing"),
    Parameter("erp", float, 0.2, 0.0, 10.0, "Global error reduction"),
    Parameter("contact_surface_layer", float, 0.001, 0.0, 10.0, "Penetration left alone, m"),
    Parameter("contact_max_correcting_vel", float, 100.0, 0.0, 1e7, "m/s"),
    Parameter("max_contacts", int, 100, 0, 10_000_000, "Contacts per pair of shapes"),
)


class PhysicsServices:
    """Values act at once, also while paused."""

    def __init__(self, server: Server):
        self._server = server
        self._world = server.world
        self._auto_disable = False
        self._parameters: ParameterServer | None = None
        advertise(server, "get_physics_properties", GetPhysicsProperties, self._get)
        advertise(server, "set_physics_properties", SetPhysicsProperties, self._set, in_physics_thread=False)

    def start_reconfigure(self) -> None:
        """Offer the parameters through dynamic_reconfigure, which shows the live values."""
        self._parameters = ParameterServer(
            "~", PARAMETERS, self._on_reconfigure, initial=self._values(), current=lambda: self._server.call(self._values)
        )
        rospy.loginfo("Physics dynamic reconfigure ready.")

    def _values(self) -> dict[str, Any]:
        gravity = self._world.gravity
        return {
            **{name: getattr(self._world.physics, setting) for name, setting in _SETTINGS.items()},
            "gravity_x": gravity[0],
            "gravity_y": gravity[1],
            "gravity_z": gravity[2],
            "auto_disable_bodies": self._auto_disable,
            "sor_pgs_rms_error_tol": 0.0,
        }

    def _apply(self, values: dict[str, Any]) -> None:
        """Take over all values, or none.

        :raises Refused, ValueError: a value that no simulation can run with
        """
        for name, setting in _SETTINGS.items():
            if not BOUNDS[setting].hold(values[name]):
                raise Refused(f"{name} must be {BOUNDS[setting]}, not {values[name]:g}; nothing is changed")
        changes = {setting: values[name] for name, setting in _SETTINGS.items()}
        self._world.set_physics(
            replace(self._world.physics.record(), **changes), (values["gravity_x"], values["gravity_y"], values["gravity_z"])
        )
        self._auto_disable = values["auto_disable_bodies"]

    def _get(self, request, response) -> str:
        values = self._values()
        response.time_step, response.max_update_rate = values["time_step"], values["max_update_rate"]
        response.pause = self._server.paused
        response.gravity.x, response.gravity.y, response.gravity.z = self._world.gravity
        response.ode_config = ODEPhysics(**{name: values[name] for name in ODEPhysics.__slots__})
        return "GetPhysicsProperties: got properties"

    def _set(self, request, response) -> str:
        x, y, z = vector_of(request.gravity, "gravity")
        values = {name: getattr(request.ode_config, name) for name in ODEPhysics.__slots__}
        values.update(time_step=request.time_step, max_update_rate=request.max_update_rate, gravity_x=x, gravity_y=y, gravity_z=z)
        self._server.call(lambda: self._apply(values))
        if self._parameters:
            self._parameters.refresh()
        return "physics engine updated"

    def _on_reconfigure(self, config: dict[str, Any], level: int) -> None:
        if level == -1:  # the call at start
            return
        self._server.call(lambda: self._apply(config))

"""Joint properties."""

from __future__ import annotations

from gazebo_msgs.srv import GetJointProperties, SetJointProperties

from gazebo_ros.api.handlers import Refused, advertise, finite, worded
from gazebo_ros.server import Server

#: fields of ODEJointProperties that act on a joint here
_FIELDS = ("damping", "hiStop", "loStop", "stop_erp", "stop_cfm", "fmax", "vel")
#: what ODE's joints here have no counterpart of
_WITHOUT_EFFECT = ("erp", "cfm", "fudge_factor")


class JointServices:
    def __init__(self, server: Server):
        self._world = server.world
        advertise(server, "get_joint_properties", GetJointProperties, self._get)
        advertise(server, "set_joint_properties", SetJointProperties, self._set)

    def _joint(self, name: str):
        joint = self._world.find_joint(name)
        if joint is None:
            raise worded("joint not found", f"[{name}] names none; name it as in the model's file (fixed joints may be merged)")
        return joint

    def _get(self, request, response) -> str:
        joint = self._joint(request.joint_name)
        if joint.axis_count:
            response.position = [joint.position()]
            response.rate = [joint.velocity()]
        return "GetJointProperties: got properties"

    def _set(self, request, response) -> str:
        joint = self._joint(request.joint_name)
        config = request.ode_joint_config
        for field in _FIELDS + _WITHOUT_EFFECT:
            values = getattr(config, field)
            finite(field, *values)
            if len(values) > joint.axis_count:
                raise Refused(f"{field} has {len(values)} elements, but joint [{joint.name}] has {joint.axis_count} axes")
        for field in _FIELDS:
            for axis, value in enumerate(getattr(config, field)):
                _set_parameter(joint, field, value, axis)
        ignored = [field for field in _WITHOUT_EFFECT if getattr(config, field)]
        return "SetJointProperties: properties set" + (f" (without effect: {', '.join(ignored)})" if ignored else "")


def _set_parameter(joint, field: str, value: float, axis: int) -> None:
    lower, upper = joint.limits(axis)
    velocity, force = joint.motor(axis)
    if field == "hiStop":
        joint.set_limits(lower, value, axis)
    elif field == "loStop":
        joint.set_limits(value, upper, axis)
    elif field == "fmax":
        joint.set_motor(velocity, value, axis)
    elif field == "vel":
        joint.set_motor(value, force, axis)
    else:  # of the whole joint
        joint.set_param(field, value)

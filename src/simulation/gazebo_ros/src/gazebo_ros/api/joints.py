"""Joint properties."""
from __future__ import annotations

from gazebo_msgs.srv import GetJointProperties, SetJointProperties

from gazebo_ros.api.handlers import Refused, advertise, finite
from gazebo_ros.server import Server

#: ODEJointProperties field -> ode_sim parameter, in the order Gazebo applies them
_PARAMETERS = (("damping", "damping"), ("hiStop", "hi_stop"), ("loStop", "lo_stop"), ("erp", "erp"), ("cfm", "cfm"),
               ("stop_erp", "stop_erp"), ("stop_cfm", "stop_cfm"), ("fudge_factor", "fudge_factor"), ("fmax", "fmax"),
               ("vel", "vel"))


class JointServices:
    def __init__(self, server: Server):
        self._world = server.world
        advertise(server, "get_joint_properties", GetJointProperties, self._get)
        advertise(server, "set_joint_properties", SetJointProperties, self._set)

    def _joint(self, name: str):
        joint = self._world.find_joint(name)
        if joint is None:
            raise Refused(f"joint [{name}] not found; name it as in the model's file (a fixed joint may have been merged)")
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
        for field, _ in _PARAMETERS:
            finite(field, *getattr(config, field))
            if len(getattr(config, field)) > joint.axis_count:
                raise Refused(f"{field} has {len(getattr(config, field))} elements, but joint [{joint.name}] has "
                              f"{joint.axis_count} axes")
        for field, parameter in _PARAMETERS:
            for axis, value in enumerate(getattr(config, field)):
                joint.set_param(parameter, value, axis)
        return "SetJointProperties: properties set"

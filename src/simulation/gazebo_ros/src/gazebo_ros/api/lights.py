"""Lights."""
from __future__ import annotations

from dataclasses import replace

from gazebo_msgs.srv import DeleteLight, GetLightProperties, SetLightProperties
from std_msgs.msg import ColorRGBA

from gazebo_ros.api.geometry import pose_of, vector_of
from gazebo_ros.api.handlers import Refused, advertise, finite, listing
from gazebo_ros.server import Server


class LightServices:
    def __init__(self, server: Server):
        self._world = server.world
        advertise(server, "delete_light", DeleteLight, self._delete)
        advertise(server, "get_light_properties", GetLightProperties, self._get)
        advertise(server, "set_light_properties", SetLightProperties, self._set)

    def _light(self, name: str):
        light = self._world.lights.get(name)
        if light is None:
            raise Refused(f"light [{name}] does not exist; there are: {listing(self._world.lights)}")
        return light

    def _delete(self, request, response) -> str:
        self._light(request.light_name)
        del self._world.lights[request.light_name]
        return "DeleteLight: successfully deleted light"

    def _get(self, request, response) -> str:
        light = self._light(request.light_name)
        response.diffuse = ColorRGBA(*light.diffuse)
        response.attenuation_constant = light.constant
        response.attenuation_linear = light.linear
        response.attenuation_quadratic = light.quadratic
        return ""

    def _set(self, request, response) -> str:
        light = self._light(request.light_name)
        r = request
        finite("the request", r.diffuse.r, r.diffuse.g, r.diffuse.b, r.diffuse.a, r.specular.r, r.specular.g,
               r.specular.b, r.specular.a, r.attenuation_constant, r.attenuation_linear, r.attenuation_quadratic)
        self._world.lights[r.light_name] = replace(
            light, cast_shadows=r.cast_shadows, diffuse=(r.diffuse.r, r.diffuse.g, r.diffuse.b, r.diffuse.a),
            specular=(r.specular.r, r.specular.g, r.specular.b, r.specular.a), constant=r.attenuation_constant,
            linear=r.attenuation_linear, quadratic=r.attenuation_quadratic,
            direction=vector_of(r.direction, "direction"), pose=pose_of(r.pose))
        return ""

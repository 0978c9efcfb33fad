"""Lights."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from gazebo_msgs.srv import DeleteLight, GetLightProperties, SetLightProperties
from ode_sim import math3
from ode_sim.description.model import Light
from std_msgs.msg import ColorRGBA

from gazebo_ros.api.geometry import pose_of, vector_of
from gazebo_ros.api.handlers import advertise, finite, listing, worded
from gazebo_ros.server import Server


class LightServices:
    """Lights of the world by name, those that links carry by ``model::link::light`` or the light's name alone."""

    def __init__(self, server: Server):
        self._world = server.world
        advertise(server, "delete_light", DeleteLight, self._delete)
        advertise(server, "get_light_properties", GetLightProperties, self._get, prefix="getLightProperties")
        advertise(server, "set_light_properties", SetLightProperties, self._set, prefix="setLightProperties")

    def _all(self) -> Iterator[tuple[str, dict[str, Light], str, Any]]:
        """(scoped name, the lights it is one of, its name there, the link that carries it or None)"""
        for name in self._world.lights:
            yield name, self._world.lights, name, None
        for model in self._world.models.values():
            for link in model.links.values():
                for name in link.lights:
                    yield f"{link.scoped_name}::{name}", link.lights, name, link

    def _find(self, wanted: str, gazebo: str = "Requested light {} not found!") -> tuple[dict[str, Light], str, Any]:
        for scoped, lights, name, link in self._all():
            if wanted in (scoped, name):
                return lights, name, link
        raise worded(gazebo.format(wanted), f"It does not exist; there are: {listing(entry[0] for entry in self._all())}")

    def _delete(self, request, response) -> str:
        lights, name, _ = self._find(request.light_name, 'Timeout reached while removing light "{}"')
        del lights[name]
        return f"DeleteLight: {request.light_name} successfully deleted"

    def _get(self, request, response) -> str:
        lights, name, _ = self._find(request.light_name)
        light = lights[name]
        response.diffuse = ColorRGBA(*light.diffuse)
        response.attenuation_constant, response.attenuation_linear, response.attenuation_quadratic = (
            float(np.float32(factor)) for factor in (light.constant, light.linear, light.quadratic)
        )  # as Gazebo keeps them
        return ""

    def _set(self, request, response) -> str:
        lights, name, link = self._find(request.light_name)
        r = request
        finite(
            "the request",
            r.diffuse.r,
            r.diffuse.g,
            r.diffuse.b,
            r.diffuse.a,
            r.specular.r,
            r.specular.g,
            r.specular.b,
            r.specular.a,
            r.attenuation_constant,
            r.attenuation_linear,
            r.attenuation_quadratic,
        )
        x_wn = pose_of(r.pose)
        lights[name] = replace(
            lights[name],
            cast_shadows=r.cast_shadows,
            diffuse=(r.diffuse.r, r.diffuse.g, r.diffuse.b, r.diffuse.a),
            specular=(r.specular.r, r.specular.g, r.specular.b, r.specular.a),
            constant=r.attenuation_constant,
            linear=r.attenuation_linear,
            quadratic=r.attenuation_quadratic,
            direction=vector_of(r.direction, "direction"),
            pose=x_wn if link is None else math3.relative(link.pose, x_wn),
        )
        return ""

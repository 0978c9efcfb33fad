"""~spawn_urdf_model and ~spawn_sdf_model."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace

from gazebo_msgs.srv import SpawnModel
from ode_sim import math3, prepare
from ode_sim.description import DescriptionError, Entity
from ode_sim.description.model import Model, Plugin, Pose

from gazebo_ros.api.geometry import frame_entity, pose_of
from gazebo_ros.api.handlers import Answer, Refused, advertise, worded
from gazebo_ros.server import Server, log_problems

_UNFIT = (
    "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be converted to Gazebo compatible "
    "format."
)  # Gazebo's words


def with_package_folders(text: str, find: Callable[[str], str | None]) -> str:
    """A URDF whose plugins get folders where ``package://NAME`` stands, as gazebo_ros_api_plugin hands them over; they open such files as
    they are. :param text: of a URDF. :param find: the folder of ``package://NAME``, or None, and it stays as it is.
    """

    def put(block: re.Match) -> str:
        return re.sub(r"package://[^/\s<>\"'&]+", lambda name: find(name.group()) or name.group(), block.group())

    return re.sub(r"<plugin\b.*?</plugin\s*>", put, text, flags=re.DOTALL)


class SpawnServices:
    """XML is read, meshes are loaded and prepared and plugins imported in the service's thread; the physics thread only
    puts the finished model into the world, so that robots that are already there run on."""

    def __init__(self, server: Server):
        self._server = server
        advertise(server, "spawn_urdf_model", SpawnModel, self._spawn_urdf, in_physics_thread=False, prefix="SpawnModel")
        advertise(server, "spawn_sdf_model", SpawnModel, self._spawn, in_physics_thread=False, prefix="SpawnModel")

    def _spawn_urdf(self, request, response) -> str:
        return self._spawn(request, response, urdf_only=True)

    def _spawn(self, request, response, urdf_only: bool = False) -> str:
        try:
            entity = self._entity(request, urdf_only)
            x_fe = pose_of(request.initial_pose, "initial_pose")
            if entity.kind == "light":
                self._spawn_light(entity, request, x_fe)
            else:
                self._spawn_model(entity, request, x_fe)
        except DescriptionError as error:
            raise Answer(f"{_UNFIT} model '{request.model_name}': {error}") from error
        return "SpawnModel: Successfully spawned entity"

    def _entity(self, request, urdf_only: bool) -> Entity:
        """
        :raises Refused, DescriptionError: the text is none of what the service takes
        """
        invalid = "Failure - entity format is invalid."
        try:
            text = with_package_folders(request.model_xml, self._server.finder.find) if urdf_only else request.model_xml
            entity = Entity(text, self._server.finder)
        except DescriptionError as error:
            if urdf_only:
                raise worded(invalid, f"model '{request.model_name}': {error}") from error
            raise
        if urdf_only and entity.kind != "urdf":
            raise worded(invalid, f"The text is SDF (<{entity.kind}>), not a URDF <robot>; use spawn_sdf_model (spawn_model -sdf)")
        return entity

    def _spawn_model(self, entity: Entity, request, x_fe: Pose) -> None:
        server = self._server
        model, problems = entity.model(request.model_name or None)
        log_problems(problems, f"model {model.name}")
        set_robot_namespace(model, request.robot_namespace)
        prepare(model)
        resolved = server.plugins.resolve(model)

        def put() -> None:
            world = server.world
            if model.name in world.models:
                raise Refused(
                    "Failure - entity already exists. A model of that name is in the world: "
                    f"'{model.name}'; delete it first (delete_model) or choose another name"
                )
            server.spawn(replace(model, pose=self._world_pose(request, x_fe, model.pose)), resolved)

        server.call(put)

    def _spawn_light(self, entity: Entity, request, x_fe: Pose) -> None:
        light, problems = entity.light(request.model_name or None)
        log_problems(problems, f"light {light.name}")

        def put() -> None:
            lights = self._server.world.lights
            if light.name in lights:
                raise Refused(f"Failure - entity already exists. A light of that name is in the world: '{light.name}'")
            lights[light.name] = replace(light, pose=self._world_pose(request, x_fe, light.pose))

        self._server.call(put)

    def _world_pose(self, request, x_fe: Pose, x_em: Pose) -> Pose:
        """X_WM: reference frame F, requested pose E in it, and the pose in the text on top."""
        frame = frame_entity(
            self._server.world,
            request.reference_frame,
            "reference reference_frame not found, did you forget to scope the link by model name?",
        )
        x_we = x_fe if frame is None else math3.compose(frame.pose, x_fe)
        return math3.compose(x_we, x_em)


def plugins_of(model: Model) -> list[Plugin]:
    """Those of the model and of its sensors."""
    return list(model.plugins) + [plugin for part in model.parts for sensor in part.sensors for plugin in sensor.plugins]


def set_robot_namespace(model: Model, namespace: str) -> None:
    """Give every plugin of ``model`` without a ``<robotNamespace>`` this ``namespace`` (nothing for an empty one)."""
    if not namespace:
        return
    for plugin in plugins_of(model):
        if plugin.element.find("robotNamespace") is None:
            ET.SubElement(plugin.element, "robotNamespace").text = namespace

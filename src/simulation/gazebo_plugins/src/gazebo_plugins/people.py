"""libActorPlugin.so: a person of a world wanders from one place to the next and keeps away from what stands in the way."""

from __future__ import annotations

import math
from typing import Any

from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from ode_sim.description.model import Pose, Vec3

_ANIMATION = "walking"
_SPEED = 0.8  # m/s; all numbers here are Gazebo's
_HEIGHT = 1.2138  # m, of the hips
_ROOM = ((-3.0, 3.5), (-10.0, 2.0))  # m, in x and y, which it never leaves
_ARRIVED = 0.3  # m
_SEES = 4.0  # m
_TURNS_FIRST = math.radians(10.0)
_TURN = 0.001  # of what is left to turn, in each step on the spot
_TRIES = 100


class Wanderer(ModelPlugin):
    """Parameters: ``target`` (0 -5 1.2138 m), ``target_weight`` (1.15), ``obstacle_weight`` (1.5), ``animation_factor`` (4.5 s/m),
    ``ignore_obstacles`` with ``model`` names."""

    def load(self, server, model, sdf) -> None:
        self._world = server.world
        self._actor: Any = server.world.actors.get(model.name)
        if self._actor is None:
            raise PluginError("it moves actors; write <actor> in place of <model>")
        if _ANIMATION not in self._actor.lengths:
            raise PluginError(f"the actor has no animation '{_ANIMATION}'; write <animation name='{_ANIMATION}'>")
        self._model = model
        self._first_target = sdf.get("target", (0.0, -5.0, _HEIGHT))
        self._target_weight = sdf.get("target_weight", 1.15)
        self._obstacle_weight = sdf.get("obstacle_weight", 1.5)
        self._animation_factor = sdf.get("animation_factor", 4.5)
        ignored = sdf.child("ignore_obstacles")
        self._ignored = {model.name} | {child.text for child in (ignored.children("model") if ignored else ())}
        self.reset()
        server.before_step(self._on_step)

    def reset(self) -> None:
        self._target: Vec3 = self._first_target
        self._last = self._world.time
        self._actor.take_over(_ANIMATION)

    def _on_step(self) -> None:
        now = self._world.time
        seconds, self._last = now - self._last, now
        pose = self._model.pose
        if math3.norm(math3.sub(self._target, pose.p)) < _ARRIVED:
            self._target = self._next_target()
        way = math3.scale(math3.unit(math3.sub(self._target, pose.p)), self._target_weight)
        for obstacle in self._obstacles():
            off = math3.sub(obstacle.pose.p, pose.p)
            distance = math3.norm(off)
            if 0.0 < distance < _SEES:
                way = math3.sub(way, math3.scale(math3.unit(off), self._obstacle_weight / distance))
        yaw = math3.quat_to_rpy(pose.q)[2]
        turn = math.remainder(math.atan2(way[1], way[0]) + math.pi / 2 - yaw, 2.0 * math.pi)  # the hips look along their z axis
        place = pose.p
        if abs(turn) > _TURNS_FIRST:
            turn *= _TURN
        else:
            place = math3.add(place, math3.scale(way, _SPEED * seconds))
        place = (*(min(max(v, low), high) for v, (low, high) in zip(place, _ROOM)), _HEIGHT)
        self._actor.script_time += self._animation_factor * math3.norm(math3.sub(place, pose.p))
        self._model.pose = Pose(place, math3.quat_from_rpy(math.pi / 2, 0.0, yaw + turn))

    def _obstacles(self) -> list[Any]:
        return [model for name, model in self._world.models.items() if name not in self._ignored]

    def _next_target(self) -> Vec3:
        """At least 2 m from here and from all that stands in the room."""
        random = self._world.rng(f"actor {self._model.name}")
        for _ in range(_TRIES):
            x, y = (float(random.uniform(low, high)) for low, high in _ROOM)
            target = x, y, self._target[2]
            near = [self._target] + [model.pose.p for model in self._world.models.values()]
            if all(math.dist(target, place) >= 2.0 for place in near):
                return target
        return self._target

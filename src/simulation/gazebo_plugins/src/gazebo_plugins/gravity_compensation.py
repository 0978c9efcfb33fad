"""libGravityCompensationPlugin.so: joints bear the weight of what hangs on them, as a description of the model has it."""

from __future__ import annotations

from typing import Any

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from ode_sim.description import DescriptionError, read_model
from ode_sim.description.model import Vec3

from gazebo_plugins.ros_side import required

_TURNS = ("revolute", "continuous", "universal", "revolute2")


class GravityCompensation(ModelPlugin):
    """``<uri>`` names a model whose masses are compensated for: the model's own, as a rule, or what its controller takes it to be.

    Each revolute, prismatic and universal joint is given the effort that holds all beyond it against the present gravity of the
    world. Weights that the description does not know, and links without ``<gravity>``, are not borne.
    """

    def load(self, server, model, sdf) -> None:
        uri = required(sdf, "uri")
        try:
            path = server.finder.find_model_sdf(uri)
            if path is None:
                raise PluginError(f"<uri>{uri}</uri>: no such model; {server.finder.explain(uri)}")
            with open(path, encoding="utf-8", errors="replace") as file:
                known, _ = read_model(file.read(), finder=server.finder)
        except (OSError, DescriptionError) as error:
            raise PluginError(f"<uri>{uri}</uri>: {error}") from error
        bodies = {link.name: link for link in known.links}
        self._check(model, {joint.name: joint for joint in known.joints}, uri)
        self.world = server.world
        self.weights = [
            (link, bodies[name].inertial.mass, bodies[name].inertial.pose.p)
            for name, link in model.links.items()
            if name in bodies and bodies[name].gravity
        ]
        beyond = self._beyond(model)
        self.joints = [(joint, [weight for weight in self.weights if weight[0] in beyond[joint]]) for joint in model.joints.values()]
        self.joints = [(joint, weights) for joint, weights in self.joints if joint.axis_count and weights]
        server.before_step(self.step)

    @staticmethod
    def _check(model, known: dict[str, Any], uri: str) -> None:
        for name, joint in model.joints.items():
            if name not in known:
                raise PluginError(f"<uri>{uri}</uri> has no joint '{name}', which model {model.name} has; name the same model")
            if known[name].type != joint.description.type:
                raise PluginError(f"<uri>{uri}</uri>: joint '{name}' is {known[name].type}, that of model {model.name} is not")
            if joint.axis_count and joint.description.type not in (*_TURNS, "prismatic"):
                rospy.logwarn(
                    "GravityCompensationPlugin of model %s: nothing is given to the %s joint '%s'", model.name, known[name].type, name
                )

    @staticmethod
    def _beyond(model) -> dict[Any, set]:
        """The links beyond each joint, which is in a tree: those that hang on its child."""
        below: dict[Any, list] = {}
        for joint in model.joints.values():
            below.setdefault(joint.parent, []).append(joint.child)

        def gather(link: Any, found: set) -> set:
            if link not in found:
                found.add(link)
                for child in below.get(link, ()):
                    gather(child, found)
            return found

        return {joint: gather(joint.child, set()) for joint in model.joints.values()}

    def step(self) -> None:
        gravity = self.world.gravity
        places = {link: math3.transform(link.pose, com) for link, _, com in self.weights}
        for joint, weights in self.joints:
            force: Vec3 = (0.0, 0.0, 0.0)
            moment: Vec3 = (0.0, 0.0, 0.0)
            anchor = joint.anchor()
            for link, mass, _ in weights:
                weight = math3.scale(gravity, mass)
                force = math3.add(force, weight)
                moment = math3.add(moment, math3.cross(math3.sub(places[link], anchor), weight))
            kind = joint.description.type
            for axis in range(joint.axis_count):
                load = moment if kind in _TURNS else force if kind == "prismatic" else (0.0, 0.0, 0.0)
                joint.add_force(-math3.dot(load, joint.world_axis(axis)), axis)

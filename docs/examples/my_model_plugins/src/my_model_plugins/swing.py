"""A model plugin: swings a joint, by forces. Its twin in C++ is ../swing.cpp."""

import math

from gazebo_ros.plugin import ModelPlugin, PluginError


class Swing(ModelPlugin):
    """``joint``, ``amplitude`` (rad), ``frequency`` (Hz)."""

    def load(self, server, model, sdf):
        name = sdf.get("joint", "")
        if name not in model.joints:
            raise PluginError(f"<joint>{name}</joint>: the model has no such joint")
        self._server = server
        self._joint = model.joints[name]
        self._amplitude = sdf.get("amplitude", 0.5)
        self._frequency = sdf.get("frequency", 0.5)
        server.before_step(self._update)

    def _update(self):
        """In every step, before it is computed: a spring with a damper pulls the joint to where it should be."""
        target = self._amplitude * math.sin(2 * math.pi * self._frequency * self._server.now().to_sec())
        self._joint.add_force(40.0 * (target - self._joint.position()) - 4.0 * self._joint.velocity())

"""Mimic joints: libroboticsgroup_gazebo_mimic_joint_plugin.so and its descendants. Gazebo itself lets them hang."""

from __future__ import annotations

from gazebo_ros.plugin import ModelPlugin

from gazebo_plugins.ros_side import find_joint, required


class MimicJoint(ModelPlugin):
    """``<mimicJoint>`` follows ``<joint>`` times ``<multiplier>`` plus ``<offset>``."""

    def load(self, server, model, sdf) -> None:
        for tag in ("joint", "mimicJoint"):
            required(sdf, tag)
        leader, follower = find_joint(model, sdf, "joint", ""), find_joint(model, sdf, "mimicJoint", "")
        server.drives(follower)
        follower.follow(leader, sdf.get("multiplier", 1.0), sdf.get("offset", 0.0))

"""libgazebo_ros_hand_of_god.so: a link is pulled to a tf frame by a critically damped spring."""

from __future__ import annotations

import math

import rospy
import tf2_ros
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from ode_sim.description.model import Pose

from gazebo_plugins.ros_side import TfBroadcaster, Topics, find_link


class HandOfGod(ModelPlugin):
    """Follows ``world`` -> ``<frameId>_desired``, tells where it is as ``<frameId>_actual``; the link feels no
    gravity."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf, "linkName")
        self.link.gravity = False
        self.frame = sdf.text_or("frameId", "hog")
        self.stiffness = sdf.get("kl", 200.0), sdf.get("ka", 200.0)  # N/m, N m/rad
        if min(self.stiffness) < 0.0:
            raise PluginError("<kl> (N/m) and <ka> (N m/rad) have to be 0 or more")
        mass, inertia = self.link.mass, max(self.link.inertia[:3])
        self.damping = 2 * math.sqrt(mass * self.stiffness[0]), 2 * math.sqrt(inertia * self.stiffness[1])
        self.buffer = tf2_ros.Buffer()
        self.listener = tf2_ros.TransformListener(self.buffer)
        self.told = False
        server.before_step(self.step)

    def step(self) -> None:
        try:
            transform = self.buffer.lookup_transform("world", self.frame + "_desired", rospy.Time(0)).transform
        except tf2_ros.TransformException:
            if not self.told:
                rospy.logwarn("%s: waiting for the transform world -> %s_desired", self.link.scoped_name, self.frame)
                self.told = True
            return
        desired = Pose(
            (transform.translation.x, transform.translation.y, transform.translation.z),
            (transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w),
        )
        pose = self.link.pose
        x, y, z, w = math3.quat_multiply(desired.q, math3.quat_inverse(pose.q))
        if w < 0.0:
            x, y, z, w = -x, -y, -z, -w
        length = math.sqrt(x * x + y * y + z * z)
        turn = math3.scale((x, y, z), 2 * math.atan2(length, w) / length) if length > 1e-12 else (0.0, 0.0, 0.0)
        spring, damper = self.stiffness, self.damping
        self.link.add_force(
            math3.sub(math3.scale(math3.sub(desired.p, pose.p), spring[0]), math3.scale(self.link.linear_velocity(), damper[0]))
        )
        self.link.add_torque(math3.sub(math3.scale(turn, spring[1]), math3.scale(self.link.angular_velocity(), damper[1])))
        TfBroadcaster.send(self.server.now(), "world", self.frame + "_actual", pose)

    def shutdown(self) -> None:
        self.listener.unregister()
        self.topics.close()

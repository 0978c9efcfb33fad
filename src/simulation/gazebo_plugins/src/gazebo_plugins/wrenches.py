"""Forces in and out: libgazebo_ros_ft_sensor.so, libgazebo_ros_f3d.so, libgazebo_ros_force.so."""
from __future__ import annotations

import math

import rospy
from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
from gazebo_ros.plugin import ModelPlugin
from node_signals.rates import Spaced
from ode_sim import math3

from gazebo_plugins.ros_side import Noise, Topics, find_joint, find_link, required


class FTSensor(ModelPlugin):
    """What the child bears on its parent (``child_to_parent``), in the child link's axes: force N, torque N m about the
    joint's anchor. Of a weight that hangs on it, the force points down."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        required(sdf, "jointName")
        self.joint = find_joint(model, sdf, "jointName", "")
        self.topics = Topics(sdf, model.name, "C")
        self.noise = Noise(server.world.rng(f"{model.name}/ft/{self.joint.name}"), sdf.get("gaussianNoise", 0.0))
        self.message = WrenchStamped()
        self.message.header.frame_id = self.topics.frame(self.joint.child.name)
        self.gate = Spaced(sdf.get("updateRate", 0.0))
        self.publisher = self.topics.publisher(required(sdf, "topicName"), WrenchStamped)
        self.joint.feedback()  # asks the engine to compute it from now on
        server.after_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if not self.publisher.get_num_connections() or not self.gate.due(now.to_nsec()):
            return
        feedback = self.joint.feedback()
        q_CW = math3.quat_inverse(self.joint.child.pose.q)
        force = self.noise.vector(math3.quat_rotate(q_CW, feedback.parent_force))
        torque = self.noise.vector(math3.quat_rotate(q_CW, feedback.parent_torque))
        self.message.header.stamp = now
        self.message.wrench = Wrench(Vector3(*force), Vector3(*torque))
        self.publisher.publish(self.message)

    def shutdown(self) -> None:
        self.topics.close()


class F3D(ModelPlugin):
    """Force and torque put on a link from outside (controllers, wrench jobs), world axes."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf)
        self.message = WrenchStamped()
        self.message.header.frame_id = self.topics.frame(sdf.text_or("frameName", "world"))
        self.publisher = self.topics.publisher(required(sdf, "topicName"), WrenchStamped)
        server.after_step(self.step)

    def step(self) -> None:
        if self.publisher.get_num_connections():
            self.message.header.stamp = self.server.now()
            self.message.wrench = Wrench(Vector3(*self.link.applied_force()), Vector3(*self.link.applied_torque()))
            self.publisher.publish(self.message)

    def shutdown(self) -> None:
        self.topics.close()


class Force(ModelPlugin):
    """The last Wrench received acts on the link's centre of mass in every step, world axes."""

    def load(self, server, model, sdf) -> None:
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf)
        self.reset()
        topic = required(sdf, "topicName")
        self.name = self.topics.resolve(topic)
        self.topics.subscriber(topic, Wrench, self._receive)
        server.before_step(self.step)

    def _receive(self, message: Wrench) -> None:
        f, t = message.force, message.torque
        if not all(map(math.isfinite, (f.x, f.y, f.z, t.x, t.y, t.z))):
            rospy.logwarn_throttle(5.0, f"{self.name}: a wrench that is not finite is ignored")
            return
        self.wrench = ((f.x, f.y, f.z), (t.x, t.y, t.z))

    def step(self) -> None:
        force, torque = self.wrench
        if any(force) or any(torque):
            self.link.add_force(force)
            self.link.add_torque(torque)

    def reset(self) -> None:
        self.wrench = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    def shutdown(self) -> None:
        self.topics.close()

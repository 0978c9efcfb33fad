"""Forces in and out: libgazebo_ros_ft_sensor.so, libgazebo_ros_f3d.so, libgazebo_ros_force.so."""

from __future__ import annotations

import math

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError, SensorPlugin
from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
from node_signals.rates import Spaced
from ode_sim import math3

from gazebo_plugins.ros_side import Noise, Topics, find_joint, find_link, required, sensor_element, subscribed
from gazebo_plugins.sensors.noise import SdfNoise, axis_noise


class Scale:
    """What a joint bears, as a ``<force_torque>`` says; the usual: what the child exerts on its parent, in the child's axes.

    :param sensor: the joint's sensor, or None for the usual
    :param rng: for its noise
    """

    def __init__(self, joint, sensor=None, rng=None):
        self.joint, self.sensor = joint, sensor
        block = sensor_element(sensor).child("force_torque") if sensor else None
        self.frame = block.text_or("frame", "child") if block else "child"
        self.sign = -1.0 if block and block.text_or("measure_direction", "") == "parent_to_child" else 1.0
        groups = [block and block.child(tag) for tag in ("force", "torque")]
        self.noise = [[SdfNoise(axis_noise(group, axis), rng) for axis in "xyz"] for group in groups]
        joint.feedback()  # asks the engine to compute it from now on

    @property
    def frame_name(self) -> str:
        """Of the link whose axes the wrench is in, or of the sensor."""
        if self.frame == "parent":
            return self.joint.parent.name if self.joint.parent else "world"
        return self.sensor.name if self.frame == "sensor" else self.joint.child.name

    def measure(self, dt: float):
        """Force (3,) N and torque (3,) N m about the joint's anchor.

        :param dt: s since the last time
        """
        feedback, joint = self.joint.feedback(), self.joint
        q_WF = joint.child.pose.q
        if self.frame == "parent":
            q_WF = joint.parent.pose.q if joint.parent else math3.IDENTITY.q
        elif self.frame == "sensor":
            q_WF = math3.quat_multiply(joint.frame().q, self.sensor.description.pose.q)
        q_FW = math3.quat_inverse(q_WF)
        return [
            tuple(noise(self.sign * value, dt) for noise, value in zip(noises, math3.quat_rotate(q_FW, vector)))
            for noises, vector in zip(self.noise, (feedback.parent_force, feedback.parent_torque))
        ]


class FTSensor(ModelPlugin, SensorPlugin):
    """What a joint bears: force N, torque N m about the joint's anchor. Of a weight that hangs on it, the force points down.

    As a plugin of a model of the joint ``<jointName>``: what the child exerts on its parent, in the child link's axes. In a joint's
    ``<sensor type="force_torque">``: what that sensor measures, by its frame, direction, noise and rate.
    """

    def load(self, server, subject, sdf) -> None:
        """Set it up in ``server`` as a plugin of ``subject``, a model or the sensor of a joint; ``sdf`` is the plugin's element.

        :raises PluginError: one line
        """
        self.server, self.last_ns = server, 0
        sensor = None if hasattr(subject, "joints") else subject
        if sensor is None:
            required(sdf, "jointName")
            self.scale = Scale(find_joint(subject, sdf, "jointName", ""))
        elif sensor.joint is None:
            raise PluginError(f"belongs into a sensor of type force_torque of a joint; '{sensor.name}' is of type '{sensor.type}'")
        else:
            self.scale = Scale(sensor.joint, sensor, server.world.rng(sensor.scoped_name))
        model = subject if sensor is None else sensor.model
        self.topics = Topics(sdf, model.name, "C")
        self.noise = Noise(server.world.rng(f"{model.name}/ft/{self.scale.joint.name}"), sdf.get("gaussianNoise", 0.0))
        self.message = WrenchStamped()
        self.message.header.frame_id = self.topics.frame(self.scale.frame_name)
        self.gate = Spaced(sdf.get("updateRate", 0.0))
        self.publisher = self.topics.publisher(required(sdf, "topicName"), WrenchStamped)
        if sensor is None:
            server.after_step(self.step)
        else:
            sensor.connect(lambda _: self.step(), subscribed(self.publisher))

    def step(self) -> None:
        now = self.server.now()
        now_ns = now.to_nsec()
        if not self.publisher.get_num_connections() or not self.gate.due(now_ns):
            return
        dt, self.last_ns = (now_ns - self.last_ns) * 1e-9, now_ns
        force, torque = (self.noise.vector(vector) for vector in self.scale.measure(dt))
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

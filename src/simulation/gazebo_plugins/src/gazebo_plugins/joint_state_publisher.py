"""libgazebo_ros_joint_state_publisher.so: positions and velocities of named joints, straight from the engine."""

from __future__ import annotations

from gazebo_ros.plugin import ModelPlugin, PluginError
from node_signals.rates import PeriodAdded
from sensor_msgs.msg import JointState

from gazebo_plugins.ros_side import Topics, joint_named


class JointStatePublisher(ModelPlugin):
    """Multi-turn angles are not wrapped; ``effort`` stays empty."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "A")
        names = "".join(sdf.get("jointName", "").split())
        if not names:
            raise PluginError("<jointName> is missing: a comma-separated list of joints")
        self.joints = [joint_named(model, name, "jointName") for name in names.split(",") if name]
        self.publisher = self.topics.publisher("joint_states", JointState, 1000)
        self.gate = PeriodAdded(sdf.get("updateRate", 100.0))
        server.before_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if self.gate.due(now.to_nsec()):
            message = JointState()
            message.header.stamp = now
            message.name = [joint.name for joint in self.joints]
            message.position = [joint.position() for joint in self.joints]
            message.velocity = [joint.velocity() for joint in self.joints]
            self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()

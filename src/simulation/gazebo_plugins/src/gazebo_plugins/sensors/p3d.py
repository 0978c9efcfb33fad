"""libgazebo_ros_p3d.so: the true pose and velocity of a link as nav_msgs/Odometry."""

from __future__ import annotations

from gazebo_ros.plugin import ModelPlugin, PluginError
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from node_signals.rates import Spaced
from ode_sim import math3
from ode_sim.description.model import Pose
from ode_sim.description.urdf_extensions import given_offset, merged_at

from gazebo_plugins.ros_side import Noise, Topics, diagonal, find_link, pose_msg, required

_WORLD = ("world", "/world", "map", "/map")


class P3D(ModelPlugin):
    """Twist in world axes, not in those of the child frame: packages that read ground truth know it so. Offsets of the file are along the
    reference's axes; a link that was merged into another is where it is on that."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf)
        frame = sdf.text_or("frameName", "world")
        self.reference = None
        if frame not in _WORLD:
            self.reference = model.links.get(frame)
            if self.reference is None:
                raise PluginError(
                    f"<frameName> must be world, map or a link of model {model.name}; '{frame}' is none of them ({', '.join(model.links)})"
                )
        self.merged, self.reference_merged = merged_at(sdf.element, "bodyName"), merged_at(sdf.element, "frameName")
        given = given_offset(sdf.element)
        self.xyz = given[0] if given else sdf.get("xyzOffset", sdf.get("xyzOffsets", (0.0, 0.0, 0.0)))
        self.rpy = math3.quat_from_rpy(*(given[1] if given else sdf.get("rpyOffset", sdf.get("rpyOffsets", (0.0, 0.0, 0.0)))))
        sigma = sdf.get("gaussianNoise", 0.0)
        self.noise = Noise(server.world.rng(f"{model.name}/p3d/{self.link.name}"), sigma)
        message = self.message = Odometry()
        message.header.frame_id = self.topics.frame(frame)
        message.child_frame_id = self.link.name
        message.pose.covariance = message.twist.covariance = diagonal((sigma * sigma,) * 6)
        self.gate = Spaced(sdf.get("updateRate", 0.0))
        self.publisher = self.topics.publisher(required(sdf, "topicName"), Odometry)
        server.after_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if not self.publisher.get_num_connections() or not self.gate.due(now.to_nsec()):
            return
        pose = math3.compose(self.link.pose, self.merged)
        linear, angular = self.link.velocity_at(pose.p), self.link.angular_velocity()
        if self.reference is not None:
            X_WR = math3.compose(self.reference.pose, self.reference_merged)
            q_RW = math3.quat_inverse(X_WR.q)
            linear = math3.quat_rotate(q_RW, math3.sub(linear, self.reference.velocity_at(X_WR.p)))
            angular = math3.quat_rotate(q_RW, math3.sub(angular, self.reference.angular_velocity()))
            pose = math3.relative(X_WR, pose)
        message = self.message
        message.header.stamp = now
        message.pose.pose = pose_msg(Pose(math3.add(pose.p, self.xyz), math3.quat_multiply(self.rpy, pose.q)))
        message.twist.twist = Twist(Vector3(*self.noise.vector(linear)), Vector3(*self.noise.vector(angular)))
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()

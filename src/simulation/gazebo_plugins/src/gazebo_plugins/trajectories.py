"""libgazebo_ros_joint_pose_trajectory.so: joints are put to the points of a trajectory one after the other."""

from __future__ import annotations

import math
from typing import Any

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from gazebo_plugins.ros_side import Topics

_WORLD = ("", "world", "map", "/map")


class JointPoseTrajectory(ModelPlugin):
    """``time_from_start`` of a point is how long it **lasts**, as upstream has it; its joints are held meanwhile.

    ``header.frame_id`` names the link that stays where it is, whose model is then the one that moves; or the world:
    then it is the first link of the plugin's own model.
    """

    by_hand = True  #: it puts joints as set_model_configuration does: an examiner wants to know who tells it to

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        topic = sdf.text_or("topicName", "set_joint_trajectory")
        self.topic = self.topics.resolve(topic)
        self.topics.subscriber(topic, JointTrajectory, self._receive, 100)
        self.playing = False
        server.before_step(self.step)

    def _receive(self, message: JointTrajectory) -> None:
        try:
            self.server.call(lambda: self._start(message))
        except PluginError as error:
            rospy.logwarn("%s: %s; the trajectory is ignored", self.topic, error)

    def _start(self, message: JointTrajectory) -> None:
        frame = message.header.frame_id
        still = self.model.canonical_link if frame in _WORLD else self.server.world.find_link(frame)
        if still is None:
            raise PluginError(f"header.frame_id '{frame}' names no link; name one as model::link, or 'world'")
        unknown = [name for name in message.joint_names if name not in still.model.joints]
        if unknown:
            raise PluginError(f"model {still.model.name} has no joint {', '.join(unknown)}")
        if any(
            len(point.positions) != len(message.joint_names) or not all(map(math.isfinite, point.positions)) for point in message.points
        ):
            raise PluginError("each point needs one finite position per joint")
        self.still, self.still_pose = still, still.pose
        self.joints = [still.model.joints[name] for name in message.joint_names]
        self.points: list[JointTrajectoryPoint] = list(message.points)
        self.held: dict[Any, float] = {}
        self.next_ns = max(self.server.now().to_nsec(), message.header.stamp.to_nsec())
        self.playing = True

    def step(self) -> None:
        if not self.playing or self.server.now().to_nsec() < self.next_ns and not self.held:
            return
        model = self.still.model
        if self.server.world.models.get(model.name) is not model:
            self.playing = False  # deleted meanwhile
            return
        if self.server.now().to_nsec() >= self.next_ns:
            if not self.points:
                self.playing = False
                return
            point = self.points.pop(0)
            self.held = dict(zip(self.joints, point.positions))
            self.next_ns += point.time_from_start.to_nsec()
        for joint, position in self.held.items():
            joint.set_position(position)
        model.pose = math3.compose(self.still_pose, math3.relative(self.still.pose, model.pose))
        model.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    def reset(self) -> None:
        self.playing = False

    def shutdown(self) -> None:
        self.topics.close()

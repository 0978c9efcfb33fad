"""libgazebo_ros_harness.so: a model hangs from the world, is lowered by a winch, and let go."""

from __future__ import annotations

import math

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import Attachment, math3
from ode_sim.description.model import Pose
from std_msgs.msg import Bool, Float32

from gazebo_plugins.ros_side import Topics, required


class Harness(ModelPlugin):
    """``<joint>`` elements with a ``<child>`` link, ``<winch><joint>``, ``<detach>`` as upstream.

    Topics ``/<model>/harness/velocity`` (m/s along the joint's axis) and ``/<model>/harness/detach``, whatever ``<robotNamespace>`` says.
    The winch moves exactly as commanded, within the joint's limits, whatever the load: its ``<pid>`` is not needed.
    """

    start: Pose
    attachment: Attachment

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        joints = {joint.attrib.get("name", ""): joint for joint in sdf.children("joint")}
        if not joints:
            raise PluginError("no <joint> that the model hangs on")
        winch = sdf.child("winch")
        tag, name = ("winch", winch.get("joint", "")) if winch else ("detach", sdf.get("detach", ""))
        if name not in joints:  # what hangs is not dropped for a slip of the pen
            first = next(iter(joints))
            rospy.logwarn(
                "%s: <%s> names the joint '%s', not one of the harness (%s); using %s", model.name, tag, name, ", ".join(joints), first
            )
            name = first
        joint = joints[name]
        child = required(joint, "child")
        if child not in model.links:
            raise PluginError(f"joint {name}: model {model.name} has no link '{child}'; it has {', '.join(model.links)}")
        self.link = model.links[child]
        axis = joint.child("axis")
        limit = axis.child("limit") if axis else None
        # in the world, as the joint is at the start
        self.axis = math3.unit(axis.get("xyz", (0.0, 0.0, 1.0)) if axis else (0.0, 0.0, 1.0))
        self.lower = limit.get("lower", -math.inf) if limit else -math.inf
        self.upper = limit.get("upper", math.inf) if limit else math.inf
        self.velocity = self.way = 0.0
        self._hold()
        self.topics = Topics(sdf, model.name, "A")
        self.velocity_topic = f"/{model.name}/harness/velocity"
        self.topics.subscriber(self.velocity_topic, Float32, self._wind)
        self.topics.subscriber(f"/{model.name}/harness/detach", Bool, self._release)
        server.before_step(self.step)

    def _hold(self) -> None:
        self.start, self.way, self.velocity = self.link.pose, 0.0, 0.0
        self.attachment = self.server.world.attach(None, self.link)

    def _wind(self, message: Float32) -> None:
        if math.isfinite(message.data):
            self.velocity = message.data
        else:
            rospy.logwarn("%s: a winch velocity that is not a finite number is ignored", self.velocity_topic)

    def _release(self, message: Bool) -> None:
        if message.data:
            self.server.call(self.attachment.detach)

    def step(self) -> None:
        if self.velocity and self.attachment.active:
            self.way = max(self.lower, min(self.upper, self.way + self.velocity * self.server.world.dt))
            self.attachment.pose = Pose(math3.add(self.start.p, math3.scale(self.axis, self.way)), self.start.q)

    def reset(self) -> None:
        self.attachment.detach()
        self._hold()

    def shutdown(self) -> None:
        self.attachment.detach()
        self.topics.close()

"""roboticsgroup's plugins and their copies: mimic joints (Gazebo itself lets them hang), and links that stand still."""

from __future__ import annotations

import math

import rospy
from control_toolbox import Pid, PidParameterError, load_pid
from controller_interface import NodeHandle
from gazebo_ros.plugin import ModelPlugin, PluginError

from gazebo_plugins.ros_side import Topics, find_joint, required


class MimicJoint(ModelPlugin):
    """``<mimicJoint>`` follows ``<joint>`` times ``<multiplier>`` plus ``<offset>``, where it is ``<sensitiveness>`` (rad, m) or more away
    from that.

    It is put there, and pushes what is in its way with the effort of the joint or ``<maxEffort>``. With ``<hasPID>`` a PID drives it by
    no more than that effort; the gains are in the namespace that the tag names, or gazebo_ros_control/pid_gains/JOINT.
    """

    def load(self, server, model, sdf) -> None:
        for tag in ("joint", "mimicJoint"):
            required(sdf, tag)
        self.server = server
        self.leader, self.follower = find_joint(model, sdf, "joint", ""), find_joint(model, sdf, "mimicJoint", "")
        self.multiplier, self.offset = sdf.get("multiplier", 1.0), sdf.get("offset", 0.0)
        self.sensitiveness = sdf.get("sensitiveness", 0.0)
        limit = self.follower.effort_limit
        self.most = max(sdf.get("maxEffort", limit if limit >= 0.0 else math.inf), 0.0)
        self.nodes = NodeHandle(Topics(sdf, model.name, "C").namespace)
        self.pid = self._pid(sdf.get("hasPID", "")) if sdf.has("hasPID") else None
        server.drives(self.follower)
        if self.pid:
            server.before_step(self.push)
            return
        if sdf.has("maxEffort"):
            self._limit_effort()
        if self.sensitiveness > 0.0:
            self.follower.drive_to(self.follower.position())
            server.before_step(self.put)
        else:
            self.follower.follow(self.leader, self.multiplier, self.offset)

    def _pid(self, name: str) -> Pid | None:
        """With the gains of the namespace ``name``; None, with an ERROR line, where there are none."""
        try:
            return load_pid(self.nodes.sub(name or f"gazebo_ros_control/pid_gains/{self.follower.name}"))
        except PidParameterError as error:
            rospy.logerr(
                "<hasPID> of %s: %s; load the gains before the robot is spawned. It follows exactly instead",
                self.follower.scoped_name,
                error,
            )
            return None

    def _limit_effort(self) -> None:
        """What a position-commanded joint pushes with is its own effort."""
        numbers = list(self.follower.core.get(0))
        numbers[2] = self.most
        self.follower.core.set_axis(0, self.follower.description.axes[0].xyz, *numbers)

    def _target(self) -> float:
        return self.leader.position() * self.multiplier + self.offset

    def put(self) -> None:
        target = self._target()
        if abs(target - self.follower.position()) >= self.sensitiveness:
            self.follower.drive_to(target)

    def push(self) -> None:
        error, dt = self._target() - self.follower.position(), self.server.world.dt
        if self.pid and abs(error) >= self.sensitiveness:
            self.follower.add_law(self.pid.compute_command(error, dt), self.pid.slope_of_position(dt), self.most)

    def reset(self) -> None:
        if self.pid:
            self.pid.reset()

    def shutdown(self) -> None:
        self.nodes.shutdown()


class DisableLink(ModelPlugin):
    """``<link>`` takes no part in the dynamics: nothing moves it. One on joints moves with them, as on Gazebo, where they wake it at
    once."""

    def load(self, server, model, sdf) -> None:
        name = required(sdf, "link")
        link = model.links.get(name)
        if link is None:
            raise PluginError(f"<link> names the link '{name}', which model {model.name} does not have; it has {', '.join(model.links)}")
        joints = [joint.name for joint in model.joints.values() if link in (joint.parent, joint.child)]
        if joints:
            rospy.logwarn(
                "plugin that disables link %s: it hangs on %s, which wakes it at once; only a link without joints stays where it is",
                link.scoped_name,
                ", ".join(joints),
            )
            return
        link.core.kinematic = True
        link.core.changed()

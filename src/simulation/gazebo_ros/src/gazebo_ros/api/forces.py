"""Wrenches on links and efforts on joints that last for a while."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazebo_msgs.srv import ApplyBodyWrench, ApplyJointEffort, BodyRequest, JointRequest
from ode_sim import math3

from gazebo_ros.api.geometry import frame_entity, vector_of
from gazebo_ros.api.handlers import advertise, finite, worded
from gazebo_ros.server import Server


@dataclass
class _Job:
    """Active while start <= sim time <= end (ns); ``end`` None = until cleared."""

    target: Any  # link or joint handle
    start_ns: int
    end_ns: int | None
    act: Callable[[], None]

    def active(self, now_ns: int) -> bool:
        return self.start_ns <= now_ns and (self.end_ns is None or now_ns <= self.end_ns)

    def over(self, now_ns: int) -> bool:
        return self.end_ns is not None and now_ns > self.end_ns


class ForceJobs:
    """Gazebo's rules: wrenches on one link replace each other (the last asked for wins), joint efforts add up.

    Sim time has advanced when a step is taken, so a duration shorter than a step does nothing.
    """

    def __init__(self, server: Server):
        self._server = server
        self._wrenches: list[_Job] = []
        self._efforts: list[_Job] = []
        server.before_step(self._on_step)
        server.world.on_remove.append(self._forget)
        advertise(server, "apply_body_wrench", ApplyBodyWrench, self._apply_body_wrench)
        advertise(server, "apply_joint_effort", ApplyJointEffort, self._apply_joint_effort)
        advertise(server, "clear_body_wrenches", BodyRequest, self._clear_body_wrenches)
        advertise(server, "clear_joint_forces", JointRequest, self._clear_joint_forces)

    def _on_step(self) -> None:
        if self._wrenches or self._efforts:
            now_ns = self._server.world.time_ns
            for jobs in (self._wrenches, self._efforts):
                for job in jobs:
                    if job.active(now_ns):
                        job.act()
                jobs[:] = [job for job in jobs if not job.over(now_ns)]

    def _forget(self, model) -> None:
        for jobs in (self._wrenches, self._efforts):
            jobs[:] = [job for job in jobs if job.target.model is not model]

    def _times(self, request) -> tuple[int, int | None]:
        """(start_ns, end_ns) of a request; a start in the past is now."""
        start_ns = max(request.start_time.to_nsec(), self._server.now().to_nsec())
        duration_ns = request.duration.to_nsec()
        return start_ns, None if duration_ns < 0 else start_ns + duration_ns

    def _apply_body_wrench(self, request, response) -> str:
        link = self._server.world.find_link(request.body_name)
        if link is None:
            raise worded("body does not exist", f"[{request.body_name}] names no link; write model::link")
        frame = frame_entity(self._server.world, request.reference_frame, "reference_frame not found")
        force = vector_of(request.wrench.force, "wrench.force")
        torque = vector_of(request.wrench.torque, "wrench.torque")
        point = vector_of(request.reference_point, "reference_point")
        torque = math3.add(torque, math3.cross(point, force))
        if frame is not None:  # lever arms count from the link origin, and the wrench acts at the centre of mass
            x_wf, x_wl = frame.pose, link.pose
            force, torque = math3.rotate(x_wf, force), math3.rotate(x_wf, torque)
            torque = math3.add(torque, math3.cross(math3.sub(x_wf.p, x_wl.p), force))

        def act() -> None:  # on the centre of mass, world axes
            link.set_force(force)
            link.set_torque(torque)

        self._wrenches.append(_Job(link, *self._times(request), act))
        return ""

    def _apply_joint_effort(self, request, response) -> str:
        joint = self._server.world.find_joint(request.joint_name)
        if joint is None:
            raise worded("joint not found", f"[{request.joint_name}] names none; name it as in the model's file")
        finite("effort", request.effort)
        self._efforts.append(_Job(joint, *self._times(request), lambda: joint.add_force(request.effort)))
        return "ApplyJointEffort: effort set"

    def _clear_body_wrenches(self, request, response) -> None:
        self._wrenches[:] = [job for job in self._wrenches if job.target.scoped_name != request.body_name]

    def _clear_joint_forces(self, request, response) -> None:
        self._efforts[:] = [job for job in self._efforts if job.target.name != request.joint_name]

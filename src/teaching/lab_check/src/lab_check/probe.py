"""What the examiner asks of the simulator, beyond Gazebo's services: everything at once, to the last digit, who touches whom, and what a
camera sees."""
from __future__ import annotations

import gc
import json
import pickle
import subprocess
import sys
from typing import Any, Dict, Set, Tuple

import numpy as np
import rospy
from gazebo_ros import node
from gazebo_ros.api.clock import ClockPublisher
from gazebo_ros.server import Server
from gazebo_ros.srv import TakePicture, TakePictureResponse
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse

_MOST_PAIRS = 200


class Probe:
    """``~lab_check_state`` (std_srvs/Trigger: JSON), ``~lab_check_contacts`` (std_srvs/SetBool: note touches from now on),
    ``~lab_check_seen`` (gazebo_ros/TakePicture: ``view`` is a camera's image topic; the answer's message is what :mod:`lab_check.seen`
    says)."""

    def __init__(self, server: Server):
        self._server = server
        self._connection = None
        self._pairs: Set[Tuple[str, str]] = set()
        rospy.Service("~lab_check_state", Trigger, self._state)
        rospy.Service("~lab_check_contacts", SetBool, self._contacts)
        rospy.Service("~lab_check_seen", TakePicture, self._seen)

    def _state(self, request) -> TriggerResponse:
        del request
        return TriggerResponse(True, json.dumps(self._server.call(self._read)))

    def _read(self) -> Dict[str, Any]:
        world = self._server.world
        models = {}
        for name, model in world.models.items():
            entry: Dict[str, Any] = {"static": bool(model.static), "pose": _numbers(model.pose)}
            if not model.static:
                entry["joints"] = {joint.name: [float(joint.position()), float(joint.velocity()), float(joint.effort())]
                                   for joint in model.joints.values() if joint.axis_count}
                entry["links"] = {link.name: _numbers(link.pose) for link in model.links.values()}
            models[name] = entry
        pairs, self._pairs = sorted(self._pairs), set()
        return {"time_ns": int(world.time_ns), "dt": float(world.dt), "models": models, "contacts": pairs[:_MOST_PAIRS]}

    def _contacts(self, request) -> SetBoolResponse:
        self._server.call(lambda: self._watch(request.data))
        return SetBoolResponse(True, "")

    def _watch(self, on: bool) -> None:
        self._pairs = set()
        if on and self._connection is None:
            self._connection = self._server.after_step(self._note)
        elif not on and self._connection is not None:
            self._connection.disconnect()
            self._connection = None

    def _note(self) -> None:
        world = self._server.world
        found = world.contacts()
        for first, second in set(zip(found["collision1"].tolist(), found["collision2"].tolist())):
            touching = [world.collision(number) for number in (first, second)]
            if all(touching):
                self._pairs.add(tuple(sorted(c.link.scoped_name for c in touching)))


    def _seen(self, request) -> TakePictureResponse:
        camera = _camera_of(request.view)
        if camera is None:
            return TakePictureResponse(success=False, status_message=f"no camera of the simulation publishes {request.view}")
        scene, poses = self._server.call(self._scene)
        done = subprocess.run([sys.executable, "-m", "lab_check.seen"], input=pickle.dumps((camera, scene, poses)), capture_output=True)
        if done.returncode:
            last = (done.stderr.decode("utf-8", "replace").strip().splitlines() or ["no reason given"])[-1]
            return TakePictureResponse(success=False, status_message=f"the simulator cannot draw what the camera sees ({last})")
        return TakePictureResponse(success=True, status_message=done.stdout.decode())

    def _scene(self):
        from ode_sim.rendering.scene import describe

        return describe(self._server.world), np.array(self._server.world.link_poses)


def _camera_of(topic: str):
    """The camera in whose namespace this topic of pictures is; None where that is none of the simulated ones."""
    plugin = sys.modules.get("gazebo_plugins.ros_camera")
    cameras = [one for one in gc.get_objects() if isinstance(one, plugin.RosCamera)] if plugin else []
    near = [one for one in cameras if topic.startswith(f"{one.namespace.rstrip('/')}/")]
    return max(near, key=lambda one: len(one.namespace)).camera if near else None


def _numbers(pose) -> list:
    """x, y, z, qx, qy, qz, qw."""
    return [float(v) for v in (*pose.p, *pose.q)]


class QuantumClock(ClockPublisher):
    """While the examiner lets a quantum pass, /clock comes once, at its end: of fifty messages that come at once, which one a loop sees
    when it wakes would differ from run to run."""

    def _on_step(self) -> None:
        if not self._server.paused:  # somebody else has let the simulation run
            super()._on_step()


def main() -> None:
    """gzserver's own, with a probe in it."""
    make, node.ClockPublisher = node.make_server, QuantumClock

    def make_server(options, sim_time=True):
        server = make(options, sim_time)
        Probe(server)
        return server

    node.make_server = make_server
    node.main()

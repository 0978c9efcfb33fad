"""What the examiner asks of the simulator, beyond Gazebo's services: everything at once, to the last digit, and who touches whom."""
from __future__ import annotations

import json
from typing import Any, Dict, Set, Tuple

import rospy
from gazebo_ros import node
from gazebo_ros.server import Server
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse

_MOST_PAIRS = 200


class Probe:
    """``~lab_check_state`` (std_srvs/Trigger: JSON), ``~lab_check_contacts`` (std_srvs/SetBool: note touches from now on)."""

    def __init__(self, server: Server):
        self._server = server
        self._connection = None
        self._pairs: Set[Tuple[str, str]] = set()
        rospy.Service("~lab_check_state", Trigger, self._state)
        rospy.Service("~lab_check_contacts", SetBool, self._contacts)

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


def _numbers(pose) -> list:
    """x, y, z, qx, qy, qz, qw."""
    return [float(v) for v in (*pose.p, *pose.q)]


def main() -> None:
    """gzserver's own, with a probe in it."""
    make = node.make_server

    def make_server(options, sim_time=True):
        server = make(options, sim_time)
        Probe(server)
        return server

    node.make_server = make_server
    node.main()

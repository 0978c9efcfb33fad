"""The simulator of an examination: ``python3 -m lab_check.examination.probe DESCRIPTOR PIPE HOME OPTIONS...`` is gzserver's own,
which also answers the examiner, and tells it through the pipe of the submission's code that it loads.

Question and answer pass through a pair of sockets that the examiner made before it started this process: nobody else has an end of it, so
that no node can answer in the simulator's place. See :mod:`lab_check.examination.simulator` for the other end.
"""

from __future__ import annotations

import base64
import gc
import json
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

import numpy as np
import rospy
from gazebo_ros import compiled, node
from gazebo_ros.api.clock import ClockPublisher
from gazebo_ros.server import Server

from lab_check.examination import submission_code
from lab_check.examination.scoped_names import belongs

if TYPE_CHECKING:
    from ode_sim.math3 import Pose
    from ode_sim_rendering.camera import Camera
    from ode_sim_rendering.scene import SceneDescription

_MOST_PAIRS = 5000
_MOST_NOTES = 100
_LONGEST_QUESTION = 100_000  # bytes
# Services of the simulator that only tell, let it come up, or are the examiner's own business; all others change what is measured.
_TELLING = ("get_", "describe_", "save_", "take_", "spawn_", "clear_", "pause_physics", "unpause_physics", "set_logger_level", "tf2_frames")
_ORDERS = {"reset": "reset_simulation", "reset_time": "reset_time", "reset_poses": "reset_world"}  # of the transport -> service
_TOPICS = ("set_model_state", "set_link_state")


class Probe:
    """Answers ``[what, arguments...]`` by ``[True, answer]``, or by ``[False, why not]``; all of it JSON."""

    def __init__(self, server: Server, wire: Connection, changes: Changes):
        self._server, self._wire, self._changes = server, wire, changes
        self._connection: Any = None
        self._pairs: set[tuple[str, str]] = set()
        self._touching: set[str] = set()  # models, or model::link, whose contacts are told; "": all
        self._models: dict[str, tuple[Any, int]] = {}  # by name, with a number that no other has had
        self._count = 0
        self._painter: Any = None
        changes.now = lambda: server.now().to_sec()
        self._say({"name": rospy.get_name(), "uri": rospy.get_node_uri()})
        threading.Thread(target=self._serve, name="lab_check", daemon=True).start()

    def _say(self, answer: Any) -> None:
        self._wire.send_bytes(json.dumps(answer).encode())

    def _serve(self) -> None:
        while True:
            try:
                what, *arguments = json.loads(self._wire.recv_bytes(_LONGEST_QUESTION))
            except (EOFError, OSError):  # the examiner is gone
                return
            try:
                answer = [True, getattr(self, f"_{what}")(*arguments)]
            except Exception as error:  # whatever a plugin did to the world: the examiner has to hear of it
                answer = [False, f"{type(error).__name__}: {error}"]
            self._say(answer)

    def _state(self) -> dict[str, Any]:
        return self._server.call(self._read)

    def _read(self) -> dict[str, Any]:
        world = self._server.world
        models = {}
        for name, model in world.models.items():
            entry: dict[str, Any] = {"static": bool(model.static), "pose": _numbers(model.pose), "serial": self._serial(name, model)}
            entry["links"] = {link.name: _numbers(link.pose) for link in model.links.values()}
            if not model.static:
                entry["joints"] = {
                    joint.name: [float(joint.position()), float(joint.velocity()), float(joint.effort())]
                    for joint in model.joints.values()
                    if joint.axis_count
                }
            models[name] = entry
        self._models = {name: self._models[name] for name in models}
        pairs, self._pairs = sorted(self._pairs), set()
        return {"time_ns": int(world.time_ns), "dt": float(world.dt), "models": models, "contacts": pairs[:_MOST_PAIRS]}

    def _serial(self, name: str, model: Any) -> int:
        """Whoever takes a model out and puts another of its name in its place has not that model any more."""
        known = self._models.get(name)
        if known is None or known[0] is not model:
            self._count += 1
            known = self._models[name] = (model, self._count)
        return known[1]

    def _step(self, count: int) -> bool:
        """Lets steps pass; False, and a simulation that rests from now on, where somebody had let it run."""
        try:
            self._server.call(lambda: self._server.request_steps(count)).result()
        except ValueError:
            self._server.call(self._server.pause)
            return False
        return True

    def _contacts(self, of: str | bool) -> None:
        """Note touches of this model or link from now on, too; True: all of them; False: none any longer."""
        self._server.call(lambda: self._watch(of))

    def _watch(self, of: str | bool) -> None:
        self._pairs = set()
        if of is False:
            self._touching.clear()
        else:
            self._touching.add("" if of is True else of)
        if self._touching and self._connection is None:
            self._connection = self._server.after_step(self._note)
        elif not self._touching and self._connection is not None:
            self._connection.disconnect()
            self._connection = None

    def _note(self) -> None:
        world = self._server.world
        found = world.contacts()
        for first, second in set(zip(found["collision1"].tolist(), found["collision2"].tolist())):
            touching = [world.collision(number) for number in (first, second)]
            if all(touching):
                pair = tuple(sorted(c.link.scoped_name for c in touching))
                if any(belongs(name, watched) for name in pair for watched in self._touching):
                    self._pairs.add(pair)

    def _seen(self, topic: str) -> dict[str, float]:
        """What the camera of an image topic sees, see :mod:`lab_check.examination.camera_visibility`."""
        camera = _camera_of(topic)
        if camera is None:
            raise LookupError(f"no camera of the simulation publishes {topic}")
        scene, poses = self._server.call(self._scene)
        done = subprocess.run(
            [sys.executable, "-P", "-s", "-m", "lab_check.examination.camera_visibility"],
            input=pickle.dumps((camera, scene, poses)),
            capture_output=True,
            cwd="/",
        )
        if done.returncode:
            last = (done.stderr.decode("utf-8", "replace").strip().splitlines() or ["no reason given"])[-1]
            raise RuntimeError(f"the simulator cannot draw what the camera sees ({last})")
        return json.loads(done.stdout)

    def _scene(self) -> tuple[SceneDescription, np.ndarray]:
        from ode_sim_rendering.scene import describe

        return describe(self._server.world), np.array(self._server.world.link_poses)

    def _picture(self, model: str, width: int, height: int) -> str:
        """A PNG in base64."""
        from ode_sim_rendering.portrait import Painter, Portrait

        scene, poses = self._server.call(self._scene)
        self._painter = self._painter or Painter()
        png, _ = self._painter.take(Portrait(scene, poses, model, "iso", width, height))
        return base64.b64encode(png).decode()

    def _changed(self) -> list[list[Any]]:
        """[service or topic, who, how often, s of simulation of the first time], since the beginning."""
        return self._changes.told()


class Changes:
    """Who has called services of the simulator that change what is measured, or published what does."""

    def __init__(self) -> None:
        self._found: dict[tuple[str, str], list[float]] = {}
        self._lock = threading.Lock()
        self.now = lambda: 0.0

    def watch(self) -> None:
        """Each service and subscriber that is made from here on."""
        offer, listen, changes = rospy.Service, rospy.Subscriber, self

        class Service(offer):  # type: ignore[misc,valid-type]
            def __init__(self, name: str, kind: Any, handler: Callable[..., Any], *arguments: Any, **more: Any):
                last = name.lstrip("~")
                if name.startswith("~") and not last.startswith(_TELLING):
                    handler = changes._noting(last, handler)
                super().__init__(name, kind, handler, *arguments, **more)

        class Subscriber(listen):  # type: ignore[misc,valid-type]
            def __init__(self, name: str, kind: Any, callback: Callable[..., Any] | None = None, *arguments: Any, **more: Any):
                last, plugin = name.lstrip("~"), type(getattr(callback, "__self__", None))
                if callback is not None and (last in _TOPICS or getattr(plugin, "by_hand", False)):
                    callback = changes._noting(last, callback)
                super().__init__(name, kind, callback, *arguments, **more)

        rospy.Service, rospy.Subscriber = Service, Subscriber
        self._watch_transport("_remove", lambda model: "delete_model")
        self._watch_transport("_order", _ORDERS.get)
        self._watch_transport("_parameter", lambda name: "set_physics_properties")

    def _watch_transport(self, method: str, service: Callable[[str], str | None]) -> None:
        """What clients of Gazebo's own topics, and compiled plugins, have the server do.

        :param service: that does the same, None for what changes nothing
        """
        do, changes = getattr(compiled.Bridge, method), self

        def noted(bridge: compiled.Bridge, order: str, *arguments: Any) -> Any:
            what = service(order)
            if what is not None:
                changes._note(what, "a client of Gazebo's transport, or a compiled plugin,")
            return do(bridge, order, *arguments)

        setattr(compiled.Bridge, method, noted)

    def _noting(self, what: str, handler: Callable[..., Any]) -> Callable[..., Any]:
        def noted(message: Any, *arguments: Any) -> Any:
            header = getattr(message, "_connection_header", None) or {}
            self._note(what, str(header.get("callerid", "somebody"))[:200])
            return handler(message, *arguments)

        return noted

    def _note(self, what: str, who: str) -> None:
        with self._lock:
            if (what, who) not in self._found and len(self._found) >= _MOST_NOTES:
                who = "others"
            self._found.setdefault((what, who), [0, self.now()])[0] += 1

    def told(self) -> list[list[Any]]:
        with self._lock:
            return [[what, who, count, first] for (what, who), (count, first) in sorted(self._found.items())]


def _camera_of(topic: str) -> Camera | None:
    """The camera in whose namespace this topic of pictures is; None where that is none of the simulated ones."""
    plugin = sys.modules.get("gazebo_plugins.cameras.ros_camera")
    cameras = [one for one in gc.get_objects() if isinstance(one, plugin.RosCamera)] if plugin else []
    near = [one for one in cameras if topic.startswith(f"{one.namespace.rstrip('/')}/")]
    return max(near, key=lambda one: len(one.namespace)).camera if near else None


def _numbers(pose: Pose) -> list[float]:
    """x, y, z, qx, qy, qz, qw."""
    return [float(v) for v in (*pose.p, *pose.q)]


class QuantumClock(ClockPublisher):
    """While the examiner lets a quantum pass, /clock comes once, at its end: of fifty messages that come at once, which one a loop sees
    when it wakes would differ from run to run."""

    def _on_step(self) -> None:
        if not self._server.paused:  # somebody else has let the simulation run
            super()._on_step()


def main(arguments: list[str] | None = None) -> None:
    """gzserver's own, with a probe in it."""
    number, pipe, home, *options = sys.argv[1:] if arguments is None else arguments
    os.set_inheritable(int(number), False)
    submission_code.tell(int(pipe), home)
    sys.argv[:] = ["gzserver", *options]
    wire, make, changes = Connection(int(number)), node.make_server, Changes()
    node.ClockPublisher = QuantumClock  # type: ignore[misc]
    changes.watch()

    def make_server(options: Any, sim_time: bool = True) -> Server:
        server = make(options, sim_time)
        Probe(server, wire, changes)
        return server

    node.make_server = make_server
    node.main()


if __name__ == "__main__":
    import signal

    signal.signal(signal.SIGINT, signal.SIG_DFL)  # until gzserver has its own handler, Ctrl-C ends it silently
    main()

"""``gz model`` and ``gz camera``: models are listed, shown, moved, spawned and deleted, cameras listed."""

from __future__ import annotations

import argparse
import re
import sys
from xml.parsers import expat

from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import DeleteModel, GetModelProperties, GetModelState, GetWorldProperties, SetModelState, SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion
from ode_sim import math3
from ode_sim.description.exchange import loads

from gazebo_ros.commands.asking import call
from gazebo_ros.commands.command_line import Failure
from gazebo_ros.srv import DescribeWorld

_ZERO = b"<pose>0 0 0 0 0 0</pose>"
_CAMERAS = ("camera", "depth", "depth_camera", "multicamera", "rgbd_camera", "wideanglecamera")


def _pose(options: argparse.Namespace) -> Pose:
    return Pose(Point(options.x, options.y, options.z), Quaternion(*math3.quat_from_rpy(options.roll, options.pitch, options.yaw)))


class _PoseFinder:
    """Where in an XML text the pose of its first model, light or inclusion is, in bytes."""

    def __init__(self, data: bytes):
        self.span: tuple[int, int] | None = None  # of its <pose>, or of no length where one has to be put
        self._data, self._path = data, list[str]()
        self._entity: int | None = None  # how deep in the tree it is
        self._begin = 0
        self._done = False
        self._parser = expat.ParserCreate("utf-8")
        self._parser.StartElementHandler, self._parser.EndElementHandler = self._start, self._end
        self._parser.Parse(data, True)

    def _start(self, name: str, _attributes: dict[str, str]) -> None:
        self._path.append(name)
        depth = len(self._path)
        if self._done:
            return
        begin = self._parser.CurrentByteIndex
        end = self._data.index(b">", begin) + 1
        closed = self._data[end - 2 : end] == b"/>"
        if self._entity is None and name in ("model", "light", "include") and set(self._path[:-1]) <= {"sdf", "gazebo", "world"}:
            self._entity = depth
            if name == "include" and not closed:
                self.span = (end, end)  # a pose there takes the place of the included model's own
        elif self._entity == depth - 1 and name == "pose":
            self._begin = begin
            if closed:  # the parser is behind it when it ends
                self.span, self._done = (begin, end), True

    def _end(self, name: str) -> None:
        depth = len(self._path)
        self._path.pop()
        if self._done or self._entity is None:
            return
        if depth == self._entity + 1 and name == "pose":
            self.span, self._done = (self._begin, self._data.index(b">", self._parser.CurrentByteIndex) + 1), True
        elif depth == self._entity:
            self._done = True


def at_its_origin(text: str) -> str:
    """``text``, of a model or a light in SDF, with a pose of zeros for its own: where it is put is where it stands then. Lines keep their
    numbers; what is no XML stays as it is."""
    data = text.encode()
    try:
        span = _PoseFinder(data).span
    except (expat.ExpatError, ValueError):  # the simulator says what is wrong with it
        return text
    if span is None:
        return text
    return (data[: span[0]] + _ZERO + b"\n" * data[slice(*span)].count(b"\n") + data[span[1] :]).decode()


def _read(path: str | None) -> str:
    """The text of the file ``path``, of standard input without one.

    :raises Failure: it cannot be read
    """
    where = path or "standard input"
    try:
        if path:
            with open(path, encoding="utf-8") as stream:
                return stream.read()
        return sys.stdin.buffer.read().decode()
    except OSError as error:
        raise Failure(f"cannot read {where}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise Failure(f"cannot read {where}: it is no text in UTF-8 (byte {error.start}); save it as such") from error


def model(options: argparse.Namespace) -> None:
    """List, show, move, spawn or delete."""
    if options.delete and options.model_name:
        call("delete_model", DeleteModel, options.model_name)
    elif options.spawn_file or options.spawn_string:
        text = at_its_origin(_read(options.spawn_file))
        try:
            call("spawn_sdf_model", SpawnModel, options.model_name, text, "", _pose(options), "")
        except Failure as error:  # the simulator calls what it was sent "text"
            raise Failure(re.sub(r"\btext(?=:\d)", lambda _: options.spawn_file or "standard input", str(error))) from error
    elif not options.model_name:
        print("\n".join(call("get_world_properties", GetWorldProperties).model_names))
    elif options.info or options.pose:
        state = call("get_model_state", GetModelState, options.model_name, "")
        p, q = state.pose.position, state.pose.orientation
        print(" ".join(f"{v:.6g}" for v in (p.x, p.y, p.z, *math3.quat_to_rpy((q.x, q.y, q.z, q.w)))))
        if options.info:
            print(call("get_model_properties", GetModelProperties, options.model_name))
    else:
        call("set_model_state", SetModelState, ModelState(options.model_name, _pose(options), ModelState().twist, ""))


def camera(options: argparse.Namespace) -> None:
    """List the cameras of the world."""
    if options.camera_name or options.follow:
        raise Failure(
            "cameras do not go after models here; the window does (pick a model, then View: Follow what is picked), and a camera that "
            "is on a link goes with it"
        )
    if not options.list:
        raise Failure("say what: -l lists the cameras of the world")
    from ode_sim_viewer import simulation  # noqa: F401, PLC0415 its records are read; all else needs it not

    record = loads(call("describe_world", DescribeWorld).world)
    for each in record.models:
        for part in each.description.parts:
            for sensor in part.sensors:
                if sensor.type in _CAMERAS:
                    print(f"{each.name}::{part.name}::{sensor.name}")

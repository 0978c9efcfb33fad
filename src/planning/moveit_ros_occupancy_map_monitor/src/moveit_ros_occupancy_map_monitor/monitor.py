"""Keeps the octomap of the planning scene."""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Callable
from typing import Any

import motion
import numpy as np
import rospy
from moveit_core import convert
from node_signals.parameters import is_number
from plugin_loader import PluginError, find_plugins

from .updater import OccupancyMapUpdater, UpdaterError

_MOST_CELLS = 1_000_000  # occupied ones, some 100 MB
_PATIENCE = 0.3  # wall s that transforms may come later than what was measured
INSIDE, SHADOW = 1, 2  # labels of points on what is known already


class OccupancyMapMonitor:
    """The octomap, and the updaters of ``~sensors``.

    :param scene: a SceneMonitor; it gets the octomap, and knows the robot and the objects that are no part of it.
    :param buffer: a tf2 buffer with a listener.
    """

    def __init__(self, scene, buffer, namespace: str = "~"):
        self._scene = scene
        self._buffer = buffer
        self._lock = threading.Lock()
        entries = self._entries(namespace)
        resolution = rospy.get_param(namespace + "octomap_resolution", None)
        if resolution is None and entries:
            rospy.logwarn("Resolution not specified for Octomap. Assuming resolution = 0.1 instead")
        self._map = _map(0.1 if resolution is None else resolution, rospy.resolve_name(namespace + "octomap_resolution"))
        self.frame = str(rospy.get_param(namespace + "octomap_frame", "")).lstrip("/") or scene.model.frame
        #: m that sensors are believed to see where their own settings do not say
        self.max_range = _number(namespace + "max_range", np.inf)
        self.updaters: list[OccupancyMapUpdater] = []
        self._load(entries)
        scene.on_octomap_gone(self._forget)
        for updater in self.updaters:
            updater.start()

    @staticmethod
    def _entries(namespace: str) -> list[dict[str, Any]]:
        parameter = rospy.resolve_name(namespace + "sensors")
        entries = rospy.get_param(namespace + "sensors", None)
        if entries is not None and not isinstance(entries, list):
            rospy.logerr("List of sensors must be an array! (parameter %s)", parameter)
            entries = []
        usable = []
        for number, entry in enumerate(entries or []):
            if not isinstance(entry, dict):
                rospy.logerr("Params for octomap updater %d not a struct; ignoring. (%s)", number, parameter)
            elif entry and not entry.get("sensor_plugin"):
                rospy.logerr("No sensor plugin specified for octomap updater %d; ignoring. (%s)", number, parameter)
            elif entry and not str(entry["sensor_plugin"]).startswith("~"):
                usable.append(entry)
        if not usable:
            rospy.loginfo("No 3D sensor plugin(s) defined for octomap updates")
        return usable

    def _load(self, entries: list[dict[str, Any]]) -> None:
        found = find_plugins("moveit_ros_occupancy_map_monitor")[0] if entries else {}
        for entry in entries:
            name = str(entry["sensor_plugin"])
            try:
                if name not in found:
                    raise PluginError(f"nobody exports it; there are: {', '.join(sorted(found)) or 'none'}")
                self.updaters.append(found[name].load()(self, entry))
            except Exception as error:  # a third party's updater may raise anything; the others are still of use
                kind = "" if isinstance(error, (PluginError, UpdaterError)) else f"{type(error).__name__}: "
                rospy.logerr("Exception while loading octomap updater '%s': %s%s", name, kind, " ".join(str(error).split())[:200])

    def shutdown(self) -> None:
        """End all updaters."""
        for updater in self.updaters:
            updater.stop()

    def clear(self) -> None:
        """Forget what was seen."""
        self._forget()
        self._scene.set_octomap(None, motion.Pose.identity())
        _give_back()

    def _forget(self) -> None:
        with self._lock:
            self._map.clear()

    def assign(self, tree: motion.OcTree) -> None:
        """Take over ``tree``, in the map's frame."""
        with self._lock:
            self._map.assign(tree)
        self._publish()

    def see(
        self,
        frame: str,
        stamp: rospy.Time,
        ends: np.ndarray,
        beyond: np.ndarray,
        scale: float,
        padding: Callable[[float], float],
        shadow: float = 0.0,
    ) -> np.ndarray:
        """Put what a sensor saw into the map, but for the robot, what it holds and the objects of the scene.

        :param frame: the sensor's frame; its origin is where rays begin.
        :param stamp: when it was there.
        :param ends: (n, 3) in that frame, m: where rays end on something.
        :param beyond: (m, 3): rays that end there are free all the way.
        :param scale: of what is left out, which is then grown by ``padding(distance from the sensor, m)`` m; what is up to
            ``shadow`` m behind it is left out as well.
        :returns: (n,) labels of ``ends``: 0 for what went into the map, else INSIDE or SHADOW.
        :raises UpdaterError: a transform is missing.
        """
        pose = self._transform(frame, stamp)
        rotation, origin = np.asarray(pose.matrix())[:3, :3], np.asarray(pose.position)
        ends, beyond = ends @ rotation.T + origin, beyond @ rotation.T + origin
        known = [(shape, at, padding(float(np.linalg.norm(at.position - origin)))) for shape, at in self._known(stamp)]
        labels = motion.label_points(known, ends, origin, scale, shadow)
        with self._lock:
            if len(self._map) > _MOST_CELLS:
                rospy.logerr(
                    "the octomap has more than %d cells and begins anew: make octomap_resolution (%g m) coarser, or max_range shorter",
                    _MOST_CELLS,
                    self._map.resolution,
                )
                self._map.clear()
            self._map.insert(origin, ends[labels == 0], ends[labels == INSIDE], beyond)
        self._publish()
        return labels

    def _publish(self) -> None:
        with self._lock:
            tree = self._map.tree() if len(self._map) else None
        pose = motion.Pose.identity()
        if self.frame != self._scene.model.frame:
            pose = self._transform(self.frame, rospy.Time(0), self._scene.model.frame)
        self._scene.set_octomap(tree, pose)

    def _known(self, stamp: rospy.Time) -> list[tuple[motion.Shape, motion.Pose]]:
        """Shapes and their poses in the map's frame: links where TF had them, what hangs on them, and objects."""
        scene, placed = self._scene.copy(), []
        held: dict[str, list] = {}
        for body in scene.state.attached:
            held.setdefault(body.link, []).append(body)
        for name in scene.model.links:
            link = scene.model.link(name)
            if not link.shapes and name not in held:
                continue
            pose = self._transform(name, stamp)
            placed += [(shape, pose * motion.Pose(*at)) for shape, at in zip(link.shapes, link.shape_poses)]
            for body in held.get(name, ()):
                placed += [(shape, pose * motion.Pose(*body.pose) * motion.Pose(*at)) for shape, at in zip(body.shapes, body.shape_poses)]
        names = [name for name in scene.objects if name != "<octomap>"]
        if names:
            frame = self._transform(scene.frame, stamp)
            for thing in map(scene.object, names):
                placed += [
                    (shape, frame * motion.Pose(*thing.pose) * motion.Pose(*at)) for shape, at in zip(thing.shapes, thing.shape_poses)
                ]
        return placed

    def _transform(self, frame: str, stamp: rospy.Time, target: str | None = None) -> motion.Pose:
        target, frame = target or self.frame, frame.lstrip("/")
        if frame == target:
            return motion.Pose.identity()
        end = time.monotonic() + _PATIENCE
        while True:
            try:
                found = self._buffer.lookup_transform(target, frame, stamp)
                return convert.pose(found.transform, f"frame '{frame}'")
            except Exception as error:  # tf2 has many kinds
                if time.monotonic() > end or rospy.is_shutdown():
                    raise UpdaterError(
                        f"what the sensor saw cannot be used: TF does not connect '{frame}' to '{target}' at "
                        f"{stamp.to_sec():.3f} s ({' '.join(str(error).split())[:100]})"
                    ) from None
            time.sleep(0.01)


def _give_back() -> None:
    """Give the system what was freed: glibc keeps the memory of a million small cells, and of clouds, for later."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:
        trim(0)


def _number(parameter: str, default: float) -> float:
    value = rospy.get_param(parameter, default)
    if not is_number(value, finite=False):
        rospy.logerr("parameter %s is %r, not a number: it is ignored", rospy.resolve_name(parameter), str(value)[:40])
        return default
    return float(value)


def _map(resolution, parameter: str) -> motion.OccupancyMap:
    try:
        return motion.OccupancyMap(float(resolution))
    except (TypeError, ValueError, motion.MotionError) as error:
        rospy.logerr("parameter %s is %s: %s; 0.1 m is used", parameter, str(resolution)[:40], error)
        return motion.OccupancyMap(0.1)

"""Cameras that compiled plugins read: drawn by the process that draws for Python's cameras, and handed to C++ as they arrive.

C++ (gazebo_cpp's ``core/picture_sensors.cpp``) says when a picture is due and what of it somebody waits for; nothing is drawn else.
"""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np
import rospy
from gazebo_cpp import _core
from ode_sim.description import model as d
from ode_sim.errors import CameraError
from ode_sim_rendering import ENCODINGS, Camera, Frame, read_camera

from gazebo_ros.rate_watch import RateWatch
from gazebo_ros.studio import Shooting


class _Taken:
    """One camera of a sensor.

    :param view: as C++ tells it, see ``Host::shoot`` in gazebo_cpp's ``core/mirror.hpp``
    """

    def __init__(self, server, number: int, link, sensor: d.Sensor, index: int, view: tuple[float, ...]):
        self.model = link.model
        self._number, self._view = number, view
        self._label = f"sensor '{sensor.name}' of model '{link.model.name}'"
        self._came, self._can_be = False, True
        self._world, self._rate, self._watch = server.world, sensor.update_rate, RateWatch()
        element = sensor.element.findall("camera")[index]
        given = (element.findtext("image/format") or "R8G8B8").strip()
        self._camera = read_camera(
            element,
            sensor.pose,
            link.scoped_name,
            f"{link.scoped_name}::{sensor.name}::{element.get('name', '')}",
            image_format=given if given in ENCODINGS else "B8G8R8",
        )
        # One at a time, as in Gazebo: plugins stamp a picture with the time at which they get it.
        self._shooting = Shooting(server, self._as_told(view), self._label, most=1)

    def _as_told(self, view: tuple[float, ...]) -> Camera:
        x, y, z, *q = view[:7]
        hfov, near, far, width, height, crop = view[7:]
        return replace(
            self._camera,
            pose=d.Pose((x, y, z), (q[0], q[1], q[2], q[3])),
            hfov=hfov,
            near=near,
            far=far,
            width=int(width),
            height=int(height),
            distortion=replace(self._camera.distortion, crop=bool(crop)),
        )

    def shoot(self, view: tuple[float, ...], outputs: tuple[str, ...]) -> bool:
        """:raises CameraError: what no camera can be, once; there are no pictures until it is told otherwise."""
        if view != self._view:
            self._view, self._can_be = view, False
            self._shooting.change(self._as_told(view))
            self._can_be = True
        if not self._can_be:
            return False
        taken = self._shooting.shoot(outputs, self._arrived)
        if self._came:  # the first one takes as long as the process that draws needs to start
            said = self._watch.asked(self._world.time_ns, taken, self._rate, 0.0, self._world.dt)
            if said:
                rospy.logwarn("%s %s", self._label, said)
        return taken

    def _arrived(self, frame: Frame) -> None:
        """Thread of the pictures, or in lock-step while the step waits for it."""
        self._came = True
        _core.develop(self._number, frame.time_ns, frame.data.get("image"), frame.data.get("depth"))

    def close(self) -> None:
        self._shooting.close()


class CompiledCameras:
    """Physics thread, within the step."""

    def __init__(self, server):
        self._server = server
        self._cameras: dict[int, _Taken | None] = {}  # None: cannot be drawn
        _core.set_studio(self._shoot, save_picture)
        server.world.on_remove.append(self._forget)

    def _shoot(self, number: int, sensor: str, index: int, view: list[float], outputs: list[str]) -> bool:
        """Have a picture of now; False when it is left out.

        :param sensor: ``model::link::sensor``. :param index: which of its cameras
        """
        try:
            if number not in self._cameras:
                self._cameras[number] = None
                self._cameras[number] = self._open(number, sensor, index, tuple(view))
            camera = self._cameras[number]
            return camera is not None and camera.shoot(tuple(view), tuple(outputs))
        except CameraError as error:
            rospy.logerr("sensor '%s' gives no pictures to compiled plugins: %s", sensor, error)
            return False

    def _open(self, number: int, name: str, index: int, view: tuple[float, ...]) -> _Taken:
        scope, _, sensor_name = name.rpartition("::")
        link = self._server.world.find_link(scope)
        found = [each for each in link.description.sensors if each.name == sensor_name] if link is not None else []
        if not found:
            raise CameraError("the model does not have it any more")
        return _Taken(self._server, number, link, found[0], index, view)

    def _forget(self, model) -> None:
        for number, camera in list(self._cameras.items()):
            if camera is not None and camera.model is model:
                camera.close()
                del self._cameras[number]


def save_picture(file: str, pixels: bytes, width: int, height: int, image_format: str) -> bool:
    """Write what a compiled plugin saves; one line where that cannot be done. Any thread.

    :param file: its ending says how. :param image_format: SDF's
    :param pixels: bytes of ``height`` rows of ``width`` pixels, the first row at the top
    """
    import cv2  # half a second, for the few who save

    encoding = ENCODINGS.get(image_format, "bgr8")
    image = np.frombuffer(pixels, np.uint16 if encoding.endswith("16") else np.uint8)
    image = image.reshape(height, width, -1)
    if encoding.startswith("rgb"):
        image = image[..., ::-1]
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        if cv2.imwrite(file, image):
            return True
        reason = "it was not written"
    except (OSError, cv2.error) as error:
        reason = str(error).strip().splitlines()[-1]
    rospy.logerr("picture %s, saved by a compiled plugin: %s", file, reason)
    return False

"""Ranges of a ``gpu_ray`` sensor from depth pictures, where a graphics card draws them: of visuals, as in Gazebo."""

from __future__ import annotations

import os

import numpy as np
import rospy
from gazebo_ros.studio import Shooting
from ode_sim_rendering import Camera
from ode_sim_rendering.camera import Fan
from ode_sim_rendering.devices import card_draws

VARIABLE = "ODE_SIM_GPU_RAY"
_KINDS = ("gpu_ray", "gpu_lidar")
_WORTH_IT = 4096  # rays; fewer are cast sooner than a picture comes
_NEAREST = 1e-3  # m, of a picture


def wanted(kind: str, rays: int) -> bool:
    """Whether a sensor of that type with so many ``rays`` measures by pictures.

    ``ODE_SIM_GPU_RAY`` says ``pictures`` or ``rays`` for each; without it many rays are pictures where a card is.

    :param kind: type of the sensor, as in SDF
    """
    told = os.environ.get(VARIABLE, "").strip() or "auto"
    if told not in ("auto", "pictures", "rays"):
        rospy.logwarn_once("%s is '%s'; use pictures, rays or auto", VARIABLE, told)
        told = "auto"
    return kind in _KINDS and (told == "pictures" or told == "auto" and rays >= _WORTH_IT and card_draws())


class RayPictures:
    """The rays of one sensor, while pictures come.

    :param yaws: (H,) rad in rising order, :param pitches: (V,) likewise
    :raises CameraError: rays that no pictures show
    """

    def __init__(self, server, sensor, yaws: np.ndarray, pitches: np.ndarray, near: float, far: float):
        camera = Camera(
            name=sensor.scoped_name, near=max(near, _NEAREST), far=far, pose=sensor.description.pose, link=sensor.link.scoped_name
        )
        fan = Fan(tuple(map(float, yaws)), tuple(map(float, pitches)))
        self._count = len(yaws) * len(pitches)
        self._shooting = Shooting(server, camera, f"sensor '{sensor.name}' of model '{sensor.model.name}'", fan=fan)

    def cast(self) -> tuple[np.ndarray, np.ndarray] | None:
        """(V*H,) ranges in m, +inf for none, and retros; None when no picture came, then or before."""
        if self._shooting.failed:
            return None
        taken: list[np.ndarray] = []
        self._shooting.shoot(("rays",), lambda frame: taken.append(np.frombuffer(frame.data["rays"], np.float32).astype(float)))
        return (taken[0][: self._count], taken[0][self._count :]) if taken else None

    def close(self) -> None:
        self._shooting.close()

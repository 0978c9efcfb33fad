"""CameraInfo as Gazebo's camera plugins compute it, and the set_camera_info service."""

from __future__ import annotations

import os
from dataclasses import dataclass

import rospkg
import yaml
from node_signals import offers
from ode_sim_rendering import Camera
from sensor_msgs.msg import CameraInfo
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoResponse


@dataclass(frozen=True)
class Calibration:
    """Numbers of the plugin's own tags; 0 stands for what follows from the image size and the field of view."""

    cx_prime: float
    cx: float
    cy: float
    focal_length: float
    baseline: float
    k1: float
    k2: float
    k3: float
    t1: float
    t2: float


def read_calibration(sdf, camera: Camera) -> Calibration:
    """From ``sdf``, the ``<plugin>`` element; with ``<autoDistortion>`` the coefficients are those of ``camera``'s lens."""
    lens = camera.distortion
    automatic = sdf.get("autoDistortion", False)
    coefficients = (
        (lens.k1, lens.k2, lens.k3, lens.p1, lens.p2)
        if automatic
        else tuple(sdf.get("distortion" + tag, 0.0) for tag in ("K1", "K2", "K3", "T1", "T2"))
    )
    return Calibration(
        sdf.get("CxPrime", 0.0),
        sdf.get("Cx", 0.0),
        sdf.get("Cy", 0.0),
        sdf.get("focalLength", 0.0),
        sdf.get("hackBaseline", 0.0),
        *coefficients,
    )


def camera_info(camera: Camera, calibration: Calibration, baseline: float) -> CameraInfo:
    """Of ``camera`` with ``calibration``, without header.

    :param baseline: m, distance to the first camera of a stereo pair, P[3] = -f * baseline.
    """
    c = calibration
    f = c.focal_length or camera.focal_length
    cx, cy = c.cx or (camera.width + 1) / 2, c.cy or (camera.height + 1) / 2
    return CameraInfo(
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        D=[c.k1, c.k2, c.t1, c.t2, c.k3],
        K=[f, 0, cx, 0, f, cy, 0, 0, 1],
        R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
        P=[f, 0, cx, -f * baseline, 0, f, cy, 0, 0, 0, 1, 0],
    )


class CameraInfoService:
    """``set_camera_info``: what a calibration program sends replaces the computed numbers and is kept in
    ``ROS_HOME/camera_info/<name>.yaml``, as camera_info_manager does."""

    def __init__(self, namespace: str, name: str, info: CameraInfo):
        self.info = info
        self._name = name
        self._service = offers.service(f"{namespace}/set_camera_info", SetCameraInfo, self._set)

    def _set(self, request):
        info = request.camera_info
        if (info.width, info.height) != (self.info.width, self.info.height):
            return SetCameraInfoResponse(
                False, f"the calibration is for {info.width}x{info.height} pixels, the camera has {self.info.width}x{self.info.height}"
            )
        self.info = info
        file = os.path.join(rospkg.get_ros_home(), "camera_info", f"{self._name}.yaml")
        try:
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "w", encoding="utf-8") as out:
                yaml.safe_dump(_as_yaml(self._name, info), out, sort_keys=False, default_flow_style=None)
        except OSError as error:
            return SetCameraInfoResponse(False, f"in use now, but not saved: {error}")
        return SetCameraInfoResponse(True, f"saved to {file}")

    def shutdown(self) -> None:
        self._service.shutdown("the camera is gone")


def _as_yaml(name: str, info: CameraInfo) -> dict:
    """The layout of camera_calibration_parsers."""

    def matrix(rows: int, values) -> dict:
        return {"rows": rows, "cols": len(values) // rows if rows else 0, "data": [float(v) for v in values]}

    return {
        "image_width": info.width,
        "image_height": info.height,
        "camera_name": name,
        "camera_matrix": matrix(3, info.K),
        "distortion_model": info.distortion_model,
        "distortion_coefficients": matrix(1, info.D),
        "rectification_matrix": matrix(3, info.R),
        "projection_matrix": matrix(3, info.P),
    }

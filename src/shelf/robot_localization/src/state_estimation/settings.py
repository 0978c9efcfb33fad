"""Parameters of the ekf and ukf nodes: names of frames, and what is told of those that have no effect."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from typing import Any

import rospy

from .inputs import KINDS

_WITHOUT_EFFECT = ("debug", "smooth_lagged_data", "history_length", "use_control")
_OF_CONTROL = (
    "stamped_control",
    "control_timeout",
    "control_config",
    "acceleration_limits",
    "acceleration_gains",
    "deceleration_limits",
    "deceleration_gains",
)
_KNOWN = (
    *_WITHOUT_EFFECT,
    *_OF_CONTROL,
    "alpha",
    "base_link_frame",
    "base_link_frame_output",
    "beta",
    "debug_out_file",
    "disabled_at_startup",
    "dynamic_process_noise_covariance",
    "frequency",
    "gravitational_acceleration",
    "initial_estimate_covariance",
    "initial_state",
    "invert_tf",
    "kappa",
    "map_frame",
    "odom_frame",
    "permit_corrected_publication",
    "predict_to_current_time",
    "print_diagnostics",
    "process_noise_covariance",
    "publish_acceleration",
    "publish_tf",
    "reset_on_time_jump",
    "sensor_timeout",
    "silent_tf_failure",
    "tf_prefix",
    "transform_time_offset",
    "transform_timeout",
    "two_d_mode",
    "world_frame",
)
_OF_SENSORS = ("config", "queue_size", "nodelay", "differential", "relative", "rejection_threshold")
_OF_KINDS = {
    "odom": ("pose_rejection_threshold", "twist_rejection_threshold", "pose_use_child_frame"),
    "imu": (
        "pose_rejection_threshold",
        "twist_rejection_threshold",
        "linear_acceleration_rejection_threshold",
        "remove_gravitational_acceleration",
    ),
}
SENSOR = re.compile(f"({'|'.join(KINDS)})[0-9]+")


@dataclass
class Frames:
    """Names, without a slash in front. ``output``: what the robot is called in what goes out."""

    map: str
    odom: str
    base: str
    world: str
    output: str


def frames_of(parameters: dict[str, Any]) -> Frames:
    """:raises ValueError: two that must differ do not, or the world is none of them"""
    place = rospy.search_param("tf_prefix")
    prefix = str(rospy.get_param(place)).strip("/") if place else ""

    def name(key: str, default: str) -> str:
        frame = str(parameters.get(key, default)).lstrip("/")
        return f"{prefix}/{frame}" if prefix else frame

    odom, base = str(parameters.get("odom_frame", "odom")), str(parameters.get("base_link_frame", "base_link"))
    names = ("map_frame", "map"), ("odom_frame", odom), ("base_link_frame", base), ("world_frame", odom), ("base_link_frame_output", base)
    frames = Frames(*(name(key, default) for key, default in names))
    if len({frames.map, frames.odom, frames.base}) < 3:
        raise ValueError(
            "map_frame, odom_frame and base_link_frame must be three different frames, but are "
            f"{frames.map}, {frames.odom} and {frames.base}"
        )
    if frames.output in (frames.map, frames.odom):
        raise ValueError(f"base_link_frame_output must be another frame than map_frame and odom_frame, but is {frames.output}")
    if frames.world not in (frames.map, frames.odom):
        raise ValueError(f"world_frame must be map_frame ({frames.map}) or odom_frame ({frames.odom}), but is {frames.world}")
    return frames


def tell_of_parameters(parameters: dict[str, Any]) -> None:
    """A warning for each that has no effect: upstream's that are not here, and names that no parameter of such a node has."""
    own = rospy.get_name()
    for name in _WITHOUT_EFFECT:
        if parameters.get(name):
            rospy.logwarn("%s/%s has no effect in this robot_localization.", own, name)
    known = set(_KNOWN)
    for sensor in filter(SENSOR.fullmatch, parameters):
        of_kind = _OF_KINDS.get(sensor.rstrip("0123456789"), ())
        known |= {sensor, *(f"{sensor}_{word}" for word in (*_OF_SENSORS, *of_kind))}
    for name in sorted(set(parameters) - known):
        near = difflib.get_close_matches(name, known, 1, 0.75)
        rospy.logwarn("%s/%s has no effect: no parameter is called so%s", own, name, f"; did you mean {near[0]}?" if near else ".")

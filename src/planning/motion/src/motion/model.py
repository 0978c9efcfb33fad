"""From URDF and SRDF text to a RobotModel."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from motion import _core
from motion.files import FindPackage, resolve
from motion.files import find_package as below_ros_package_path


def load_model(
    urdf: str,
    srdf: str | None = None,
    *,
    joint_limits: Mapping[str, Any] | None = None,
    find_package: FindPackage | None = None,
    meshes: bool = True,
) -> _core.RobotModel:
    """The robot that the texts describe.

    :param urdf: XML text of the URDF.
    :param srdf: XML text of the SRDF; without it the robot has no groups.
    :param joint_limits: the mapping of joint_limits.yaml, whole or what is below its key ``joint_limits``; wins over the URDF.
        The variables of a planar or floating joint have their limits below its name: ``{"base": {"x": {"max_velocity": 0.5}}}``,
        or under ``"base/x"``.
    :param find_package: ``f(package name) -> directory or None``; by default a search below ROS_PACKAGE_PATH.
    :param meshes: load collision meshes.
    :raises ModelError: the texts cannot be made into a robot. What is only left out is in ``warnings``;
        a line of these that begins with ``error: `` says that some of the robot cannot be planned for.
    :raises InvalidInputError: the joint limits are not what they should be.
    """
    limits = dict(joint_limits or {})
    if isinstance(limits.get("joint_limits"), Mapping):
        limits = dict(limits["joint_limits"])
    package = find_package or below_ros_package_path
    return _core._load_model(urdf, srdf or "", by_variable(limits), lambda uri: resolve(uri, package), meshes)


def by_variable(limits: Mapping[str, Any], above: str = "") -> dict[str, dict[str, Any]]:
    """The tables ``limits`` of joint_limits.yaml by variable name: ``{"base": {"x": {...}}}`` is ``{"base/x": {...}}``.

    :param above: stands before each name, with its slash.
    """
    found: dict[str, dict[str, Any]] = {}
    for name, values in limits.items():
        if not isinstance(values, Mapping):
            continue
        own = {key: value for key, value in values.items() if not isinstance(value, Mapping)}
        if own or not values:
            found[f"{above}{name}"] = own
        found.update(by_variable(values, f"{above}{name}/"))
    return found

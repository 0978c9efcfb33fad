"""Named collections of handles, and the claims that controllers lay on them.

``type_name`` is the C++ name that users see in list_controllers and write (with a slash) in transmissions.
"""

from __future__ import annotations

from typing import Any

import rospy

from .errors import ResourceError


class HardwareInterface:
    """Handles by name. ``claiming`` interfaces note which resources a controller has taken.

    :cvar type_name: C++ name, ``package::Class`` of the deriving class unless that says otherwise.
    """

    type_name = "hardware_interface::HardwareInterface"
    claiming = False

    def __init_subclass__(cls) -> None:
        if "type_name" not in vars(cls):
            cls.type_name = f"{cls.__module__.partition('.')[0]}::{cls.__name__}"

    def __init__(self, *handles: Any):
        self._handles: dict[str, Any] = {}
        self._claims: set[str] = set()
        for handle in handles:
            self.register_handle(handle)

    def register_handle(self, handle: Any) -> None:
        """Add a handle under its name. A second one of the same name replaces the first, with a warning."""
        if handle.name in self._handles:
            rospy.logwarn("Replacing previously registered handle '%s' in '%s'.", handle.name, self.type_name)
        self._handles[handle.name] = handle

    def get_handle(self, name: str) -> Any:
        """The handle of resource ``name``; claims it when the interface is one that commands.

        :raises ResourceError: no such resource.
        """
        try:
            handle = self._handles[name]
        except KeyError:
            raise ResourceError(
                f"Could not find resource '{name}' in '{self.type_name}'; it has: {', '.join(self.names()) or 'none'}"
            ) from None
        if self.claiming:
            self.claim(name)
        return handle

    def handles(self) -> list[Any]:
        """All handles, sorted by name, without claiming anything: for the hardware itself."""
        return [self._handles[name] for name in self.names()]

    def names(self) -> list[str]:
        """Resource names, sorted."""
        return sorted(self._handles)

    def __contains__(self, name: str) -> bool:
        return name in self._handles

    def claim(self, resource: str) -> None:
        """Note that the controller which is being initialised takes ``resource``, a joint's name."""
        self._claims.add(resource)

    def clear_claims(self) -> None:
        self._claims.clear()

    @property
    def claims(self) -> set[str]:
        """Resources claimed since clear_claims()."""
        return set(self._claims)

    @classmethod
    def merged(cls, interfaces: list[HardwareInterface]) -> HardwareInterface:
        """One interface with the handles of ``interfaces``, several of the same type."""
        result = cls()
        for interface in interfaces:
            for handle in interface.handles():
                result.register_handle(handle)
        return result


class JointStateInterface(HardwareInterface):
    """JointStateHandles."""


class JointCommandInterface(HardwareInterface):
    """JointHandles: base of the interfaces with one command per joint."""

    claiming = True


class PositionJointInterface(JointCommandInterface):
    """JointHandles whose command is a position, rad or m."""


class VelocityJointInterface(JointCommandInterface):
    """JointHandles whose command is a velocity, rad/s or m/s."""


class EffortJointInterface(JointCommandInterface):
    """JointHandles whose command is an effort, Nm or N."""


class PosVelJointInterface(HardwareInterface):
    """PosVelJointHandles."""

    claiming = True


class PosVelAccJointInterface(HardwareInterface):
    """PosVelAccJointHandles."""

    claiming = True


class PositionVelocityTorqueGainsJointInterface(HardwareInterface):
    """PositionVelocityTorqueGainsJointHandles."""

    claiming = True


class ActuatorStateInterface(HardwareInterface):
    """ActuatorStateHandles."""


class PositionActuatorInterface(HardwareInterface):
    """ActuatorHandles whose command is a position, rad or m."""


class VelocityActuatorInterface(HardwareInterface):
    """ActuatorHandles whose command is a velocity, rad/s or m/s."""


class EffortActuatorInterface(HardwareInterface):
    """ActuatorHandles whose command is an effort, Nm or N."""


class ImuSensorInterface(HardwareInterface):
    """ImuSensorHandles."""


class ForceTorqueSensorInterface(HardwareInterface):
    """ForceTorqueSensorHandles."""


class JointModeInterface(HardwareInterface):
    """JointModeHandles."""

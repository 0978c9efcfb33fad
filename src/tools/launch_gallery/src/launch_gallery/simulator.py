"""The running simulator's services and topics. A launch file that starts it within a group has them below that group's name."""

from __future__ import annotations

from collections.abc import Iterable

import rospy
from rosservice import get_service_class_by_name

_KNOWN_BY = "/gazebo/get_model_state"


class Simulator:
    """``space``: namespace of the group, '' where there is none."""

    def __init__(self, space: str):
        self.space = space

    def name(self, name: str) -> str:
        """Full name of one of its services or topics."""
        return f"{self.space}/gazebo/{name}"

    def service(self, name: str, persistent: bool = False) -> rospy.ServiceProxy:
        """The service ``name``; its kind is asked of the running one. ``persistent``: over one connection.

        :raises rosservice.ROSServiceException: nobody offers it.
        """
        full = self.name(name)
        return rospy.ServiceProxy(full, get_service_class_by_name(full), persistent=persistent)

    def parameter(self, name: str, default: str) -> str:
        """The parameter ``name`` of the group, or of the whole system, or ``default``."""
        return rospy.get_param(f"{self.space}/{name}", rospy.get_param(f"/{name}", default))


def find(services: Iterable[str]) -> Simulator | None:
    """The one among ``services`` (full names) in the outermost namespace; None if nobody simulates."""
    spaces = [name[: -len(_KNOWN_BY)] for name in services if name.endswith(_KNOWN_BY)]
    return Simulator(min(spaces, key=lambda space: (space.count("/"), space))) if spaces else None

"""Constraints by name, from the warehouse."""

from __future__ import annotations

from moveit_msgs.msg import Constraints
from moveit_ros_warehouse.location import connect
from moveit_ros_warehouse.storage import StorageError

from .exception import MoveItCommanderException

_PATIENCE = 5.0  # s for a warehouse that is just being launched


class StoredConstraints:
    """The constraints that a warehouse has for one group of a robot.

    :param host: a database file, or the name of upstream's server: then that of the running warehouse is used.
    :raises MoveItCommanderException: there is no warehouse.
    """

    def __init__(self, host: str, robot: str, group: str):
        self._owners = {"robot": robot, "planning_group": group}
        try:
            self._constraints = connect(host, _PATIENCE).constraints
        except StorageError as error:
            raise MoveItCommanderException(str(error)) from error

    def names(self) -> list[str]:
        """All names; those that were saved for no robot in particular as well."""
        return sorted({*self._constraints.names(**self._owners), *self._constraints.names_without_owner()})

    def load(self, name: str) -> Constraints:
        """The constraints of a name.

        :raises MoveItCommanderException: there are none.
        """
        try:
            own = self._constraints.has(name, **self._owners)
            return self._constraints.load(name, **(self._owners if own else {}))
        except StorageError as error:
            raise MoveItCommanderException(f"Unable to set path constraints {name}: {error}") from error

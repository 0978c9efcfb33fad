"""The node ``moveit_warehouse_services``: robot states by name, as services."""

from __future__ import annotations

from collections.abc import Callable

import node_signals
import rospy
from moveit_msgs.srv import (
    CheckIfRobotStateExistsInWarehouse,
    DeleteRobotStateFromWarehouse,
    GetRobotStateFromWarehouse,
    ListRobotStatesInWarehouse,
    RenameRobotStateInWarehouse,
    SaveRobotStateToWarehouse,
)

from .location import connect
from .storage import StorageError, Warehouse


def main() -> int:
    """Run the node; the exit code."""
    node_signals.init_node("moveit_warehouse_services")
    patience = float(rospy.get_param("warehouse_db_connection_timeout", 5.0)) * int(rospy.get_param("warehouse_db_connection_retries", 5))
    try:
        warehouse = connect(patience=patience)
        known = warehouse.states.names()
    except StorageError as error:
        rospy.logfatal("%s", error)
        return 1
    services = Services(warehouse)
    rospy.loginfo(
        "Robot states are kept in %s. %s",
        warehouse.path,
        f"Previously stored robot states: {', '.join(known)}" if known else "There are no previously stored robot states",
    )
    node_signals.spin()
    services.shutdown()
    return 0


class Services:
    """Upstream's six services on a warehouse."""

    def __init__(self, warehouse: Warehouse):
        self._warehouse, self._states = warehouse, warehouse.states
        self._services = [
            self._serve(name, kind, handler)
            for name, kind, handler in (
                ("save_robot_state", SaveRobotStateToWarehouse, self._save),
                ("list_robot_states", ListRobotStatesInWarehouse, self._list),  # as Melodic calls it
                ("list_robot_state", ListRobotStatesInWarehouse, self._list),  # Noetic
                ("get_robot_state", GetRobotStateFromWarehouse, self._get),
                ("has_robot_state", CheckIfRobotStateExistsInWarehouse, self._has),
                ("rename_robot_state", RenameRobotStateInWarehouse, self._rename),
                ("delete_robot_state", DeleteRobotStateFromWarehouse, self._delete),
            )
        ]

    def shutdown(self) -> None:
        """Withdraw the services and close the file."""
        for service in self._services:
            service.shutdown()
        self._warehouse.close()

    @staticmethod
    def _serve(name: str, kind, handler: Callable) -> rospy.Service:
        def answer(request):
            response = kind._response_class()
            try:
                handler(request, response)
            except StorageError as error:
                rospy.logerr("%s: %s", name, error)
                if not hasattr(response, "success"):  # no field for it: the call fails, with the reason
                    raise rospy.ServiceException(str(error)) from error
            return response

        return rospy.Service(name, kind, answer)

    def _save(self, request, response) -> None:
        self._states.save(request.name, request.state, robot=request.robot)
        response.success = True

    def _list(self, request, response) -> None:
        response.states = self._states.names(request.regex, robot=request.robot)

    def _get(self, request, response) -> None:
        response.state = self._states.load(request.name, robot=request.robot)

    def _has(self, request, response) -> None:
        response.exists = self._states.has(request.name, robot=request.robot)

    def _rename(self, request, _response) -> None:
        self._states.rename(request.old_name, request.new_name, robot=request.robot)

    def _delete(self, request, _response) -> None:
        self._states.remove(request.name, robot=request.robot)

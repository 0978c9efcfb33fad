"""The node ``moveit_warehouse_services``: robot states by name, as services."""
from __future__ import annotations

import os
from typing import Callable

import rospy
from moveit_msgs.srv import (CheckIfRobotStateExistsInWarehouse, DeleteRobotStateFromWarehouse, GetRobotStateFromWarehouse,
                             ListRobotStatesInWarehouse, RenameRobotStateInWarehouse, SaveRobotStateToWarehouse)

import node_signals

from .storage import StateStorage, StorageError


def main() -> int:
    """Run the node; the exit code. ``~database_path`` is the file, or the folder that warehouse.launch names."""
    node_signals.init_node("moveit_warehouse_services")
    path = str(rospy.get_param("~database_path", "")).strip() or "~/.ros/warehouse.sqlite"
    if os.path.isdir(os.path.expanduser(path)) or not os.path.splitext(path)[1]:
        path = os.path.join(path, "warehouse.sqlite")
    try:
        storage = StateStorage(path)
    except StorageError as error:
        rospy.logfatal("%s", error)
        return 1
    services = Services(storage)
    rospy.loginfo("Robot states are kept in %s", storage.path)
    node_signals.spin()
    services.shutdown()
    return 0


class Services:
    """Upstream's six services on a StateStorage."""

    def __init__(self, storage: StateStorage):
        self._storage = storage
        self._services = [self._serve(name, kind, handler) for name, kind, handler in (
            ("save_robot_state", SaveRobotStateToWarehouse, self._save),
            ("list_robot_states", ListRobotStatesInWarehouse, self._list),
            ("get_robot_state", GetRobotStateFromWarehouse, self._get),
            ("has_robot_state", CheckIfRobotStateExistsInWarehouse, self._has),
            ("rename_robot_state", RenameRobotStateInWarehouse, self._rename),
            ("delete_robot_state", DeleteRobotStateFromWarehouse, self._delete))]

    def shutdown(self) -> None:
        """Withdraw the services and close the file."""
        for service in self._services:
            service.shutdown()
        self._storage.close()

    @staticmethod
    def _serve(name: str, kind, handler: Callable) -> rospy.Service:
        def answer(request):
            response = kind._response_class()
            try:
                handler(request, response)
            except StorageError as error:  # the services have no field for it
                rospy.logerr("%s: %s", name, error)
            return response
        return rospy.Service(name, kind, answer)

    def _save(self, request, response) -> None:
        self._storage.save(request.robot, request.name, request.state)
        response.success = True

    def _list(self, request, response) -> None:
        response.states = self._storage.names(request.robot, request.regex)

    def _get(self, request, response) -> None:
        response.state = self._storage.load(request.robot, request.name)

    def _has(self, request, response) -> None:
        response.exists = request.name in self._storage.names(request.robot)

    def _rename(self, request, _response) -> None:
        self._storage.rename(request.robot, request.old_name, request.new_name)

    def _delete(self, request, _response) -> None:
        self._storage.remove(request.robot, request.name)

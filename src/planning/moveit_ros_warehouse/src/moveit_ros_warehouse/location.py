"""Which database file a node uses.

Upstream's clients connect to a MongoDB server at ``warehouse_host``:``warehouse_port``. Here the server of
``warehouse.launch`` (:mod:`.server`) names its file in the parameter ``warehouse_file``, and clients open it themselves.
"""

from __future__ import annotations

import os
import time

import rospkg
import rospy

from .storage import StorageError, Warehouse

FILE_NAME = "warehouse.sqlite"
#: parameter, beside warehouse_port, in which a running server says which file is used
PARAMETER = "warehouse_file"
_PATIENCE = 25.0  # s: upstream's 5 tries of 5 s


def file_of(path: str) -> str:
    """The database file of a path: itself, or the usual name in a folder."""
    path = os.path.expanduser(path)
    return path if os.path.splitext(path)[1] and not os.path.isdir(path) else os.path.join(path, FILE_NAME)


def _find(name: str):
    found = rospy.search_param(name)
    return None if found is None else rospy.get_param(found, None)


def database_file(host: str = "", patience: float | None = None) -> str:
    """The file for this node: ``~database_path``; ``host``, if it is a path; ``warehouse_host``, if ``warehouse_plugin``
    is that of SQLite; that of the running server; and where no warehouse is configured, one in ~/.ros.

    :param patience: wall s to wait for a server that parameters announce.
    :raises StorageError: none runs.
    """
    own = str(rospy.get_param("~database_path", "")).strip()
    if own or os.path.sep in host or host.endswith((".sqlite", ".db")):
        return file_of(own or host)
    plugin, named = str(_find("warehouse_plugin") or ""), str(_find("warehouse_host") or "")
    if "sqlite" in plugin.lower() and named:
        return file_of(named)
    end = time.monotonic() + (_PATIENCE if patience is None else patience)
    while not rospy.is_shutdown():
        running = _find(PARAMETER)
        if running:
            return str(running)
        if not plugin:
            return os.path.join(rospkg.get_ros_home(), FILE_NAME)
        if time.monotonic() > end:
            break
        time.sleep(0.1)
    raise StorageError(
        f"Failed to connect to DB on {named or 'localhost'}:{_find('warehouse_port') or 33829}: nobody runs a "
        f"warehouse; start it first (roslaunch <your moveit_config> default_warehouse_db.launch, or db:=true)"
    )


def connect(host: str = "", patience: float | None = None) -> Warehouse:
    """The warehouse of this node; ``host`` and ``patience`` as for :func:`database_file`.

    :raises StorageError: there is none, or its file cannot be used.
    """
    return Warehouse(database_file(host, patience))

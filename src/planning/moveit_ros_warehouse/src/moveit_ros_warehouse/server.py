"""The node ``mongo_wrapper_ros.py`` of ``warehouse.launch``: says which database file is used, as long as it runs."""

from __future__ import annotations

import os

import node_signals
import rospkg
import rospy

from .location import FILE_NAME, PARAMETER, file_of
from .storage import StorageError, Warehouse

_HELP = """usage: rosrun warehouse_ros_mongo mongo_wrapper_ros.py
Offers a database file to the nodes of moveit_ros_warehouse (no MongoDB is needed). Parameters:
  ~database_path (or ~db_path)  folder or file; default: that of ROS, ~/.ros
  ~overwrite                    begin with an empty database; default false
  warehouse_port, warehouse_host are accepted, and not needed"""


def main(arguments) -> int:
    """Run the node; the exit code."""
    if "--help" in arguments or "-h" in arguments:
        print(_HELP)
        return 0
    node_signals.init_node("mongodb")
    if "--repair" in arguments:
        rospy.loginfo("SQLite repairs its file by itself: nothing to do")
        return 0
    path = str(rospy.get_param("~database_path", "") or rospy.get_param("~db_path", "") or rospkg.get_ros_home())
    if os.path.exists(os.path.join(os.path.expanduser(path), "WiredTiger")):
        rospy.logwarn("'%s' holds a database of MongoDB, which cannot be read here: %s beside it is used", path, FILE_NAME)
    try:
        file = _open(path)
    except StorageError as error:
        rospy.logfatal("%s", error)
        return 1
    parameter = rospy.resolve_name(PARAMETER)
    rospy.set_param(parameter, file)
    rospy.loginfo("The warehouse is in %s", file)
    node_signals.spin()
    if rospy.get_param(parameter, None) == file:
        rospy.delete_param(parameter)
    return 0


def _open(path: str) -> str:
    """Make the database; the file, beside ROS's own if the place that was asked for may not be written to."""
    file = file_of(path)
    try:
        if rospy.get_param("~overwrite", False) and os.path.exists(file):
            os.remove(file)
            rospy.loginfo("Removed existing db at %s", file)
        Warehouse(file).close()
    except (OSError, StorageError) as error:
        spare = os.path.join(rospkg.get_ros_home(), FILE_NAME)
        if os.path.exists(file) or file == spare:  # there is something, which nobody may lose sight of
            raise error if isinstance(error, StorageError) else StorageError(str(error)) from error
        rospy.logwarn("%s. Trying %s instead.", error, spare)
        file = spare
        Warehouse(file).close()
    return os.path.abspath(file)

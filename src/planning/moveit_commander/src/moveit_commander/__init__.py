"""Python clients of move_group.

``MoveGroupCommander`` plans and moves one group of joints, ``RobotCommander`` tells about the whole robot,
``PlanningSceneInterface`` changes what stands around it.
"""

import importlib
import os
import re
import time

import rospy

from . import conversions
from .exception import MoveItCommanderException
from .interpreter import MoveGroupCommandInterpreter, MoveGroupInfoLevel
from .move_group import MoveGroupCommander
from .planning_scene_interface import PlanningSceneInterface
from .robot import RobotCommander
from .roscpp_initializer import roscpp_initialize, roscpp_shutdown

__all__ = [
    "MoveGroupCommandInterpreter",
    "MoveGroupCommander",
    "MoveGroupInfoLevel",
    "MoveItCommanderException",
    "PlanningSceneInterface",
    "RobotCommander",
    "roscpp_initialize",
    "roscpp_shutdown",
]

#: what upstream's modules import shows up in this one, and scripts end with ``moveit_commander.os._exit(0)``
_SEEN = {
    "tf": "",
    **{name: "geometry_msgs.msg" for name in ("Pose", "PoseStamped", "Point")},
    **{
        name: "moveit_msgs.msg"
        for name in (
            "AllowedCollisionEntry",
            "AllowedCollisionMatrix",
            "AttachedCollisionObject",
            "CollisionObject",
            "Constraints",
            "Grasp",
            "MotionPlanRequest",
            "MoveItErrorCodes",
            "PlaceLocation",
            "PlanningScene",
            "RobotState",
            "RobotTrajectory",
        )
    },
    **{name: "shape_msgs.msg" for name in ("Mesh", "MeshTriangle", "Plane", "SolidPrimitive")},
    "JointState": "sensor_msgs.msg",
    "MarkerArray": "visualization_msgs.msg",
}


def __getattr__(name: str):
    if name not in _SEEN:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    if not _SEEN[name]:
        return importlib.import_module(name)
    return getattr(importlib.import_module(_SEEN[name]), name)

"""Python clients of move_group.

``MoveGroupCommander`` plans and moves one group of joints, ``RobotCommander`` tells about the whole robot,
``PlanningSceneInterface`` changes what stands around it.
"""
from .exception import MoveItCommanderException
from .roscpp_initializer import roscpp_initialize, roscpp_shutdown
from .planning_scene_interface import PlanningSceneInterface
from .move_group import MoveGroupCommander
from .robot import RobotCommander
from .interpreter import MoveGroupCommandInterpreter, MoveGroupInfoLevel

__all__ = ["MoveGroupCommandInterpreter", "MoveGroupCommander", "MoveGroupInfoLevel", "MoveItCommanderException",
           "PlanningSceneInterface", "RobotCommander", "roscpp_initialize", "roscpp_shutdown"]

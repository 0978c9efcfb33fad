"""Error codes, and what can go wrong in MoveIt's face: one tree, each error one line for a student.

::

    MoveItError
    ├── PlanningError              a request that cannot be served; .code for the answer
    ├── DescriptionError           moveit_ros_planning.robot_model: the robot cannot be loaded
    ├── PipelineError              moveit_ros_planning.planning_pipeline: a pipeline cannot be made
    ├── ExecutionError             moveit_ros_planning.trajectory_execution: a trajectory cannot be executed
    ├── UpdaterError               moveit_ros_occupancy_map_monitor: a sensor's settings, or what it sent
    ├── StorageError               moveit_ros_warehouse: the file, or what is asked for in it
    ├── OptionsError               moveit_ros_benchmarks: the benchmark cannot be understood
    └── MoveItCommanderException   moveit_commander: upstream's name, for its clients

The library's own root is ``motion.MotionError``; capabilities answer it with a code. srdfdom stands alone.
"""

from __future__ import annotations

from moveit_msgs.msg import MoveItErrorCodes

#: value -> name, as upstream's clients print it
CODES = {value: name for name, value in vars(MoveItErrorCodes).items() if name.isupper() and isinstance(value, int)}


def code_name(value: int) -> str:
    """Name of a MoveItErrorCodes value, for example ``START_STATE_IN_COLLISION``."""
    return CODES.get(int(value), f"error code {value}")


class MoveItError(Exception):
    """The root; the text is the whole line."""


class PlanningError(MoveItError):
    """A request that cannot be served: ``code`` (MoveItErrorCodes value) and ``message``, one line saying what to do about it."""

    def __init__(self, code: int, message: str):
        super().__init__(message)
        self.code = int(code)


def one_line(text: object, limit: int = 200) -> str:
    """``text`` without line ends, shortened to ``limit`` characters: what a message may quote of an input."""
    line = " ".join(str(text).split())
    return line if len(line) <= limit else line[: limit - 3] + "..."

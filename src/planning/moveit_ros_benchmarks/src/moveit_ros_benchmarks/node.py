"""The nodes ``moveit_run_benchmark`` and ``moveit_combine_predefined_poses_benchmark``."""

from __future__ import annotations

import node_signals
import rospy
from moveit_ros_planning.robot_model import DescriptionError
from moveit_ros_warehouse.storage import StorageError

from . import options as options_module
from .executor import Executor, open_warehouse
from .options import Options, OptionsError


def _options() -> Options:
    """Those of the files that the command line names (run_benchmark_ompl.launch cfg:=FILE), or of the parameter."""
    files = [argument for argument in rospy.myargv()[1:] if not argument.startswith("-")]
    if files:
        return options_module.load(files[0])
    config = rospy.get_param("~benchmark_config", None)
    if config is None:
        raise OptionsError(
            f"No benchmark_config found on param server: load a YAML file into {rospy.resolve_name('~benchmark_config')}, "
            f"or name one (cfg:=FILE)"
        )
    return options_module.read(config, rospy.resolve_name("~benchmark_config"))


def _run(poses: bool) -> int:
    try:
        options = _options()
        executor = Executor(options)
        warehouse = open_warehouse(options)
        problems = executor.load(warehouse) if not poses else executor.combine_poses()
        rospy.loginfo(
            "Benchmark '%s': %d problems, %d planners, %d runs each, %.3g s at most",
            options.name,
            len(problems),
            sum(map(len, options.pipelines.values())),
            options.runs,
            options.timeout,
        )
        executor.run(problems)
    except (OptionsError, DescriptionError, StorageError, OSError) as error:
        rospy.logfatal("%s", " ".join(str(error).split()))
        return 1
    return 0


def run_benchmark() -> int:
    """Stored queries and goals; the exit code."""
    node_signals.init_node("moveit_run_benchmark")
    return _run(poses=False)


def combine_poses() -> int:
    """From every predefined pose to every other; the exit code."""
    node_signals.init_node("moveit_combine_predefined_poses_benchmark")
    return _run(poses=True)

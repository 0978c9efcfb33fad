"""What a benchmark runs, from ``~benchmark_config``, a YAML file of the same form, or a .cfg file of old configurations."""

from __future__ import annotations

import configparser
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import yaml
from moveit_core.errors import MoveItError
from node_signals.parameters import is_number


class OptionsError(MoveItError):
    """The benchmark cannot be understood; one line."""


@dataclass
class Options:
    """One benchmark. Names of stored things are regular expressions; "" takes none. Metres, radians, seconds.

    :param pipelines: planners by pipeline, in the order of the file.
    :param goal_offset: (x, y, z, roll, pitch, yaw) by which pose goals are moved.
    :param workspace: (frame, lower corner, upper corner), or None.
    """

    scene: str = ""
    host: str = ""
    name: str = ""
    runs: int = 10
    timeout: float = 10.0
    group: str = ""
    output_directory: str = ""
    queries: str = ".*"
    start_states: str = ""
    goal_constraints: str = ""
    path_constraints: str = ""
    trajectory_constraints: str = ""
    predefined_poses: list[str] = field(default_factory=list)
    predefined_poses_group: str = ""
    goal_offset: Sequence[float] = (0.0,) * 6
    workspace: Any = None
    pipelines: dict[str, list[str]] = field(default_factory=dict)


def read(config: Any, where: str) -> Options:
    """The options of ``config``, a ``benchmark_config`` table.

    :param where: its place, for messages.
    :raises OptionsError: something is missing or of a wrong kind.
    """
    if isinstance(config, dict) and "benchmark_config" in config:
        config = config["benchmark_config"]
    if not isinstance(config, dict):
        raise OptionsError(f"{where} holds no benchmark: a table with warehouse, parameters and planning_pipelines is expected")
    warehouse, parameters = _table(config, "warehouse", where), _table(config, "parameters", where)
    options = Options(scene=str(warehouse.get("scene_name", "")), host=str(warehouse.get("host", "")))
    for key in (
        "name",
        "group",
        "output_directory",
        "queries",
        "start_states",
        "goal_constraints",
        "path_constraints",
        "trajectory_constraints",
        "predefined_poses_group",
    ):
        if key in parameters:
            setattr(options, key, str(parameters[key] or ""))
    options.runs = int(_number(parameters, "runs", 10, where, 1))
    options.timeout = _number(parameters, "timeout", 10.0, where, 1e-3)
    poses = parameters.get("predefined_poses", [])
    options.predefined_poses = [str(pose) for pose in poses] if isinstance(poses, list) else []
    offset = _table(parameters, "goal_offset", where)
    options.goal_offset = tuple(_number(offset, key, 0.0, where) for key in ("x", "y", "z", "roll", "pitch", "yaw"))
    space = _table(parameters, "workspace", where)
    if space:
        corners = [
            tuple(_number(_table(space, corner, where), axis, 0.0, where) for axis in "xyz") for corner in ("min_corner", "max_corner")
        ]
        options.workspace = (str(space.get("frame_id", "")), *corners)
    options.pipelines = _pipelines(config.get("planning_pipelines", []), where)
    if not options.group:
        raise OptionsError(f"{where}/parameters/group is missing: name the planning group")
    return options


def _table(config: dict[str, Any], key: str, where: str) -> dict[str, Any]:
    value = config.get(key) or {}
    if not isinstance(value, dict):
        raise OptionsError(f"{where}/{key} is '{str(value)[:40]}', where a table is expected")
    return value


def _number(table: dict[str, Any], key: str, default: float, where: str, least: float = -1e9) -> float:
    value = table.get(key, default)
    if not is_number(value, least) or value >= 1e9:
        raise OptionsError(
            f"{where}: {key} is '{str(value)[:40]}', where a number" + (f" from {least:g}" if least > -1e9 else "") + " is expected"
        )
    return float(value)


def _pipelines(entries: Any, where: str) -> dict[str, list[str]]:
    found = {}
    for entry in entries if isinstance(entries, list) else []:
        planners = entry.get("planners") if isinstance(entry, dict) else None
        if not isinstance(planners, list) or not entry.get("name"):
            raise OptionsError(f"{where}/planning_pipelines: an entry needs a name and a list of planners, not '{str(entry)[:60]}'")
        found[str(entry["name"])] = [str(planner) for planner in planners]
    if not found:
        raise OptionsError(f"{where}/planning_pipelines names no planner: give a list of entries with name and planners")
    return found


def load(file: str) -> Options:
    """The options of a file: YAML, or the .cfg of before Indigo (sections [scene], [parameters] and [plugin]).

    :raises OptionsError: it cannot be read or understood.
    """
    try:
        with open(os.path.expanduser(file), encoding="utf-8") as text:
            content = text.read()
        if any(line.strip().lower() in ("[scene]", "[plugin]") for line in content.splitlines()):
            return _old(content, file)
        return read(yaml.safe_load(content), file)
    except (OSError, UnicodeDecodeError, yaml.YAMLError, configparser.Error) as error:
        raise OptionsError(f"{file}: {' '.join(str(error).split())[:200]}") from error


def _old(content: str, file: str) -> Options:
    parser = configparser.ConfigParser(strict=False, interpolation=None, inline_comment_prefixes=("#",))
    names: list[tuple[str, list[str]]] = []
    lines = []
    for line in content.splitlines():  # sections of one name, one a plug-in, become sections of their own
        if line.strip().lower() == "[plugin]":
            line = f"[plugin {len(names)}]"
            names.append((line[1:-1], []))
        lines.append(line)
    parser.read_string("\n".join(lines))
    scene = {key: value for section in ("scene", "parameters") if parser.has_section(section) for key, value in parser[section].items()}
    pipelines = []
    for name, _ in names:
        kind = parser[name].get("name", "")
        pipelines.append({"name": "ompl" if "ompl" in kind.lower() else kind, "planners": parser[name].get("planners", "").split()})
    numbers: dict[str, Any] = {key: yaml.safe_load(scene[key]) for key in ("runs", "timeout") if key in scene}
    parameters: dict[str, Any] = {
        "name": scene.get("name", ""),
        "group": scene.get("group", ""),
        "queries": scene.get("query", ".*"),
        "start_states": scene.get("start", ""),
        "goal_constraints": scene.get("goal", ""),
        "path_constraints": scene.get("path_constraints", ""),
        "output_directory": os.path.dirname(scene.get("output", "")),
        **numbers,
    }
    return read({"warehouse": {"scene_name": scene.get("name", "")}, "parameters": parameters, "planning_pipelines": pipelines}, file)

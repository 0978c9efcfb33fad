"""Planner configurations as ompl_planning.yaml gives them, per group, and changes to them at run time."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any

import motion
import rospy
from moveit_core.errors import one_line

#: settings of a group that every planner of it inherits
_GROUP_KEYS = (
    "projection_evaluator",
    "longest_valid_segment_fraction",
    "enforce_joint_model_state_space",
    "enforce_constrained_state_space",
)
_DEFAULT = "geometric::RRTConnect"


def as_text(value: Any) -> str:
    """A parameter's value as upstream writes it into a configuration."""
    if isinstance(value, bool):
        return "1" if value else "0"
    return repr(value) if isinstance(value, float) else str(value)


class PlannerConfigs:
    """The table name -> settings (texts). Names are ``group`` (its default) and ``group[config]``."""

    def __init__(self, model: motion.RobotModel, namespace: str):
        self._lock = threading.Lock()
        self._namespace = namespace
        self._configs: dict[str, dict[str, str]] = {}
        shared = rospy.get_param(namespace + "planner_configs", {})
        self._shared = shared if isinstance(shared, dict) else {}
        if not isinstance(shared, dict):
            rospy.logerr(
                "parameter %splanner_configs is %s, where a table is expected: planners have their defaults",
                namespace,
                one_line(repr(shared), 60),
            )
        for group in model.groups:
            self._load_group(group)

    def _load_group(self, group: str) -> None:
        entry = rospy.get_param(self._namespace + group, {})
        entry = entry if isinstance(entry, dict) else {}
        common = {key: as_text(entry[key]) for key in _GROUP_KEYS if key in entry}
        default = {"type": _DEFAULT, **common}
        wanted = entry.get("default_planner_config")
        if wanted is not None:
            default = self._config(group, str(wanted), common) or default
        self._configs[group] = default
        names = entry.get("planner_configs", [])
        if not isinstance(names, list):
            rospy.logerr("The planner_configs argument of a group configuration should be an array of strings (for group '%s')", group)
            return
        for name in names:
            config = self._config(group, str(name), common)
            if config:
                self._configs[f"{group}[{name}]"] = config

    def _config(self, group: str, name: str, common: dict[str, str]) -> dict[str, str]:
        entry = self._shared.get(name)
        if not isinstance(entry, dict):
            rospy.logerr(
                "Could not find the planner configuration '%s' on the param server; group '%s' uses %s instead (harmless: %s has %s)",
                name,
                group,
                _DEFAULT,
                rospy.resolve_name(self._namespace + "planner_configs"),
                ", ".join(sorted(self._shared)) or "none",
            )
            return {}
        if "type" not in entry:
            rospy.logerr("The planning configuration '%s' does not have a type", name)
            return {}
        return {**common, **{str(key): as_text(value) for key, value in entry.items()}}

    def names(self) -> list[str]:
        """All names, sorted."""
        with self._lock:
            return sorted(self._configs)

    def find(self, group: str, planner_id: str) -> tuple[str, dict[str, str]]:
        """(name, settings) for a request to ``group``; an unknown ``planner_id`` is told, and the group's default is used, as for ""."""
        with self._lock:
            name = group
            if planner_id:
                name = planner_id if group in planner_id else f"{group}[{planner_id}]"
                if name not in self._configs:
                    known = sorted(key[len(group) + 1 : -1] for key in self._configs if key.startswith(group + "["))
                    rospy.logwarn(
                        "Cannot find planning configuration for group '%s' using planner '%s'. Will use "
                        "defaults instead. "
                        "Known planners: %s",
                        group,
                        planner_id,
                        ", ".join(known) or "none",
                    )
                    name = group
            return name, dict(self._configs.get(name, {"type": _DEFAULT}))

    def get(self, group: str, config: str) -> dict[str, str]:
        """Settings for get_planner_params: of the planner, overlaid by those of ``group[config]``."""
        with self._lock:
            settings = {str(key): as_text(value) for key, value in self._shared.get(config, {}).items()} if config else {}
            settings.update(self._configs.get(f"{group}[{config}]" if config and group else config or group, {}))
            return settings

    def set(self, group: str, config: str, keys: Sequence[str], values: Sequence[str], replace: bool) -> None:
        """Set ``keys`` to ``values`` in ``config`` of ``group`` ("": ``config`` is the whole name); they count from the next request on.

        :param replace: forget what else the configuration says.
        """
        if not config:
            return
        with self._lock:
            name = f"{group}[{config}]" if group else config
            present = {} if replace else dict(self._configs.get(name, {}))
            present.update(zip(keys, values))
            self._configs[name] = present

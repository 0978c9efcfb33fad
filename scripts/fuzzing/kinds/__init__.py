"""The kinds of input. A kind makes cases (bytes) from a random generator, and runs one case."""

from __future__ import annotations

import abc
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Optional


class Kind(abc.ABC):
    """One kind of input.

    :cvar name: on the command line. :cvar suffix: of a saved case. :cvar time_limit: s of processor time that a case may
        take. :cvar wall_limit: s of wall time, on a machine that does other things too. :cvar memory: bytes of address
        space that a worker may have.
    """

    name: str
    suffix: str
    time_limit = 5.0
    wall_limit = 120.0
    memory = 6 << 30
    cases_per_worker = 1000  # then a fresh process takes over
    silent = True  # whether any output on the terminal is a finding

    def prepare(self) -> None:
        """Once, in the parent process: import and read what all workers share."""

    def start(self, folder: Path, number: int) -> None:
        """In a new worker process. :param folder: of its own, also the working directory. :param number: of the worker."""

    def stop(self) -> None:
        """At the orderly end of a worker."""

    @abc.abstractmethod
    def generate(self, random: Random) -> bytes:
        """A case. The same generator state gives the same case."""

    @abc.abstractmethod
    def run(self, case: bytes) -> None:
        """Use the case as a user would.

        :raises Found: something is wrong. Any other exception is one that nobody declared: a finding too.
        """

    @abc.abstractmethod
    def smaller(self, case: bytes) -> Iterator[bytes]:
        """Simpler cases, the boldest first."""


def all_kinds() -> dict[str, Kind]:
    """By name, in the order of a run."""
    from fuzzing.kinds.api_calls import ApiKind
    from fuzzing.kinds.controllers import ControllerKind
    from fuzzing.kinds.descriptions import SdfKind, UrdfKind, WorldKind
    from fuzzing.kinds.launches import LaunchKind
    from fuzzing.kinds.meshes import MeshKind
    from fuzzing.kinds.messages import MessageKind, PlanningKind
    from fuzzing.kinds.plans import PlanKind
    from fuzzing.kinds.xacros import XacroKind

    kinds: list[Kind] = [
        UrdfKind(),
        XacroKind(),
        SdfKind(),
        WorldKind(),
        PlanKind(),
        MeshKind(),
        ApiKind(),
        ControllerKind(),
        LaunchKind(),
        MessageKind(),
        PlanningKind(),
    ]
    return {kind.name: kind for kind in kinds}


def kind_of_file(path: Path) -> str | None:
    """What a file to replay is, by its name and, where that does not tell, by what is in it."""
    known = {".urdf": "urdf", ".xacro": "xacro", ".sdf": "sdf", ".world": "world", ".mesh": "mesh", ".launchargs": "launch"}
    if path.suffix in known:
        return known[path.suffix]
    if path.name.endswith(".planning.json"):
        return "planning"
    text = path.read_bytes()
    if path.suffix == ".json":
        return (
            "messages"
            if b'"messages"' in text
            else "mesh"
            if b'"mesh"' in text
            else "launch"
            if b'"program"' in text
            else "api"
            if b'"calls"' in text
            else None
        )
    if path.suffix in (".yaml", ".yml"):
        return "yaml" if b"type:" in text or b'"type"' in text or b"gazebo_ros_control" in text else "plan"
    return None

"""Messages by name, in an SQLite file that several nodes may use at the same time."""

from __future__ import annotations

import io
import os
import re
import sqlite3
import struct
import threading
from typing import Any

import genpy
from moveit_core.errors import MoveItError
from moveit_msgs.msg import (
    Constraints,
    MotionPlanRequest,
    PlanningScene,
    PlanningSceneWorld,
    RobotState,
    RobotTrajectory,
    TrajectoryConstraints,
)

_PATIENCE = 10.0  # s that another node may hold the file


class StorageError(MoveItError):
    """The file cannot be used, or what is asked for is not there; one line."""


class Warehouse:
    """One database file. May be used by several threads.

    ``scenes``, ``worlds``, ``states`` (of a robot), ``constraints`` and ``trajectory_constraints`` (of a robot and a
    group), ``requests`` (of a scene), ``results`` (of a scene; the name is that of the request, numbered) are
    collections of messages by name.

    :param path: the file; its folders are made where they are missing.
    :raises StorageError: it cannot be opened, or is something else.
    """

    def __init__(self, path: str):
        self.path = os.path.abspath(os.path.expanduser(path))
        self._lock = threading.Lock()
        try:
            os.makedirs(os.path.dirname(self.path), exist_ok=True)
            self._base = sqlite3.connect(self.path, timeout=_PATIENCE, check_same_thread=False)
        except (OSError, sqlite3.Error) as error:
            raise self._unusable(error) from error
        self.states = Collection(self, "states", RobotState, "state", "robot")
        self.scenes = Collection(self, "scenes", PlanningScene, "planning scene")
        self.worlds = Collection(self, "worlds", PlanningSceneWorld, "planning scene world")
        self.constraints = Collection(self, "constraints", Constraints, "constraints", "robot", "planning_group")
        self.trajectory_constraints = Collection(
            self, "trajectory_constraints", TrajectoryConstraints, "trajectory constraints", "robot", "planning_group"
        )
        self.requests = Collection(self, "requests", MotionPlanRequest, "planning query", "scene")
        self.results = Collection(self, "results", RobotTrajectory, "planning result", "scene")

    def _unusable(self, error: Exception) -> StorageError:
        return StorageError(f"the database file '{self.path}' cannot be used: {error}")

    def run(self, text: str, *values: Any) -> sqlite3.Cursor:
        """One SQL statement, ``text`` with ``values`` for its question marks, committed.

        :raises StorageError: the file cannot be used.
        """
        try:
            with self._lock, self._base:
                return self._base.execute(text, values)
        except sqlite3.Error as error:
            raise self._unusable(error) from error

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._base.close()

    def add_request(self, scene: str, request: MotionPlanRequest, name: str = "") -> str:
        """Keep a planning request of a scene, once; without a name it gets "Motion Plan Request <n>". Its name."""
        known = self.requests.names(scene=scene)
        same = [entry for entry in known if self.requests.load(entry, scene=scene) == request]
        if same and name in ("", same[0]):
            return same[0]
        number = len(known)
        while not name or (name in known and name.startswith("Motion Plan Request ")):
            name = f"Motion Plan Request {number}"
            number += 1
        self.requests.save(name, request, scene=scene)
        return name

    def add_result(self, scene: str, request: MotionPlanRequest, result: RobotTrajectory) -> None:
        """Keep ``result``, which answers ``request`` of ``scene`` (its name); a request that is not known is kept as well."""
        name = self.add_request(scene, request)
        self.results.save(f"{name}#{len(self.results_of(scene, name))}", result, scene=scene)

    def results_of(self, scene: str, request: str) -> list[RobotTrajectory]:
        """The trajectories that were kept for ``request`` of ``scene`` (names)."""
        names = [name for name in self.results.names(scene=scene) if name.rpartition("#")[0] == request]
        return [self.results.load(name, scene=scene) for name in sorted(names, key=lambda name: int(name.rpartition("#")[2]))]

    def remove_scene(self, name: str) -> None:
        """Forget the scene ``name`` with its requests and results."""
        self.scenes.remove(name)
        self.requests.clear(scene=name)
        self.results.clear(scene=name)


class Collection:
    """Messages of one type by name. ``owners`` narrow a name down (robot, group, scene); "" means any of them, but
    where something is saved."""

    def __init__(self, warehouse: Warehouse, table: str, kind: type, title: str, *owners: str):
        self._warehouse, self._table, self._kind, self._title, self._owners = warehouse, table, kind, title, owners
        columns = ("name", *owners)
        warehouse.run(
            f"CREATE TABLE IF NOT EXISTS {table} ({', '.join(f'{column} TEXT' for column in columns)}, "
            f"data BLOB, PRIMARY KEY ({', '.join(columns)}))"
        )

    def _where(self, owners) -> tuple:
        unknown = set(owners) - set(self._owners)
        if unknown:
            raise TypeError(f"{self._title} has no {', '.join(sorted(unknown))}")
        given = [(owner, owners[owner]) for owner in self._owners if owners.get(owner)]
        return "".join(f" AND {owner} = ?" for owner, _ in given), [value for _, value in given]

    def save(self, name: str, message, **owners: str) -> None:
        """Keep a message; one of the same name and owners is replaced.

        :raises StorageError: no name, or a message that cannot be written.
        """
        if not name:
            raise StorageError(f"a {self._title} without a name cannot be kept")
        data = io.BytesIO()
        try:
            message.serialize(data)
        except (genpy.MessageError, struct.error) as error:
            raise StorageError(f"the {self._title} '{name}' cannot be written: {error}") from error
        values = [name, *(owners.get(owner, "") for owner in self._owners), data.getvalue()]
        columns = ", ".join(("name", *self._owners, "data"))
        self._warehouse.run(f"INSERT OR REPLACE INTO {self._table} ({columns}) VALUES ({', '.join('?' * len(values))})", *values)

    def load(self, name: str, **owners: str):
        """The message of a name; its own field ``name``, if it has one, says it as well.

        :raises StorageError: there is none, or it is damaged.
        """
        where, values = self._where(owners)
        row = self._warehouse.run(f"SELECT data FROM {self._table} WHERE name = ?{where} LIMIT 1", name, *values).fetchone()
        if row is None:
            raise StorageError(f"there is no {self._title} '{name}'{_of(owners)}; there are: {', '.join(self.names(**owners)) or 'none'}")
        try:
            message = self._kind().deserialize(row[0])
        except (genpy.MessageError, struct.error) as error:
            raise StorageError(f"the {self._title} '{name}' in '{self._warehouse.path}' is damaged: {error}") from error
        if "name" in message.__slots__:
            message.name = name
        return message

    def has(self, name: str, **owners: str) -> bool:
        """Whether there is a message of that name."""
        where, values = self._where(owners)
        return self._warehouse.run(f"SELECT 1 FROM {self._table} WHERE name = ?{where}", name, *values).fetchone() is not None

    def names(self, pattern: str | None = None, **owners: str) -> list[str]:
        """Names in order; ``pattern``: a regular expression that the whole name fits.

        :raises StorageError: the pattern is no regular expression.
        """
        where, values = self._where(owners)
        found = [row[0] for row in self._warehouse.run(f"SELECT DISTINCT name FROM {self._table} WHERE 1{where} ORDER BY name", *values)]
        if not pattern:
            return found
        try:
            fits = re.compile(pattern).fullmatch
        except re.error as error:
            raise StorageError(f"'{pattern[:40]}' is no regular expression: {error}") from error
        return [name for name in found if fits(name)]

    def names_without_owner(self) -> list[str]:
        """Names of what was saved without saying whose it is, in order."""
        none = " AND ".join(f"{owner} = ''" for owner in self._owners)
        return [row[0] for row in self._warehouse.run(f"SELECT name FROM {self._table} WHERE {none or 1} ORDER BY name")]

    def rename(self, old: str, new: str, **owners: str) -> None:
        """Give a message another name; one that had it is replaced.

        :raises StorageError: there is none of the old name, or the new one is empty.
        """
        self.load(old, **owners)
        if not new:
            raise StorageError(f"a {self._title} without a name cannot be kept")
        where, values = self._where(owners)
        self._warehouse.run(f"UPDATE OR REPLACE {self._table} SET name = ? WHERE name = ?{where}", new, old, *values)

    def remove(self, name: str, **owners: str) -> None:
        """Forget the message ``name``.

        :raises StorageError: there is none.
        """
        where, values = self._where(owners)
        if not self._warehouse.run(f"DELETE FROM {self._table} WHERE name = ?{where}", name, *values).rowcount:
            raise StorageError(f"there is no {self._title} '{name}'{_of(owners)}")

    def clear(self, **owners: str) -> None:
        """Forget all, or all of the owners."""
        where, values = self._where(owners)
        self._warehouse.run(f"DELETE FROM {self._table} WHERE 1{where}", *values)


def _of(owners) -> str:
    return "".join(f" of {owner.replace('_', ' ')} '{value}'" for owner, value in owners.items() if value)

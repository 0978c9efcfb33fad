"""Robot states by name and robot, in an SQLite file."""
from __future__ import annotations

import io
import os
import re
import sqlite3
import threading
from typing import List, Optional

from moveit_msgs.msg import RobotState


class StorageError(Exception):
    """The file cannot be used, or what is asked for is not there; one line."""


class StateStorage:
    """Keeps RobotState messages; may be used by several threads.

    :param path: the file; its folders are made where they are missing.
    :raises StorageError: it cannot be opened, or is something else.
    """

    def __init__(self, path: str):
        self.path = os.path.abspath(os.path.expanduser(path))
        self._lock = threading.Lock()
        try:
            os.makedirs(os.path.dirname(self.path), exist_ok=True)
            self._base = sqlite3.connect(self.path, check_same_thread=False)
            with self._base:
                self._base.execute("CREATE TABLE IF NOT EXISTS states "
                                   "(robot TEXT, name TEXT, data BLOB, PRIMARY KEY (robot, name))")
        except (OSError, sqlite3.Error) as error:
            raise StorageError(f"the database file '{self.path}' cannot be used: {error}") from error

    def _run(self, text: str, *values) -> sqlite3.Cursor:
        try:
            with self._lock, self._base:
                return self._base.execute(text, values)
        except sqlite3.Error as error:
            raise StorageError(f"the database file '{self.path}' cannot be used: {error}") from error

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._base.close()

    def save(self, robot: str, name: str, state: RobotState) -> None:
        """Keep a state; one of the same name is replaced."""
        if not name:
            raise StorageError("a state without a name cannot be kept")
        data = io.BytesIO()
        state.serialize(data)
        self._run("INSERT OR REPLACE INTO states VALUES (?, ?, ?)", robot, name, data.getvalue())

    def load(self, robot: str, name: str) -> RobotState:
        """The state of a name.

        :raises StorageError: there is none.
        """
        row = self._run("SELECT data FROM states WHERE name = ? AND (? = '' OR robot = ?) LIMIT 1", name, robot, robot).fetchone()
        if row is None:
            raise StorageError(f"there is no state '{name}'{self._of(robot)}; there are: {', '.join(self.names(robot)) or 'none'}")
        return RobotState().deserialize(row[0])

    def names(self, robot: str, pattern: Optional[str] = None) -> List[str]:
        """Names in order, of one robot or ("") of all; ``pattern``: a regular expression that the whole name fits.

        :raises StorageError: the pattern is no regular expression.
        """
        found = [row[0] for row in self._run("SELECT DISTINCT name FROM states WHERE ? = '' OR robot = ? ORDER BY name", robot, robot)]
        if not pattern:
            return found
        try:
            fits = re.compile(pattern).fullmatch
        except re.error as error:
            raise StorageError(f"'{pattern[:40]}' is no regular expression: {error}") from error
        return [name for name in found if fits(name)]

    def rename(self, robot: str, old: str, new: str) -> None:
        """Give a state another name; one that had it is replaced."""
        state = self.load(robot, old)
        self.save(robot, new, state)
        if new != old:
            self.remove(robot, old)

    def remove(self, robot: str, name: str) -> None:
        """Forget a state.

        :raises StorageError: there is none.
        """
        if not self._run("DELETE FROM states WHERE name = ? AND (? = '' OR robot = ?)", name, robot, robot).rowcount:
            raise StorageError(f"there is no state '{name}'{self._of(robot)}")

    @staticmethod
    def _of(robot: str) -> str:
        return f" of robot '{robot}'" if robot else ""

"""What is known of a class, in SQLite: each submission's state and result, as soon as it is there."""

from __future__ import annotations

import hashlib
import json
import os
import pathlib
import sqlite3
import time
from collections.abc import Collection
from typing import Any

from ..isolation.untrusted_files import walk
from ..outcome import Result

_TABLE = """CREATE TABLE IF NOT EXISTS submissions (
  name TEXT PRIMARY KEY, path TEXT NOT NULL, fingerprint TEXT NOT NULL, state TEXT NOT NULL DEFAULT 'waiting',
  tries INTEGER NOT NULL DEFAULT 0, points REAL, of REAL, seconds REAL, result TEXT, why TEXT, finished REAL)"""


class Store:
    """States: waiting, running, done, failed (its worker died each time)."""

    def __init__(self, path: pathlib.Path):
        self._db = sqlite3.connect(path, timeout=30.0, isolation_level=None)
        self._db.row_factory = sqlite3.Row
        self._db.execute("PRAGMA journal_mode=WAL")
        self._db.execute(_TABLE)

    def enlist(self, name: str, path: pathlib.Path, fingerprint: str) -> None:
        """The submission ``name`` at ``path`` waits. Known already and unchanged, by its ``fingerprint``: what is done stays done."""
        row = self._db.execute("SELECT fingerprint FROM submissions WHERE name = ?", (name,)).fetchone()
        if row is None or row["fingerprint"] != fingerprint:
            self._db.execute(
                "INSERT OR REPLACE INTO submissions (name, path, fingerprint) VALUES (?, ?, ?)", (name, os.fsencode(path), fingerprint)
            )

    def begin_again(self, names: Collection[str] | None = None) -> None:
        """After an interruption: what ran then, and what failed, waits.

        :param names: what is asked for; others, of an earlier run, no longer wait
        """
        self._db.execute("UPDATE submissions SET state = 'waiting', tries = 0 WHERE state IN ('running', 'failed')")
        if names is not None:
            known, wanted = {row["name"] for row in self.rows()}, set(names)
            self._db.executemany("DELETE FROM submissions WHERE name = ?", [(name,) for name in known - wanted])

    def waiting(self) -> list[str]:
        return [row["name"] for row in self._db.execute("SELECT name FROM submissions WHERE state = 'waiting' ORDER BY name")]

    def _one(self, name: str, column: str) -> Any:
        return self._db.execute(f"SELECT {column} FROM submissions WHERE name = ?", (name,)).fetchone()[column]

    def path_of(self, name: str) -> pathlib.Path:
        """Where the submission ``name`` is."""
        return pathlib.Path(os.fsdecode(self._one(name, "path")))

    def tries(self, name: str) -> int:
        """How often the examination of ``name`` was begun."""
        return self._one(name, "tries")

    def started(self, name: str) -> None:
        """The examination of ``name`` begins; it is one more of its tries."""
        self._db.execute("UPDATE submissions SET state = 'running', tries = tries + 1 WHERE name = ?", (name,))

    def waits_again(self, name: str, why: str, tried: bool = True) -> None:
        """``name`` waits once more, because of ``why``; ``tried``: that was one of its tries."""
        back = 0 if tried else 1
        self._db.execute("UPDATE submissions SET state = 'waiting', why = ?, tries = tries - ? WHERE name = ?", (why, back, name))

    def failed(self, name: str, why: str) -> None:
        """No result comes of ``name``, because of ``why``."""
        self._db.execute("UPDATE submissions SET state = 'failed', why = ?, finished = ? WHERE name = ?", (why, time.time(), name))

    def done(self, name: str, result: Result) -> None:
        """``name`` has its ``result``."""
        self._db.execute(
            "UPDATE submissions SET state = 'done', points = ?, of = ?, seconds = ?, result = ?, why = NULL, finished = ? WHERE name = ?",
            (result.points, result.of, result.seconds, json.dumps(result.data()), time.time(), name),
        )

    def rows(self) -> list[sqlite3.Row]:
        return list(self._db.execute("SELECT * FROM submissions ORDER BY name"))

    def counts(self) -> dict[str, int]:
        return {row[0]: row[1] for row in self._db.execute("SELECT state, COUNT(*) FROM submissions GROUP BY state")}

    def close(self) -> None:
        self._db.close()


def result_of(row: sqlite3.Row) -> Result | None:
    """The result in ``row``, None while there is none."""
    return Result.from_data(json.loads(row["result"])) if row["result"] else None


def fingerprint(path: pathlib.Path, spec_text: str) -> str:
    """Of names, sizes and times of the files at ``path``, and of the spec, ``spec_text``: another one is examined again.

    Links are not followed.
    """
    digest = hashlib.sha256(spec_text.encode())
    if path.is_file():
        information = path.stat()
        digest.update(f"{information.st_size} {information.st_mtime_ns}".encode())
    elif path.is_dir() and path.resolve() != pathlib.Path("/"):
        for name, information in sorted(walk(path), key=lambda found: found[0])[:20000]:
            text = f"{name} {information.st_size} {information.st_mtime_ns}"
            digest.update(text.encode("utf-8", "surrogateescape"))
    return digest.hexdigest()

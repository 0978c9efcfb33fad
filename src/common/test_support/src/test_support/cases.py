"""A TestCase whose subtests are all told."""

from __future__ import annotations

import contextlib
import traceback
import unittest
from collections.abc import Iterator
from typing import Any


class TestCase(unittest.TestCase):
    """As unittest's, but that the cases of ``subTest`` that failed end the test with one message that names them and says why.

    rosunit writes no line about a failure of unittest's own subtests into its report.
    """

    _told: list[str] | None = None

    @contextlib.contextmanager
    def subTest(self, msg: Any = None, **params: Any) -> Iterator[None]:
        """The test goes on after a case that failed, and fails at its end."""
        told = self._told
        if told is None:
            told = self._told = []
            self.addCleanup(self._tell)
        try:
            yield
        except unittest.SkipTest:
            raise
        except Exception as error:
            names = ([] if msg is None else [str(msg)]) + [f"{key}={value!r}" for key, value in params.items()]
            place = traceback.extract_tb(error.__traceback__)
            line = next((f"{frame.filename}:{frame.lineno}" for frame in place[1:]), "")
            kind = "" if isinstance(error, self.failureException) else f"{type(error).__name__}: "
            told.append(f"{', '.join(names) or 'a case'}: {kind}{error} ({line})")

    def _tell(self) -> None:
        told, self._told = self._told, None
        if told:
            raise self.failureException(f"{len(told)} case{'s' if len(told) > 1 else ''} failed: " + "; ".join(told))

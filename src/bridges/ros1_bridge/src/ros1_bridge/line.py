"""What the two processes say to each other: tuples of words, pickled, each with data, which are bytes of any length. Needs neither ROS."""

from __future__ import annotations

import itertools
import queue
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

#: What an interface of each form consists of: ROS 1's classes end with these, ROS 2's interface has classes of these names.
PARTS = {"msg": ("",), "srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
BULK = 65536  # bytes from which data goes as a piece of its own


def one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:200] or type(error).__name__


class Line:
    """One end. A question ends with its number, by which :meth:`answer` of the other end answers it."""

    def __init__(self, connection: Connection) -> None:
        self._connection, self._sending = connection, threading.Lock()
        self._numbers = itertools.count(1)
        self._waiting: dict[int, Callable[[int, Any, Any], None]] = {}

    def tell(self, *words: Any, data: Any = None) -> None:
        with self._sending:
            try:
                bulk = data is not None and len(data) > BULK
                self._connection.send((*words, None if bulk or data is None else bytes(data), bulk))
                if bulk:
                    self._connection.send_bytes(data)
            except OSError:  # the other end is gone; who listens says so
                pass

    def ask(self, then: Callable[[int, Any, Any], None], *words: Any, data: Any = None) -> int:
        """Tell ``words`` and ``data`` with a number, which is returned; ``then(number, said, data)`` is called with the answer."""
        number = next(self._numbers)
        self._waiting[number] = then
        self.tell(*words, number, data=data)
        return number

    def wait(self, patience: float, *words: Any, data: Any = None) -> tuple[Any, Any]:
        """The answer to the question ``words`` and ``data``: what is said, and its data.

        :param patience: s
        :raises TimeoutError: there is none for so long
        """
        came: queue.SimpleQueue = queue.SimpleQueue()
        number = self.ask(lambda _, *answer: came.put(answer), *words, data=data)
        try:
            return came.get(timeout=patience)
        except queue.Empty:
            self._waiting.pop(number, None)
            raise TimeoutError from None

    def answer(self, number: int, said: Any, data: Any = None) -> None:
        """Answer the question ``number`` of the other end with ``said``, one word that depends on the question, and ``data``."""
        self.tell("answer", number, said, data=data)

    def answered(self, number: int, said: Any, data: Any) -> None:
        """To be called with each "answer" that comes: ``number``, ``said`` and ``data``. Calls what :meth:`ask` was given."""
        then = self._waiting.pop(number, None)
        if then is not None:
            then(number, said, data)

    def listen(self, heard: Callable[..., None]) -> None:
        """Hand on what comes, as ``heard(*words, data)``, until the line ends."""
        try:
            while True:
                *words, data, bulk = self._connection.recv()
                heard(*words, self._connection.recv_bytes() if bulk else data)
        except (EOFError, OSError, TypeError):  # closed, by them or by us
            pass

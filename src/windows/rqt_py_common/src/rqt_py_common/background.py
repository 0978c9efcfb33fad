"""Calls that may take their time, in threads; their results in the thread of the window."""

import threading
from collections.abc import Callable
from typing import Any

from python_qt_binding.QtCore import QObject, Signal


class Background(QObject):
    """Runs calls to the master and to services, any of which may hang, so that the window does not.

    Make it in the window's thread. After :meth:`close`, or once the object is deleted, results are dropped.
    """

    _ended = Signal(object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._lock = threading.Lock()
        self._running: dict[Any, object] = {}  # key -> token of the newest call
        self._closed = False
        self._ended.connect(self._deliver)

    def run(
        self,
        key: Any,
        work: Callable[[], Any],
        done: Callable[[Any], None] | None = None,
        failed: Callable[[Exception], None] | None = None,
    ) -> bool:
        """Run ``work()`` in a thread, then ``done(result)`` or ``failed(exception)`` in the window's.

        :param key: while a call of this key runs, another is not started (what is asked for every second would pile up)
        :return: whether it was started
        """
        with self._lock:
            if self._closed or key in self._running:
                return False
            token = self._running[key] = object()

        def thread():
            try:
                ended = (done, work())
            except Exception as error:  # of any kind: the one who asked gets it
                ended = (failed, error)
            try:
                self._ended.emit((key, token, *ended))
            except RuntimeError:  # the window has been closed meanwhile
                pass

        threading.Thread(target=thread, name=f"rqt {key}", daemon=True).start()
        return True

    def busy(self, key: Any) -> bool:
        return key in self._running

    def forget(self, key: Any) -> None:
        """Drop the result of a call that is not wanted any more; another of this key may start at once."""
        with self._lock:
            self._running.pop(key, None)

    def close(self) -> None:
        with self._lock:
            self._closed = True
            self._running.clear()

    def _deliver(self, ended) -> None:
        key, token, call, result = ended
        with self._lock:
            if self._running.get(key) is not token:
                return
            del self._running[key]
        if call is not None:
            call(result)

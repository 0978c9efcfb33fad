"""rosmon's own log: one line for everything nodes say and everything that happens to them."""

from __future__ import annotations

import logging
import logging.handlers
import os
import time

from rosmon_core import RosmonError
from rosmon_core.severity import without_escapes

_LEVELS = {"debug": logging.DEBUG, "info": logging.INFO, "warn": logging.WARNING, "error": logging.ERROR}


class Log:
    """Writes to a file, or to the system log for ``syslog``.

    :raises RosmonError: the file cannot be written.
    """

    def __init__(self, target: str | None, flush: bool) -> None:
        self._syslog = None
        self._file = None
        self._flush = flush
        if target is None and os.environ.get("ROSMON_SYSLOG") == "1":
            target = "syslog"
        self.name = target or time.strftime("/tmp/rosmon_%Y_%m_%d_%H_%M_%S.log")
        try:
            if target == "syslog":
                self._syslog = logging.handlers.SysLogHandler("/dev/log")
            else:
                self._file = open(self.name, "w", encoding="utf-8")
        except OSError as error:
            raise RosmonError(f"cannot log to {self.name}: {error.strerror}; choose another place with --log=FILE") from None

    def write(self, label: str, text: str, severity: str) -> None:
        """A line of ``text`` by ``label``, of ``severity`` debug, info, warn or error."""
        text = without_escapes(text)
        if self._file:
            now = time.time()
            stamp = f"{time.strftime('%Y-%m-%d %H:%M:%S', time.localtime(now))}.{int(now % 1 * 1000):03d}"
            self._file.write(f"[{stamp}] {severity.upper():5} {label}: {text}\n")
            if self._flush:
                self._file.flush()
        elif self._syslog:
            self._syslog.emit(logging.LogRecord("rosmon", _LEVELS[severity], "", 0, f"rosmon: {label}: {text}", None, None))

    def flush(self) -> None:
        if self._file:
            self._file.flush()

    def close(self) -> None:
        for target in (self._file, self._syslog):
            if target:
                target.close()

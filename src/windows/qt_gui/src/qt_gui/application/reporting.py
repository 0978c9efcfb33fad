"""What plugins raise and what Qt says, as lines on the terminal; the container lives on."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable

from python_qt_binding import QtCore

_CYAN, _RED, _RESET = "\033[36m", "\033[31m", "\033[0m"
_NOISE = (
    "This plugin does not support",
    "QStandardPaths: ",
    "QXcbConnection: XCB error",
    "OpenType support missing",
)  # of no use to anybody
_options = {"verbose": False}
_seen: dict[tuple, int] = {}
listeners: list[Callable[[str], None]] = []  # each is given every warning and error, for tests


def describe(error: BaseException) -> str:
    """One line: class and text of ``error`` and the line of code that raised it; with --verbose its traceback below."""
    text = " ".join(str(error).split())[:300]
    line = f"{type(error).__name__}: {text}" if text else type(error).__name__
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if not frame.filename.startswith("<frozen ")]
    if isinstance(error, SyntaxError) and error.filename:
        line = f"{type(error).__name__}: {error.msg} ({error.filename}, line {error.lineno})"
    elif frames:
        line += f" ({frames[-1].filename}, line {frames[-1].lineno}, in {frames[-1].name})"
    if _options["verbose"]:
        line += "\n" + "".join(traceback.format_exception(type(error), error, error.__traceback__)).rstrip()
    return line


def _on_exception(kind, error, trace) -> None:
    """For what a slot or a timer of a plugin raises: PyQt would end the process without this.

    The same error from the same line is printed the first three times only: timers repeat it for ever.
    """
    if issubclass(kind, KeyboardInterrupt):
        app = QtCore.QCoreApplication.instance()
        if app is not None:
            app.quit()
        return
    frames = traceback.extract_tb(trace)
    place = (frames[-1].filename, frames[-1].lineno, kind) if frames else (None, None, kind)
    _seen[place] = _seen.get(place, 0) + 1
    if _seen[place] <= 3:
        more = " (not shown again)" if _seen[place] == 3 else ""
        hint = "" if _options["verbose"] else "; --verbose shows the way to it"
        QtCore.qCritical(f"a plugin raised {describe(error.with_traceback(trace))}{hint}{more}")


def _on_unraisable(unraisable) -> None:
    """For destructors of plugins. Qt's objects go before Python's at the end: that is no news."""
    error = unraisable.exc_value
    if not (isinstance(error, RuntimeError) and "wrapped C/C++ object" in str(error)) and error is not None:
        QtCore.qWarning(f"a plugin raised while it was deleted: {describe(error)}")


def _on_message(kind, _context, text) -> None:
    level = getattr(kind, "value", kind)  # 0 debug, 1 warning, 2 critical, 3 fatal, 4 info in every binding
    if level in (0, 4) and not _options["verbose"] or text.lstrip().startswith(_NOISE):
        return
    if level not in (0, 4):
        for listener in listeners:
            listener(text)
    colours = "TERM" in os.environ and "ANSI_COLORS_DISABLED" not in os.environ and sys.stderr.isatty()
    colour = {0: "", 4: "", 1: _CYAN}.get(level, _RED) if colours else ""
    print(f"{colour}{text}{_RESET if colour else ''}", file=sys.stderr, flush=True)


def install(verbose: bool = False) -> None:
    """From here on exceptions in slots and Qt's messages are lines on stderr, coloured on a terminal."""
    _options["verbose"] = verbose
    sys.excepthook = _on_exception
    sys.unraisablehook = _on_unraisable
    QtCore.qInstallMessageHandler(_on_message)

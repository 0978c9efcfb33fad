"""Runs a command of ours with an ear: ``python3 -m rqt_testing.driven SOCKET SCRIPT ARGUMENTS...``.

The script runs as it would alone; a thread answers questions about its widgets on a Unix socket, one JSON line each way:
``{"what": "rect", "name": ...}``. Clicks and keys come from outside, through the X server, like a person's.
"""

import json
import runpy
import socket
import sys
import threading
import time

from python_qt_binding.QtCore import QCoreApplication, QEvent, QObject, Qt
from python_qt_binding.QtWidgets import QAbstractItemView, QApplication, QMenu, QScrollArea, QTabBar, QWidget

_KIND = QEvent.Type(QEvent.registerEventType())
_ANYWHERE = Qt.MatchStartsWith | Qt.MatchWrap | Qt.MatchRecursive  # rows of trees below others, too


class _Call(QEvent):
    def __init__(self, function):
        super().__init__(_KIND)
        self.function, self.done, self.answer = function, threading.Event(), None


class _Runner(QObject):
    """Runs calls in the thread of the widgets, and measures the longest time that this thread did not come back to Qt."""

    _PULSE = 5  # ms

    def __init__(self):
        super().__init__()
        self._last, self._longest = None, [0.0, 0.0]

    def timerEvent(self, _event):
        now = time.monotonic(), time.thread_time()
        if self._last is not None:
            spent = now[0] - self._last[0] - self._PULSE / 1000, now[1] - self._last[1]
            self._longest = [max(pair) for pair in zip(self._longest, spent)]
        self._last = now

    def pause(self):
        """The longest pause since the last such question, [passed, of this thread's processor time] in ms; the first question
        begins the measuring. The second says what the widgets' thread did, however busy the machine was."""
        if self._last is None:
            self.startTimer(self._PULSE)
        longest, self._longest = [1000 * longest for longest in self._longest], [0.0, 0.0]
        return longest

    def event(self, event):
        if event.type() == _KIND:
            try:
                event.answer = event.function()
            except Exception as error:  # the answer to a question about a widget that goes just now
                event.answer = {"error": f"{type(error).__name__}: {error}"}
            event.done.set()
            return True
        return super().event(event)


def _rect(widget, inner=None):
    inner = widget.rect() if inner is None else inner
    corner = widget.mapToGlobal(inner.topLeft())
    return [corner.x(), corner.y(), inner.width(), inner.height()]


def _scroll_to(widget):
    """As a person does before clicking: what is in a scroll area is brought into sight."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            parent.ensureWidgetVisible(widget, 5, 5)
        parent = parent.parentWidget()


def _widgets(name):
    return [w for w in QApplication.allWidgets() if w.objectName() == name and w.isVisible()]


def _text(widget):
    for getter in ("text", "currentText", "toPlainText", "windowTitle"):
        if hasattr(widget, getter):
            return str(getattr(widget, getter)())
    return ""


def _answer(question):
    what, name = question["what"], question.get("name", "")
    if what == "names":
        return sorted({w.objectName() for w in QApplication.allWidgets() if w.isVisible()} - {""})
    if what == "windows":
        shown = [w for w in QApplication.topLevelWidgets() if w.isVisible() and w.windowHandle() and w.windowHandle().isExposed()]
        return [[w.windowTitle(), type(w).__name__, *_rect(w)] for w in shown] if QApplication.activeWindow() else []
    if what == "entry":  # of a menu, menu bar, tab bar or item view, by its text
        return _entry(name)
    found = _widgets(name)
    if not found:
        return {"error": f"no visible widget is named {name}"}
    if what == "rect":
        _scroll_to(found[-1])
        return _rect(found[-1])
    if what == "text":
        return _text(found[-1])
    if what == "enabled":
        return found[-1].isEnabled()
    return {"error": f"what is {what}"}


def _entry(text):
    for widget in reversed([w for w in QApplication.allWidgets() if w.isVisible()]):
        if hasattr(widget, "actionGeometry"):
            for action in widget.actions():
                if action.text().replace("&", "") == text and action.isVisible():
                    return _rect(widget, widget.actionGeometry(action))
        elif isinstance(widget, QTabBar):
            for index in range(widget.count()):
                if widget.tabText(index) == text:
                    return _rect(widget, widget.tabRect(index))
    for view in (w for w in QApplication.allWidgets() if w.isVisible() and isinstance(w, QAbstractItemView)):
        found = view.model() and view.model().match(view.model().index(0, 0), 0, text, 1, _ANYWHERE)
        if found:
            if not view.viewport().rect().contains(view.visualRect(found[0])):  # a list that has grown since it was opened
                view.scrollTo(found[0])
            return _rect(view.viewport(), view.visualRect(found[0]))
    for widget in (w for w in QApplication.allWidgets() if w.isVisible() and not isinstance(w, QMenu)):
        if isinstance(widget, QWidget) and hasattr(widget, "text") and _plain_text(widget) == text:
            return _rect(widget)
    return {"error": f"nothing visible says {text}"}


def _plain_text(widget):
    try:
        return str(widget.text()).replace("&", "")
    except TypeError:
        return None


def _serve(path):
    server = socket.socket(socket.AF_UNIX)
    server.bind(path)
    server.listen()
    while QCoreApplication.instance() is None:
        time.sleep(0.005)
    runner = _Runner()
    runner.moveToThread(QCoreApplication.instance().thread())
    while True:
        connection, _ = server.accept()
        try:
            with connection, connection.makefile("rw") as stream:
                question = json.loads(stream.readline())
                call = _Call(runner.pause if question["what"] == "pause" else lambda: _answer(question))
                QCoreApplication.postEvent(runner, call)
                call.done.wait(10)
                stream.write(json.dumps(call.answer) + "\n")
        except (OSError, ValueError):
            continue  # who asked, on a busy machine, has given up waiting; it asks again


def main():
    path, script = sys.argv[1:3]
    sys.argv = sys.argv[2:]
    threading.Thread(target=_serve, args=(path,), daemon=True).start()
    runpy.run_path(script, run_name="__main__")


if __name__ == "__main__":
    main()

"""An interpreter in a text."""

import code
import contextlib
import io
import sys

from python_qt_binding.QtCore import QSize, Qt
from python_qt_binding.QtGui import QFontDatabase, QTextCursor
from python_qt_binding.QtWidgets import QPlainTextEdit

_LINES = 5000  # kept


class PyConsoleWidget(QPlainTextEdit):
    """Lines are typed at the end; Up and Down go through those of before, Tab completes names."""

    def __init__(self, names=None):
        """:param names: names to values that the interpreter knows from the start"""
        super().__init__()
        self.setObjectName("PyConsoleWidget")
        self.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.setMaximumBlockCount(_LINES)
        self.setUndoRedoEnabled(False)
        self._names = {"__name__": "__console__", "__doc__": None, "window": self, **(names or {})}
        self._interpreter = code.InteractiveInterpreter(self._names)
        self._history, self._place, self._lines = [], 0, []
        self.insertPlainText(f"Python {sys.version.split()[0]}; known: {', '.join(sorted(n for n in self._names if n[0] != '_'))}\n")
        self._prompt()

    def sizeHint(self) -> QSize:
        return QSize(640, 400)

    def _prompt(self) -> None:
        self._to_end()
        self.insertPlainText("... " if self._lines else ">>> ")
        self._start = self.textCursor().position()

    def _to_end(self) -> None:
        self.moveCursor(QTextCursor.MoveOperation.End)

    def current_line(self) -> str:
        """What is typed after the prompt."""
        cursor = self.textCursor()
        cursor.setPosition(min(self._start, self.document().characterCount() - 1))
        cursor.movePosition(QTextCursor.MoveOperation.End, QTextCursor.MoveMode.KeepAnchor)
        return cursor.selectedText()

    def set_line(self, text: str) -> None:
        cursor = self.textCursor()
        cursor.setPosition(self._start)
        cursor.movePosition(QTextCursor.MoveOperation.End, QTextCursor.MoveMode.KeepAnchor)
        cursor.insertText(text)
        self.setTextCursor(cursor)

    def enter(self) -> None:
        """Run what is typed, or go on with the next line of a block."""
        line = self.current_line()
        self._to_end()
        self.insertPlainText("\n")
        if line.strip():
            self._history = [kept for kept in self._history if kept != line][-499:] + [line]
        self._place = len(self._history)
        self._lines.append(line)
        output, more = io.StringIO(), False
        hook, sys.excepthook = sys.excepthook, sys.__excepthook__  # the interpreter asks it, and rqt's prints elsewhere
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            try:
                more = self._interpreter.runsource("\n".join(self._lines), "<console>")
            except SystemExit:
                print("exit() does not end rqt: close the window instead")
            except KeyboardInterrupt:
                print("KeyboardInterrupt")
            finally:
                sys.excepthook = hook
        if not more:
            self._lines = []
        self._to_end()
        self.insertPlainText(output.getvalue()[-100000:])
        self._prompt()
        self.ensureCursorVisible()

    def complete(self) -> None:
        import re
        import rlcompleter

        line = self.current_line()
        end = re.search(r"[\w.]*$", line)
        word = end.group() if end else ""
        completer = rlcompleter.Completer(self._names)
        found: list[str] = []
        while word and len(found) < 200:
            entry = completer.complete(word, len(found))
            if entry is None:
                break
            found.append(entry)
        if len(found) == 1:
            self.set_line(line[: len(line) - len(word)] + found[0])
        elif found:
            self._to_end()
            self.insertPlainText("\n" + "  ".join(found) + "\n")
            self._prompt()
            self.set_line(line)

    def keyPressEvent(self, event) -> None:
        key, control = event.key(), event.modifiers() & Qt.KeyboardModifier.ControlModifier
        if control and key == Qt.Key.Key_C and not self.textCursor().hasSelection():
            self._lines = []
            self._to_end()
            self.insertPlainText("\nKeyboardInterrupt\n")
            self._prompt()
        elif control and key == Qt.Key.Key_C:
            self.copy()
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) or event.text() in ("\r", "\n"):
            self.enter()
        elif key in (Qt.Key.Key_Up, Qt.Key.Key_Down) and self._history:
            self._place = min(max(self._place + (1 if key == Qt.Key.Key_Down else -1), 0), len(self._history))
            self.set_line(self._history[self._place] if self._place < len(self._history) else "")
        elif key == Qt.Key.Key_Tab:
            self.insertPlainText("    ") if not self.current_line().strip() else self.complete()
        elif key == Qt.Key.Key_Home:
            cursor = self.textCursor()
            cursor.setPosition(self._start)
            self.setTextCursor(cursor)
        else:
            self._type(event)

    def _type(self, event) -> None:
        """Anything else: what is above the prompt stays."""
        cursor = self.textCursor()
        back = event.key() in (Qt.Key.Key_Backspace, Qt.Key.Key_Left)
        if cursor.selectionStart() < self._start or back and not cursor.hasSelection() and cursor.position() <= self._start:
            if back:
                return
            self._to_end()
        super().keyPressEvent(event)

    def insertFromMimeData(self, source) -> None:
        """A paste runs all lines but the last."""
        lines = source.text().split("\n")
        self._to_end()
        for number, line in enumerate(lines):
            self.insertPlainText(line)
            if number < len(lines) - 1:
                self.enter()

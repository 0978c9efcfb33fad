"""A text field that behaves like a terminal."""

import sys

from python_qt_binding.QtCore import Qt
from python_qt_binding.QtGui import QFontDatabase
from python_qt_binding.QtWidgets import QTextEdit


class ConsoleTextEdit(QTextEdit):
    """A prompt, a history (up, down), output in colours. A derived class executes lines in ``_exec_code(code)``."""

    _color_stdout = Qt.GlobalColor.blue
    _color_stderr = Qt.GlobalColor.red
    _color_stdin = Qt.GlobalColor.black
    _multi_line_char = "\\"  # at the end of a line: more lines follow, until an empty one
    _multi_line_indent = "    "
    _prompt = ("$ ", "  ")  # for the first, and for further lines of a command

    class TextEditColoredWriter:
        """A file-like object that writes into the text field in one colour."""

        def __init__(self, text_edit, color):
            self._text_edit = text_edit
            self._color = color

        def write(self, line):
            edit = self._text_edit
            before = edit.textColor()
            edit.setTextColor(self._color)
            edit.insertPlainText(line)
            edit.setTextColor(before)
            edit.ensureCursorVisible()

        def flush(self):
            pass

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.setUndoRedoEnabled(False)
        self._multi_line = False
        self._multi_line_level = 0
        self._command = ""
        self._history = []  # newest first
        self._history_index = -1
        self._stdout = self.TextEditColoredWriter(self, self._color_stdout)
        self._stderr = self.TextEditColoredWriter(self, self._color_stderr)
        self._comment_writer = self.TextEditColoredWriter(self, self._color_stdin)

    def print_message(self, msg):
        """Put a line in the place of the prompt, and the prompt below it."""
        self._clear_current_line(clear_prompt=True)
        self._comment_writer.write(msg + "\n")
        self._add_prompt()

    def _add_prompt(self):
        self._comment_writer.write(self._prompt[self._multi_line] + self._multi_line_indent * self._multi_line_level)

    def _prompt_position(self):
        """Where in the document the text begins that the user may change."""
        return self.document().lastBlock().position() + len(self._prompt[self._multi_line])

    def _clear_current_line(self, clear_prompt=False):
        cursor = self.textCursor()
        cursor.setPosition(self.document().lastBlock().position() if clear_prompt else self._prompt_position())
        cursor.movePosition(cursor.MoveOperation.End, cursor.MoveMode.KeepAnchor)
        cursor.removeSelectedText()
        self.setTextCursor(cursor)

    def _move_in_history(self, delta):
        self._clear_current_line()
        self._history_index = max(-1, min(self._history_index + delta, len(self._history) - 1))
        if self._history_index >= 0:
            self.insertPlainText(self._history[self._history_index])

    def _exec_code(self, code):
        """Execute what was typed: where a derived class does its work."""
        raise NotImplementedError

    def _exec_with_captured_output(self, code):
        """Execute with what it prints going into this field."""
        before = sys.stdout, sys.stderr
        sys.stdout, sys.stderr = self._stdout, self._stderr
        try:
            self._exec_code(code)
        finally:
            sys.stdout, sys.stderr = before

    def keyPressEvent(self, event):
        keys, start = Qt.Key, self._prompt_position()
        cursor = self.textCursor()
        if cursor.selectionStart() < start and event.text() and event.key() != keys.Key_C:
            cursor.movePosition(cursor.MoveOperation.End)  # what is printed stays; typing goes to the prompt
            self.setTextCursor(cursor)
        if event.key() in (keys.Key_Up, keys.Key_Down):
            self._move_in_history(1 if event.key() == keys.Key_Up else -1)
        elif event.key() == keys.Key_Backspace and cursor.position() <= start and not cursor.hasSelection():
            pass
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            self._on_return(start)
        else:
            super().keyPressEvent(event)
            cursor = self.textCursor()
            if self.document().lastBlock().position() <= cursor.position() < start and not cursor.hasSelection():
                cursor.setPosition(start)
                self.setTextCursor(cursor)

    def _on_return(self, start):
        cursor = self.textCursor()
        cursor.movePosition(cursor.MoveOperation.End)
        self.setTextCursor(cursor)
        line = self.toPlainText()[start:].rstrip()
        self._history_index = -1
        self.insertPlainText("\n")
        if line:
            self._history.insert(0, line)
            if line.endswith(self._multi_line_char):
                self._multi_line = True
                self._multi_line_level += 1
            if self._multi_line:
                self._command += line + "\n"
            else:
                self._exec_with_captured_output(line)
        elif self._multi_line:
            command, self._command, self._multi_line, self._multi_line_level = self._command, "", False, 0
            self._exec_with_captured_output(command)
        self._add_prompt()

"""A terminal: pyte keeps the screen, this draws it and sends the keys."""

import fcntl
import os
import pty
import signal
import struct
import termios
import time

import pyte
from python_qt_binding.QtCore import QRectF, QSize, QSocketNotifier, Qt, QTimer, Signal
from python_qt_binding.QtGui import QColor, QFontDatabase, QFontMetricsF, QPainter
from python_qt_binding.QtWidgets import QApplication, QWidget

_HISTORY = 2000  # lines
_COLORS = {
    "black": "#000000",
    "red": "#cd3131",
    "green": "#0dbc79",
    "brown": "#c8b400",
    "blue": "#3b78ff",
    "magenta": "#bc3fbc",
    "cyan": "#11a8cd",
    "white": "#e5e5e5",
}
_KEYS = {
    "Key_Up": "\x1b[A",
    "Key_Down": "\x1b[B",
    "Key_Right": "\x1b[C",
    "Key_Left": "\x1b[D",
    "Key_Home": "\x1b[H",
    "Key_End": "\x1b[F",
    "Key_Delete": "\x1b[3~",
    "Key_PageUp": "\x1b[5~",
    "Key_PageDown": "\x1b[6~",
    "Key_Backspace": "\x7f",
    "Key_Return": "\r",
    "Key_Enter": "\r",
    "Key_Tab": "\t",
    "Key_Backtab": "\x1b[Z",
    "Key_Escape": "\x1b",
}
_BYTES = {getattr(Qt.Key, name): text.encode() for name, text in _KEYS.items()}


class TerminalWidget(QWidget):
    """Runs ``command`` ($SHELL) in a pseudo-terminal; ``ended`` tells that it is over."""

    ended = Signal()

    def __init__(self, command=None):
        super().__init__()
        self.setObjectName("ShellWidget")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        metrics = QFontMetricsF(self.font())
        self._width, self._height, self._ascent = max(1.0, metrics.horizontalAdvance("M")), max(1.0, metrics.height()), metrics.ascent()
        self.screen = pyte.HistoryScreen(80, 24, history=_HISTORY, ratio=0.3)
        self._stream = pyte.ByteStream(self.screen)
        self.setMinimumSize(200, 100)
        self._descriptor: int | None
        self._process, self._descriptor = pty.fork()
        if self._process == 0:
            self._become(command or [os.environ.get("SHELL", "/bin/bash")])
        os.set_blocking(self._descriptor, False)
        self._notifier = QSocketNotifier(self._descriptor, QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(lambda *_: self._read())
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.update)

    def sizeHint(self) -> QSize:
        return QSize(int(80.5 * self._width), int(24.5 * self._height))

    @staticmethod
    def _become(command) -> None:
        """In the child: never returns."""
        try:
            for number in (signal.SIGINT, signal.SIGPIPE, signal.SIGTERM):
                signal.signal(number, signal.SIG_DFL)
            os.environ["TERM"] = "linux"
            for name in ("COLUMNS", "LINES"):  # of the terminal that rqt was started in; readline exports them
                os.environ.pop(name, None)
            os.execvp(command[0], command)
        finally:
            os._exit(127)

    def text(self) -> str:
        """What is on the screen, without empty lines at the end."""
        return "\n".join(line.rstrip() for line in self.screen.display).rstrip()

    def send(self, data: bytes) -> None:
        if self._descriptor is not None:
            try:
                os.write(self._descriptor, data)
            except OSError:  # the shell is over, or does not read
                pass

    def _read(self) -> None:
        if self._descriptor is None:
            return
        try:
            data = os.read(self._descriptor, 65536)
        except BlockingIOError:
            return
        except OSError:  # the other side is closed
            data = b""
        if not data:
            self.end()
            self.ended.emit()
            return
        try:
            self._stream.feed(data)
        except (IndexError, TypeError, ValueError, KeyError):  # sequences that pyte does not know
            self.screen.reset()
        if not self._timer.isActive():
            self._timer.start(20)  # much output is drawn fifty times a second

    def end(self) -> None:
        """Hang up: what runs in the terminal gets SIGHUP."""
        if self._descriptor is None:
            return
        self._notifier.setEnabled(False)
        os.close(self._descriptor)
        self._descriptor = None
        try:
            os.kill(self._process, signal.SIGHUP)
            for _ in range(50):
                if os.waitpid(self._process, os.WNOHANG)[0]:
                    return
                time.sleep(0.01)
            os.kill(self._process, signal.SIGKILL)
            os.waitpid(self._process, 0)
        except (ProcessLookupError, ChildProcessError):
            pass

    def resizeEvent(self, event) -> None:
        columns, lines = max(10, int(self.width() / self._width)), max(2, int(self.height() / self._height))
        self.screen.resize(lines, columns)
        if self._descriptor is not None:
            fcntl.ioctl(self._descriptor, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))
        super().resizeEvent(event)

    def event(self, event) -> bool:
        if event.type() == event.Type.KeyPress and event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            self.keyPressEvent(event)  # Qt would go to the next widget
            return True
        return super().event(event)

    def keyPressEvent(self, event) -> None:
        modifiers, key = event.modifiers(), event.key()
        control, shift = modifiers & Qt.KeyboardModifier.ControlModifier, modifiers & Qt.KeyboardModifier.ShiftModifier
        if control and shift and key == Qt.Key.Key_V or shift and key == Qt.Key.Key_Insert:
            self.send(QApplication.clipboard().text().encode())
        elif control and shift and key == Qt.Key.Key_C:
            QApplication.clipboard().setText(self.text())
        elif shift and key == Qt.Key.Key_PageUp:
            self.screen.prev_page()
            self.update()
        elif shift and key == Qt.Key.Key_PageDown:
            self.screen.next_page()
            self.update()
        else:
            self._leave_history()
            letter = control and Qt.Key.Key_A <= key <= Qt.Key.Key_Z
            self.send(bytes([key - Qt.Key.Key_A + 1]) if letter else _BYTES.get(key) or event.text().encode())

    def _leave_history(self) -> None:
        while self.screen.history.position < self.screen.history.size:
            self.screen.next_page()

    def wheelEvent(self, event) -> None:
        self.screen.prev_page() if event.angleDelta().y() > 0 else self.screen.next_page()
        self.update()

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        painter.setFont(self.font())
        painter.fillRect(self.rect(), QColor("black"))
        for row in range(self.screen.lines):
            line = self.screen.buffer[row]
            for column in range(self.screen.columns):
                cell = line[column]
                if cell.data != " " or cell.bg != "default" or cell.reverse:
                    self._draw(painter, column, row, cell)
        cursor = self.screen.cursor
        if not cursor.hidden:
            painter.fillRect(QRectF(cursor.x * self._width, cursor.y * self._height, self._width, self._height), QColor(200, 200, 200, 150))
        painter.end()

    def _draw(self, painter, column, row, cell) -> None:
        front, back = _color(cell.fg, "#e5e5e5"), _color(cell.bg, "#000000")
        if cell.reverse:
            front, back = back, front
        place = QRectF(column * self._width, row * self._height, self._width, self._height)
        if back != QColor("black"):
            painter.fillRect(place, back)
        painter.setPen(front.lighter(130) if cell.bold else front)
        painter.drawText(place.topLeft() + QRectF(0, 0, 0, self._ascent).bottomLeft(), cell.data)


def _color(name: str, default: str) -> QColor:
    if name == "default":
        return QColor(default)
    return QColor(_COLORS.get(name.replace("bright", ""), f"#{name}" if len(name) == 6 else default))

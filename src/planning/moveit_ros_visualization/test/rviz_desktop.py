"""RViz's window on a private display."""

import os
import signal

from rviz_offscreen import qt

_WINDOW = os.path.join(os.path.dirname(os.path.abspath(__file__)), "rviz_window.py")
_QT = (qt.package() or "").lower()  # the one that RViz stands on: pyqt5, on Debian 13 pyqt6
_DRAWN = 5  # frames
_TRIES = 4


def run_rviz(desktop, config, size, **variables):
    """The window, when it has drawn its first frames.

    Mesa 22.3's software OpenGL ends RViz, plain RViz too, in its first frame by SIGSEGV, one start in some twenty where others start as
    well: what was to be drawn on before the window had its size has been freed then. Such a start does not count.
    """
    for left in reversed(range(_TRIES)):
        rviz = desktop.run([_WINDOW, config, size], QT_API=_QT, **variables)
        rviz.wait(lambda: rviz.process.poll() is not None or int(rviz.ask("text", "frames") or 0) >= _DRAWN, "first frame")
        if rviz.process.poll() != -signal.SIGSEGV or not left:
            return rviz

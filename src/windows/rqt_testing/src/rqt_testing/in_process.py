"""Plugins in the test's own process, without a display. Import this before anything of Qt.

::

    from rqt_testing.in_process import find, open_plugin, wait_until

    def test_topic_is_kept():
        with open_plugin("rqt_my_plugin") as gui:          # settings are private, and kept within a test by settings=path
            find(gui, "topic_edit").setText("/other")      # by objectName
            assert gui.plugin.topic_edit.text() == "/other"

A plugin that uses rospy needs a master: rostest gives one. In a plain pytest, ``rospy_without_master()`` before
``open_plugin`` lets it be created; what it publishes and subscribes then goes nowhere.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

os.environ["QT_QPA_PLATFORM"] = "offscreen"
if "XDG_RUNTIME_DIR" not in os.environ:
    os.environ["XDG_RUNTIME_DIR"] = tempfile.mkdtemp(prefix="xdg_")  # Qt asks for one, and for 0700
    atexit.register(shutil.rmtree, os.environ["XDG_RUNTIME_DIR"], True)

from python_qt_binding.QtCore import QEvent, QObject, QSettings  # noqa: E402
from python_qt_binding.QtTest import QTest  # noqa: E402
from python_qt_binding.QtWidgets import QApplication, QWidget  # noqa: E402
from qt_gui.application import options as command_line  # noqa: E402
from qt_gui.application import reporting  # noqa: E402
from qt_gui.application.compatibility import accept_floats  # noqa: E402
from qt_gui.gui import Gui  # noqa: E402
from qt_gui.icon_loader import choose_theme  # noqa: E402
from qt_gui.plugin_context import PluginContext  # noqa: E402

accept_floats()
errors: list[str] = []  # texts of warnings and errors since the last open_gui(): what a plugin raised, what the container refused
_application: list[Any] = []


def application() -> QApplication:
    """The application of this process; made at the first call and kept."""
    if not _application:
        _application.append(QApplication.instance() or QApplication(["test"]))
        choose_theme()
        reporting.install()
        reporting.listeners.append(errors.append)
    return _application[0]


@contextlib.contextmanager
def open_gui(arguments: Sequence[str] = (), settings: str | None = None, providers=None) -> Iterator[Gui]:
    """A window as ``rqt ARGUMENTS`` opens it.

    :param arguments: without the program's name
    :param settings: path of an INI file to keep settings in from one window to the next; private and empty without
    :param providers: plugin providers; those of rqt without
    """
    app = application()
    errors.clear()
    with tempfile.TemporaryDirectory(prefix="rqt_") as folder:
        store = QSettings(settings or os.path.join(folder, "rqt.ini"), QSettings.Format.IniFormat)
        gui = Gui(rqt_providers() if providers is None else providers, store, command_line.parse("rqt", list(arguments)))
        try:
            gui.open()
            app.processEvents()
            yield gui
        finally:
            gui.dispose()
            app.processEvents()


@contextlib.contextmanager
def open_plugin(name: str, argv: Sequence[str] = (), settings: str | None = None, providers=None) -> Iterator[Gui]:
    """A window with one plugin, as ``rqt --standalone NAME --args ARGV`` opens it; ``gui.plugin`` is the instance.

    ``name`` and ``argv`` stand for NAME and ARGV; ``settings`` and ``providers`` are those of :func:`open_gui`.
    """
    with open_gui(["--standalone", name, *(["--args", *argv] if argv else [])], settings, providers) as gui:
        gui.plugin = gui.plugins.running()[0].plugin()
        yield gui
        gui.plugin = None


def rqt_providers():
    """The providers of the real rqt; its plugins of rospy are loaded without a wait for the master."""
    from rqt_gui.main import Main

    main = Main()
    main._add_plugin_providers()
    return main.plugin_providers


def rospy_without_master() -> None:
    """Let plugins make publishers, subscribers and services though there is no master."""
    import rospy

    from rqt_testing.no_master import NoMaster

    if not rospy.core.is_initialized():
        os.environ["ROS_MASTER_URI"] = NoMaster().start()
        rospy.init_node("rqt_test", anonymous=True, disable_signals=True)


class FakeContext(PluginContext):
    """A context without a container, for tests of a plugin class alone; ``widgets`` are those it has added."""

    def __init__(self, argv: Sequence[str] = (), serial_number: int = 0):
        application()
        self._parent = QObject()
        super().__init__(self._parent)
        self.widgets: list[Any] = []
        self.toolbars: list[Any] = []
        self.closed = False
        self._argv, self._serial = list(argv), serial_number

    def serial_number(self):
        return self._serial

    def argv(self):
        return self._argv

    def add_widget(self, widget):
        self.widgets.append(widget)

    def remove_widget(self, widget):
        self.widgets.remove(widget)

    def add_toolbar(self, toolbar):
        self.toolbars.append(toolbar)

    def remove_toolbar(self, toolbar):
        self.toolbars.remove(toolbar)

    def close_plugin(self):
        self.closed = True


def find(parent, name: str) -> QWidget:
    """The widget or action of which ``name`` is the ``objectName`` below ``parent``, a widget or a :class:`Gui`.

    :raises LookupError: none, or several; it lists the names that there are.
    """
    parent = getattr(parent, "window", None) if isinstance(parent, Gui) else parent
    found = parent.findChildren(QObject, name)
    if len(found) != 1:
        names = sorted({child.objectName() for child in parent.findChildren(QObject)} - {""})
        raise LookupError(f"{len(found)} things are named {name}; there are: {', '.join(names)}")
    return found[0]


def wait_until(condition: Callable[[], object], timeout: float = 20.0):
    """Run Qt's event loop until ``condition()`` is true; returns its value.

    :raises AssertionError: it was not within ``timeout`` seconds.
    """
    end = time.monotonic() + timeout
    while True:
        application().processEvents()
        value = condition()
        if value:
            return value
        assert time.monotonic() < end, f"not within {timeout} s: {getattr(condition, '__doc__', None) or condition}"
        QTest.qWait(5)


def process_events() -> None:
    """Let everything queued happen, deferred deletions too."""
    for _ in range(3):
        application().processEvents()
        application().sendPostedEvents(None, getattr(QEvent.Type.DeferredDelete, "value", QEvent.Type.DeferredDelete))


def screenshot(widget, path: str) -> None:
    """Write a PNG of ``widget``, a widget or a :class:`Gui`, to ``path``, to look at."""
    (widget.window if isinstance(widget, Gui) else widget).grab().save(path)

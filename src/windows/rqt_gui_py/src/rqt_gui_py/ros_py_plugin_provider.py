"""Loads the plugins that use rospy: waits for a master, starts the node once."""

import os
import sys
import threading

import rosgraph
import rospy
from node_signals import clock_watch, master_watch
from python_qt_binding.QtCore import QObject, Qt, QTimer, Signal, qWarning
from python_qt_binding.QtWidgets import QApplication, QMessageBox
from qt_gui.composite_plugin_provider import CompositePluginProvider
from qt_gui.errors import PluginLoadError
from rqt_gui.rospkg_plugin_provider import RospkgPluginProvider

_PATIENCE = 1.0  # s that a master gets to answer before the user is told
_PERIOD = 0.2  # s between two looks for a master
_CLOCK_PERIOD = 1000  # ms between two looks at the time
_CLOCK_PATIENCE = 3  # looks without a time before the user is told


class _ClockNotice(QObject):
    """A line in the window, and one on the terminal, while simulated time does not begin; every plugin waits for it in its own way."""

    def __init__(self, parent):
        super().__init__(parent)
        self._looks = 0
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.look)
        self._timer.start(_CLOCK_PERIOD)

    def look(self):
        missing = clock_watch.missing()
        self._looks += 1
        if missing and self._looks < _CLOCK_PATIENCE:
            return
        if missing and self._looks == _CLOCK_PATIENCE:
            qWarning(f"rqt: {missing}")
        for window in QApplication.topLevelWidgets():
            if hasattr(window, "show_notice"):
                window.show_notice(missing or "")
        if not missing:
            self._timer.stop()


class RosPyPluginProvider(CompositePluginProvider):
    """All plugins with the base ``rqt_gui_py::Plugin``."""

    _master_found = Signal()

    def __init__(self):
        super().__init__([RospkgPluginProvider("rqt_gui", "rqt_gui_py::Plugin")])
        self.setObjectName("RosPyPluginProvider")
        self._clock = None

    def load(self, plugin_id, plugin_context):
        if not rospy.core.is_initialized():
            self._wait_for_master()
            # Nodes that are started by hand have no name given; two windows must not push each other out.
            rospy.init_node(f"rqt_gui_py_node_{os.getpid()}", disable_signals=True)
            master_watch.watch()
        if self._clock is None and clock_watch.expected():
            self._clock = _ClockNotice(self)
        return super().load(plugin_id, plugin_context)

    def _wait_for_master(self):
        """Return when a master answers; until then a dialog offers to give up.

        :raises PluginLoadError: the user gave up.
        """
        found, given_up = threading.Event(), threading.Event()

        def look():
            while not given_up.is_set():
                if rosgraph.is_master_online():
                    found.set()
                    self._master_found.emit()
                    return
                given_up.wait(_PERIOD)

        threading.Thread(target=look, name="wait for master", daemon=True).start()
        if found.wait(_PATIENCE):
            return
        uri = rosgraph.get_master_uri()
        print(f"rqt: waiting for the ROS master at {uri}; start roscore, or press Abort", file=sys.stderr, flush=True)
        dialog = QMessageBox(
            QMessageBox.Icon.Question,
            "Waiting for ROS master",
            f"Could not find the ROS master at {uri}.\nEither start a 'roscore' or abort loading the plugin.",
            QMessageBox.StandardButton.Abort,
            QApplication.activeWindow(),
        )
        dialog.setObjectName("waiting_for_master")
        self._master_found.connect(dialog.accept, Qt.ConnectionType.QueuedConnection)
        if not found.is_set():
            dialog.exec() if hasattr(dialog, "exec") else dialog.exec_()
        given_up.set()
        dialog.deleteLater()
        if not found.is_set():
            raise PluginLoadError(f"there is no ROS master at {uri}; start roscore, or set ROS_MASTER_URI")

"""Loads the plugins that use rospy: waits for a master, starts the node once."""
import os
import sys
import threading

import rosgraph
import rospy
from node_signals import master_watch
from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import QApplication, QMessageBox
from qt_gui.composite_plugin_provider import CompositePluginProvider
from qt_gui.errors import PluginLoadError
from rqt_gui.rospkg_plugin_provider import RospkgPluginProvider

_PATIENCE = 1.0  # s that a master gets to answer before the user is told
_PERIOD = 0.2  # s between two looks for a master


class RosPyPluginProvider(CompositePluginProvider):
    """All plugins with the base ``rqt_gui_py::Plugin``."""

    _master_found = Signal()

    def __init__(self):
        super().__init__([RospkgPluginProvider("rqt_gui", "rqt_gui_py::Plugin")])
        self.setObjectName("RosPyPluginProvider")

    def load(self, plugin_id, plugin_context):
        if not rospy.core.is_initialized():
            self._wait_for_master()
            # Nodes that are started by hand have no name given; two windows must not push each other out.
            rospy.init_node(f"rqt_gui_py_node_{os.getpid()}", disable_signals=True)
            master_watch.watch()
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
        dialog = QMessageBox(QMessageBox.Icon.Question, "Waiting for ROS master",
                             f"Could not find the ROS master at {uri}.\nEither start a 'roscore' or abort loading the plugin.",
                             QMessageBox.StandardButton.Abort, QApplication.activeWindow())
        dialog.setObjectName("waiting_for_master")
        self._master_found.connect(dialog.accept, Qt.ConnectionType.QueuedConnection)
        if not found.is_set():
            dialog.exec() if hasattr(dialog, "exec") else dialog.exec_()
        given_up.set()
        dialog.deleteLater()
        if not found.is_set():
            raise PluginLoadError(f"there is no ROS master at {uri}; start roscore, or set ROS_MASTER_URI")

"""The window of the tree of frames."""

import rospy
import tf2_ros
from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtGui import QKeySequence
from python_qt_binding.QtWidgets import QCheckBox, QVBoxLayout, QWidget
from qt_gui.application.compatibility import QShortcut
from rqt_graph.graph_pane import GraphPane
from rqt_graph.toolbar import Row
from rqt_gui_py.plugin import Plugin

from rqt_tf_tree.dotcode_tf import FramesError, generate_dot, parse

LISTEN = 1000  # ms of listening before the first tree, and again while there is none
_PERIOD = 2000  # ms between two automatic refreshes


class RosTfTree(Plugin):
    """The frames heard so far, from when the window was opened or its buffer cleared."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RosTfTree")
        self._widget = QWidget()
        self._widget.setObjectName("RosTfTreeUi")
        number = context.serial_number()
        self._widget.setWindowTitle("TF Tree" + (f" ({number})" if number > 1 else ""))
        self.pane = GraphPane(self._widget)
        rows, row = QVBoxLayout(self._widget), Row()
        rows.setContentsMargins(3, 3, 3, 3)
        rows.addLayout(row)
        rows.addWidget(self.pane, 1)
        row.button("clear_buffer_push_button", "edit-clear", "Clear", "Clear TF buffer", self.clear)
        row.button("refresh_graph_push_button", "view-refresh", "Refresh", "Refresh TF tree (Ctrl+R)", self.refresh)
        self.auto_box = row.check("auto_refresh_check_box", "Auto", "Refresh every two seconds", False, self._set_auto)
        row.addStretch(1)
        self.highlight_box: QCheckBox = row.check(
            "highlight_connections_check_box",
            "Highlight",
            "Highlight connections under the mouse",
            True,
            lambda: self.pane.set_highlight(self.highlight_box.isChecked()),
        )
        self.fit_box: QCheckBox = row.check(
            "auto_fit_graph_check_box",
            "Fit",
            "Automatically fit graph into view",
            True,
            lambda: self.pane.set_auto_fit(self.fit_box.isChecked()),
        )
        row.button("fit_in_view_push_button", "zoom-fit-best", "Fit", "Fit graph in view", self.pane.fit)
        row.file_buttons(self.pane, "frames", self._load)
        QShortcut(QKeySequence("Ctrl+R"), self._widget, self.refresh).setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        # debug: the buffer offers ~tf2_frames, which tf_echo and view_frames ask too
        self._buffer = tf2_ros.Buffer(rospy.Duration(10), debug=True)
        self._listener = tf2_ros.TransformListener(self._buffer)
        self._waiting = QTimer(self)
        self._waiting.timeout.connect(self.refresh)
        self._waiting.start(LISTEN)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.refresh)
        context.add_widget(self._widget)

    def refresh(self):
        """Draw what has been heard."""
        try:
            frames = parse(self._buffer.all_frames_as_yaml())
        except FramesError as error:
            self.pane.show_problem(str(error))
            return
        if frames:
            self._waiting.stop()
        self.pane.show_dot(generate_dot(frames, rospy.get_time()))

    def clear(self):
        """Forget all frames; those that still come are drawn again."""
        self._buffer.clear()
        self.refresh()
        self._waiting.start(LISTEN)

    def _set_auto(self):
        self._timer.start(_PERIOD) if self.auto_box.isChecked() else self._timer.stop()

    def _load(self):
        if self.pane.ask_load_dot():
            self.auto_box.setChecked(False)
            self._waiting.stop()

    def shutdown_plugin(self):
        self._waiting.stop()
        self._timer.stop()
        self._listener.unregister()
        server = getattr(self._buffer, "frame_server", None)
        if server is not None:
            server.shutdown("the window is closed")

    def _stored(self):
        return (self.highlight_box, self.fit_box, self.auto_box)

    def save_settings(self, plugin_settings, instance_settings):
        for box in self._stored():
            instance_settings.set_value(box.objectName() + "_state", box.isChecked())

    def restore_settings(self, plugin_settings, instance_settings):
        for box in self._stored():
            box.setChecked(instance_settings.value(box.objectName() + "_state", box.isChecked()) in (True, "true"))

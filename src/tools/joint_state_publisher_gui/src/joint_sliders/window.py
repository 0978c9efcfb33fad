"""The window, with sliders that take fractions and an end at every signal.

Since Python 3.10 PyQt refuses floats for sliders; and Qt's loop lets Python see no signal until the window has something to do.
"""

from __future__ import annotations

import sys
import threading

import joint_state_publisher
import joint_state_publisher_gui
import node_signals
import rospy
from python_qt_binding.QtCore import QTimer
from python_qt_binding.QtWidgets import QApplication

_LOOK = 100  # ms between looks whether the node has been shut down


class Slider(joint_state_publisher_gui.QSlider):
    """A slider that rounds what it is set to."""

    def setValue(self, value):
        super().setValue(round(value))


def main() -> int:
    node_signals.init_node("joint_state_publisher_gui")
    joint_state_publisher_gui.QSlider = Slider
    app = QApplication(sys.argv)
    app.setApplicationDisplayName("Joint State Publisher")
    rows = joint_state_publisher.get_param("num_rows", 0)
    states = joint_state_publisher.JointStatePublisher()
    window = joint_state_publisher_gui.JointStatePublisherGui(f"Node: {rospy.get_name()}", states, rows)
    window.show()
    window.sliderUpdateTrigger.emit()
    threading.Thread(target=states.loop, daemon=True).start()
    look = QTimer()
    look.timeout.connect(lambda: app.quit() if rospy.is_shutdown() else None)
    look.start(_LOOK)
    return app.exec_()

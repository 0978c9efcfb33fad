"""Shows the last text on a topic."""

import rospy
from python_qt_binding.QtCore import Signal
from python_qt_binding.QtWidgets import QLabel, QLineEdit, QVBoxLayout, QWidget
from rqt_gui_py.plugin import Plugin
from std_msgs.msg import String


class MyPlugin(Plugin):
    """One widget, one subscriber, one setting."""

    _received = Signal(str)  # callbacks of rospy run in threads of their own; widgets may be touched in this one only

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("MyPlugin")
        self._subscriber = None
        self._widget = QWidget()
        self._widget.setObjectName("MyPluginUi")
        number = context.serial_number()
        self._widget.setWindowTitle("My Plugin" + (f" ({number})" if number > 1 else ""))
        self.topic_edit, self.text_label = QLineEdit("/chatter"), QLabel("nothing received yet")
        self.topic_edit.setObjectName("topic_edit")
        self.text_label.setObjectName("text_label")
        layout = QVBoxLayout(self._widget)
        layout.addWidget(self.topic_edit)
        layout.addWidget(self.text_label)
        self._received.connect(self.text_label.setText)
        self.topic_edit.editingFinished.connect(self._subscribe)
        context.add_widget(self._widget)
        self._subscribe()

    def _subscribe(self):
        self.shutdown_plugin()
        self._subscriber = rospy.Subscriber(self.topic_edit.text(), String, lambda message: self._received.emit(message.data))

    def shutdown_plugin(self):
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None

    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("topic", self.topic_edit.text())

    def restore_settings(self, plugin_settings, instance_settings):
        self.topic_edit.setText(instance_settings.value("topic", self.topic_edit.text()))
        self._subscribe()

"""The plugin: velocities from sliders and keys."""

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from python_qt_binding.QtCore import QTimer
from rqt_gui_py.plugin import Plugin

from .steering_widget import SteeringWidget

PERIOD = 100  # ms


class RobotSteering(Plugin):
    """Publishes ten times a second; a velocity of zero once only, so that it does not fight others who drive, but at each Stop."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RobotSteering")
        self._publisher, self._zero_sent = None, False
        self._widget = SteeringWidget()
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        self._widget.topic_changed.connect(self.set_topic)
        self._widget.stopped.connect(self._stop)
        context.add_widget(self._widget)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.publish)
        self._timer.start(PERIOD)
        self.set_topic(self._widget.topic_line_edit.text())

    @property
    def widget(self) -> SteeringWidget:
        return self._widget

    def set_topic(self, topic: str) -> None:
        """A name that cannot be one is marked, and nothing is published.

        The same name keeps its publisher: Enter and the loss of the focus both end an edit, and a second publisher would
        break the connection that a robot is just making to the first.
        """
        legal = bool(topic) and rosgraph.names.is_legal_name(topic)
        self._widget.mark_topic(legal)
        if legal and self._publisher is not None and self._publisher.resolved_name == rospy.resolve_name(topic):
            return
        self._unregister()
        if legal:
            self._publisher = rospy.Publisher(topic, Twist, queue_size=10)

    def _stop(self) -> None:
        """Also where the sliders stand at zero: another node may have left the robot driving."""
        self._zero_sent = False
        self.publish()

    def publish(self) -> None:
        twist = Twist()
        twist.linear.x, twist.angular.z = self._widget.velocities()
        zero = twist.linear.x == 0 and twist.angular.z == 0
        if self._publisher is None or zero and self._zero_sent:
            return
        try:
            self._publisher.publish(twist)
            self._zero_sent = zero
        except rospy.ROSException:  # the node is being shut down
            pass

    def _unregister(self) -> None:
        if self._publisher is not None:
            self._publisher.unregister()
            self._publisher = None

    def shutdown_plugin(self):
        self._timer.stop()
        if self._publisher is not None and not self._zero_sent:
            self._widget.stop()  # a closed window must not leave a robot driving
        self._unregister()

    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("topic", self._widget.topic_line_edit.text())
        for name, box in self._widget.limits.items():
            instance_settings.set_value(name, box.value())

    def restore_settings(self, plugin_settings, instance_settings):
        topic = rospy.get_param("~default_topic", instance_settings.value("topic", "/cmd_vel"))
        self._widget.topic_line_edit.setText(str(topic))
        for name, box in self._widget.limits.items():
            value = rospy.get_param(f"~default_{name}", instance_settings.value(name, box.value()))
            try:
                box.setValue(float(value))
            except (TypeError, ValueError):
                rospy.logwarn(
                    "%s is %r, but must be a number; it is left at %g", rospy.resolve_name(f"~default_{name}"), value, box.value()
                )
        self.set_topic(self._widget.topic_line_edit.text())

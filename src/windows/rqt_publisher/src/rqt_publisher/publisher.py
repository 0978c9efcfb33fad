"""The plugin: publishers with a rate each, whose fields are expressions."""

import ast
import math

import rospy
from python_qt_binding.QtCore import QObject, Qt, QTimer
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.installed_types import installed_types
from rqt_py_common.message_template import Field, TemplateError

from .publisher_widget import PublisherWidget

HIGHEST_RATE = 1000.0  # Hz


class PublisherEntry(QObject):
    """One topic that is published, or could be.

    :ivar error: what hinders the message, or None
    """

    def __init__(self, topic: str, type_name: str, rate: float, report, parent=None):
        """:param report: is called with this entry after each attempt to publish
        :raises TemplateError: if there is no such type
        :raises ValueError: if there can be no such topic
        """
        super().__init__(parent)
        self.topic, self.type_name, self.rate, self.enabled = topic, type_name, rate, False
        self.template = Field("", type_name)
        if self.template.expression is not None or self.template.is_array:
            raise TemplateError("", f"{type_name} is no message type")
        self.error: TemplateError | None = None
        self.counter = 0
        self._report = report
        self._publisher = rospy.Publisher(topic, self.template.message_class, queue_size=100)
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.publish)

    def set_enabled(self, enabled: bool) -> None:
        self.enabled = enabled
        self.set_rate(self.rate)

    def set_rate(self, rate: float) -> None:
        """Hz; 0 publishes by hand only."""
        self.rate = rate
        if self.enabled and rate > 0:
            self._timer.start(max(1, round(1000 / rate)))
        else:
            self._timer.stop()

    def publish(self) -> None:
        """Evaluate the expressions and publish; with one that has no value nothing is published."""
        try:
            message = self.template.value(self.counter + 1)  # i is 1 in the first message, as in Noetic
        except TemplateError as error:
            self.error = error
        else:
            self.error = None
            self.counter += 1
            try:
                self._publisher.publish(message)
            except rospy.ROSException as error:  # fields that cannot be sent, or the node is being shut down
                self.error = TemplateError("", str(error))
        self._report(self)

    def close(self) -> None:
        self._timer.stop()
        self._publisher.unregister()


class Publisher(Plugin):
    """The list of publishers; the widget shows them."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Publisher")
        self.entries: list[PublisherEntry] = []
        self._background = Background(self)
        self._widget = PublisherWidget()
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        self._widget.add_requested.connect(lambda topic, kind, rate: self.add_publisher(topic, kind, rate))
        self._widget.remove_requested.connect(self.remove_publisher)
        self._widget.clear_requested.connect(self.clear)
        self._widget.refresh_requested.connect(self.refresh)
        context.add_widget(self._widget)
        self.refresh()
        self._background.run("types", lambda: installed_types(".msg"), self._widget.set_types)

    @property
    def widget(self) -> PublisherWidget:
        return self._widget

    def refresh(self) -> None:
        """Ask for the topics anew."""
        self._background.run("topics", rospy.get_published_topics, self._widget.set_topics, lambda error: None)

    def add_publisher(self, topic: str, type_name: str, rate="1", state=None):
        """A new entry, not enabled; None with a line in the widget if there can be none.

        :param topic: relative names are resolved
        :param type_name: ``package/Name``
        :param rate: Hz, a number or what the user has typed
        :param state: expressions of its fields, as they were saved
        """
        try:
            value = parse_rate(rate)
            check_topic(topic)
            entry = PublisherEntry(rospy.resolve_name(topic), type_name, value, self._widget.show_result, self)
        except (ValueError, rospy.ROSException) as error:
            self._widget.show_error(str(error))
            return None
        entry.template.restore(state or {})
        self.entries.append(entry)
        self._widget.add_entry(entry)
        self._widget.show_error("")
        return entry

    def remove_publisher(self, entry: PublisherEntry) -> None:
        entry.close()
        self.entries.remove(entry)
        self._widget.remove_entry(entry)
        entry.deleteLater()

    def clear(self) -> None:
        for entry in list(self.entries):
            self.remove_publisher(entry)

    def shutdown_plugin(self) -> None:
        self._background.close()
        for entry in self.entries:
            entry.close()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        """As Noetic's rqt_publisher writes them, which reads them too: expressions by the whole path, topic included."""
        publishers = [
            {
                "topic_name": entry.topic,
                "type_name": entry.type_name,
                "rate": entry.rate,
                "enabled": False,
                "publisher_id": number,
                "counter": 0,
                "expressions": {f"{entry.topic}/{path}": expression for path, expression in entry.template.state().items()},
            }
            for number, entry in enumerate(self.entries)
        ]
        instance_settings.set_value("publishers", repr(publishers))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        """All publishers come back disabled: opening a window shall move nothing."""
        self.clear()
        try:
            publishers = ast.literal_eval(instance_settings.value("publishers", "[]") or "[]")
            for kept in publishers:
                topic, expressions = kept["topic_name"], kept.get("expressions") or {}
                state = {path.removeprefix(f"{topic}/"): expression for path, expression in expressions.items()}
                self.add_publisher(topic, kept["type_name"], kept.get("rate", 1), state)
        except (ValueError, SyntaxError, TypeError, KeyError, AttributeError):
            self._widget.show_error("the publishers of last time cannot be read; they are left out")


def parse_rate(rate) -> float:
    """:raises ValueError: unless it is a number from 0 to HIGHEST_RATE"""
    try:
        value = float(rate)
    except (TypeError, ValueError):
        value = math.nan
    if not 0 <= value <= HIGHEST_RATE:
        raise ValueError(f"the rate must be a number from 0 to {HIGHEST_RATE:g} Hz, not {rate}")
    return value


def check_topic(topic: str) -> None:
    """:raises ValueError: if no topic can have that name"""
    import rosgraph

    if not topic or not rosgraph.names.is_legal_name(topic):
        raise ValueError(f"{topic or 'an empty text'} is no name for a topic: letters, digits, _ and / only")

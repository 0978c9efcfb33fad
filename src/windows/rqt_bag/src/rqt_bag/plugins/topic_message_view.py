"""Base of views in a window of their own, with buttons that go from message to message."""

from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QToolBar
from qt_gui.application.compatibility import QAction

from rqt_bag.plugins.message_view import MessageView


class TopicMessageView(MessageView):
    """A view whose window begins with a tool bar: first, previous, next, last message of the topic.

    :param parent: widget with a layout, to which the view adds itself.
    """

    def __init__(self, timeline, parent, topic):
        super().__init__(timeline, topic)
        self._parent = parent
        self._stamp = None
        self._name = parent.objectName()
        self.toolbar = QToolBar()
        for icon, text, action in (
            ("go-first", "First", self.navigate_first),
            ("go-previous", "Previous", self.navigate_previous),
            ("go-next", "Next", self.navigate_next),
            ("go-last", "Last", self.navigate_last),
        ):
            made = QAction(QIcon.fromTheme(icon), text, self.toolbar)
            made.setToolTip(f"{text} message of {topic}")
            made.triggered.connect(lambda _checked=False, action=action: action())
            self.toolbar.addAction(made)
        parent.layout().addWidget(self.toolbar)

    @property
    def parent(self):
        return self._parent

    @property
    def stamp(self):
        """Stamp of the message shown."""
        return self._stamp

    def message_viewed(self, bag, msg_details):
        self._stamp = msg_details[2]

    def _go(self, entry):
        if entry is not None:
            self.timeline._timeline_frame.playhead = entry.time

    def navigate_first(self):
        self._go(next(iter(self.timeline.get_entries([self.topic], *self.timeline._timeline_frame.play_region)), None))

    def navigate_previous(self):
        self._go(self.timeline.neighbour(self.topic, -1))

    def navigate_next(self):
        self._go(self.timeline.neighbour(self.topic, 1))

    def navigate_last(self):
        self._go(self.timeline.get_entry(self.timeline._timeline_frame.play_region[1], self.topic)[1])

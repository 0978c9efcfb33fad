"""Base of what shows the message at the playhead."""

from python_qt_binding.QtCore import QObject

from rqt_bag.message_listener_thread import ListenerEvent


class MessageView(QObject):
    """Shows messages of one topic. Its methods are called in the GUI's thread.

    :param timeline: the BagTimeline.
    """

    name = "Untitled"

    def __init__(self, timeline, topic):
        super().__init__()
        self.timeline = timeline
        self.topic = topic

    def message_viewed(self, bag, msg_details):
        """The playhead is at another message, of ``bag``.

        :param msg_details: (topic, message, stamp)
        """

    def message_cleared(self):
        """No message is at the playhead."""

    def timeline_changed(self):
        """Messages were added."""

    def event(self, event):
        """Time lines of other packages tell of messages by an event of their own thread."""
        if not isinstance(event, ListenerEvent):
            return super().event(event)
        bag, details = event.data
        if details:
            self.message_viewed(bag, details)
        else:
            self.message_cleared()
        return True

    def close(self):
        """Let go of what is held."""

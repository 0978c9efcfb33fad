"""For time lines of other packages: tells a view of messages that a thread has loaded."""

import threading

from python_qt_binding.QtCore import QCoreApplication, QEvent


class ListenerEvent(QEvent):
    """``data`` is (bag, (topic, message, stamp)), the second None when there is no message."""

    def __init__(self, data):
        super().__init__(QEvent.Type.User)
        self.data = data


class MessageListenerThread(threading.Thread):
    """Posts a ListenerEvent to ``listener`` for each new value of ``timeline._messages[topic]``, which the time line
    sets and notifies of under ``timeline._messages_cvs[topic]``. It runs from the beginning, until :meth:`stop`."""

    def __init__(self, timeline, topic, listener):
        super().__init__(daemon=True)
        self.timeline, self.topic, self.listener = timeline, topic, listener
        self.bag_msg_data = None
        self._stopped = False
        self.start()

    def run(self):
        condition, messages = self.timeline._messages_cvs[self.topic], self.timeline._messages
        while True:
            with condition:
                seen = self.bag_msg_data
                condition.wait_for(lambda: self._stopped or messages.get(self.topic, seen) != seen)
                if self._stopped:
                    return
                self.bag_msg_data = messages[self.topic]
            try:
                QCoreApplication.postEvent(self.listener, ListenerEvent(self.bag_msg_data))
            except RuntimeError:
                return  # the view is gone

    def stop(self):
        condition = self.timeline._messages_cvs[self.topic]
        with condition:
            self._stopped = True
            condition.notify_all()

"""A publisher for control loops."""

from __future__ import annotations

from typing import Any

import rospy

from .prompt import make_prompt


class RealtimePublisher:
    """Serialises and sends at once; ``publish`` costs the loop some ten microseconds and never waits for a subscriber.

    A thread of its own would cost the loop more: in Python the two would take turns. Without subscribers nothing is
    serialised at all.

    :param nh: NodeHandle (anything with ``publisher(name, type, queue_size)``).
    :param topic: name relative to ``nh``.
    :param queue_size: per subscriber that has fallen behind.
    :param message_type: class of the messages.
    """

    def __init__(self, nh: Any, topic: str, message_type: type, queue_size: int = 4):
        self._publisher = make_prompt(nh.publisher(topic, message_type, queue_size=queue_size), queue_size)

    @property
    def has_subscribers(self) -> bool:
        return bool(self._publisher.impl and self._publisher.impl.connections)

    def publish(self, message: Any) -> None:
        """Send ``message``, which may be filled anew afterwards."""
        if not self.has_subscribers:
            return
        try:
            self._publisher.publish(message)
        except rospy.ROSException:  # unregistered or shut down meanwhile: nobody is left to tell
            rospy.logdebug("publisher of %s is gone", self._publisher.name)
        except Exception as error:  # a wrong field type must not abort the controller
            rospy.logerr_throttle(5.0, f"message on {self._publisher.name} cannot be published: {error}")

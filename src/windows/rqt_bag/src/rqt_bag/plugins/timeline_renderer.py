"""Base of what draws the messages of a topic on the time line."""

from python_qt_binding.QtCore import QObject


class TimelineRenderer(QObject):
    """Draws stretches of the time line.

    :param timeline: the TimelineFrame; its ``scene()`` is the BagTimeline. :param msg_combine_px: messages that are closer than
        this many pixels make one stretch.
    """

    def __init__(self, timeline, msg_combine_px=1.5):
        super().__init__()
        self.timeline = timeline
        self.msg_combine_px = msg_combine_px

    def get_segment_height(self, topic):
        """Height of the topic's row in pixels; None for the usual one."""
        return None

    def draw_timeline_segment(self, painter, topic, stamp_start, stamp_end, x, y, width, height):
        """Draw the messages of ``topic`` from ``stamp_start`` to ``stamp_end`` (s) with ``painter``.

        :param x, y, width, height: the rectangle for it, pixels
        :returns: whether it was done.
        """
        return False

    def close(self):
        """Let go of what is held."""

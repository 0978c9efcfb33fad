"""Bag files on a time line: the plugin rqt_bag of rqt, and the bases of plugins for it."""

from rqt_bag import bag_helper
from rqt_bag.plugins.message_view import MessageView
from rqt_bag.plugins.timeline_renderer import TimelineRenderer
from rqt_bag.plugins.topic_message_view import TopicMessageView
from rqt_bag.timeline_cache import TimelineCache

__all__ = ["MessageView", "TimelineCache", "TimelineRenderer", "TopicMessageView", "bag_helper"]

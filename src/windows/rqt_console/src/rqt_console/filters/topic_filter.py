"""...from topic."""

from .list_filter import ListFilter


class TopicFilter(ListFilter):
    @staticmethod
    def values_of(message):
        return message.topics

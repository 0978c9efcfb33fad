"""...from node."""

from .list_filter import ListFilter


class NodeFilter(ListFilter):
    @staticmethod
    def values_of(message):
        return (message.node,)

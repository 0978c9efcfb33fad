"""...with severities."""

from .list_filter import ListFilter


class SeverityFilter(ListFilter):
    @staticmethod
    def values_of(message):
        return (message.severity,)

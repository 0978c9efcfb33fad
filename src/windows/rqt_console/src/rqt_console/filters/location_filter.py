"""...from location."""

from .text_filter import TextFilter


class LocationFilter(TextFilter):
    @staticmethod
    def text_of(message) -> str:
        return message.location

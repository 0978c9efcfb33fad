"""...containing."""

from .text_filter import TextFilter


class MessageFilter(TextFilter):
    @staticmethod
    def text_of(message) -> str:
        return message.message

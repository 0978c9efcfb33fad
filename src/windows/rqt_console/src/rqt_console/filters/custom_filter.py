"""Custom: several conditions at once."""

from .base_filter import BaseFilter
from .message_filter import MessageFilter
from .node_filter import NodeFilter
from .severity_filter import SeverityFilter
from .topic_filter import TopicFilter


class CustomFilter(BaseFilter):
    """All of text, severity, node and topic, as far as they are given."""

    def __init__(self):
        super().__init__()
        self.parts = {"message": MessageFilter(), "severity": SeverityFilter(), "node": NodeFilter(), "topic": TopicFilter()}
        for part in self.parts.values():
            part.filter_changed_signal.connect(self.filter_changed_signal)

    def has_filter(self) -> bool:
        return any(part.has_filter() for part in self.parts.values())

    def test_message(self, message) -> bool:
        given = [part for part in self.parts.values() if part.has_filter()]
        return self._enabled and bool(given) and all(part.test_message(message) for part in given)

    def state(self) -> dict:
        return {name: part.state() for name, part in self.parts.items()}

    def restore(self, state: dict) -> None:
        for name, part in self.parts.items():
            part.restore(state.get(name, {}))

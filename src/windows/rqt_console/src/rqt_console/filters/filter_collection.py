"""A list of conditions of which one is enough."""

from python_qt_binding.QtCore import QObject, Signal


class FilterCollection(QObject):
    """Matches a message if any of its filters does."""

    changed = Signal()

    def __init__(self):
        super().__init__()
        self.filters = []

    def append(self, filter_) -> None:
        self.filters.append(filter_)
        filter_.filter_changed_signal.connect(self.changed)
        self.changed.emit()

    def remove(self, filter_) -> None:
        self.filters.remove(filter_)
        filter_.filter_changed_signal.disconnect(self.changed)
        self.changed.emit()

    def active(self) -> bool:
        """Whether there is any condition in force."""
        return any(filter_.is_enabled() and filter_.has_filter() for filter_ in self.filters)

    def test_message(self, message) -> bool:
        return any(filter_.test_message(message) for filter_ in self.filters)

    def count_enabled_filters(self) -> int:
        return sum(filter_.is_enabled() for filter_ in self.filters)

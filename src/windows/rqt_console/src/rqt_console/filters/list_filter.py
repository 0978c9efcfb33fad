"""Conditions that are a choice among values."""

from .base_filter import BaseFilter


class ListFilter(BaseFilter):
    """The message has one of the chosen values."""

    @staticmethod
    def values_of(message):
        raise NotImplementedError

    def __init__(self):
        super().__init__()
        self._selected = []

    def selected_items(self) -> list:
        return list(self._selected)

    def set_selected_items(self, items) -> None:
        self._selected = list(items)
        self.filter_changed_signal.emit()

    def has_filter(self) -> bool:
        return bool(self._selected)

    def test_message(self, message) -> bool:
        return self._enabled and any(value in self._selected for value in self.values_of(message))

    def state(self) -> dict:
        return {"selected": list(self._selected)}

    def restore(self, state: dict) -> None:
        self.set_selected_items(state.get("selected", []))

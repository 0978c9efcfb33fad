"""What all conditions share."""

from python_qt_binding.QtCore import QObject, Signal


class BaseFilter(QObject):
    """A condition on a message. ``filter_changed_signal`` tells that it is another one now."""

    filter_changed_signal = Signal()

    def __init__(self):
        super().__init__()
        self._enabled = True

    def is_enabled(self) -> bool:
        return self._enabled

    def set_enabled(self, checked: bool) -> None:
        self._enabled = bool(checked)
        self.filter_changed_signal.emit()

    def has_filter(self) -> bool:
        """Whether there is anything to compare with; an empty text, say, is no condition."""
        raise NotImplementedError

    def test_message(self, message) -> bool:
        raise NotImplementedError

    def state(self) -> dict:
        """What :meth:`restore` takes: texts, numbers, booleans and lists of them."""
        raise NotImplementedError

    def restore(self, state: dict) -> None:
        raise NotImplementedError

"""...from time range."""

from .base_filter import BaseFilter


class TimeFilter(BaseFilter):
    """The stamp lies between two times, in s; without an end, after the first."""

    def __init__(self):
        super().__init__()
        self._start, self._stop, self._stop_enabled = 0.0, 0.0, True

    def set_start_time(self, seconds: float) -> None:
        self._start = seconds
        self.filter_changed_signal.emit()

    def set_stop_time(self, seconds: float) -> None:
        self._stop = seconds
        self.filter_changed_signal.emit()

    def set_stop_time_enabled(self, checked: bool) -> None:
        self._stop_enabled = bool(checked)
        self.filter_changed_signal.emit()

    def has_filter(self) -> bool:
        return True

    def test_message(self, message) -> bool:
        stamp = message.stamp[0] + message.stamp[1] * 1e-9
        return self._enabled and self._start <= stamp and not (self._stop_enabled and stamp > self._stop)

    def state(self) -> dict:
        return {"start": self._start, "stop": self._stop, "stop_enabled": self._stop_enabled}

    def restore(self, state: dict) -> None:
        self._start, self._stop = float(state.get("start", 0)), float(state.get("stop", 0))
        self._stop_enabled = bool(state.get("stop_enabled", True))
        self.filter_changed_signal.emit()

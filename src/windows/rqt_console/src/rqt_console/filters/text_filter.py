"""Conditions on a text of a message."""

import re

from .base_filter import BaseFilter


class TextFilter(BaseFilter):
    """The text occurs, or a regular expression is found, anywhere; case counts. One that is wrong finds nothing."""

    @staticmethod
    def text_of(message) -> str:
        raise NotImplementedError

    def __init__(self):
        super().__init__()
        self._text, self._regex, self._compiled = "", False, None
        self.error = ""  # what is wrong with the regular expression

    def set_text(self, text: str) -> None:
        self._text = text
        self._compile()

    def set_regex(self, checked: bool) -> None:
        self._regex = bool(checked)
        self._compile()

    def has_filter(self) -> bool:
        return self._text != ""

    def test_message(self, message) -> bool:
        if not self._enabled or not self._text:
            return False
        text = self.text_of(message)
        if self._regex:
            return self._compiled is not None and self._compiled.search(text) is not None
        return self._text in text

    def state(self) -> dict:
        return {"text": self._text, "regex": self._regex}

    def restore(self, state: dict) -> None:
        self._text, self._regex = str(state.get("text", "")), bool(state.get("regex"))
        self._compile()

    def _compile(self) -> None:
        self._compiled, self.error = None, ""
        if self._regex:
            try:
                self._compiled = re.compile(self._text)
            except (re.error, RecursionError, OverflowError) as error:
                self.error = f"not a regular expression: {error}"
        self.filter_changed_signal.emit()

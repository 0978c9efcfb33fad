"""A message whose fields are expressions. Knows no Qt."""

import re
from typing import Any

from genmsg.msgs import is_valid_constant_type, parse_type
from qt_gui.errors import WindowError

from .expressions import ExpressionError, field_value
from .topic_helpers import get_type_class

_MOST = 1000  # elements of an array of messages
_DEFAULTS = {"string": "''", "bool": "False", "float32": "0.0", "float64": "0.0", "time": "genpy.Time()", "duration": "genpy.Duration()"}


class TemplateError(WindowError, ValueError):
    """A field without a value; ``path`` says which."""

    def __init__(self, path: str, text: str):
        super().__init__(f"{path}: {text}" if path else text)
        self.path, self.text = path, text


class Field:
    """A field: a leaf with an expression, or a message or array of messages with fields of its own.

    ``path`` is ``pose/position/x`` or ``points[1]/x``; ``type_name`` as in the definition, an array with its present size.
    """

    def __init__(self, name: str, type_name: str, path: str = ""):
        """:raises TemplateError: if the type cannot be imported"""
        self.name, self.type_name, self.path = name, type_name, path
        self.expression: str | None = None
        self.children: list[Field] = []
        try:
            base, self.is_array, length = parse_type(type_name)
        except Exception as error:  # genmsg has no class for brackets that do not close
            raise TemplateError(path, f"{type_name or 'an empty text'} is no message type") from error
        self.base, self.fixed_length = base, length
        if is_valid_constant_type(base) or base in ("time", "duration"):
            default = _DEFAULTS.get(base, "0")
            self.expression = default if not self.is_array else "[" + ", ".join([default] * (length or 0)) + "]"
            return
        self.message_class = get_type_class(base)
        if self.message_class is None:
            raise TemplateError(path, f"cannot import the message type {base}; is its package built and sourced?")
        if self.is_array:
            self.resize(length or 0)
        else:
            self._add_slots()

    @property
    def resizable(self) -> bool:
        """Whether it is an array of messages of any length."""
        return self.is_array and self.expression is None and self.fixed_length is None

    def resize(self, size: int) -> None:
        """Set the number of messages in an array of them; those that stay keep their expressions.

        :raises TemplateError: for sizes out of range
        """
        if not 0 <= size <= _MOST:
            raise TemplateError(self.path, f"an array has 0 to {_MOST} elements here, not {size}")
        del self.children[size:]
        for index in range(len(self.children), size):
            self.children.append(Field(f"[{index}]", self.base, f"{self.path}[{index}]"))

    def shown_type(self) -> str:
        return f"{self.base}[{len(self.children)}]" if self.resizable else self.type_name

    def _add_slots(self) -> None:
        for name, kind in zip(self.message_class.__slots__, self.message_class._slot_types):
            self.children.append(Field(name, kind, f"{self.path}/{name}" if self.path else name))

    def value(self, counter: int = 0) -> Any:
        """:param counter: what ``i`` stands for
        :raises TemplateError: if a field has no value
        """
        if self.expression is not None:
            try:
                return field_value(self.expression, self.type_name, counter)
            except ExpressionError as error:
                raise TemplateError(self.path, f"{error} (wanted: {self.type_name})") from error
        if self.is_array:
            return [child.value(counter) for child in self.children]
        message = self.message_class()
        for child in self.children:
            setattr(message, child.name, child.value(counter))
        return message

    def walk(self):
        """This field and all within."""
        yield self
        for child in self.children:
            yield from child.walk()

    def state(self) -> dict[str, str]:
        """Path to expression, and to size for arrays that were given one."""
        return {
            field.path: str(len(field.children)) if field.resizable else field.expression
            for field in self.walk()
            if field.expression is not None or field.resizable and field.children
        }

    def restore(self, state: dict[str, str]) -> None:
        """What fits; the rest stays as it is."""
        if self.resizable and re.fullmatch(r"\d{1,4}", str(state.get(self.path, ""))):
            self.resize(min(int(state[self.path]), _MOST))
        elif self.expression is not None and self.path in state:
            self.expression = str(state[self.path])
        for child in self.children:
            child.restore(state)

"""Reading the YAML of a plan: only what a plan can need, of a size that a person writes."""

from __future__ import annotations

from typing import Any

import yaml
from ode_sim.errors import DescriptionError, one_line

MOST_BYTES = 1_000_000
_DEEPEST = 20
_MOST_KEYS = 1000  # of a mapping; mappings that merge each other twice grow without end


class PlanError(DescriptionError):
    """The plan cannot be built. One line that names the entry."""


class _Loader(yaml.SafeLoader):
    _depth = 0

    def compose_node(self, parent, index):
        self._depth += 1
        if self._depth > _DEEPEST:
            raise yaml.MarkedYAMLError(
                problem=f"it nests more than {_DEEPEST} lists and mappings", problem_mark=self.peek_event().start_mark
            )
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def flatten_mapping(self, node):
        super().flatten_mapping(node)
        if len(node.value) > _MOST_KEYS:
            raise yaml.MarkedYAMLError(problem=f"a mapping of more than {_MOST_KEYS} entries", problem_mark=node.start_mark)


def load_plan(path: str) -> Any:
    """What the YAML file ``path`` holds.

    :raises ValueError: one line: unreadable, too long, no YAML, or nested deeper than any plan.
    """
    try:
        with open(path, "rb") as stream:
            text = stream.read(MOST_BYTES + 1)
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}") from None
    if len(text) > MOST_BYTES:
        raise ValueError(f"{path}: is longer than {MOST_BYTES // 1000} kB; no plan is")
    try:
        return yaml.load(text, _Loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f":{mark.line + 1}" if mark else ""
        raise ValueError(f"{path}{line}: is no YAML, {one_line(getattr(error, 'problem', None) or error, 200)}") from None
    except (ValueError, TypeError, ArithmeticError, LookupError, AttributeError, RecursionError) as error:
        # a date of month 13, a number of 5000 digits, a mapping that merges itself
        raise ValueError(f"{path}: holds a value that is none, {one_line(error, 200)}") from None

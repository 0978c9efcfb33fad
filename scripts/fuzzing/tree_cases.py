"""YAML and JSON from YAML and JSON: values changed, dropped, doubled, replaced by others of the same document."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from random import Random
from typing import Any

from fuzzing import values

Path_ = tuple[Any, ...]


def places(tree: Any, path: Path_ = ()) -> Iterator[Path_]:
    """The way to every value below the root, parents first."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in entries:
        yield (*path, key)
        yield from places(value, (*path, key))


def value_at(tree: Any, path: Path_) -> Any:
    for key in path:
        tree = tree[key]
    return tree


def changed(random: Random, tree: Any, times: int, odd: Callable[[Random], Any]) -> Any:
    """A changed copy. :param odd: makes a value to put anywhere."""
    tree = copy.deepcopy(tree)
    for _ in range(times):
        ways = list(places(tree))
        if not ways:
            return odd(random)
        path = random.choice(ways)
        parent, key, value = value_at(tree, path[:-1]), path[-1], value_at(tree, path)
        change = random.random()
        if change < 0.45 and isinstance(value, (int, float)) and not isinstance(value, bool):
            parent[key] = any_number(random)
        elif change < 0.55:
            parent[key] = odd(random)
        elif change < 0.7:
            del parent[key]
        elif change < 0.8:
            parent[key] = copy.deepcopy(value_at(tree, random.choice(ways)))
        elif change < 0.9 and isinstance(parent, list):
            parent[key:key] = [copy.deepcopy(value)] * random.choice((1, 1, 2, 20))
        elif change < 0.9:
            parent[random.choice(("x", 0, True, None, "", *[way[-1] for way in ways]))] = copy.deepcopy(value)
        elif isinstance(value, str):
            parent[key] = random.choice(values.NAMES + values.ODDITIES)
        else:
            parent[key] = [value] if random.random() < 0.5 else {"x": value}
    return tree


def any_number(random: Random) -> Any:
    """A float or an int of any size."""
    chance = random.random()
    if chance < 0.15:
        return random.choice((0, 1, -1, 2, 7, 255, 10**6, 2**31, -(2**31), 2**32, 2**63, -(2**63), 2**64, 10**400, -(10**400)))
    return values.number(random, 0.5)


def odd_value(random: Random) -> Any:
    """Of any type that YAML has."""
    return random.choice(
        (
            None,
            True,
            False,
            "",
            [],
            {},
            [[]],
            {"": None},
            "nan",
            ".inf",
            "1e400",
            [None, "a"],
            [[1, 2], [3, 4]],
            any_number(random),
            [any_number(random)] * 3,
            {"p": any_number(random)},
            random.choice(values.NAMES),
            random.choice(values.ODDITIES),
        )
    )


def smaller(tree: Any) -> Iterator[Any]:
    """Copies without one value each, the upper ones first, then with values made plain. The tree itself is not changed."""
    for path in sorted(places(tree), key=len):
        copied = copy.deepcopy(tree)
        del value_at(copied, path[:-1])[path[-1]]
        yield copied
    for path in list(places(tree)):
        value = value_at(tree, path)
        for plain in (0, "a"):
            if type(value) is type(plain) and value != plain or isinstance(value, float) and plain == 0 and value != 0.0:
                copied = copy.deepcopy(tree)
                value_at(copied, path[:-1])[path[-1]] = type(value)(plain)
                yield copied


def runs(items: list[Any]) -> Iterator[list[Any]]:
    """The list without runs of its items, the long runs first."""
    size = len(items) // 2
    while size >= 1:
        for start in range(0, len(items), size):
            yield items[:start] + items[start + size :]
        size //= 2

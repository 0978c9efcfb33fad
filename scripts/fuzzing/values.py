"""What is put in the place of a number, a name or a text."""

from __future__ import annotations

import re
from collections.abc import Sequence
from random import Random

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")

_MOST_WORDS = 1000
EXTREMES = """0 -0.0 1 -1 2 0.5 3.141592653589793 1000 1000000 1e-3 1e-6 1e-9 1e-12 1e-300 5e-324 1e3 1e6 1e7 -1e7 2e8 1e9 -1e9 1e12
1e15 1e20 1e38 1e39 1e100 1e150 1e155 1e200 1e300 -1e300 1e308 -1e308 1e400 -1e400 nan -nan inf -inf 127 128 255 256 32768 65536
2147483647 2147483648 -2147483649 4294967295 4294967296 9223372036854775807 9223372036854775808 18446744073709551616""".split()
EXTREMES.append("9" * 400)
ODDITIES = [
    "",
    " ",
    "1 2 3",
    "$(arg x)",
    "1 " * 50,
    "a" * 200,
    "0,1 0,2 0,3",
    "1.000,5",
    ",5",
    *"true false x 0x10 1,5 1e --1 1_000 \u0663 \u221e None ${1/0} %s".split(),
    *"\u00e4 world __default__ :: a::b / .. ~".split(),
]
NAMES = ["", " ", "a" * 200, *"world __model__ base_link link a::b :: /abs ../up \u00fc 0 nan %n%s __root__ default".split()]
URIS = [
    "",
    *"""model:// model://sun model://ground_plane model://no_such model://../../etc model://coke_can model://unit_box/model.sdf
model://table_marble/meshes/table_lightmap.dae file:///etc/passwd file:///dev/zero package://arm_description/meshes/base_link.stl
package://../x /dev/null /proc/self/mem http://example.org/x.dae . / \u00e4.stl""".split(),
]
NUMBERS: list[float] = [float(text) for text in EXTREMES if len(text) < 100]


def number_text(random: Random) -> str:
    """Mostly a number, ordinary or extreme."""
    chance = random.random()
    if chance < 0.55:
        return random.choice(EXTREMES)
    if chance < 0.9:
        return repr(round(random.gauss(0.0, 1.0) * 10.0 ** random.randint(-3, 3), 4))
    return random.choice(ODDITIES)


def number(random: Random, extreme: float = 0.4) -> float:
    """:param extreme: the share of extreme ones among the ordinary."""
    if random.random() < extreme:
        return random.choice(NUMBERS)
    return random.gauss(0.0, 1.0) * 10.0 ** random.randint(-2, 2)


def with_numbers_changed(random: Random, text: str) -> str:
    """One number of the text replaced; where there is none, the whole text."""
    found = list(NUMBER.finditer(text))
    if not found or random.random() < 0.05:
        return number_text(random)
    chosen = random.choice(found)
    return text[: chosen.start()] + number_text(random) + text[chosen.end() :]


def with_tokens_changed(random: Random, text: str) -> str:
    """Words dropped, doubled or swapped."""
    words = text.split()
    if not words or len(words) > _MOST_WORDS:
        return number_text(random)
    i, j = random.randrange(len(words)), random.randrange(len(words))
    change = random.randrange(4)
    if change == 0:
        del words[i]
    elif change == 1:
        words.insert(j, words[i])
    elif change == 2:
        words[i], words[j] = words[j], words[i]
    else:
        words = words * random.choice((2, 10))
    return " ".join(words)


def damaged(random: Random, data: bytes, times: int = 1) -> bytes:
    """Bytes flipped, cut out, doubled, inserted."""
    result = bytearray(data)
    for _ in range(times):
        if not result:
            return bytes(random.randrange(256) for _ in range(20))
        i = random.randrange(len(result))
        n = min(len(result) - i, random.choice((1, 1, 2, 4, 16, 100, 2000)))
        change = random.randrange(6)
        if change == 0:
            result[i] ^= 1 << random.randrange(8)
        elif change == 1:
            del result[i : i + n]
        elif change == 2:
            result[i:i] = result[i : i + n]
        elif change == 3:
            result[i:i] = bytes(random.randrange(256) for _ in range(min(n, 16)))
        elif change == 4:
            result[i : i + n] = random.choice((b"\x00", b"\xff", b"\x7f")) * n
        else:
            del result[i:]
    return bytes(result)


def chosen(random: Random, items: Sequence, most: int) -> list:
    """At most ``most`` of the items, in their order."""
    if len(items) <= most:
        return list(items)
    return [items[i] for i in sorted(random.sample(range(len(items)), most))]

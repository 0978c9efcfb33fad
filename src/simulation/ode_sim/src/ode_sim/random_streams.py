"""Random numbers of a world: streams by name."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

import numpy as np


class RandomStreams:
    """Generators by name; what one gives depends on the seed and its name alone, not on who draws from the others."""

    def __init__(self, seed: int) -> None:
        self.seed = int(seed)
        self._streams: dict[str, np.random.Generator] = {}

    def stream(self, name: str) -> np.random.Generator:
        """The generator called ``name``, where it has got to."""
        if name not in self._streams:
            digest = hashlib.sha256(f"{self.seed}/{name}".encode()).digest()
            self._streams[name] = np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "little")))
        return self._streams[name]

    def restart(self) -> None:
        """All streams from their beginnings."""
        self._streams.clear()

    def state(self) -> dict[str, Any]:
        """What :meth:`read` makes the same streams of; fit for JSON."""
        states = [(name, generator.bit_generator.state) for name, generator in sorted(self._streams.items())]
        return {"seed": self.seed, "streams": states}

    @classmethod
    def read(cls, state: Mapping[str, Any]) -> RandomStreams:
        """The streams that :meth:`state` gave ``state`` of. :raises ValueError, TypeError, KeyError: it is damaged"""
        read = cls(state["seed"])
        for name, of_stream in state["streams"]:
            read._streams[name] = np.random.Generator(np.random.PCG64())
            read._streams[name].bit_generator.state = of_stream
        return read

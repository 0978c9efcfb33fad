"""Cases made smaller as long as they find the same."""

from __future__ import annotations

import time

from fuzzing.findings import Finding
from fuzzing.kinds import Kind
from fuzzing.pool import Pool


def minimised(kind: Kind, pool: Pool, case: bytes, finding: Finding, seconds: float = 60.0) -> bytes:
    """Greedy: the first simpler case that finds the same is taken and made simpler itself.

    :param seconds: of wall time to spend at most.
    """
    deadline = time.monotonic() + seconds
    tried = {case}
    improved = True
    while improved and time.monotonic() < deadline:
        improved = False
        for candidate in kind.smaller(case):
            if time.monotonic() > deadline:
                break
            if candidate in tried or len(candidate) > len(case):
                continue
            tried.add(candidate)
            if _same(pool.one(candidate), finding):
                case, improved = candidate, True
                break
    return case


def _same(found: Finding | None, wanted: Finding) -> bool:
    return found is not None and found.key == wanted.key

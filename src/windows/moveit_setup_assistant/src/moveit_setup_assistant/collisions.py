"""Which pairs of links need no collision check (moveit.md of MoveIt's assistant: adjacent, default, always, never)."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import motion

Pair = tuple[str, str]
ADJACENT, DEFAULT, ALWAYS, NEVER, USER = "Adjacent", "Default", "Always", "Never", "User"
ROUND = 200  # states in each round of the search for pairs that always collide


def pair(one: str, other: str) -> Pair:
    """The two names, ``one`` and ``other``, in alphabetical order, as the matrix keeps them."""
    return (one, other) if one < other else (other, one)


def adjacent_pairs(model: motion.RobotModel) -> set[Pair]:
    """Links joined by one joint; a link without geometry makes its neighbours adjacent to one another."""
    neighbours: dict[str, set[str]] = {name: set() for name in model.links}
    for name in model.links:
        parent = model.link(name).parent_link
        if parent:
            neighbours[name].add(parent)
            neighbours[parent].add(name)
    for name in [n for n in model.links if not model.link(n).has_geometry]:
        around = neighbours.pop(name)
        for one in around:
            neighbours[one].discard(name)
            neighbours[one] |= around - {one, name}
    return {pair(one, other) for one, others in neighbours.items() for other in others}


class Sampler:
    """Random states of a robot, each told which of the pairs still in question collide."""

    def __init__(self, model: motion.RobotModel, seed: int) -> None:
        self._scene = motion.PlanningScene(model)
        self._state = model.state()
        self._seed = seed
        self._acm = motion.AllowedCollisionMatrix.from_matrix([], [])
        self._limit = len(model.links) ** 2

    def allow(self, pairs) -> None:
        """Ask no more about these pairs."""
        for one, other in pairs:
            self._acm.set(one, other, True)

    def default(self) -> set[Pair]:
        """Pairs that collide in the robot's default state."""
        self._state.set_default()
        return self._collisions()

    def random(self) -> set[Pair]:
        """Pairs that collide in the next random state."""
        self._state.randomize(seed=self._seed)
        self._seed += 1
        return self._collisions()

    def _collisions(self) -> set[Pair]:
        found = self._scene.check(self._state, contacts=self._limit, per_pair=1, padded=False, acm=self._acm, world=False)
        return {pair(contact.body_1, contact.body_2) for contact in found.contacts}


def compute_disabled(
    model: motion.RobotModel,
    trials: int = 10000,
    always_fraction: float = 0.95,
    seed: int = 1,
    find_never: bool = True,
    progress: Callable[[float], bool] | None = None,
) -> dict[Pair, str]:
    """The pairs that need no check, each with the first reason that holds for it.

    :param model: the robot; groups and disabled collisions of its SRDF play no part.
    :param trials: random states that a pair must survive without contact to be "Never".
    :param always_fraction: of the states, those that must collide for "Always".
    :param seed: of the random states; the same seed gives the same result.
    :param find_never: whether to look for pairs that are "Never" in contact.
    :param progress: called with 0 to 1 now and then; a false return value other than None ends the search (``{}``).
    """
    geometry = [name for name in sorted(model.links) if model.link(name).has_geometry]
    reasons: dict[Pair, str] = {p: ADJACENT for p in sorted(adjacent_pairs(model))}
    sampler = Sampler(model, seed)
    sampler.allow(reasons)
    _add(reasons, sampler, sampler.default(), DEFAULT)
    while _always_round(reasons, sampler, always_fraction):
        pass
    if find_never:
        seen = _seen_in(sampler, trials, progress)
        if seen is None:
            return {}
        _add(reasons, sampler, set(combinations(geometry, 2)) - seen, NEVER)
    return reasons


def _add(reasons: dict[Pair, str], sampler: Sampler, pairs: set[Pair], reason: str) -> None:
    new = sorted(p for p in pairs if p not in reasons)
    reasons.update((p, reason) for p in new)
    sampler.allow(new)


def _always_round(reasons: dict[Pair, str], sampler: Sampler, fraction: float) -> bool:
    counts: dict[Pair, int] = {}
    for _ in range(ROUND):
        for p in sampler.random():
            counts[p] = counts.get(p, 0) + 1
    always = {p for p, count in counts.items() if count > int(ROUND * fraction)}
    _add(reasons, sampler, always, ALWAYS)
    return bool(always)


def _seen_in(sampler: Sampler, trials: int, progress) -> set[Pair] | None:
    """Every pair that collided at least once; asked no more from then on, so that the search grows faster."""
    seen: set[Pair] = set()
    for trial in range(trials):
        new = sampler.random() - seen
        if new:
            seen |= new
            sampler.allow(new)
        if progress and trial % 250 == 0 and progress(trial / trials) is False:
            return None
    if progress:
        progress(1.0)
    return seen


def collision_table(model: motion.RobotModel, reasons: dict[Pair, str]) -> list[tuple[str, str, str]]:
    """All pairs of links of ``model`` with geometry as (link 1, link 2, reason); "" for those that ``reasons`` does not have."""
    names = [name for name in sorted(model.links) if model.link(name).has_geometry]
    return [(one, other, reasons.get((one, other), "")) for one, other in combinations(names, 2)]

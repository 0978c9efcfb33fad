"""What the simulated world shows: joints, ways, objects, distances, touches."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from ..examination.scoped_names import belongs
from ..examination.simulated_world import Sample
from .base import Check, Context, names
from .presence import Presence

_EVERY = 0.05  # s between two points of a plot
_A_MOMENT = 1e-6  # s: until the next look at the world


class Timed(Check):
    """Keeps points for the plot."""

    def note(self, name: str, time: float, value: float) -> None:
        """Keep ``value`` at ``time`` (simulated s) as a point of the line ``name``, unless the last one is too near, or it is no number."""
        if not math.isfinite(value):
            return
        line = self.series.setdefault(name, [])
        if not line or time - line[-1][0] >= _EVERY - 1e-9:
            line.append([time, value])


class JointCheck(Timed):
    """A joint is within ``tolerance`` of ``value`` by ``within`` s after the commands, and stays there for ``hold`` s."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 10.0) + wanted.get("hold", 0.0)
        self._inside: float | None = None
        self._best = math.inf
        self._last: float | None = None
        self._reached: float | None = None
        self._begin = math.inf
        self._owner: tuple[str, int] | None = None  # the model that has it
        self._gone = ""

    def commanded(self) -> None:
        self._begin = self.context.bench.now.time

    def _follow(self, sample: Sample) -> None:
        """What another body does, or did before it came back, is not held by this one."""
        owner = sample.owner(self.wanted["name"], self.context.model)
        if self._owner is not None and owner != self._owner and not self.settled:
            self._inside = None
            if owner is None:
                self._gone = self._gone or f"; it was gone at {sample.time:.2f} s of simulation"
            else:
                self.doubts.add(f"the model with the joint {self.wanted['name']} was replaced by {sample.time:.2f} s of simulation")
        self._owner = owner or self._owner

    def sample(self, sample: Sample) -> None:
        self._follow(sample)
        found = sample.joint(self.wanted["name"], self.context.model)
        if found is None:
            self._inside = None
            return
        _doubt(self, sample, self.wanted["name"])
        value = found[1 if self.wanted.get("velocity") else 0]
        self._last = value
        self.note(self.wanted["name"], sample.time, value)
        if sample.time < self._begin:
            return
        off = abs(value - self.wanted["value"])
        self._best = min(self._best, off)
        if not off <= self.wanted["tolerance"]:
            self._inside = None
            return
        if self._inside is None:
            self._inside = sample.time
        if sample.time - self._inside >= self.wanted.get("hold", 0.0) - 1e-9 and self._inside <= self._begin + self.wanted.get(
            "within", 10.0
        ):
            self._reached = self._inside - self._begin
            self.settled = True

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        name, unit = self.wanted["name"], "rad/s" if self.wanted.get("velocity") else "rad (or m)"
        if self._last is None:
            there = sorted({j for m in self.context.bench.now.models.values() for j in m.get("joints", {})})
            return False, f"no model in the simulator has a joint '{name}' (there are: {names(there)})", {}
        figures = {"last": self._last, "closest": self._best}
        if self.settled:
            return (
                True,
                f"joint {name} was at {self.wanted['value']:g} {unit} after {self._reached:.2f} s",
                {**figures, "after": self._reached},
            )
        held = f" and stay there for {self.wanted['hold']:g} s" if self.wanted.get("hold") else ""
        return (
            False,
            (
                f"joint {name} should reach {self.wanted['value']:g} {unit} within {self.wanted.get('within', 10.0):g} s{held}; "
                f"it ended at "
                f"{self._last:.4g}, {abs(self._last - self.wanted['value']):.4g} away (closest {self._best:.4g}, "
                f"allowed {self.wanted['tolerance']:g}){self._gone}"
            ),
            figures,
        )


def _doubt(check: Check, sample: Sample, joint: str) -> None:
    """Several models have a joint of that name, and the spec names none."""
    models = [] if check.context.model else sample.models_with(joint)
    if len(models) > 1:
        check.doubts.add(
            f"the joint {joint} is there in several models ({names(models)}), and the spec's task names no model: "
            f"that of {models[0]} was measured"
        )


def _extreme(known: float, value: float, of: Callable[[float, float], float]) -> float:
    """The ``of``, min or max, of both; what is no number once stays that, as the comparisons of min and max would forget it."""
    return math.nan if math.isnan(known) or math.isnan(value) else of(known, value)


class StillCheck(Timed):
    """Joints that must not move."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 1.0)
        self._first: dict[str, float] = {}
        self._most: dict[str, float] = {}
        self._joints = Presence(wanted["joints"], lambda sample, joint: sample.owner(joint, context.model))

    def start(self) -> None:
        now = self.context.bench.now
        self._joints.look(now)
        for name in self.wanted["joints"]:
            found = now.joint(name, self.context.model)
            if found is not None:
                self._first[name] = found[0]

    def sample(self, sample: Sample) -> None:
        self._joints.look(sample)
        for name, first in self._first.items():
            found = sample.joint(name, self.context.model)
            _doubt(self, sample, name)
            if found is not None:
                off = abs(found[0] - first)
                self._most[name] = _extreme(self._most.get(name, 0.0), off, max)
                self.note(name, sample.time, found[0])

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        missing = [name for name in self.wanted["joints"] if name not in self._first]
        if missing:
            return False, f"no model in the simulator has a joint '{missing[0]}'", {}
        if self._joints.problem:
            return False, f"the joint {self._joints.problem}", {}
        tolerance = self.wanted.get("tolerance", 0.02)
        moved = {name: most for name, most in self._most.items() if not most <= tolerance}
        return (
            not moved,
            (
                f"joint {next(iter(moved))} moved by {next(iter(moved.values())):.4g}, though it should stand still"
                if moved
                else "nothing moved, as it should"
            ),
            {"most": max(self._most.values(), default=0.0)},
        )


def subject(check: Check) -> str:
    """The model that is meant: named, or the one with most joints."""
    name = (check.wanted.get("model") if isinstance(check.wanted, dict) else None) or check.context.model
    if name:
        return name
    models = check.context.bench.now.models
    return max((n for n in models if not models[n]["static"]), key=lambda n: len(models[n].get("joints", {})), default="")


def yaw(pose: list[float]) -> float:
    """The angle about z, rad, of ``pose``: x, y, z, qx, qy, qz, qw."""
    x, y, z, w = pose[3:]
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class _Following(Timed):
    """Follows one model or ``model::link``: the one that is named, or is meant when the task begins."""

    def start(self) -> None:
        self._name = subject(self)
        self._presence = Presence([self._name])
        self._presence.look(self.context.bench.now)

    def place(self, sample: Sample) -> list[float] | None:
        """Its pose; None where it is not there."""
        if not self._name and subject(self):
            self._name = subject(self)
            self._presence = Presence([self._name])
        self._presence.look(sample)
        return sample.place(self._name)

    def nobody(self) -> str:
        there = f"(there are: {names(self.context.bench.now.models)})"
        return (
            f"there is no '{self._name}' in the simulator {there}" if self._name else f"no model that can move is in the simulator {there}"
        )


class MovedCheck(_Following):
    """How far a model (or ``model::link``) went and turned from the task's beginning, or that it is at a place."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 0.0)
        self._turned = 0.0

    def start(self) -> None:
        super().start()
        self._first = self._last = self._old = self.context.bench.now.place(self._name)

    def sample(self, sample: Sample) -> None:
        pose = self._last = self.place(sample)
        if pose is None:
            self.settled = False
            return
        step = yaw(pose) - yaw(self._old or pose)
        self._turned += math.remainder(step, 2 * math.pi)
        self._old = pose
        self.note(f"{self._name} x", sample.time, pose[0])
        self.note(f"{self._name} y", sample.time, pose[1])
        if "to" in self.wanted and "by" not in self.wanted and "turned" not in self.wanted:
            self.settled = self._off(pose) <= self.wanted.get("tolerance", 0.05)

    def _off(self, pose: Sequence[float]) -> float:
        to = self.wanted["to"]
        return math.dist(pose[: len(to)], to)

    def _absent(self) -> str:
        """Why it cannot be told how far it went, or where it is; '' when it can."""
        if self._presence.missing():
            return self.nobody()
        way = "to" not in self.wanted or "by" in self.wanted or "turned" in self.wanted
        if self._presence.problem and (way or self._last is None):
            return self._presence.problem
        if way and self._first is None:
            return f"'{self._name}' was not there when the task began: how far it went is not known"
        if self._presence.problem:
            self.doubts.add(self._presence.problem)
        return ""

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        absent = self._absent()
        if absent or self._last is None:
            return False, absent or self.nobody(), {}
        way = math.dist((self._first or self._last)[:3], self._last[:3])
        figures = {"moved": way, "turned": self._turned, "at": self._last[:3]}
        said = []
        for key, value, unit in (("by", way, "m"), ("turned", self._turned, "rad")):
            if key in self.wanted:
                low, high = self.wanted[key]
                if not low <= value <= high:
                    said.append(
                        f"{self._name} {'turned' if key == 'turned' else 'moved'} by {value:.4g} {unit}; {low:g} to {high:g} are asked for"
                    )
        if "to" in self.wanted and not self._off(self._last) <= self.wanted.get("tolerance", 0.05):
            said.append(f"{self._name} is {self._off(self._last):.4g} m from {self.wanted['to']}, where it should be")
        return not said, "; ".join(said) or f"{self._name} moved by {way:.4g} m and turned by {self._turned:.4g} rad, as asked", figures


class PathCheck(_Following):
    """The points are passed in their order, each within ``tolerance``."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 30.0)
        self._next, self._closest = 0, math.inf

    def sample(self, sample: Sample) -> None:
        if self.settled:
            return
        pose = self.place(sample)
        if pose is None:
            return
        self.note(f"{self._name} x", sample.time, pose[0])
        self.note(f"{self._name} y", sample.time, pose[1])
        point = self.wanted["points"][self._next]
        self._closest = min(self._closest, math.dist(pose[: len(point)], point))
        if self._closest <= self.wanted["tolerance"] and not self._presence.problem:
            self._next, self._closest = self._next + 1, math.inf
            self.settled = self._next == len(self.wanted["points"])

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        points = self.wanted["points"]
        if self.settled:
            return True, f"all {len(points)} points were passed", {}
        if self._presence.missing():
            return False, self.nobody(), {}
        return (
            False,
            (
                f"{self._next} of {len(points)} points were passed; the next, {points[self._next]}, was missed by "
                f"{self._closest:.4g} m (allowed {self.wanted['tolerance']:g})"
                + (f"; {self._presence.problem}" if self._presence.problem else "")
            ),
            {"passed": self._next},
        )


class DistanceCheck(Timed):
    """Distance between two places, models or ``model::link``, all the while."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 0.0)
        self._least, self._most = math.inf, -math.inf
        self._presence = Presence([wanted["from"], wanted["to"]])

    def commanded(self) -> None:
        self._presence.due()

    def sample(self, sample: Sample) -> None:
        self._presence.look(sample)
        a, b = (sample.place(self.wanted[key]) for key in ("from", "to"))
        if a and b:
            distance = math.dist(a[:3], b[:3])
            self._least, self._most = _extreme(self._least, distance, min), _extreme(self._most, distance, max)
            self.note("distance", sample.time, distance)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        missing = self._presence.missing()
        if missing:
            return False, f"there is no '{missing[0]}' in the simulator (there are: {names(self.context.bench.now.models)})", {}
        if self._presence.problem:
            return False, self._presence.problem, {}
        figures = {"least": self._least, "most": self._most}
        if not self._least >= self.wanted.get("least", -math.inf):
            return False, f"they came within {self._least:.4g} m of each other; {self.wanted['least']:g} m had to be kept", figures
        if not self._most <= self.wanted.get("most", math.inf):
            return False, f"they were {self._most:.4g} m apart; {self.wanted['most']:g} m were allowed", figures
        return True, f"the distance stayed between {self._least:.4g} and {self._most:.4g} m", figures


class NoCollisionCheck(Check):
    """A model, or ``model::link``, touches nothing but its own model and what is allowed."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", _A_MOMENT)
        self._touched: list[str] = []
        self._presence = Presence([wanted["model"]])
        self._allowed = [wanted["model"].partition("::")[0], *wanted.get("allow", ["ground_plane"])]

    def start(self) -> None:
        self.context.bench.watch_contacts(self.wanted["model"])

    def commanded(self) -> None:
        self._presence.due()

    def sample(self, sample: Sample) -> None:
        self._presence.look(sample)
        for pair in sample.contacts:
            mine = [belongs(name, self.wanted["model"]) for name in pair]
            if any(mine) and not all(any(belongs(name, allowed) for allowed in self._allowed) for name in pair):
                text = f"{pair[0]} touched {pair[1]} at {sample.time:.2f} s"
                if len(self._touched) < 5:
                    self._touched.append(text)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        if self._touched:
            return False, self._touched[0], {}
        if self._presence.missing():
            there = names(self.context.bench.now.models)
            return False, f"there is no model '{self.wanted['model']}' in the simulator (there are: {there})", {}
        if self._presence.problem:
            return False, self._presence.problem, {}
        return True, f"{self.wanted['model']} touched nothing that it should not", {}


class RealTimeFactorCheck(Check):
    """Simulated seconds per second of the simulator's processor time: what a busy machine does not change much."""

    horizon = 1.0

    def start(self) -> None:
        self._begin = (self.context.bench.now.time, self.context.simulator_seconds())

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        spent = self.context.simulator_seconds() - self._begin[1]
        factor = (self.context.bench.now.time - self._begin[0]) / max(spent, 1e-3)
        # The figure itself stays out of the result: it differs from run to run.
        good = factor >= self.wanted["least"]
        return good, f"the simulation runs {'at least' if good else 'less than'} {self.wanted['least']:g} times as fast as real time", {}

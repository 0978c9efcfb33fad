"""What the simulated world shows: joints, ways, objects, distances, touches, odometry, energy, pictures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import image_pixels
import numpy as np
import rospy

from ..examination.camera_visibility import share_of
from ..examination.commands import CommandError, find_topic
from ..examination.simulated_world import Sample
from .base import Check, Context, names

_EVERY = 0.05  # s between two points of a plot
_MOST_MESSAGES = 200_000  # of a topic that one task keeps
_SHARE = [0.005, 1.0]  # of a picture, where the spec says none


class Timed(Check):
    """Keeps points for the plot."""

    def note(self, name: str, time: float, value: float) -> None:
        """Keep ``value`` at ``time`` (simulated s) as a point of the line ``name``, unless the last one is too near."""
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

    def commanded(self) -> None:
        self._begin = self.context.bench.now.time

    def sample(self, sample: Sample) -> None:
        found = sample.joint(self.wanted["name"], self.context.model)
        if found is None:
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
                f"allowed {self.wanted['tolerance']:g})"
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


class StillCheck(Timed):
    """Joints that must not move."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 1.0)
        self._first: dict[str, float] = {}
        self._most: dict[str, float] = {}

    def start(self) -> None:
        for name in self.wanted["joints"]:
            found = self.context.bench.now.joint(name, self.context.model)
            if found is not None:
                self._first[name] = found[0]

    def sample(self, sample: Sample) -> None:
        for name, first in self._first.items():
            found = sample.joint(name, self.context.model)
            _doubt(self, sample, name)
            if found is not None:
                self._most[name] = max(self._most.get(name, 0.0), abs(found[0] - first))
                self.note(name, sample.time, found[0])

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        missing = [name for name in self.wanted["joints"] if name not in self._first]
        if missing:
            return False, f"no model in the simulator has a joint '{missing[0]}'", {}
        tolerance = self.wanted.get("tolerance", 0.02)
        moved = {name: most for name, most in self._most.items() if not most <= tolerance}
        return (
            not moved,
            (
                f"joint {next(iter(moved))} moved by {next(iter(moved.values())):.4g}, though it should stand still"
                if moved
                else "nothing moved, as it should"
            ),
            {"most": self._most},
        )


def _subject(check: Check) -> str:
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


class MovedCheck(Timed):
    """How far a model (or ``model::link``) went and turned from the task's beginning, or that it is at a place."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 0.0)
        self._turned, self._way = 0.0, 0.0
        self._old: list[float] | None = None

    def start(self) -> None:
        self._name = _subject(self)
        self._first = self._old = self.context.bench.now.place(self._name)

    def sample(self, sample: Sample) -> None:
        pose = sample.place(self._name)
        if pose is None or self._first is None:
            return
        step = yaw(pose) - yaw(self._old or self._first)
        self._turned += math.remainder(step, 2 * math.pi)
        self._old = pose
        self.note(f"{self._name} x", sample.time, pose[0])
        self.note(f"{self._name} y", sample.time, pose[1])
        if "to" in self.wanted and "by" not in self.wanted and "turned" not in self.wanted:
            self.settled = self._off(pose) <= self.wanted.get("tolerance", 0.05)

    def _off(self, pose: Sequence[float]) -> float:
        to = self.wanted["to"]
        return math.dist(pose[: len(to)], to)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        if self._first is None or self._old is None:
            return False, f"there is no '{self._name}' in the simulator (there are: {names(self.context.bench.now.models)})", {}
        way = math.dist(self._first[:3], self._old[:3])
        figures = {"moved": way, "turned": self._turned, "at": self._old[:3]}
        said = []
        for key, value, unit in (("by", way, "m"), ("turned", self._turned, "rad")):
            if key in self.wanted:
                low, high = self.wanted[key]
                if not low <= value <= high:
                    said.append(
                        f"{self._name} {'turned' if key == 'turned' else 'moved'} by {value:.4g} {unit}; {low:g} to {high:g} are asked for"
                    )
        if "to" in self.wanted and not self._off(self._old) <= self.wanted.get("tolerance", 0.05):
            said.append(f"{self._name} is {self._off(self._old):.4g} m from {self.wanted['to']}, where it should be")
        return not said, "; ".join(said) or f"{self._name} moved by {way:.4g} m and turned by {self._turned:.4g} rad, as asked", figures


class PathCheck(Timed):
    """The points are passed in their order, each within ``tolerance``."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 30.0)
        self._next, self._closest = 0, math.inf

    def sample(self, sample: Sample) -> None:
        name = _subject(self)
        pose = sample.place(name)
        if pose is None or self.settled:
            return
        self.note(f"{name} x", sample.time, pose[0])
        self.note(f"{name} y", sample.time, pose[1])
        point = self.wanted["points"][self._next]
        self._closest = min(self._closest, math.dist(pose[: len(point)], point))
        if self._closest <= self.wanted["tolerance"]:
            self._next, self._closest = self._next + 1, math.inf
            self.settled = self._next == len(self.wanted["points"])

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        points = self.wanted["points"]
        if self.settled:
            return True, f"all {len(points)} points were passed", {}
        return (
            False,
            (
                f"{self._next} of {len(points)} points were passed; the next, {points[self._next]}, was missed by "
                f"{self._closest:.4g} m (allowed {self.wanted['tolerance']:g})"
            ),
            {"passed": self._next},
        )


class DistanceCheck(Timed):
    """Distance between two places, models or ``model::link``, all the while."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 0.0)
        self._least, self._most = math.inf, -math.inf

    def sample(self, sample: Sample) -> None:
        a, b = (sample.place(self.wanted[key]) for key in ("from", "to"))
        if a and b:
            distance = math.dist(a[:3], b[:3])
            self._least, self._most = min(self._least, distance), max(self._most, distance)
            self.note("distance", sample.time, distance)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        if self._most < 0:
            return False, f"{self.wanted['from']} or {self.wanted['to']} is not in the simulator", {}
        figures = {"least": self._least, "most": self._most}
        if self._least < self.wanted.get("least", -math.inf):
            return False, f"they came within {self._least:.4g} m of each other; {self.wanted['least']:g} m had to be kept", figures
        if self._most > self.wanted.get("most", math.inf):
            return False, f"they were {self._most:.4g} m apart; {self.wanted['most']:g} m were allowed", figures
        return True, f"the distance stayed between {self._least:.4g} and {self._most:.4g} m", figures


class _Listening(Timed):
    """Takes the messages of a topic; ``messages`` has (simulated time, message)."""

    def start(self) -> None:
        import roslib.message

        self.messages: list[tuple[float, Any]] = []
        self.problem = ""
        self._subscriber: Any = None  # rospy.Subscriber, once somebody publishes
        try:
            import rosgraph

            name = self._topic = find_topic(self.wanted["topic"])
            kind = dict(rosgraph.Master("/lab_check").getTopicTypes()).get(name)
        except CommandError as error:
            self.problem = str(error)
            return
        message = roslib.message.get_message_class(kind) if kind and kind != "*" else None
        if message is None:
            self.problem = f"nobody publishes {name}" if kind is None else f"{name} carries {kind}, which is not known here"
            return
        self._subscriber = rospy.Subscriber(name, message, self._take, queue_size=None, buff_size=1 << 24, tcp_nodelay=True)
        self.context.bench.connect()

    def _take(self, message: Any) -> None:
        if len(self.messages) < _MOST_MESSAGES:
            self.messages.append((self.context.bench.now.time, message))

    def _of_the_simulator(self) -> None:
        """Where the simulator publishes the topic, what others publish there does not count, and is a doubt."""
        simulator = self.context.bench.simulator
        headers = {id(c.header): c.endpoint_id for c in self._subscriber.impl.connections}
        sources = [headers.get(id(message._connection_header)) for _, message in self.messages]
        if simulator in sources and any(source != simulator for source in sources):
            self.doubts.add(f"another node publishes {self._topic}, too, which is the simulator's: what it sent does not count")
            self.messages = [entry for entry, source in zip(self.messages, sources) if source == simulator]

    def stop(self) -> None:
        if self._subscriber is not None:
            self._of_the_simulator()
        if self._subscriber is not None:
            self._subscriber.unregister()
        if not self.problem and not self.messages:
            self.problem = f"no message came on {self.wanted['topic']}"


class OdometryCheck(_Listening):
    """The way that odometry tells from the task's beginning, against the simulator's truth."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 0.0)

    def start(self) -> None:
        super().start()
        self._name = _subject(self)
        self._first = self.context.bench.now.place(self._name)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        self.stop()
        last = self.context.bench.now.place(self._name)
        if self.problem or last is None or self._first is None:
            return False, self.problem or f"there is no model '{self._name}'", {}
        told = [self.messages[k][1].pose.pose for k in (0, -1)]
        own = [[p.position.x, p.position.y, 0, p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w] for p in told]
        off = math.dist(_seen(own[0], own[1]), _seen(self._first, last))
        return (
            off <= self.wanted["tolerance"],
            f"odometry is {off:.4g} m from the truth (allowed {self.wanted['tolerance']:g})",
            {"off": off},
        )


def _seen(first: list[float], last: list[float]) -> tuple[float, float]:
    """Where ``last`` is in the plane, seen from ``first``."""
    dx, dy, angle = last[0] - first[0], last[1] - first[1], -yaw(first)
    return dx * math.cos(angle) - dy * math.sin(angle), dx * math.sin(angle) + dy * math.cos(angle)


class EnergyCheck(_Listening):
    """Work of the joints, from joint states: the sum of |effort x velocity| over simulated time, J."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 5.0)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        self.stop()
        if self.problem:
            return False, self.problem, {}
        work, old = 0.0, None
        for _, message in self.messages:
            now = message.header.stamp.to_sec()
            if old is not None and now > old and message.effort:
                work += (now - old) * float(sum(abs(e * v) for e, v in zip(message.effort, message.velocity)))
            old = now
        return work <= self.wanted["most"], f"the joints did {work:.4g} J of work (allowed {self.wanted['most']:g})", {"work": work}


class ImageCheck(_Listening):
    """A camera's newest picture: its size, and how much of it has a colour, or shows a model as the simulator knows it."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 1.0)

    def sample(self, sample: Sample) -> None:
        del sample
        del self.messages[:-20]  # of whom they came is looked at later

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        self.stop()
        if self.problem:
            return False, self.problem, {}
        message = self.messages[-1][1]
        pixels = to_rgb(message)
        if pixels is None:
            return False, f"a picture in the encoding '{message.encoding}' cannot be looked at", {}
        if "size" in self.wanted and [message.width, message.height] != self.wanted["size"]:
            return False, f"the picture has {message.width}x{message.height} pixels, not {'x'.join(map(str, self.wanted['size']))}", {}
        if "object" in self.wanted:
            return self._object(self.wanted["object"])
        if "colour" not in self.wanted:
            lively = float(pixels.std())
            return (
                lively > 1.0,
                "the picture shows something" if lively > 1.0 else "the picture is all of one colour",
                {"deviation": lively},
            )
        off = np.abs(pixels.astype(int) - np.array(self.wanted["colour"])).max(axis=2)
        part = float((off <= self.wanted.get("tolerance", 40)).mean())
        low, high = self.wanted.get("share", _SHARE)
        return low <= part <= high, f"{part:.2%} of the picture has that colour; {low:.2%} to {high:.2%} are asked for", {"share": part}

    def _object(self, name: str) -> tuple[bool, str, dict[str, Any]]:
        if self.context.bench.now.place(name) is None:
            return False, f"there is no '{name}' in the simulator (there are: {names(self.context.bench.now.models)})", {}
        found = self.context.bench.seen(self._topic)
        if isinstance(found, str):
            return False, found, {}
        part = share_of(name, found)
        low, high = self.wanted.get("share", _SHARE)
        return low <= part <= high, f"{name} fills {part:.2%} of the picture; {low:.2%} to {high:.2%} are asked for", {"share": part}


def to_rgb(message: Any) -> np.ndarray | None:
    """(rows, columns, 3) uint8, None for an encoding without colours or a message that contradicts itself."""
    try:
        picture = image_pixels.picture_of(message)
    except image_pixels.ImageError:
        return None
    if picture.unit:
        return None
    return picture.pixels if picture.pixels.ndim == 3 else np.repeat(picture.pixels[..., None], 3, axis=2)


class NoCollisionCheck(Check):
    """A model touches nothing but itself and what is allowed."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 0.0)
        self._touched: list[str] = []

    def start(self) -> None:
        self.context.bench.watch_contacts(True)

    def sample(self, sample: Sample) -> None:
        mine, allowed = self.wanted["model"], [self.wanted["model"], *self.wanted.get("allow", ["ground_plane"])]
        for pair in sample.contacts:
            models = [name.split("::")[0] for name in pair]
            if mine in models and not all(model in allowed for model in models):
                text = f"{pair[0]} touched {pair[1]} at {sample.time:.2f} s"
                if len(self._touched) < 5:
                    self._touched.append(text)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        return not self._touched, self._touched[0] if self._touched else f"{self.wanted['model']} touched nothing that it should not", {}


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

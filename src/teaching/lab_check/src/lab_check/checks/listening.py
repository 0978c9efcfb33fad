"""What is told on topics, beside the simulator's truth: odometry, energy, pictures."""

from __future__ import annotations

import math
import statistics
from typing import Any

import image_pixels
import numpy as np
import rosgraph
import roslib.message
import rospy

from ..examination.camera_visibility import share_of
from ..examination.commands import CommandError, find_topic
from ..examination.simulated_world import Sample
from .base import Context, names
from .motion import Timed, subject, yaw
from .presence import Presence

_MOST_MESSAGES = 200_000  # of a topic that one task keeps
_SHARE = [0.005, 1.0]  # of a picture, where the spec says none
_PATIENCE, _CAMERAS_PATIENCE = 5.0, 10.0  # s after the commands for which a first message is waited for
_SLOWEST = 2.0  # s until the first message of odometry that is compared from there on
_PART = 0.25  # of the task's time, which that may be at most: who tells nothing before the robot stands still has told nothing
_GAP, _GAPS = 1.0, 5.0  # s without joint states, and usual periods, that may pass: what was done in longer ones is not known


class Listening(Timed):
    """Takes the messages of a topic from when somebody publishes it; ``messages`` has (simulated time, message)."""

    patience = _PATIENCE
    in_wall_time = True

    def start(self) -> None:
        self.messages: list[tuple[float, Any]] = []
        self.problem = ""
        self._subscriber: Any = None  # rospy.Subscriber, once somebody publishes
        self._sources: dict[int, tuple[Any, str]] = {}  # id of a connection's header -> header, who is at its other end
        self._begin = math.inf
        self._topic = self.wanted["topic"]
        self._listen()

    def commanded(self) -> None:
        self._begin = self.context.bench.now.time
        self._listen()

    def sample(self, sample: Sample) -> None:
        del sample
        self._listen()

    def _listen(self) -> None:
        """To whoever publishes by now, if nobody did before."""
        if self._subscriber is not None:
            return
        try:
            name = self._topic = find_topic(self.wanted["topic"])
        except CommandError as error:
            self.problem = str(error)
            return
        kind = dict(rosgraph.Master("/lab_check").getTopicTypes()).get(name)
        message = roslib.message.get_message_class(kind) if kind and kind != "*" else None
        if message is None:
            self.problem = f"nobody publishes {name}" if kind is None else f"{name} carries {kind}, which is not known here"
            return
        self.problem = ""
        self._subscriber = rospy.Subscriber(name, message, self._take, queue_size=None, buff_size=1 << 24, tcp_nodelay=True)
        self.context.bench.connect()
        self._look_who_sends()

    def _take(self, message: Any) -> None:
        if id(message._connection_header) not in self._sources:
            self._look_who_sends()
        if len(self.messages) < _MOST_MESSAGES:
            self.messages.append((self.context.bench.now.time, message))

    def there(self) -> bool:
        return bool(self.messages)

    def _look_who_sends(self) -> None:
        """While the connections stand: who has ended has none any more."""
        if self._subscriber is not None:
            self._sources.update({id(c.header): (c.header, c.endpoint_id) for c in self._subscriber.impl.connections})

    def _from_the_simulator(self) -> list[bool]:
        """Of each message: the simulator sent it."""
        self._look_who_sends()
        simulator = self.context.bench.simulator
        return [self._sources.get(id(message._connection_header), (None, ""))[1] == simulator for _, message in self.messages]

    def heard(self) -> str:
        """'' or why there is nothing to look at. Where the simulator publishes the topic, what others publish there does not count, and is
        a doubt."""
        if self._subscriber is not None:
            own = self._from_the_simulator()
            if any(own) and not all(own):
                self.doubts.add(f"another node publishes {self._topic}, too, which is the simulator's: what it sent does not count")
                self.messages = [entry for entry, mine in zip(self.messages, own) if mine]
        if not self.problem and not self.messages:
            return f"no message came on {self.wanted['topic']}"
        return self.problem

    def end(self) -> None:
        if self._subscriber is not None:
            self._subscriber.unregister()


class OdometryCheck(Listening):
    """The way that odometry tells from the task's beginning, against the simulator's truth."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 0.0)

    def start(self) -> None:
        super().start()
        self._name = subject(self)
        self._presence = Presence([self._name])
        self._presence.look(self.context.bench.now)
        self._start = self.context.bench.now

    def sample(self, sample: Sample) -> None:
        super().sample(sample)
        self._presence.look(sample)

    def _first(self) -> Sample:
        """The truth to begin with: that of the task's beginning, or of the first message of odometry that comes a few times a minute."""
        end, heard = self.context.bench.now.time, self.messages[0][0]
        late = heard - self._start.time
        if late <= 1.5 * self.context.bench.quantum or late > min(_SLOWEST, _PART * (end - self._start.time)):
            return self._start
        return next((sample for sample in self.context.samples if sample.time > heard + 1e-9), self._start)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        problem = self.heard()
        if problem:
            return False, problem, {}
        last = self.context.bench.now.place(self._name)
        if self._presence.problem:
            return False, self._presence.problem, {}
        first = self._first().place(self._name)
        if last is None or first is None:
            return False, f"there is no model '{self._name}'", {}
        told = [self.messages[k][1].pose.pose for k in (0, -1)]
        own = [[p.position.x, p.position.y, 0, p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w] for p in told]
        off = math.dist(_seen(own[0], own[1]), _seen(first, last))
        return (
            off <= self.wanted["tolerance"],
            f"odometry is {off:.4g} m from the truth (allowed {self.wanted['tolerance']:g})",
            {"off": off},
        )


def _seen(first: list[float], last: list[float]) -> tuple[float, float]:
    """Where ``last`` is in the plane, seen from ``first``."""
    dx, dy, angle = last[0] - first[0], last[1] - first[1], -yaw(first)
    return dx * math.cos(angle) - dy * math.sin(angle), dx * math.sin(angle) + dy * math.cos(angle)


class EnergyCheck(Listening):
    """Work of the joints, from joint states: the sum of |effort x velocity| over simulated time, J."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("for", 5.0)

    def start(self) -> None:
        super().start()
        self._start = self.context.bench.now.time

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        problem = self.heard()
        if problem:
            return False, problem, {}
        told = [(time, message) for time, message in self.messages if len(message.effort) and len(message.velocity)]
        if len(told) < 2:
            return False, f"the joint states on {self._topic} tell no efforts with velocities: the work is not known", {}
        gap = self._gap([time for time, _ in told])
        if gap:
            return False, gap, {}
        stamped = told[-1][1].header.stamp.to_sec() - told[0][1].header.stamp.to_sec()
        if stamped < 0.5 * (told[-1][0] - told[0][0]):
            return False, f"the stamps of the joint states on {self._topic} do not go on with the time: the work is not known", {}
        work, old = 0.0, None
        for _, message in told:
            if not len(message.effort) == len(message.velocity) == len(message.name):
                return False, f"the joint states on {self._topic} do not tell effort and velocity of each of their joints", {}
            now = message.header.stamp.to_sec()
            if old is not None and now > old:
                work += (now - old) * float(sum(abs(e * v) for e, v in zip(message.effort, message.velocity)))
            old = now
        if not math.isfinite(work):
            return False, f"the joint states on {self._topic} hold efforts or velocities that are no numbers: the work is not known", {}
        return work <= self.wanted["most"], f"the joints did {work:.4g} J of work (allowed {self.wanted['most']:g})", {"work": work}

    def _gap(self, times: list[float]) -> str:
        """A time without joint states, '' where there is none that is longer than the usual pause between two by much."""
        usual = statistics.median(b - a for a, b in zip(times, times[1:]))
        longest = max(_GAP, _GAPS * usual) + 2 * self.context.bench.quantum
        for a, b in zip([self._start, *times], [*times, self.context.bench.now.time]):
            if b - a > longest:
                return f"no joint states came on {self._topic} from {a:.2f} to {b:.2f} s of simulation: the work is not known"
        return ""


class ImageCheck(Listening):
    """A camera's newest picture: its size, and how much of it has a colour, or shows a model as the simulator knows it."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 1.0)
        self.patience = wanted.get("within", _CAMERAS_PATIENCE)

    def sample(self, sample: Sample) -> None:
        super().sample(sample)
        del self.messages[:-20]  # of whom they came is looked at later

    def there(self) -> bool:
        """A camera of the simulator that has ended has taken no picture of what the commands did; a node may have made its only one."""
        return bool(self.messages) and (self.messages[-1][0] >= self._begin or not any(self._from_the_simulator()))

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        problem = self.heard()
        if problem:
            return False, problem, {}
        if not self.there():
            return False, f"no picture came on {self._topic} after {self.messages[-1][0]:.2f} s of simulation", {}
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

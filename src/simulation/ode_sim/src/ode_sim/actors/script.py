"""Where an actor is, as a function of the time since it began to play. No state: a script can be asked in any order."""

from __future__ import annotations

import bisect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ode_sim.actors.splines import PositionSpline, RotationSpline
from ode_sim.description.model import ActorScript, Pose, Trajectory, Waypoint
from ode_sim.math3 import norm, sub

FRAME_RATE = 30  # Hz of sim time, Gazebo's
_NANO = 1_000_000_000
_MOST_SAMPLES = 50_000  # of a path, to measure its length


class Path:
    """A curve through ``waypoints``; ``tension`` 0: a Catmull-Rom curve, 1: straight lines.

    The first one counts from 0 on, whatever time it has, as in Gazebo; of two of the same time the later counts.
    """

    def __init__(self, waypoints: Sequence[Waypoint], tension: float = 0.0):
        points = {point.time: point.pose for point in sorted(_latest(waypoints), key=lambda point: point.time)}
        self._times = [0.0] + list(points)[1:]
        self.duration = max(points)
        poses = list(points.values())
        self._poses = poses
        self._positions = PositionSpline([pose.p for pose in poses], tension)
        self._rotations = RotationSpline([pose.q for pose in poses])
        self._step = max(1.0 / FRAME_RATE, self.duration / _MOST_SAMPLES)  # s
        self._lengths: list[float] = []  # ways walked until each, m; measured when somebody asks

    def pose(self, time: float) -> Pose:
        """In the world, at ``time`` (s)."""
        time = min(max(time, 0.0), self.duration)
        after = bisect.bisect_left(self._times, time)
        if after == len(self._times):
            return self._poses[-1]
        if self._times[after] == time or after == 0:
            return self._poses[after]
        before = self._times[after - 1]
        part = (time - before) / (self._times[after] - before)
        if part < 1e-6:
            return self._poses[after - 1]
        return Pose(self._positions.at(after - 1, part), self._rotations.at(after - 1, part))

    def _measure(self) -> list[float]:
        lengths, at = [0.0], self._poses[0].p
        for number in range(1, int(self.duration / self._step) + 2):
            now = self.pose(number * self._step).p
            lengths.append(lengths[-1] + norm(sub(now, at)))
            at = now
        return lengths

    def walked(self, time: float) -> float:
        """The way from the beginning until ``time`` (s), m."""
        self._lengths = self._lengths or self._measure()
        frame = min(max(time, 0.0), self.duration) / self._step
        before = min(int(frame), len(self._lengths) - 2)
        return self._lengths[before] + (frame - before) * (self._lengths[before + 1] - self._lengths[before])

    @property
    def gap(self) -> float:
        """From its end to its beginning, m."""
        return norm(sub(self._poses[-1].p, self._poses[0].p))


def _latest(waypoints: Sequence[Waypoint]) -> list[Waypoint]:
    return list({point.time: point for point in waypoints}.values())


@dataclass(frozen=True)
class Clip:
    """A trajectory as it is played: ``start`` and ``duration`` within the script, s; ``path`` None: it stays where its animation is."""

    id: int
    type: str
    path: Path | None
    start: float
    duration: float


class Moment(NamedTuple):
    """What is played: ``time`` s within the clip, ``round`` how often the whole script was played before."""

    clip: Clip
    time: float
    round: int


class Script:
    """:param lengths: of the animations that could be loaded, s, by name.

    Trajectories follow one another by their ids; without any the animation that comes first by name is played.
    """

    def __init__(self, script: ActorScript, lengths: Mapping[str, float]):
        self.delay = max(script.delay_start, 0.0)
        self.loop = script.loop
        self.auto_start = script.auto_start
        trajectories = sorted(script.trajectories, key=lambda trajectory: trajectory.id)
        if not trajectories and lengths:
            trajectories = [Trajectory(0, min(lengths))]
        self.clips: list[Clip] = []
        self.length = 0.0
        for trajectory in trajectories:
            path = Path(trajectory.waypoints, trajectory.tension) if trajectory.waypoints else None
            duration = path.duration if path else lengths.get(trajectory.type, 0.0)
            self.clips.append(Clip(trajectory.id, trajectory.type, path, self.length, duration))
            self.length += duration

    def moment(self, elapsed_ns: int) -> Moment | None:
        """What is played ``elapsed_ns`` after the start; None without trajectories.

        Until ``delay_start`` is over, in every round anew, the first moment; after the end of what does not loop, the last.
        """
        if not self.clips:
            return None
        delay, length = round(self.delay * _NANO), round(self.length * _NANO)
        rounds, within = 0, elapsed_ns
        if self.loop and length > 0 and elapsed_ns >= 0:
            rounds, within = divmod(elapsed_ns, delay + length)
        within = min(max(within - delay, 0), length)
        return self._find(within / _NANO, rounds)

    def _find(self, time: float, rounds: int) -> Moment:
        for clip in self.clips:
            if clip.start + clip.duration >= time:
                break
        return Moment(clip, min(max(time - clip.start, 0.0), clip.duration), rounds)

    def walked(self, moment: Moment) -> float:
        """The way at ``moment`` by which an animation with ``interpolate_x`` goes on, m: from the beginning of the trajectory; a script
        of one
        trajectory that loops walks on, through the gap between its end and its beginning.
        """
        path = moment.clip.path
        if path is None:
            return 0.0
        walked = path.walked(moment.time)
        if len(self.clips) == 1 and self.loop and self.delay == 0.0:
            walked += moment.round * (path.walked(path.duration) + path.gap)
        return walked


def frame_of(time_ns: int) -> int:
    """The number of the frame that is shown at ``time_ns``."""
    return time_ns * FRAME_RATE // _NANO


def frame_time(frame: int) -> int:
    """When a frame is due, ns; rounded up, so that it is due then."""
    return -(-frame * _NANO // FRAME_RATE)

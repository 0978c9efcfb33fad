"""An actor of a running world: its links are put where its script has them, thirty times a second of simulated time."""

from __future__ import annotations

from typing import Any

import numpy as np

from ode_sim.actors import quaternions
from ode_sim.actors.animation import Animation, animation_for
from ode_sim.actors.script import Moment, Script, frame_of, frame_time
from ode_sim.actors.skeleton import Skeleton, load_skeleton
from ode_sim.description.model import Actor, ActorAnimation, DescriptionError, Pose
from ode_sim.math3 import add, quat_multiply, quat_rotate, scale

_NOWHERE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


class Rig:
    """The bones of ``skeleton``, ``size`` times as large, as a pose of an animation bends them."""

    def __init__(self, skeleton: Skeleton, size: float):
        self.names = [bone.name for bone in skeleton.bones]
        self.parents = [bone.parent for bone in skeleton.bones]
        self._size = size
        self._rest = np.column_stack([skeleton.rest[:, :3, 3], quaternions.from_matrices(skeleton.rest[:, :3, :3])])
        self.stands = tuple(self._rest[0, 3:].tolist())  # rotation of the root, as the skin was bound

    def bend(self, animation: tuple[Animation, ActorAnimation] | None, time: float) -> np.ndarray:
        """(N, 7) x y z qx qy qz qw of each bone in its parent at ``time`` (s) of ``animation``; at rest without one."""
        poses = self._rest.copy()
        if animation is not None:
            moved = animation[0].moved
            places, turns = animation[0].pose_at(time)
            poses[moved, :3] = places[moved] * animation[1].scale
            poses[moved, 3:] = turns[moved]
        poses[:, :3] *= self._size
        return poses


class Puppet:
    """:ivar active: it plays. :ivar custom: the animation that a plugin plays in place of the script, at :attr:`script_time`
    and wherever the plugin puts the model; '' for one that is not there, None: the script is played.

    :ivar collides: it was asked to push what it meets, see :meth:`let_collide`; it then moves in every step.
    """

    def __init__(self, model: Any, time_ns: int):
        actor: Actor = model.description.actor
        self.model = model
        self.problems: list[str] = []
        self._actor = actor
        self._rig: Rig | None = None
        self._animations: dict[str, tuple[Animation, ActorAnimation]] = {}
        self._load(actor)
        self.lengths = {name: animation.length for name, (animation, _) in self._animations.items()}
        self.script = Script(actor.script, self.lengths)
        self.custom: str | None = None
        self.script_time = 0.0
        self.collides = False
        self._director: Any = None
        self._refused = False
        self._links = list(model.links.values())
        self._bones: list[int] = []  # which bone each link is, of those that are one
        self._rows: list[int] = []  # and which link that is
        self._parents = self._join()
        self._fixed = np.array([(*link.description.pose.p, *link.description.pose.q) for link in self._links])
        self.restart(time_ns)

    def _load(self, actor: Actor) -> None:
        try:
            if not actor.skin:
                return
            skeleton = load_skeleton(actor.skin)
            self._rig = Rig(skeleton, actor.scale)
            for written in actor.animations:
                self._animations[written.name] = (animation_for(written.path, skeleton), written)
        except DescriptionError as error:  # the file was another one when the description was read
            self.problems.append(str(error))

    def _join(self) -> list[int]:
        """The link that each link hangs on, by their places; -1: the world. Bones hang on bones, the rest on the first link."""
        parents = [-1] + [0] * (len(self._links) - 1)
        rows = {link.name: row for row, link in enumerate(self._links) if row}
        of_bone: dict[int, int] = {}
        for bone, name in enumerate(self._rig.names if self._rig else ()):
            row = rows.pop(name, None)
            if row is None or self._rig is None:
                continue
            of_bone[bone] = row
            parents[row] = of_bone.get(self._rig.parents[bone], 0)
            self._bones.append(bone)
            self._rows.append(row)
        return parents

    # ------------------------------------------------------------------ playing

    def restart(self, time_ns: int) -> None:
        """As just spawned, at ``time_ns``: where its script begins, or where it was put if that is another's work."""
        self.active = self.script.auto_start
        self.started_ns = time_ns
        self.custom = None
        self._taken = False
        self.script_time = 0.0
        self._frame = -1
        self._tell(anew=True)
        if self.active and not self.model.description.plugins:
            self._play(0, 0.0)
        else:
            self._bend(self.model.initial_pose, self._first_animation(), 0.0, 0.0, waits=True)

    def take_over(self, animation: str) -> None:
        """From now on a plugin moves the model, which plays ``animation``, and sets :attr:`script_time`, until a reset."""
        self.custom, self._taken = animation, True

    def direct(self, director: Any) -> None:
        """Have the actor directed from outside. :param director: ``wanted()``, asked before every step, and ``plays(...)``, told of it."""
        self._director = director
        self._tell(anew=True)

    def _tell(self, anew: bool = False) -> None:
        if self._director is not None:
            self._director.plays(self.script_time, self.active, self.started_ns, anew)

    def _ask(self) -> None:
        custom, script_time, self.active, self.started_ns, collides = self._director.wanted()
        self.custom = custom
        if custom is not None:
            self.script_time = script_time
        if collides:
            self.collides = True

    def play(self, time_ns: int) -> None:
        """Its script begins at ``time_ns``."""
        self.active = True
        self.started_ns = time_ns

    def stop(self) -> None:
        self.active = False

    def shift(self, time_ns: int) -> None:
        """The clock was set forward by ``time_ns``; the actor goes on where it is."""
        self.started_ns += time_ns
        self._frame = -1
        if self.custom is None:
            self._tell(anew=True)

    def state(self) -> list[Any]:
        """For snapshots; numbers and texts."""
        return [self.started_ns, self.active, self._frame, self.custom, self.script_time, self.collides]

    @staticmethod
    def read_state(state: list[Any]) -> tuple[int, bool, int, str | None, float, bool]:
        """What :meth:`state` gave, for :meth:`set_state`.

        :raises ValueError, TypeError: it is damaged
        """
        started, active, frame, custom, script_time, collides = state
        return int(started), bool(active), int(frame), None if custom is None else str(custom), float(script_time), bool(collides)

    def set_state(self, state: tuple[int, bool, int, str | None, float, bool]) -> None:
        """Go on from ``state``, which :meth:`state` gave."""
        self.started_ns, self.active, self._frame, self.custom, self.script_time, self.collides = state
        if self.custom is None:
            self._tell(anew=True)

    def advance(self, time_ns: int, step: float) -> None:
        """Before the step that leads to ``time_ns``."""
        if self._director is not None and not self._taken:
            self._ask()
        frame = frame_of(time_ns)
        if frame == self._frame and not self.collides:
            return
        seconds = step if self.collides and self._frame >= 0 else 0.0
        self._frame = frame
        if self.custom is not None:
            self._bend(self.model.pose, self._animation(self.custom), self.script_time, seconds)
        elif self.active:
            self._play((time_ns if self.collides else frame_time(frame)) - self.started_ns, seconds)

    def let_collide(self, link_name: str = "") -> None:
        """The shapes of the link ``link_name`` (all links) touch others from now on, but not the skin itself: it is what rays and
        cameras see.
        """
        for link in self._links:
            if link_name not in ("", link.name):
                continue
            for name, collision in link.collisions.items():
                if not name.endswith("_skin"):
                    collision.surface.collide_bitmask = 0xFFFF
                    self.collides = True

    # ------------------------------------------------------------------ where the links are

    def _animation(self, name: str) -> tuple[Animation, ActorAnimation] | None:
        return self._animations.get(name)

    def _first_animation(self) -> tuple[Animation, ActorAnimation] | None:
        moment = self.script.moment(0)
        return self._animation(moment.clip.type) if moment else None

    def _play(self, elapsed_ns: int, seconds: float) -> None:
        moment = self.script.moment(max(elapsed_ns, 0))
        if moment is None:
            return
        self.script_time = moment.time
        self._tell()
        on_path = moment.clip.path.pose(moment.time) if moment.clip.path else Pose()
        found = self._animation(moment.clip.type)
        if found is None:
            self._bend(on_path, None, 0.0, seconds)
            return
        time = self._animation_time(moment, *found)
        animation, written = found
        if not animation.moved[0]:
            self._bend(Pose(scale(on_path.p, self._actor.scale), on_path.q), found, time, seconds)
            return
        places, turns = animation.pose_at(time)
        x, y, z = (float(v) * written.scale for v in places[0])
        of_root = (0.0 if moment.clip.path else x, y, z)
        place = scale(add(on_path.p, quat_rotate(on_path.q, of_root)), self._actor.scale)  # upstream's: the path grows with the skin
        turn = quat_multiply(on_path.q, tuple(turns[0].tolist()))
        if animation.root_turn is not None:
            place, turn = quat_rotate(animation.root_turn, place), quat_multiply(animation.root_turn, turn)
        self._bend(Pose(place, turn), found, time, seconds)

    def _animation_time(self, moment: Moment, animation: Animation, written: ActorAnimation) -> float:
        if written.interpolate_x and moment.clip.path:
            time = animation.time_at(self.script.walked(moment) / written.scale)
            if time is not None:
                return time
        return moment.time

    def _bend(self, root: Pose, found: tuple[Animation, ActorAnimation] | None, time: float, seconds: float, waits: bool = False) -> None:
        """:param waits: nobody plays it yet, and it stands as its skin was bound; those who play turn the whole of it."""
        poses = self._fixed.copy()
        if self._rig is not None:
            poses[self._rows] = self._rig.bend(found, time)[self._bones]
            poses[self._rows[0]] = (0.0, 0.0, 0.0, *self._rig.stands) if waits else _NOWHERE  # the root is the model's frame
        poses[0] = (*root.p, *root.q)
        try:
            self.model.core.lead(poses, self._parents, seconds)
        except ValueError as error:  # scales and waypoints, each of which may be, lead too far together
            if not self._refused:
                self.model.world.messages.append(f"actor '{self.model.name}' stays where it is: {error}")
            self._refused = True

"""What a user holds of a simulated model: thin objects over the C++ core.

Poses ``X_WA`` are :class:`~ode_sim.description.model.Pose`; vectors are tuples of three floats in world axes; SI units.
A handle of a removed model raises ``RuntimeError`` when it would have to act.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ode_sim.core_numbers import finite, flat, pose_of, unlimited
from ode_sim.description import model as description
from ode_sim.description.model import FARTHEST, Pose, Vec3
from ode_sim.inertia import usable_inertia, usable_mass
from ode_sim.math3 import compose, inverse

if TYPE_CHECKING:
    from ode_sim import _core
    from ode_sim.world import World


class Twist(NamedTuple):
    """``linear`` m/s, ``angular`` rad/s, world axes."""

    linear: Vec3
    angular: Vec3


class JointFeedback(NamedTuple):
    """What the joint exerts on its two links: forces N, torques N m about the joint's anchor, world axes."""

    child_force: Vec3
    child_torque: Vec3
    parent_force: Vec3
    parent_torque: Vec3


class CollisionHandle:
    """One collision shape. ``surface`` (friction, stiffness, slip ...) may be changed while the world runs."""

    def __init__(self, link: LinkHandle, collision: description.Collision, core: _core.Shape) -> None:
        self.link = link
        self.description = collision
        self.name = collision.name
        self.scoped_name = f"{link.scoped_name}::{collision.name}"
        self.core = core
        self.watchers = 0  # who wants the forces of its contacts

    @property
    def id(self) -> int:
        """The number by which contacts and ray hits name it."""
        return self.core.id

    @property
    def surface(self) -> _core.Surface:
        """Mutable: mu, mu2, slip1, slip2, torsional_mu, patch_radius, kp, kd, max_vel, min_depth, restitution, bounce_threshold, fdir1 ...

        NaN is refused (ValueError); infinities and negative numbers are cut to the largest and least that can be simulated.
        """
        return self.core.surface

    @property
    def laser_retro(self) -> float:
        return self.description.laser_retro

    @property
    def pose(self) -> Pose:
        """X_WC."""
        return pose_of(self.core.pose)

    def bounding_box(self) -> tuple[Vec3, Vec3]:
        """Lower and upper corner in the world, m; infinite for a plane."""
        x0, x1, y0, y1, z0, z1 = self.core.aabb()
        return (x0, y0, z0), (x1, y1, z1)


class LinkHandle:
    """A link. Forces act in the next step only and are then cleared."""

    def __init__(self, model: ModelHandle, link: description.Link, core: _core.Link) -> None:
        self.model = model
        self.description = link
        self.name = link.name
        self.scoped_name = f"{model.name}::{link.name}"
        self.core = core
        self.collisions: dict[str, CollisionHandle] = {}
        self.lights: dict[str, description.Light] = {light.name: light for light in link.lights}  # poses in the link frame

    @property
    def index(self) -> int:
        """Row in ``world.link_poses``."""
        return self.core.row

    @property
    def pose(self) -> Pose:
        """X_WL. Setting it moves this link only (and what is rigidly joined to it); joints pull back in the next step."""
        return pose_of(self.core.pose())

    @pose.setter
    def pose(self, pose: Pose) -> None:
        self.core.set_pose(flat(pose, f"pose of link {self.scoped_name}"))

    def linear_velocity(self) -> Vec3:
        """Of the link origin."""
        return self.core.linear_velocity()

    def angular_velocity(self) -> Vec3:
        return self.core.angular_velocity()

    def com_velocity(self) -> Vec3:
        """Of the centre of mass."""
        return self.core.com_velocity()

    def com(self) -> Vec3:
        """Centre of mass in the world, m."""
        return self.core.com()

    def velocity_at(self, p_W: Vec3) -> Vec3:
        """Of the point of the link that is at ``p_W`` now."""
        return self.core.velocity_at(p_W)

    def set_twist(self, linear: Vec3, angular: Vec3) -> None:
        """Set the velocity of the centre of mass, ``linear`` (m/s, world axes), and the angular velocity, ``angular`` (rad/s)."""
        finite((*linear, *angular), f"twist of link {self.scoped_name}")
        arm = np.subtract(self.core.pose()[:3], self.core.com())
        self.core.set_twist(tuple(np.add(linear, np.cross(angular, arm))), (*angular,))

    def add_force(self, f_W: Vec3, p_W: Vec3 | None = None) -> None:
        """Force ``f_W``, N, at the point ``p_W``, m, at the centre of mass if None. Forces beyond 1e12 N are cut to it."""
        finite(f_W, f"force on link {self.scoped_name}")
        if p_W is None:
            self.core.add_force((*f_W,))
        else:
            finite(p_W, f"point of force on link {self.scoped_name}")
            self.core.add_force_at((*f_W,), (*p_W,))

    def run_belt(self, speed: float, left_W: Vec3, linear: Vec3 = (0.0, 0.0, 0.0), angular: Vec3 = (0.0, 0.0, 0.0)) -> None:
        """In the next step the surface runs round the link at ``speed`` m/s, as a track's, and drives it; ``left_W`` points to the left
        of it.

        ``linear``, ``angular``: how the link is meant to move, m/s and rad/s, world axes.
        """
        self.core.run_belt(speed, left_W, linear, angular)

    def add_torque(self, t_W: Vec3) -> None:
        """Torque ``t_W``, N m, in the next step."""
        finite(t_W, f"torque on link {self.scoped_name}")
        self.core.add_torque((*t_W,))

    def set_force(self, f_W: Vec3) -> None:
        """``f_W``, N, takes the place of all forces added for the next step."""
        finite(f_W, f"force on link {self.scoped_name}")
        self.core.set_force((*f_W,))

    def set_torque(self, t_W: Vec3) -> None:
        """``t_W``, N m, takes the place of all torques added for the next step."""
        finite(t_W, f"torque on link {self.scoped_name}")
        self.core.set_torque((*t_W,))

    def force(self) -> Vec3:
        """Set or added for the next step, N, at the centre of mass."""
        return self.core.force()

    def torque(self) -> Vec3:
        """Set or added for the next step, N m, about the centre of mass."""
        return self.core.torque()

    def applied_force(self) -> Vec3:
        """What :meth:`force` was in the last step, N."""
        return self.core.applied_force()

    def applied_torque(self) -> Vec3:
        """What :meth:`torque` was in the last step, N m."""
        return self.core.applied_torque()

    @property
    def mass(self) -> float:
        """kg."""
        return self.core.mass

    @property
    def inertia(self) -> tuple[float, ...]:
        """ixx, iyy, izz, ixy, ixz, iyz about the centre of mass in link axes, kg m^2."""
        return self.core.inertia

    @property
    def gravity(self) -> bool:
        return self.core.gravity_flag

    @gravity.setter
    def gravity(self, on: bool) -> None:
        self.core.gravity_flag = bool(on)
        self.core.changed()

    def set_inertial(self, inertial: description.Inertial) -> None:
        """New mass, centre of mass and tensor, those of ``inertial``.

        :raises ValueError: one that no body can have; nothing is changed.
        """
        where = f"link {self.scoped_name}"
        mass, problem = usable_mass(inertial.mass, where)
        tensor, second = usable_inertia(inertial, mass, where)
        if problem or second:
            raise ValueError(problem or second)
        pose = flat(inertial.pose, f"centre of mass of {where}")
        self.core.set_inertial(mass, pose[:3], tensor)


class JointHandle:
    """A joint. ``axis`` is 0, or 1 for the second axis of universal and revolute2.

    Of a screw, axis 0 is the angle, rad, and axis 1 the way along it, m; a force on the latter pulls. Those of a gearbox are the
    angles of child and parent, as its reference body sees them; nothing drives them but what drives these links.
    """

    def __init__(
        self, model: ModelHandle, joint: description.Joint, parent: LinkHandle | None, child: LinkHandle, core: _core.Joint
    ) -> None:
        self.model = model
        self.description = joint
        self.name = joint.name
        self.scoped_name = f"{model.name}::{joint.name}"
        self.parent = parent  # None: the world
        self.child = child
        self.core = core
        # The calls of every controller cycle go straight to the core.
        self.position = core.position
        self.velocity = core.velocity
        self.effort = (
            core.effort
        )  # N m or N: the sum of the forces added since the last step, after truncation; that of the step if none were
        self.motor = core.motor
        self._drive_to = core.drive_to

    @property
    def index(self) -> int:
        """Row of the first axis in ``world.joint_positions``."""
        return self.core.row

    @property
    def axis_count(self) -> int:
        return self.core.axis_count

    def add_force(self, force: float, axis: int = 0) -> None:
        """``force`` N m or N about ``axis``, for the next step.

        It is cut to the effort limit, and to 0 in the direction of motion above the velocity limit.
        """
        if not math.isfinite(force):
            raise ValueError(f"force on joint {self.scoped_name} must be a finite number, not {force}")
        self.core.add_force(force, axis)

    def add_law(self, force: float, slope: float, bound: float = math.inf, axis: int = 0) -> None:
        """The force of a controller, for the next step: ``force`` N m or N at the joint's present speed, ``slope`` less for each
        rad/s or m/s that it gets faster, and never more than ``bound``. Negative: a law of the position alone, whose ``force`` is
        taken as at rest where the joint has no friction and damping: it comes to rest instead of swinging on.

        As ``add_force`` of ``force``, cut to the bound, where that holds for a step. Where the slope would make good more than the
        whole error of the speed within one step, the force is that at the speed which the step arrives at: too high gains then drive
        the joint instead of throwing it to and fro. Not with the ``gazebo`` solver. One controller per axis and step.
        """
        finite((force, slope), f"force of a controller on joint {self.scoped_name}")
        if math.isnan(bound):
            raise ValueError(f"the bound of a controller's force on joint {self.scoped_name} must be a number")
        self.core.add_law(force, slope, bound, axis)

    def set_motor(self, velocity: float, max_force: float, axis: int = 0) -> None:
        """Drive ``axis`` to ``velocity`` (rad/s, m/s) with at most ``max_force`` (N m, N) until changed; 0 switches the motor off."""
        finite((velocity,), f"motor velocity of joint {self.scoped_name}")
        if math.isnan(max_force):
            raise ValueError(f"motor force of joint {self.scoped_name} must be a number")
        self.core.set_motor(velocity, max(max_force, 0.0), axis)

    def drive_to(self, position: float) -> None:
        """Be at ``position`` (clamped to the limits, and to 1e7) after the next step, whatever the masses, without recoil.

        The link beyond becomes rigidly joined and is moved exactly. While it, or something beyond it, touches another
        model, the joint is a motor with the effort limit instead, so that it pushes, grips and stalls.
        Revolute and prismatic joints only.
        """
        if position - position != 0.0:  # not a number, or infinite
            raise ValueError(f"position command of joint {self.scoped_name} must be a finite number, not {position}")
        self._drive_to(position)

    def drive_off(self) -> None:
        """Let go: the joint moves freely again."""
        self.core.drive_off()

    @property
    def drive_active(self) -> bool:
        return self.core.drive_mode != 0

    @property
    def drive_pushing(self) -> bool:
        """Whether the position-commanded joint is an effort-limited motor at the moment, because of a contact."""
        return self.core.drive_mode == 2

    def follow(self, leader: JointHandle | None, multiplier: float = 1.0, offset: float = 0.0) -> None:
        """Mimic: keep at ``multiplier * leader + offset`` by :meth:`drive_to`. ``None`` ends it.

        The leader may be of another model; when that is removed, the joint stays where it was commanded last.
        """
        finite((multiplier, offset), f"mimic of joint {self.scoped_name}")
        self.core.follow(leader.core if leader else None, multiplier, offset)

    def set_position(self, q: float, axis: int = 0) -> bool:
        """Teleport ``axis``: what is beyond moves along, its velocities become zero; ``q`` (rad, m) is clamped to the limits.

        :returns: False for a joint in a closed loop, which stays as it is.
        :raises ValueError: no number, or a place beyond what can be simulated.
        """
        finite((q,), f"position of joint {self.scoped_name}")
        return self.core.set_position(q, axis)

    def limits(self, axis: int = 0) -> tuple[float, float]:
        """Lower and upper of ``axis``, rad or m; infinite = none."""
        return self.core.get(axis)[:2]

    def set_limits(self, lower: float, upper: float, axis: int = 0) -> None:
        """Let ``axis`` move from ``lower`` to ``upper`` (rad, m; infinity is no limit). :raises ValueError: no position is between them."""
        if not lower <= upper:
            raise ValueError(f"joint {self.scoped_name}: lower limit {lower} is above upper limit {upper}")
        if unlimited(lower) == math.inf or unlimited(upper) == -math.inf:
            raise ValueError(f"joint {self.scoped_name}: no position is between {lower:g} and {upper:g}")
        self._set(axis, 0, unlimited(lower), unlimited(upper))

    @property
    def damping(self) -> float:
        """N m s/rad or N s/m, first axis."""
        return self.core.get(0)[4]

    @damping.setter
    def damping(self, value: float) -> None:
        self._set(0, 4, max(float(value), 0.0))

    @property
    def friction(self) -> float:
        """Coulomb friction, N m or N, first axis. A motor takes its place while it runs."""
        return self.core.get(0)[5]

    @friction.setter
    def friction(self, value: float) -> None:
        self._set(0, 5, max(float(value), 0.0))

    @property
    def effort_limit(self) -> float:
        """-1 = unlimited."""
        return self.core.get(0)[2]

    @property
    def velocity_limit(self) -> float:
        """-1 = unlimited."""
        return self.core.get(0)[3]

    def _set(self, axis: int, first: int, *values: float) -> None:
        if any(math.isnan(v) for v in values):
            raise ValueError(f"joint {self.scoped_name}: a parameter must not be NaN")
        if not 0 <= axis < self.axis_count:
            raise ValueError(f"joint {self.scoped_name} has {self.axis_count} axes, there is no axis {axis}")
        numbers = list(self.core.get(axis))
        numbers[first : first + len(values)] = values
        self.core.set_axis(axis, self.description.axes[axis].xyz, *numbers)

    def feedback(self) -> JointFeedback:
        """Force and torque of the last step. The first call asks for them: they are there after the next step."""
        self.core.watch()
        return JointFeedback(*self.core.feedback())

    def anchor(self) -> Vec3:
        """Joint origin in the world, as the child carries it, m."""
        return self.core.frame()[:3]

    def frame(self) -> Pose:
        """X_WJ, the joint frame as the child carries it."""
        return pose_of(self.core.frame())

    def world_axis(self, axis: int = 0) -> Vec3:
        """Unit vector along ``axis``."""
        from_parent = pose_of(self.core.parent_frame() if axis == 0 else self.core.frame())
        return compose(Pose(q=from_parent.q), Pose(p=self.description.axes[axis].xyz)).p

    def set_param(self, name: str, value: float) -> None:
        """By ODE's and Gazebo's name: fmax, vel, hi_stop, lo_stop, stop_erp, stop_cfm, friction, damping, thread_pitch, gearbox_ratio.

        :raises ValueError: there is no such parameter, or the value is none for it.
        """
        velocity, force = self.core.motor(0) if self.axis_count else (0.0, 0.0)
        setters = {
            "fmax": lambda: self.set_motor(velocity, value),
            "vel": lambda: self.set_motor(value, force),
            "hi_stop": lambda: self.set_limits(self.limits()[0], value),
            "lo_stop": lambda: self.set_limits(value, self.limits()[1]),
            "stop_erp": lambda: self._set_stop("stop_erp", value),
            "stop_cfm": lambda: self._set_stop("stop_cfm", value),
            "friction": lambda: setattr(self, "friction", value),
            "damping": lambda: setattr(self, "damping", value),
            "thread_pitch": lambda: setattr(self.core, "thread_pitch", value),  # rad/m
            "gearbox_ratio": lambda: setattr(self.core, "gear_ratio", value),
        }
        if name not in setters:
            raise ValueError(f"joint {self.scoped_name} has no parameter '{name}'; there are {', '.join(setters)}")
        setters[name]()

    def _set_stop(self, name: str, value: float) -> None:
        setattr(self.core, name, value)
        self.core.changed()


class ModelHandle:
    """A model in the world. ``links`` and ``joints`` are in file order."""

    def __init__(self, world: World, name: str, model: description.Model, pose: Pose, core: _core.Model) -> None:
        self.world = world
        self.name = name
        self.description = model
        self.initial_pose = pose  # X_WM
        self.core = core
        self.links: dict[str, LinkHandle] = {}
        self.joints: dict[str, JointHandle] = {}
        self._X_LM = Pose()  # model frame in the first link's frame

    @property
    def parts(self) -> tuple[LinkHandle | JointHandle, ...]:
        """Links and joints: what may have sensors."""
        return (*self.links.values(), *self.joints.values())

    @property
    def static(self) -> bool:
        return self.core.is_static

    @property
    def asleep(self) -> bool:
        """At rest and left out of the simulation until something touches it."""
        return self.core.asleep

    @property
    def canonical_link(self) -> LinkHandle | None:
        """The first link: the model frame is fixed to it."""
        return next(iter(self.links.values()), None)

    @property
    def pose(self) -> Pose:
        """X_WM. Setting it moves all links rigidly, and the place where the model is bolted to the world."""
        link = self.canonical_link
        return compose(link.pose, self._X_LM) if link else self.initial_pose

    @pose.setter
    def pose(self, pose: Pose) -> None:
        if self.links:
            now = self.pose
            self.core.set_pose((*now.p, *now.q), flat(pose, f"pose of model {self.name}"))

    def twist(self) -> Twist:
        """Of the first link: of its centre of mass."""
        link = self.canonical_link
        return Twist(link.com_velocity(), link.angular_velocity()) if link else Twist((0, 0, 0), (0, 0, 0))

    def set_twist(self, linear: Vec3, angular: Vec3) -> None:
        """The same velocity of the centre of mass, ``linear`` (m/s), and angular velocity, ``angular`` (rad/s), for every link."""
        for link in self.links.values():
            link.set_twist(linear, angular)

    def move_as_one(self, linear: Vec3, angular: Vec3, origin_W: Vec3) -> None:
        """The first link gets ``linear`` (m/s, at the point ``origin_W``) and ``angular`` (rad/s); the others go along, their joints go
        on.
        """
        link = self.canonical_link
        if link:
            finite((*linear, *angular), f"twist of model {self.name}")
            self.core.add_twist(
                tuple(np.subtract(linear, link.velocity_at(origin_W))), tuple(np.subtract(angular, link.angular_velocity())), (*origin_W,)
            )

    @property
    def flown_apart(self) -> bool:
        """Whether some link is where no joint can have taken it."""
        base = self.pose.p
        far = max((abs(x - x0) for link in self.links.values() for x, x0 in zip(link.pose.p, base)), default=0.0)
        return far > FARTHEST / 10 or max(map(abs, base)) > FARTHEST

    def put_together(self) -> None:
        """Every link where the description has it relative to the model, as with all joints at zero."""
        if self.static or len(self.links) < 2:
            return
        base = self.pose
        for link in self.links.values():
            pose = compose(base, link.description.pose)
            link.core.set_pose((*pose.p, *pose.q))

    def remove(self) -> None:
        self.world.remove(self.name)

    def bind(self) -> None:
        """Fix the model frame to the first link, as they are now."""
        link = self.canonical_link
        if link:
            self._X_LM = compose(inverse(link.pose), self.initial_pose)

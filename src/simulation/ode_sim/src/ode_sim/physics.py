"""The settings of the physics, and within what bounds a world can run with them."""

from __future__ import annotations

import math
import os
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from ode_sim.description.model import Physics, Vec3

if TYPE_CHECKING:
    from ode_sim import _core

STRONGEST_GRAVITY = 1e6  # m/s^2, of each component


class Bounds(NamedTuple):
    """What a setting may be: from ``least`` to ``most``, or 0 where ``or_zero``."""

    least: float
    most: float
    unit: str = ""
    or_zero: bool = False

    def hold(self, value: float) -> bool:
        """Whether ``value`` may be. A NaN may not."""
        return self.least <= value <= self.most or (self.or_zero and value == 0)  # never for a NaN

    def __str__(self) -> str:
        return f"{'0 or ' if self.or_zero else ''}{self.least:g} to {self.most:g}{' ' if self.unit else ''}{self.unit}"


# A step below a microsecond loses its length in the nanoseconds of the clock; one above a second is no simulation any more.
# The upper bounds of the counts keep a step from taking seconds; those of iterations are what upstream lets dynamic_reconfigure set.
BOUNDS: dict[str, Bounds] = {
    "max_step_size": Bounds(1e-6, 1.0, "s"),
    "real_time_update_rate": Bounds(1e-3, 1e9, "Hz", or_zero=True),
    "real_time_factor": Bounds(0.0, 1e9),
    "max_contacts": Bounds(1, 10_000_000),
    "iters": Bounds(1, 10_000),
    "precon_iters": Bounds(0, 10_000),
    "sor": Bounds(1e-6, 10.0),
    "cfm": Bounds(0.0, 1e3),
    "erp": Bounds(0.0, 10.0),
    "contact_max_correcting_vel": Bounds(0.0, 1e10, "m/s"),
    "contact_surface_layer": Bounds(0.0, 1e3, "m"),
}


def check_physics(physics: Physics, gravity: Vec3 | None = None) -> Physics:
    """``physics`` with whole numbers where counts are wanted; nothing is changed anywhere.

    :param gravity: m/s^2, checked too if given.
    :raises ValueError: one line that names the first setting that no world can run with, and what it may be.
    """
    if gravity is not None:
        check_gravity(gravity)
    return replace(physics, **{name: check_setting(name, getattr(physics, name)) for name in BOUNDS})


def check_gravity(gravity: Vec3) -> Vec3:
    """``gravity`` as three floats, m/s^2.

    :raises ValueError: not three finite numbers, or beyond :data:`STRONGEST_GRAVITY`.
    """
    try:
        x, y, z = (float(g) for g in gravity)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"gravity must be three numbers, not {_shown(gravity)}") from None
    if not all(abs(g) <= STRONGEST_GRAVITY for g in (x, y, z)):
        raise ValueError(f"gravity must be finite numbers of at most {STRONGEST_GRAVITY:g} m/s^2, not {x:g} {y:g} {z:g}")
    return x, y, z


def check_setting(name: str, value: Any) -> Any:
    """``value`` of the setting ``name``, converted to the type that the description has for it.

    :raises ValueError: out of bounds, or not a number where one is wanted.
    """
    if name not in BOUNDS:
        return value
    bounds = BOUNDS[name]
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"physics parameter {name} must be a number, {bounds}, not {_shown(value)}") from None
    if not bounds.hold(number):
        raise ValueError(f"physics parameter {name} must be {bounds}, not {number:g}")
    return int(number) if isinstance(getattr(Physics, name), int) else number


def usable_physics(physics: Physics) -> tuple[Physics, list[str]]:
    """The settings as near as possible to ``physics``, those of a file, and one line for each that had to be changed."""
    changed: dict[str, Any] = {}
    lines = []
    for name, bounds in BOUNDS.items():
        value = getattr(physics, name)
        try:
            changed[name] = check_setting(name, value)
        except ValueError as error:
            default = getattr(Physics, name)
            number = float(value) if isinstance(value, (int, float)) else math.nan
            nearest = default if math.isnan(number) else min(max(number, bounds.least), bounds.most)
            changed[name] = type(default)(nearest)
            lines.append(f"{error}; {changed[name]:g} is used")
    return replace(physics, **changed), lines


#: ``gazebo``: contacts, joints and friction as Gazebo Classic solves them, with its faults; any other name: this project's own solvers.
GAZEBO = "gazebo"
SOLVER_VARIABLE = "ODE_SIM_SOLVER"


class PhysicsSettings:
    """The fields of :class:`ode_sim.description.model.Physics`; setting one takes effect in the next step.

    ``solver`` is what the world file says in ``<physics><ode><solver><type>``; the environment variable ``ODE_SIM_SOLVER``, when
    set, counts instead of what a world starts with. A value that no world can run with raises ``ValueError`` and changes nothing.
    """

    _IN_CORE = {
        "max_step_size": "dt",
        "max_contacts": "max_contacts",
        "iters": "iters",
        "sor": "sor",
        "cfm": "cfm",
        "erp": "erp",
        "contact_max_correcting_vel": "contact_max_vel",
        "contact_surface_layer": "surface_layer",
    }
    _NAMES = tuple(field.name for field in fields(Physics))

    def __init__(self, core: _core.World, physics: Physics) -> None:
        object.__setattr__(self, "_core", core)
        object.__setattr__(self, "_others", {})
        wanted = os.environ.get(SOLVER_VARIABLE, "").strip()
        self.update(replace(physics, solver=wanted) if wanted else physics)

    def update(self, physics: Physics) -> None:
        """Take over all settings of ``physics``, or none.

        :raises ValueError: as :func:`check_physics`.
        """
        checked = check_physics(physics)
        for name in self._NAMES:
            self._put(name, getattr(checked, name))

    def record(self) -> Physics:
        """All settings as they are now."""
        return Physics(**{name: getattr(self, name) for name in self._NAMES})

    def _put(self, name: str, value: Any) -> None:
        if name in self._IN_CORE:
            setattr(self._core, self._IN_CORE[name], value)
        else:
            self._others[name] = value
            if name == "solver":
                self._core.like_gazebo = str(value).strip().lower() == GAZEBO

    def __getattr__(self, name: str) -> Any:
        if name in self._IN_CORE:
            return getattr(self._core, self._IN_CORE[name])
        if name in self._NAMES:
            return self._others[name]
        raise AttributeError(f"physics has no parameter '{name}'; there are {', '.join(self._NAMES)}")

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._NAMES:
            raise AttributeError(f"physics has no parameter '{name}'; there are {', '.join(self._NAMES)}")
        self._put(name, check_setting(name, value))


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."

"""What a plugin is given, as types: a plugin in Python is written, and checked, against these, without the server.

``Server`` is the server as one plugin sees it, ``Sensor`` what a sensor plugin measures with. Models, links and joints are those of
``ode_sim``; ``SdfElement`` is :class:`gazebo_ros.SdfElement`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    import rospy
    from ode_sim import World
    from ode_sim.description import ResourceFinder
    from ode_sim.description import model as d
    from ode_sim.handles import JointHandle, LinkHandle, ModelHandle

_Result = TypeVar("_Result")


class Connection(Protocol):
    """A callback of the step loop."""

    def disconnect(self) -> None:
        """It is not called any more; the server does this when the model is deleted."""


class Server(Protocol):
    """Step callbacks made through it end with the plugin."""

    world: World
    description: d.World
    finder: ResourceFinder
    lockstep: bool  #: a step waits for the pictures that it asks for

    @property
    def paused(self) -> bool: ...

    def now(self) -> rospy.Time:
        """Sim time of the current step (of the last one, between steps)."""

    def call(self, f: Callable[[], _Result]) -> _Result:
        """Run ``f()`` in the physics thread between two steps: the only way for another thread to touch the world."""

    def before_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step before collision and dynamics, after sim time has advanced."""

    def after_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step when poses, velocities and contacts are those at :meth:`now`."""

    def unpause(self) -> None:
        """Let the simulation run. Any thread."""

    def step(self) -> None:
        """One step though paused; returns when it is done. Not in the physics thread."""

    def drives(self, *joints: JointHandle) -> None:
        """The plugin moves these joints from now on. Where two say so of the same joint, one warning names both."""


class Sensor(Protocol):
    """A sensor on a link, or of a joint, of a simulated model."""

    description: d.Sensor
    link: LinkHandle  #: of a joint's sensor the joint's child
    joint: JointHandle | None  #: whose sensor it is; None of a link's
    model: ModelHandle
    measurement_ns: int  #: sim time of the newest update

    @property
    def name(self) -> str: ...

    @property
    def scoped_name(self) -> str:
        """``model::link::sensor`` or ``model::joint::sensor``"""

    @property
    def type(self) -> str: ...

    @property
    def measurement_time(self) -> rospy.Time: ...

    def pictured(self, measured_ns: int) -> None:
        """For cameras: a picture of the update at ``measured_ns`` has been published. Any thread."""

    def connect(self, measure: Callable[[Any], None], wanted: Callable[[], bool] = ...) -> None:
        """Call ``measure(sensor)`` in the physics thread at every update while ``wanted()`` is true."""

"""What the simulator and the render process say to each other (pickled over a socket)."""

from __future__ import annotations

from dataclasses import dataclass

from ode_sim_rendering.camera import Camera, Fan
from ode_sim_rendering.scene import SceneDescription


@dataclass(frozen=True)
class SetScene:
    scene: SceneDescription


@dataclass(frozen=True)
class AddCamera:
    """``depth_range``: m, (lowest, highest) valid depth, exclusive; ``seed``: of the noise; ``fan``: it is a lidar."""

    key: int
    camera: Camera
    seed: int
    depth_range: tuple[float, float]
    fan: Fan | None = None


@dataclass(frozen=True)
class ForgetCamera:
    key: int


@dataclass(frozen=True)
class Draw:
    """``outputs``: see :data:`ode_sim_rendering.process.OUTPUTS`; ``poses``: bytes of the (L,7) float64 link poses;
    ``offset``, ``room``: where in shared memory the results go."""

    frame: int
    key: int
    outputs: tuple[str, ...]
    time_ns: int
    poses: bytes
    offset: int
    room: int


@dataclass(frozen=True)
class Done:
    """``stored``: output -> (offset, length) in shared memory."""

    frame: int
    stored: dict[str, tuple[int, int]]


@dataclass(frozen=True)
class Failed:
    frame: int
    reason: str


@dataclass(frozen=True)
class DrawnBy:
    """What draws: a graphics card's name, or the software's."""

    device: str


@dataclass(frozen=True)
class Problems:
    """Lines about what cannot be drawn as described."""

    lines: list[str]

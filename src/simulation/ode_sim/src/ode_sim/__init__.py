"""Robot simulation without ROS: descriptions, physics, sensors, rendering.

    world = ode_sim.World.load("arm.world")
    arm = world.spawn_urdf(text, name="arm")
    world.step(1000)

Its parts are loaded when they are first asked for: programs that only show or describe worlds start without the physics.
"""

from importlib import import_module
from pkgutil import extend_path
from typing import TYPE_CHECKING, Any

__path__ = extend_path(__path__, __name__)  # the compiled core lies in the devel space, whichever path comes first

if TYPE_CHECKING:
    from ode_sim.attachment import Attachment
    from ode_sim.collision_meshes import prepare
    from ode_sim.description.model import DescriptionError, Pose, Problem
    from ode_sim.handles import CollisionHandle, JointFeedback, JointHandle, LinkHandle, ModelHandle, Twist
    from ode_sim.world import Snapshot, World

__all__ = [
    "Attachment",
    "CollisionHandle",
    "DescriptionError",
    "JointFeedback",
    "JointHandle",
    "LinkHandle",
    "ModelHandle",
    "Pose",
    "Problem",
    "Snapshot",
    "Twist",
    "World",
    "prepare",
]

_PLACES = {
    "attachment": ("Attachment",),
    "collision_meshes": ("prepare",),
    "description.model": ("DescriptionError", "Pose", "Problem"),
    "handles": ("CollisionHandle", "JointFeedback", "JointHandle", "LinkHandle", "ModelHandle", "Twist"),
    "world": ("Snapshot", "World"),
}
_WHERE = {name: module for module, names in _PLACES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name in _WHERE:
        value = globals()[name] = getattr(import_module(f"{__name__}.{_WHERE[name]}"), name)
        return value
    try:
        return import_module(f"{__name__}.{name}")  # ode_sim.math3 after `import ode_sim` alone
    except ModuleNotFoundError as error:
        if error.name != f"{__name__}.{name}":
            raise
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'") from None

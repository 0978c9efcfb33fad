"""A window onto a world, in a web browser: drawn, played, paused and edited there.

::

    from ode_sim import World
    from ode_sim_viewer import LocalSimulation, Page
    with Page(LocalSimulation(World.load("arm.world"))) as page:
        print(page.address)
        page.run()

======================  =========================================================================================
``simulation``          what the page wants of a simulator: :class:`Simulation`, its records
``local``               a world in this process as a simulation
``website``             the web server: who may open the page (loopback, token, origin)
``porter``              hands the page out while the web server is being loaded
``page``                the page: draws, and joins the parts below
``drawing``             models and lights
``overlays``            collisions, centres of mass, inertias, joints, frames, labels
``selection``           what is picked, its gizmo, copy, delete, undo
``shapes resizing``     simple shapes; other sizes for simple shapes, typed or by hand
``pulling``             a body pulled at with the mouse
``placing pointer``     what is inserted hangs at the pointer until a click puts it down
``contacts arrows``     where bodies touch and with what force; forces as arrows
``surfaces saving``     colours of a running world; the world as a file
``movie``               films (MP4)
``eye``                 from where a page looks at first
``panels``              one module for each tab
======================  =========================================================================================

Needs the PyPI package viser (scripts/requirements.txt).
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ode_sim_viewer.simulation import Frame, ModelRecord, Refused, Simulation, WorldRecord

__all__ = ["Frame", "LocalSimulation", "ModelRecord", "Page", "Refused", "Simulation", "WorldRecord"]

_LATER = {"LocalSimulation": "local", "Page": "page"}  # a server that only describes its world loads no web server


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(f"{__name__}.{_LATER.get(name, 'simulation')}"), name)

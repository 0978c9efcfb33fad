"""Pictures of a world, off screen: colour, depth and segmentation images.

:class:`Renderer` draws a scene in this process, :func:`render` the world as it is now, :class:`RenderProcess`
beside it.
"""

from importlib import import_module
from typing import Any

from ode_sim_rendering.camera import ENCODINGS, Camera, CameraError, Distortion, WideLens, look_at, read_camera, read_distortion
from ode_sim_rendering.context import RenderingUnavailable, create_context
from ode_sim_rendering.process import OUTPUTS, Frame, RenderProcess
from ode_sim_rendering.scene import SceneDescription, arrange, describe

__all__ = [
    "Camera",
    "CameraError",
    "Distortion",
    "ENCODINGS",
    "Frame",
    "NOTHING",
    "OUTPUTS",
    "RenderProcess",
    "Renderer",
    "RenderingUnavailable",
    "SceneDescription",
    "WideLens",
    "arrange",
    "create_context",
    "describe",
    "look_at",
    "read_camera",
    "read_distortion",
    "render",
    "segment_names",
]

# Drawing in this process needs OpenCV, half a second to load; a simulator draws in another and comes up without it.
_DRAWING = {"NOTHING": "target", "Renderer": "renderer", "render": "live", "segment_names": "live"}


def __getattr__(name: str) -> Any:
    if name not in _DRAWING:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(f"{__name__}.{_DRAWING[name]}"), name)

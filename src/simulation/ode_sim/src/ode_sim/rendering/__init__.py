"""Pictures of a world, off screen: colour, depth and segmentation images.

:class:`Renderer` draws a scene in this process, :func:`render` the world as it is now, :class:`RenderProcess`
beside it.
"""
from ode_sim.rendering.camera import ENCODINGS, Camera, CameraError, Distortion, look_at, read_camera, read_distortion
from ode_sim.rendering.context import RenderingUnavailable, create_context
from ode_sim.rendering.live import render, segment_names
from ode_sim.rendering.process import OUTPUTS, Frame, RenderProcess
from ode_sim.rendering.renderer import NOTHING, Renderer
from ode_sim.rendering.scene import SceneDescription, arrange, describe

__all__ = ["Camera", "CameraError", "Distortion", "ENCODINGS", "Frame", "NOTHING", "OUTPUTS", "RenderProcess",
           "Renderer", "RenderingUnavailable", "SceneDescription", "arrange", "create_context", "describe", "look_at",
           "read_camera", "read_distortion", "render", "segment_names"]

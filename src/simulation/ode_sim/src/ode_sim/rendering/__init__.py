"""Pictures of a world, off screen: colour, depth and segmentation images. See :class:`Renderer` and :class:`Camera`."""
from ode_sim.rendering.camera import ENCODINGS, Camera, CameraError, Distortion, look_at, read_camera
from ode_sim.rendering.context import RenderingUnavailable, create_context
from ode_sim.rendering.renderer import NOTHING, Renderer
from ode_sim.rendering.scene import SceneDescription, arrange, describe

__all__ = ["Camera", "CameraError", "Distortion", "ENCODINGS", "NOTHING", "Renderer", "RenderingUnavailable",
           "SceneDescription", "arrange", "create_context", "describe", "look_at", "read_camera"]

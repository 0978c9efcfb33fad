"""Meshes and images as OpenGL has them, each handed over once."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any, NamedTuple

import numpy as np
from ode_sim.description.model import TextureUnit, one_line

from ode_sim_rendering.assets import Assets, Look, Part
from ode_sim_rendering.geometry import texture_coordinates

_WIDEST_TEXTURE = 4096  # pixels along a side
_NEAREST, _LINEAR, _LINEAR_MIPMAP_LINEAR = 0x2600, 0x2601, 0x2703  # OpenGL's: moderngl is loaded with the first context


class ImageKey(NamedTuple):
    """A file, and what a material says of how it is looked up."""

    file: str
    address: str
    smooth: bool
    holes: bool  # whether its alpha counts


class MeshKey(NamedTuple):
    """A mesh of the assets, and how an image lies on it (None: there is none)."""

    name: Hashable
    matrix: tuple[float, ...] | None


def image_of(look: Look) -> ImageKey | None:
    """The image of a look, if it has one."""
    unit = look.texture_unit
    holes = look.blend == "alpha_blend" or look.alpha_above is not None
    return ImageKey(look.texture, unit.address, unit.smooth, holes) if look.texture else None


def mesh_of(part: Part) -> MeshKey:
    """The mesh of a part, with the texture coordinates of its look."""
    return MeshKey(part.key, part.look.texture_unit.matrix if part.look.texture else None)


class Buffers:
    """What is on the card; to be used while ``context``, a moderngl one, is current."""

    def __init__(self, context: Any, assets: Assets):
        self._ctx = context
        self._assets = assets
        self._widest = min(_WIDEST_TEXTURE, context.info["GL_MAX_TEXTURE_SIZE"])
        self._meshes: dict[MeshKey, tuple[Any, Any]] = {}
        self._textures: dict[ImageKey, Any] = {}

    def take(self, part: Part, name: str) -> bool:
        """Whether OpenGL has taken the mesh of ``part``, and its texture if it has one; else a problem is noted.

        :param name: scoped, of the visual that it belongs to.
        """
        image, mesh = image_of(part.look), mesh_of(part)
        try:
            self.mesh(mesh)
            if image and image not in self._textures:
                self._textures[image] = None
                self._textures[image] = self._make_texture(image, self._assets.texture(image.file, name, self._widest))
        except Exception as error:  # a mesh that is no mesh, no more memory: the rest is drawn all the same
            self._assets.note(name, f"is not drawn as it should be: {one_line(error, 200).strip() or type(error).__name__}")
        return mesh in self._meshes

    def texture(self, image: ImageKey) -> Any:
        """The texture, or None where it could not be made. :raises KeyError: it was not taken."""
        return self._textures[image]

    def mesh(self, key: MeshKey) -> tuple[Any, Any]:
        """(vertices, triangles): buffers of float32 position, normal, texture coordinates with v downwards; and of uint32."""
        if key not in self._meshes:
            mesh = self._assets.meshes[key.name]
            uv = np.zeros((len(mesh.vertices), 2)) if key.matrix is None else texture_coordinates(mesh, TextureUnit(key.matrix))
            vertices = np.concatenate([mesh.vertices, mesh.normals, uv * [1, -1] + [0, 1]], axis=1).astype("f4")
            self._meshes[key] = (self._ctx.buffer(vertices.tobytes()), self._ctx.buffer(mesh.triangles.astype("u4").tobytes()))
        return self._meshes[key]

    def _make_texture(self, image: ImageKey, pixels: np.ndarray | None) -> Any:
        if pixels is None:
            return None
        pixels = pixels[::-1].copy()  # its first row on top, as v runs in the buffers
        if not image.holes:
            pixels[..., 3] = 255
        texture = self._ctx.texture((pixels.shape[1], pixels.shape[0]), 4, pixels.tobytes())
        texture.build_mipmaps()
        texture.filter = (_LINEAR_MIPMAP_LINEAR, _LINEAR) if image.smooth else (_NEAREST, _NEAREST)
        texture.repeat_x = texture.repeat_y = image.address not in ("clamp", "border")
        return texture

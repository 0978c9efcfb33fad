"""Shadow map of the sun: where its rays end, drawn once per change of the poses and shared by all cameras."""

from __future__ import annotations

from typing import Any

import numpy as np

_SIZE = 2048  # texels along a side
_REACH = 25.0  # m around the camera, where the scene is larger; a texel is then 2.4 cm
_TO_TEXTURE = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])


class ShadowMap:
    """Depth texture seen along one direction."""

    def __init__(self, ctx: Any):
        self._texture = ctx.depth_texture((_SIZE, _SIZE))
        self._texture.compare_func = "<="
        self._texture.repeat_x = self._texture.repeat_y = False
        self._frame = ctx.framebuffer([], self._texture)
        self._drawn: bytes | None = None
        self._matrix = np.eye(4)

    def aim(self, direction: np.ndarray, centres: np.ndarray, radii: np.ndarray, eye: np.ndarray) -> np.ndarray:
        """Fit the map around the casters' bounding spheres (``centres`` (P,3), ``radii`` (P,), world frame, m).

        :param direction: (3,) unit vector of the rays. :param eye: (3,) m: where a map that cannot hold all is laid around.
        :return: (4,4) clip matrix from the world frame.
        """
        z = -direction
        x = np.cross((0.0, 0.0, 1.0) if abs(z[2]) < 0.9 else (0.0, 1.0, 0.0), z)
        x /= np.linalg.norm(x)
        R_SW = np.stack([x, np.cross(z, x), z])
        p, r = centres @ R_SW.T, radii[:, None]
        low, high = (p - r).min(axis=0), (p + r).max(axis=0)
        if (high - low)[:2].max() > 2 * _REACH:
            middle = (R_SW @ eye)[:2]
            low[:2], high[:2] = np.maximum(low[:2], middle - _REACH), np.minimum(high[:2], middle + _REACH)
        size = np.maximum(high - low, 1e-3)
        self._matrix = np.eye(4)
        self._matrix[:3, :3] = R_SW * (2 / size * (1, 1, -1))[:, None]
        self._matrix[:3, 3] = -(high + low) / size * (1, 1, -1)
        return self._matrix

    def begin(self, key: bytes) -> bool:
        """Make the map current and clear it; False if it already shows ``key``."""
        if key == self._drawn:
            return False
        self._drawn = key
        self._frame.use()
        self._frame.clear(depth=1.0)
        return True

    def forget(self) -> None:
        """The scene changed: draw anew."""
        self._drawn = None

    def bind(self, program: Any, unit: int = 1) -> None:
        """Let ``program`` (moderngl's) read the map from the texture ``unit``."""
        self._texture.use(unit)
        program["shadow_map"].value = unit
        program["shadow_matrix"].write((_TO_TEXTURE @ self._matrix).T.astype("f4").tobytes())

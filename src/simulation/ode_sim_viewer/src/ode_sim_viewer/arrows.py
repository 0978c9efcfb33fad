"""Forces as arrows, and the places where they act."""

from __future__ import annotations

from typing import Any

import numpy as np

from ode_sim_viewer.drawing import take_away

_THICK = 0.006  # m
_LEAST, _MOST = 0.01, 2.0  # m: shorter ones are not drawn, longer ones are cut


def arrow_points(places: np.ndarray, vectors: np.ndarray, scale: float) -> np.ndarray:
    """(M, 2, 3) from each of ``places`` (N, 3) along its one of ``vectors`` (N, 3) times ``scale``; only those long enough to be seen."""
    tips = np.asarray(vectors, float) * scale
    length = np.linalg.norm(tips, axis=1)
    good = np.isfinite(length) & (length >= _LEAST) & np.isfinite(places).all(axis=1)
    tips = tips[good] * np.minimum(1.0, _MOST / length[good])[:, None]
    begin = np.asarray(places, float)[good]
    return np.stack([begin, begin + tips], axis=1).astype(np.float32)


class Forces:
    """Arrows in the world that change with every call of :meth:`show`; none are left by :meth:`hide`.

    :param node: name of the scene node; its parent may be a link. :param colour: 0 to 255
    """

    def __init__(self, scene: Any, node: str, colour: tuple[int, int, int], dots: bool = False):
        self._scene = scene
        self._node = node
        self._colour = colour
        self._dots = dots
        self._arrows: Any | None = None
        self._points: Any | None = None

    def show(self, places: np.ndarray, vectors: np.ndarray, scale: float) -> int:
        """How many arrows there are now.

        :param places, vectors: (N, 3) m and N. :param scale: m of an arrow for each N
        """
        arrows = arrow_points(places, vectors, scale)
        if not len(arrows):
            _without(self._arrows)
            self._arrows = None
        elif self._arrows is None:
            self._arrows = self._scene.add_arrows(
                f"{self._node}/arrows", arrows, self._colour, shaft_radius=_THICK, head_radius=2.5 * _THICK, head_length=6 * _THICK
            )
        else:
            self._arrows.points = arrows
        if self._dots:
            self._show_dots(np.asarray(places, np.float32))
        return len(arrows)

    def _show_dots(self, places: np.ndarray) -> None:
        if not len(places):
            _without(self._points)
            self._points = None
        elif self._points is None:
            self._points = self._scene.add_point_cloud(
                f"{self._node}/places", places, colors=(220, 30, 30), point_size=0.02, point_shape="circle", precision="float32"
            )
        else:
            self._points.points = places

    def hide(self) -> None:
        _without(self._arrows)
        _without(self._points)
        self._arrows = self._points = None


def _without(node: Any | None) -> None:
    if node is not None:
        take_away(node)

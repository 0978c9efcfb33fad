"""What is drawn into: frame buffers whose images become arrays."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from ode_sim.math3 import Vec3

NOTHING = -1  # of a segmentation image: no visual there


class Target:
    """Frame buffer of ``width`` x ``height`` pixels for some ``outputs``, with ``samples`` for each pixel, or not multi-sampled (0).

    :param ctx: moderngl's.
    """

    _KINDS = {"color": (4, "f1"), "depth": (1, "f4"), "ident": (1, "f4")}

    def __init__(self, ctx: Any, width: int, height: int, outputs: tuple[str, ...], samples: int):
        self._ctx, self._shape, self._outputs = ctx, (height, width), outputs
        self.frame, self._single = self._make(samples)
        self._plain = self._make(0)[0] if samples else self.frame

    def _make(self, samples: int) -> tuple[Any, list[Any]]:
        size = self._shape[::-1]
        images = [
            self._ctx.renderbuffer(size, components, samples=samples, dtype=kind)
            for components, kind in (self._KINDS[name] for name in self._outputs)
        ]
        depth = self._ctx.depth_renderbuffer(size, samples=samples)
        # each image alone as well: a clear of several at once would give them all one value
        single = [self._ctx.framebuffer([image], depth) for image in images]
        return (single[0] if len(images) == 1 else self._ctx.framebuffer(images, depth)), single

    def clear(self, background: Vec3) -> None:
        """Set background colour, no depth, no visual, and make the frame buffer current."""
        values = {"color": (*background[:3], 1.0), "depth": (np.inf,) * 4, "ident": (NOTHING,) * 4}
        for name, frame in zip(self._outputs, self._single):
            frame.clear(*values[name])
        self.frame.use()

    def read(self) -> dict[str, np.ndarray]:
        if self._plain is not self.frame:
            self._ctx.copy_framebuffer(self._plain, self.frame)
        pictures = {}
        for attachment, name in enumerate(self._outputs):
            if name == "color":
                pixels = np.frombuffer(self._plain.read(components=4, attachment=attachment), np.uint8)
                pictures[name] = cv2.cvtColor(pixels.reshape(*self._shape, 4), cv2.COLOR_RGBA2RGB)
            else:
                pixels = np.frombuffer(self._plain.read(components=1, attachment=attachment, dtype="f4"), np.float32)
                pixels = pixels.reshape(self._shape)
                pictures[name] = pixels.copy() if name == "depth" else pixels.astype(np.int32)
        return pictures

"""Rotations by the thousand: arrays (..., 4) of x y z w."""

from __future__ import annotations

import numpy as np


def normalized(q: np.ndarray) -> np.ndarray:
    """``q`` (..., 4) with unit length; what has none is no rotation."""
    length = np.linalg.norm(q, axis=-1, keepdims=True)
    if length.size and length.min() > 1e-12:
        return q / length
    return np.where(length > 1e-12, np.divide(q, length, out=np.zeros_like(q), where=length > 1e-12), [0.0, 0.0, 0.0, 1.0])


def slerp(a: np.ndarray, b: np.ndarray, part: np.ndarray | float) -> np.ndarray:
    """From ``a`` to ``b`` the short way at a constant rate; ``part`` of it is done, 0 to 1, (..., 1) or a number."""
    cosine = np.sum(a * b, axis=-1, keepdims=True)
    b = np.where(cosine < 0.0, -b, b)
    angle = np.arccos(np.clip(np.abs(cosine), 0.0, 1.0))
    sine = np.sin(angle)
    near = sine < 1e-6
    safe = np.where(near, 1.0, sine)
    first = np.where(near, 1.0 - part, np.sin((1.0 - part) * angle) / safe)
    second = np.where(near, part, np.sin(part * angle) / safe)
    return normalized(first * a + second * b)


def from_matrices(m: np.ndarray) -> np.ndarray:
    """Of ``m`` (..., 3, 3); what they scale by is left out, neighbours in the first axis are on the same side."""
    length = np.linalg.norm(m, axis=-2, keepdims=True)
    m = np.divide(m, length, out=np.zeros_like(m), where=length > 1e-12)
    xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    squares = np.stack([1.0 + xx - yy - zz, 1.0 - xx + yy - zz, 1.0 - xx - yy + zz, 1.0 + xx + yy + zz], axis=-1)
    largest = np.argmax(squares, axis=-1)
    yz, zx, xy = m[..., 2, 1], m[..., 0, 2], m[..., 1, 0]
    zy, xz, yx = m[..., 1, 2], m[..., 2, 0], m[..., 0, 1]
    rows = np.stack(
        [
            np.stack([squares[..., 0], xy + yx, zx + xz, yz - zy], axis=-1),
            np.stack([xy + yx, squares[..., 1], yz + zy, zx - xz], axis=-1),
            np.stack([zx + xz, yz + zy, squares[..., 2], xy - yx], axis=-1),
            np.stack([yz - zy, zx - xz, xy - yx, squares[..., 3]], axis=-1),
        ],
        axis=-2,
    )
    chosen = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
    return normalized(chosen)


def to_matrices(q: np.ndarray) -> np.ndarray:
    """(..., 3, 3) of ``q``."""
    x, y, z, w = np.moveaxis(q, -1, 0)
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

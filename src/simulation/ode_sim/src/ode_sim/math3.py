"""Poses, quaternions and vectors in plain floats.

Quaternions are (x, y, z, w), unit length, and turn vectors of frame B into frame A: ``v_A = R_AB v_B``.
Roll, pitch, yaw are about the fixed axes x, y, z in that order (URDF, SDF). For arrays of many poses use NumPy;
for one at a time these are several times faster.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

Vec3 = tuple[float, float, float]
Quat = tuple[float, float, float, float]
Mat3 = tuple[Vec3, Vec3, Vec3]


@dataclass(frozen=True)
class Pose:
    """Rigid transform X_AB, the pose of frame B in A: ``p`` metres, ``q`` unit quaternion (x, y, z, w)."""

    p: Vec3 = (0.0, 0.0, 0.0)
    q: Quat = (0.0, 0.0, 0.0, 1.0)


IDENTITY = Pose()


# ---------------------------------------------------------------------------------------------- vectors


def vec3(values: Iterable[float]) -> Vec3:
    """Three numbers of any kind, ``values``, such as an array's."""
    x, y, z = values
    return float(x), float(y), float(z)


def add(a: Vec3, b: Vec3) -> Vec3:
    """``a`` + ``b``."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec3, b: Vec3) -> Vec3:
    """``a`` - ``b``."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vec3, s: float) -> Vec3:
    """``a`` times ``s``."""
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a: Vec3, b: Vec3) -> float:
    """The scalar product of ``a`` and ``b``."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    """The vector product ``a`` x ``b``."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: Vec3) -> float:
    """The length of ``a``."""
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def unit(a: Vec3) -> Vec3:
    """``a`` scaled to length 1; a null vector stays null."""
    n = norm(a)
    return (a[0] / n, a[1] / n, a[2] / n) if n > 0.0 else a


# ---------------------------------------------------------------------------------------------- quaternions


def quat_multiply(a: Quat, b: Quat) -> Quat:
    """q_AC from ``a``, q_AB, and ``b``, q_BC."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def quat_inverse(q: Quat) -> Quat:
    """q_BA of a unit ``q``, q_AB."""
    return (-q[0], -q[1], -q[2], q[3])


def quat_normalize(q: Sequence[float]) -> Quat:
    """``q`` with unit length; a null quaternion becomes the identity, as ROS messages filled with zeros mean it."""
    x, y, z, w = q
    n = math.sqrt(x * x + y * y + z * z + w * w)
    return (x / n, y / n, z / n, w / n) if n > 0.0 else (0.0, 0.0, 0.0, 1.0)


def quat_rotate(q: Quat, v: Vec3) -> Vec3:
    """v_A of ``v``, v_B, for a unit ``q``, q_AB."""
    x, y, z, w = q
    tx = 2.0 * (y * v[2] - z * v[1])
    ty = 2.0 * (z * v[0] - x * v[2])
    tz = 2.0 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def quat_from_axis_angle(axis: Vec3, angle: float) -> Quat:
    """Turn by ``angle`` (rad) about ``axis`` (any length but null)."""
    ax, ay, az = unit(axis)
    s = math.sin(0.5 * angle)
    return (ax * s, ay * s, az * s, math.cos(0.5 * angle))


def quat_from_rpy(roll: float, pitch: float, yaw: float) -> Quat:
    """The rotation of ``roll``, ``pitch`` and ``yaw``, rad, about the fixed axes x, y, z in that order."""
    cr, sr = math.cos(0.5 * roll), math.sin(0.5 * roll)
    cp, sp = math.cos(0.5 * pitch), math.sin(0.5 * pitch)
    cy, sy = math.cos(0.5 * yaw), math.sin(0.5 * yaw)
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def quat_to_rpy(q: Quat) -> Vec3:
    """Roll, pitch, yaw of ``q`` in rad, pitch within +-pi/2. At pitch +-pi/2 the roll is 0 and the yaw carries the turn."""
    x, y, z, w = q
    sin_pitch = 2.0 * (w * y - z * x)
    if abs(sin_pitch) > 1.0 - 1e-14:
        return (0.0, math.copysign(0.5 * math.pi, sin_pitch), math.atan2(2.0 * (w * z - x * y), 1.0 - 2.0 * (x * x + z * z)))
    # the distance from the z axis keeps the pitch accurate near +-pi/2, where asin is not
    cos_pitch = math.hypot(1.0 - 2.0 * (y * y + z * z), 2.0 * (w * z + x * y))
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        math.atan2(sin_pitch, cos_pitch),
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )


def quat_to_matrix(q: Quat) -> Mat3:
    """R_AB as three rows, of ``q``, q_AB."""
    x, y, z, w = q
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
        (2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
        (2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)),
    )


def quat_from_matrix(r: Sequence[Sequence[float]]) -> Quat:
    """Unit quaternion of ``r``, a proper rotation matrix (rows)."""
    (a, b, c), (d, e, f), (g, h, i) = r
    trace = a + e + i
    if trace > 0.0:
        s = 2.0 * math.sqrt(trace + 1.0)
        q = ((h - f) / s, (c - g) / s, (d - b) / s, 0.25 * s)
    elif a >= e and a >= i:
        s = 2.0 * math.sqrt(1.0 + a - e - i)
        q = (0.25 * s, (b + d) / s, (c + g) / s, (h - f) / s)
    elif e >= i:
        s = 2.0 * math.sqrt(1.0 + e - a - i)
        q = ((b + d) / s, 0.25 * s, (f + h) / s, (c - g) / s)
    else:
        s = 2.0 * math.sqrt(1.0 + i - a - e)
        q = ((c + g) / s, (f + h) / s, 0.25 * s, (d - b) / s)
    return quat_normalize(q)


def quat_between(a: Vec3, b: Vec3) -> Quat:
    """The shortest turn that takes the direction of ``a`` into that of ``b``."""
    a, b = unit(a), unit(b)
    w = 1.0 + dot(a, b)
    if w < 1e-12:  # opposite: half a turn about any perpendicular axis
        axis = cross((1.0, 0.0, 0.0), a) if abs(a[0]) < 0.9 else cross((0.0, 1.0, 0.0), a)
        return (*unit(axis), 0.0)
    return quat_normalize((*cross(a, b), w))


def slerp(a: Quat, b: Quat, t: float) -> Quat:
    """Along the shorter arc from ``a`` (t = 0) to ``b`` (t = 1)."""
    c = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    if c < 0.0:
        b, c = (-b[0], -b[1], -b[2], -b[3]), -c
    if c > 0.9995:  # nearly parallel: the chord is the arc
        u, v = 1.0 - t, t
    else:
        angle = math.acos(c)
        u, v = math.sin((1.0 - t) * angle), math.sin(t * angle)
    return quat_normalize((u * a[0] + v * b[0], u * a[1] + v * b[1], u * a[2] + v * b[2], u * a[3] + v * b[3]))


# ---------------------------------------------------------------------------------------------- poses


def compose(x_ab: Pose, x_bc: Pose) -> Pose:
    """X_AC = X_AB X_BC, of ``x_ab`` and ``x_bc``."""
    return Pose(add(x_ab.p, quat_rotate(x_ab.q, x_bc.p)), quat_multiply(x_ab.q, x_bc.q))


def inverse(x_ab: Pose) -> Pose:
    """X_BA of ``x_ab``."""
    q = quat_inverse(x_ab.q)
    return Pose(scale(quat_rotate(q, x_ab.p), -1.0), q)


def relative(x_wa: Pose, x_wb: Pose) -> Pose:
    """X_AB = X_WA^-1 X_WB, of ``x_wa`` and ``x_wb``."""
    return compose(inverse(x_wa), x_wb)


def transform(x_ab: Pose, p_b: Vec3) -> Vec3:
    """The point ``p_b`` of frame B, in A, for ``x_ab``, X_AB."""
    return add(x_ab.p, quat_rotate(x_ab.q, p_b))


def rotate(x_ab: Pose, v_b: Vec3) -> Vec3:
    """The free vector ``v_b`` of frame B, in A, for ``x_ab``, X_AB."""
    return quat_rotate(x_ab.q, v_b)


def from_rpy(x: float = 0.0, y: float = 0.0, z: float = 0.0, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> Pose:
    """The pose at ``x``, ``y``, ``z`` (m) turned by ``roll``, ``pitch``, ``yaw`` (rad, about the fixed axes in that order)."""
    return Pose((x, y, z), quat_from_rpy(roll, pitch, yaw))


def to_rpy(pose: Pose) -> Vec3:
    """Roll, pitch, yaw of ``pose``, rad, as :func:`quat_to_rpy`."""
    return quat_to_rpy(pose.q)


def to_matrix(pose: Pose) -> tuple[tuple[float, float, float, float], ...]:
    """4x4 homogeneous matrix of ``pose``, rows."""
    r = quat_to_matrix(pose.q)
    return ((*r[0], pose.p[0]), (*r[1], pose.p[1]), (*r[2], pose.p[2]), (0.0, 0.0, 0.0, 1.0))


def from_matrix(m: Sequence[Sequence[float]]) -> Pose:
    """Of ``m``, a 4x4 (or 3x4) homogeneous matrix with a proper rotation."""
    return Pose((float(m[0][3]), float(m[1][3]), float(m[2][3])), quat_from_matrix([[float(v) for v in row[:3]] for row in m[:3]]))


# ---------------------------------------------------------------------------------------------- inertia


def mat3(rows: Sequence[Sequence[float]]) -> Mat3:
    """``rows``, three of three numbers, as tuples."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    return (a, b, c), (d, e, f), (g, h, i)


def rotate_inertia(q_ab: Quat, i_b: Sequence[Sequence[float]]) -> Mat3:
    """The tensor ``i_b`` (rows, kg m^2 about one point) given in the axes of B, in those of A for ``q_ab``: R I R^T."""
    r = quat_to_matrix(q_ab)
    ri = [[sum(r[i][k] * i_b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    rows = [[sum(ri[i][k] * r[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
    return mat3(rows)

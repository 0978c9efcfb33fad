"""How a rigid body moves on by itself: constant acceleration in the body's axes. No ROS in it.

State (15): x, y, z (m, world), roll, pitch, yaw (rad), vx, vy, vz (m/s, body), their angular rates (rad/s, body), ax, ay, az
(m/s², body).
"""

import numpy as np

SIZE = 15
POSITION, ORIENTATION, VELOCITY, RATE, ACCELERATION = (slice(start, start + 3) for start in range(0, SIZE, 3))
PLANAR_OUT = (2, 3, 4, 8, 9, 10, 14)  # what does not move on the ground: z, roll, pitch and what belongs to them
_STEEP = 1e-6  # rad; nearer to straight up or down, roll and yaw cannot be told apart


def wrap(angle):
    """``angle``, or an array of them, rad, into [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def rotation(rpy) -> np.ndarray:
    """(3, 3): from the body's axes into the world's, for fixed-axis roll, pitch, yaw, ``rpy`` (REP-103). Or (N, 3) to (N, 3, 3)."""
    (sr, sp, sy), (cr, cp, cy) = np.moveaxis(np.sin(rpy), -1, 0), np.moveaxis(np.cos(rpy), -1, 0)
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _rates(rpy) -> np.ndarray:
    """(..., 3, 3): from the body's rates to those of roll, pitch and yaw."""
    roll, pitch = rpy[..., 0], rpy[..., 1]
    cp = np.cos(pitch)
    cp = np.where(np.abs(cp) < _STEEP, np.copysign(_STEEP, cp), cp)
    sr, cr, tp = np.sin(roll), np.cos(roll), np.sin(pitch) / cp
    one, zero = np.ones_like(roll), np.zeros_like(roll)
    rows = [[one, sr * tp, cr * tp], [zero, cr, -sr], [zero, sr / cp, cr / cp]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def moved(states: np.ndarray, dt: float) -> np.ndarray:
    """(..., 15) states after dt seconds; angles are not wrapped."""
    after = states.copy()
    rpy = states[..., ORIENTATION]
    way = states[..., VELOCITY] * dt + 0.5 * states[..., ACCELERATION] * dt**2
    after[..., POSITION] += np.einsum("...ij,...j->...i", rotation(rpy), way)
    after[..., ORIENTATION] += dt * np.einsum("...ij,...j->...i", _rates(rpy), states[..., RATE])
    after[..., VELOCITY] += dt * states[..., ACCELERATION]
    return after


def jacobian(state: np.ndarray, dt: float) -> np.ndarray:
    """(15, 15): d moved / d ``state`` for ``dt`` s. Straight up or down it is that of the bound of the rates, see :func:`moved`."""
    roll, pitch, yaw = state[ORIENTATION]
    way = state[VELOCITY] * dt + 0.5 * state[ACCELERATION] * dt**2
    _, q, r = state[RATE] * dt
    (sr, sp, sy), (cr, cp, cy) = np.sin((roll, pitch, yaw)), np.cos((roll, pitch, yaw))
    turn, rates = rotation(state[ORIENTATION]), _rates(state[ORIENTATION])
    change = np.eye(SIZE)
    change[POSITION, VELOCITY], change[POSITION, ACCELERATION] = turn * dt, turn * (0.5 * dt**2)
    change[ORIENTATION, RATE] = rates * dt
    change[VELOCITY, ACCELERATION] = np.eye(3) * dt
    after = turn @ way
    change[POSITION, 3] = turn[:, 2] * way[1] - turn[:, 1] * way[2]
    change[POSITION, 4] = np.array([cy, sy, 0.0]) * after[2] - np.array([0.0, 0.0, cy * after[0] + sy * after[1]])
    change[POSITION, 5] = -after[1], after[0], 0.0
    cp = cp if abs(cp) >= _STEEP else np.copysign(_STEEP, cp)
    aside, along = cr * q - sr * r, sr * q + cr * r
    change[3:6, 3] += np.array([aside * sp / cp, -along, aside / cp])
    change[3:6, 4] += np.array([along, 0.0, along * sp]) / cp**2
    return change

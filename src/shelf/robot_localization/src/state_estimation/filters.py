"""The extended and the unscented Kalman filter over the motion of a rigid body. No ROS in it."""

from dataclasses import dataclass

import numpy as np

from .motion import ORIENTATION, PLANAR_OUT, POSITION, RATE, SIZE, VELOCITY, jacobian, moved, wrap

_LEAST_VARIANCE = 1e-9
_PLANAR_VARIANCE = 1e-6
_ANGLES = np.zeros(SIZE, bool)
_ANGLES[ORIENTATION] = True
PROCESS_NOISE = np.diag([0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015])
INITIAL_COVARIANCE = np.eye(SIZE) * 1e-9


@dataclass
class Measurement:
    """Values of some of the 15 entries of the state.

    ``used`` (15,) bool, ``values`` (15,), ``covariance`` (15, 15), ``time`` s, ``threshold``: Mahalanobis distance beyond which
    it is thrown away.
    """

    name: str
    time: float
    used: np.ndarray
    values: np.ndarray
    covariance: np.ndarray
    threshold: float = np.inf


class Ekf:
    """The extended Kalman filter."""

    def __init__(
        self,
        process_noise: np.ndarray = PROCESS_NOISE,
        covariance: np.ndarray = INITIAL_COVARIANCE,
        planar: bool = False,
        dynamic_noise: bool = False,
    ):
        """:param process_noise: (15, 15), for one second
        :param covariance: (15, 15), of the state before the first measurement
        :param planar: the robot stays on the ground: z, roll, pitch and what belongs to them are zero
        :param dynamic_noise: a robot at rest does not become less certain of its pose
        """
        self.state, self.covariance = np.zeros(SIZE), covariance.copy()
        self.process_noise, self._planar, self._dynamic = process_noise, planar, dynamic_noise
        self.time: float | None = None  # s, of the newest measurement that went in, or of a prediction beyond it

    def process(self, measurement: Measurement) -> bool:
        """Predict to the measurement's time and correct by it. One older than the estimate corrects it as if it were of now.

        Returns whether it was used: not if it is beyond its threshold.
        """
        if self.time is None:
            self._start(measurement)
            return True
        self.predict(measurement.time - self.time)
        return self.correct(measurement)

    def _start(self, measurement: Measurement) -> None:
        used = measurement.used
        self.state[used] = measurement.values[used]
        block = np.ix_(used, used)
        self.covariance[block] = np.where(
            np.eye(used.sum(), dtype=bool),
            np.maximum(np.abs(measurement.covariance[block]), _LEAST_VARIANCE),
            measurement.covariance[block],
        )
        self.time = measurement.time
        self._flatten()

    def predict(self, dt: float) -> None:
        """Move on by dt seconds; nothing happens for dt <= 0, nor before the first measurement."""
        if dt <= 0 or self.time is None:
            return
        noise = self._noise() * dt
        self._propagate(dt, noise)
        self.state[_ANGLES] = wrap(self.state[_ANGLES])
        self.time += dt
        self._flatten()

    def _propagate(self, dt: float, noise: np.ndarray) -> None:
        change = jacobian(self.state, dt)
        self.state = moved(self.state, dt)
        self.covariance = change @ self.covariance @ change.T + noise

    def _noise(self) -> np.ndarray:
        if not self._dynamic:
            return self.process_noise
        scale = np.ones(SIZE)
        scale[POSITION] = np.minimum(np.abs(self.state[VELOCITY]).max(), 1.0)
        scale[ORIENTATION] = np.minimum(np.abs(self.state[RATE]).max(), 1.0)
        return self.process_noise * np.sqrt(np.outer(scale, scale))

    def _flatten(self) -> None:
        """On the ground the state stays there."""
        if self._planar:
            self.state[list(PLANAR_OUT)] = 0.0

    def _on_ground(self, measurement: Measurement):
        """(used, values, covariance) with the zeros of the ground put in."""
        used, values, covariance = measurement.used.copy(), measurement.values.copy(), measurement.covariance.copy()
        if self._planar:
            out = list(PLANAR_OUT)
            used[out], values[out] = True, 0.0
            covariance[out, :], covariance[:, out] = 0.0, 0.0
            covariance[out, out] = _PLANAR_VARIANCE
        return used, values, covariance

    def correct(self, measurement: Measurement) -> bool:
        used, values, covariance = self._on_ground(measurement)
        used &= np.isfinite(values)
        noise = covariance[np.ix_(used, used)]
        np.fill_diagonal(noise, np.maximum(np.abs(np.diag(noise)), _LEAST_VARIANCE))
        expected, innovation_covariance, cross = self._observe(used)
        innovation = values[used] - expected
        angles = _ANGLES[used]
        innovation[angles] = wrap(innovation[angles])
        total = innovation_covariance + noise
        # The ground's zeros say nothing about an outlier.
        told = measurement.used[used]
        if np.isfinite(measurement.threshold) and told.any():
            inner = np.ix_(told, told)
            if innovation[told] @ np.linalg.solve(total[inner], innovation[told]) > measurement.threshold**2:
                return False
        gain = np.linalg.solve(total, cross.T).T
        self.state = self.state + gain @ innovation
        self._update_covariance(gain, used, noise, total)
        self.state[_ANGLES] = wrap(self.state[_ANGLES])
        self._flatten()
        return True

    def _observe(self, used: np.ndarray):
        """(expected values, their covariance, covariance of the state with them) of the used entries."""
        return self.state[used], self.covariance[np.ix_(used, used)], self.covariance[:, used]

    def _update_covariance(self, gain, used, noise, _total) -> None:
        rest = np.eye(SIZE) - gain @ np.eye(SIZE)[used]
        self.covariance = rest @ self.covariance @ rest.T + gain @ noise @ gain.T  # Joseph's form stays positive


class Ukf(Ekf):
    """The unscented Kalman filter: moves 31 points of the covariance's ellipsoid instead of a derivative."""

    def __init__(self, *arguments, alpha: float = 0.001, kappa: float = 0.0, beta: float = 2.0, **options):
        super().__init__(*arguments, **options)
        self._spread = alpha**2 * (SIZE + kappa)
        shift = self._spread - SIZE
        self._mean_weights = np.full(2 * SIZE + 1, 0.5 / self._spread)
        self._weights = self._mean_weights.copy()
        self._mean_weights[0] = shift / self._spread
        self._weights[0] = self._mean_weights[0] + 1 - alpha**2 + beta

    def _propagate(self, dt: float, noise: np.ndarray) -> None:
        ahead = moved(self._points(), dt)
        offsets = ahead - ahead[0]  # angles are those of one turn: no wrapping within
        mean = self._mean_weights @ offsets
        spread = offsets - mean
        self.state = ahead[0] + mean
        self.covariance = (self._weights[:, None] * spread).T @ spread + noise

    def _points(self) -> np.ndarray:
        """(31, 15)"""
        values, axes = np.linalg.eigh((self.covariance + self.covariance.T) / 2)
        # Where the state is uncertain by whole turns, the points' weights may leave a variance below zero.
        root = (axes * np.sqrt(self._spread * np.maximum(values, 0.0))).T
        return np.vstack([self.state, self.state + root, self.state - root])

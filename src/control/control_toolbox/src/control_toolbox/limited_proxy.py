"""Proxy-based sliding mode control with velocity, acceleration and effort limits.

A virtual mass (the proxy) is coupled to the joint by a PID spring and tracks the target on a sliding surface. The
effort limit bounds the coupling, so that a blocked joint is left by a proxy that waits nearby instead of winding up.
"""

from __future__ import annotations

import math


def _clamp(value: float, bound: float) -> float:
    return min(max(value, -bound), bound)


class LimitedProxy:
    """Position control that comes back gently after a large error.

    :param mass: of the proxy (kg or kg m^2); 0 makes it follow without inertia of its own.
    :param kp, ki, kd: coupling between proxy and joint; ``ficl`` bounds its integral effort.
    :param effort_limit: of the coupling (N or Nm).
    :param acc_converge: deceleration used when planning the approach (rad/s^2 or m/s^2).
    :param lam: bandwidth of the approach near the target (1/s).
    :param vel_limit, acc_limit: of the proxy.
    """

    def __init__(
        self,
        mass: float = 1.0,
        kp: float = 0.0,
        ki: float = 0.0,
        kd: float = 0.0,
        ficl: float = 0.0,
        effort_limit: float = math.inf,
        acc_converge: float = 1.0,
        lam: float = 1.0,
        vel_limit: float = math.inf,
        acc_limit: float = math.inf,
    ):
        self.mass, self.kp, self.ki, self.kd, self.ficl = mass, kp, ki, kd, ficl
        self.effort_limit, self.acc_converge, self.lam = effort_limit, acc_converge, lam
        self.vel_limit, self.acc_limit = vel_limit, acc_limit
        self.reset(0.0, 0.0)

    def reset(self, position: float, velocity: float) -> None:
        """Put the proxy on the joint, at ``position`` (rad or m) and ``velocity`` (rad/s or m/s), and forget the integral."""
        self.position = position
        self.velocity = velocity
        self._integral = 0.0

    def _approach(self, error: float) -> float:
        """Velocity with which the proxy should close ``error``: linear nearby, square root (constant deceleration)
        far away, the two meeting smoothly."""
        knee = self.acc_converge / (self.lam * self.lam)
        if abs(error) <= knee:
            velocity = self.lam * error
        else:
            velocity = math.copysign(math.sqrt(self.acc_converge * (2.0 * abs(error) - knee)), error)
        return _clamp(velocity, self.vel_limit)

    def update(self, pos_target: float, vel_target: float, acc_target: float, position: float, velocity: float, dt: float) -> float:
        """One step. :return: effort on the joint (N or Nm); 0 where ``dt`` is not positive.

        :param pos_target, vel_target, acc_target: what the joint is to do (rad or m, and its derivatives by s).
        :param position, velocity: what the joint does, measured (rad or m, rad/s or m/s).
        :param dt: s since the step before.
        """
        if dt <= 0.0:
            return 0.0
        wanted = _clamp(vel_target + self._approach(pos_target - self.position), self.vel_limit)
        acceleration = _clamp(acc_target + (wanted - self.velocity) / dt, self.acc_limit)
        proxy_velocity = _clamp(self.velocity + acceleration * dt, self.vel_limit)
        integral = _clamp(self._integral + self.ki * (self.position - position) * dt, self.ficl)
        # The effort is linear in the proxy's velocity: effort = slope * velocity + rest.
        slope = self.kp * dt + self.kd + self.mass / dt
        rest = self.kp * (self.position - position) + integral - self.kd * velocity - self.mass * self.velocity / dt
        unlimited = slope * proxy_velocity + rest
        effort = _clamp(unlimited, self.effort_limit)
        if effort == unlimited:
            self._integral = integral
        elif slope > 0.0:
            proxy_velocity = (effort - rest) / slope  # the joint cannot follow: the proxy waits where it pulls enough
        self.velocity = proxy_velocity
        self.position += proxy_velocity * dt
        return effort

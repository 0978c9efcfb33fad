"""Geometry of a base with four steered and driven wheels. Knows no ROS.

Angles are those of the wheels to the left of straight ahead, rad; wheel speeds are in rad/s; the base frame lies midway
between the axles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

STANDSTILL = 1e-3  # m/s; slower bases do not turn their wheels
STRAIGHT = 1e-3  # rad


class Axle(NamedTuple):
    """Steering angles and speeds of the two wheels of an axle."""

    left_angle: float
    right_angle: float
    left_speed: float = 0.0
    right_speed: float = 0.0


@dataclass(frozen=True)
class Base:
    """Lengths in m.

    :param steering_track: distance between the steering axes of an axle's two wheels
    :param y_offset: distance from a steering axis outwards to the middle of its wheel
    """

    steering_track: float
    wheel_base: float
    wheel_radius: float
    y_offset: float

    def from_twist(self, linear: float, angular: float) -> tuple[Axle, Axle]:
        """(front, rear) that move the base at ``linear`` (m/s) and ``angular`` (rad/s); the axles steer opposite ways.

        The base turns about a point outside of its track; when asked for a tighter turn it steers as far as it can.
        """
        left_speed, right_speed = self._speeds(linear, angular, 0.5 * self.wheel_base * angular)
        if abs(2.0 * linear) > abs(angular * self.steering_track):
            left = math.atan(angular * self.wheel_base / (2.0 * linear - angular * self.steering_track))
            right = math.atan(angular * self.wheel_base / (2.0 * linear + angular * self.steering_track))
        else:
            left = right = math.copysign(0.5 * math.pi, angular) if abs(linear) > STANDSTILL else 0.0
        return Axle(left, right, left_speed, right_speed), Axle(-left, -right, left_speed, right_speed)

    def from_steering(self, speed: float, front: float, rear: float) -> tuple[Axle, Axle]:
        """(front, rear) that move the base at ``speed`` (m/s).

        :param front, rear: steering angles of the middles of the axles, rad
        """
        tan_front, tan_rear = math.tan(front), math.tan(rear)
        length = self.wheel_base
        shift = 0.5 * self.steering_track * (tan_front - tan_rear)
        angular = speed * (tan_front - tan_rear) / length
        axles = []
        for tangent in (tan_front, tan_rear):
            left = right = 0.0
            if abs(length - abs(shift)) > 1e-3:
                left = math.atan(length * tangent / (length - shift))
                right = math.atan(length * tangent / (length + shift))
            difference = math.tan(left) - math.tan(right)
            lever = 0.0
            if abs(difference) > 0.01:
                lever = math.tan(left) * math.tan(right) * self.steering_track / difference
            axles.append(Axle(left, right, *self._speeds(speed, angular, lever * angular)))
        return axles[0], axles[1]

    def _speeds(self, linear: float, angular: float, lateral: float) -> tuple[float, float]:
        """Wheel speeds of an axle that goes ``linear`` forward and ``lateral`` to the left (m/s)."""
        if abs(linear) <= STANDSTILL:
            return 0.0, 0.0
        half = 0.5 * self.steering_track * angular
        inner = self.y_offset * angular
        return (
            (math.copysign(math.hypot(linear - half, lateral), linear) - inner) / self.wheel_radius,
            (math.copysign(math.hypot(linear + half, lateral), linear) + inner) / self.wheel_radius,
        )

    def motion(self, front: Axle, rear: Axle) -> tuple[float, float, float]:
        """(forward m/s, to the left m/s, rad/s) of a base whose wheels do what ``front`` and ``rear`` say, the best fit to all four."""
        angles = axle_angle(front), axle_angle(rear)
        bend = math.tan(angles[0]) - math.tan(angles[1])
        speeds, rates = [], []
        for axle, angle in zip((front, rear), angles):
            curvature = math.cos(angle) * bend / self.wheel_base
            across = self.steering_track * curvature
            # what each wheel would do if the middle of the axle went 1 m/s, m/s
            left = math.sqrt(max(0.0, 1.0 - across * math.cos(angle) + 0.25 * across**2)) - self.y_offset * curvature
            right = math.sqrt(max(0.0, 1.0 + across * math.cos(angle) + 0.25 * across**2)) + self.y_offset * curvature
            speeds.append(self.wheel_radius * (left * axle.left_speed + right * axle.right_speed) / (left * left + right * right))
            rates.append(speeds[-1] * curvature)
        linear = 0.5 * sum(speed * math.cos(angle) for speed, angle in zip(speeds, angles))
        # the yaw adds as much to the sideways motion of one axle as it takes from the other
        lateral = 0.5 * sum(speed * math.sin(angle) for speed, angle in zip(speeds, angles))
        return linear, lateral, 0.5 * sum(rates)


def axle_angle(axle: Axle) -> float:
    """Steering angle of the middle of an axle, rad."""
    if abs(axle.left_angle) <= STRAIGHT and abs(axle.right_angle) <= STRAIGHT:
        return 0.0
    left, right = math.tan(axle.left_angle), math.tan(axle.right_angle)
    return math.atan(2.0 * left * right / (left + right)) if left + right != 0.0 else 0.0

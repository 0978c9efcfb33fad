"""A sensor has a rate of its own, and some plugins one more: of two that do not fit, less is left than either says."""

from __future__ import annotations

import rospy
from node_signals.rates import LatenessKept, Spaced

_NS = 1_000_000_000
_SECONDS = 10
_KEPT = 0.9  # of the lesser rate
_MOST_STEPS = 50_000  # that are counted; the world stands still meanwhile


def left_of(sensor_rate: float, plugin_rate: float, dt: float) -> float:
    """Measurements a second of sim time that pass both gates.

    :param sensor_rate: Hz of ``<update_rate>``, 0: every step
    :param plugin_rate: Hz of the plugin's own, 0: all
    :param dt: s of a step
    """
    step = max(round(dt * _NS), 1)
    sensor, plugin = LatenessKept(sensor_rate), Spaced(plugin_rate)
    return sum(sensor.due(now) and plugin.due(now) for now in range(step, _SECONDS * _NS + 1, step)) / _SECONDS


def tell_what_is_left(sensor, plugin_rate: float, tag: str, dt: float) -> None:
    """Warn, once, where the gates of ``sensor`` and of its plugin leave less than the lesser of both.

    :param plugin_rate: Hz. :param tag: of the plugin, which gives that
    :param dt: s of a step
    """
    own = sensor.description.update_rate
    if own <= 0.0 or plugin_rate <= 0.0 or _SECONDS / dt > _MOST_STEPS:
        return
    left, wanted = left_of(own, plugin_rate, dt), min(own, plugin_rate)
    if left < _KEPT * min(wanted, 1.0 / dt):
        rospy.logwarn(
            "sensor '%s' of model '%s' gives %.3g messages a second of simulated time, not the %.3g that are asked for: of its %g a second "
            "(<update_rate>) the plugin takes those that are 1/%g s or more apart (<%s>). Write the rate that you want into <update_rate>, "
            "and twice as much or more into <%s>",
            sensor.name,
            sensor.model.name,
            left,
            wanted,
            own,
            plugin_rate,
            tag,
            tag,
        )

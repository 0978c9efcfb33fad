"""The node joy_remap.py: another order of axes and buttons, as parameters say it in small formulas."""

from __future__ import annotations

import sys

import node_signals
import rospy
from sensor_msgs.msg import Joy

from .formula import Formula


class Remap:
    """What ``~mappings/axes`` and ``~mappings/buttons`` make of a message.

    :raises ValueError: one of them is no list of formulas.
    """

    def __init__(self, axes: object, buttons: object):
        self.axes, self.buttons = _formulas("axes", axes), _formulas("buttons", buttons)
        self._told: set[str] = set()

    def message(self, seen: Joy) -> Joy:
        """What is made of ``seen``, the same moment; an entry that this joystick cannot give is 0, and told once."""
        made = Joy(header=seen.header)
        made.axes = [float(self._value(formula, seen)) for formula in self.axes]
        made.buttons = [int(self._value(formula, seen) > 0) for formula in self.buttons]
        return made

    def _value(self, formula: Formula, seen: Joy) -> float:
        try:
            return formula.value(seen.axes, seen.buttons)
        except (IndexError, ArithmeticError, TypeError) as error:
            if formula.text not in self._told:
                self._told.add(formula.text)
                reason = error if isinstance(error, IndexError) else f"'{formula.text}': {error}"
                rospy.logerr("%s; 0 is told instead", reason)
            return 0.0


def _formulas(name: str, given: object) -> list[Formula]:
    if not isinstance(given, list):
        raise ValueError(f"parameter ~mappings/{name} must be a list of formulas, not {given!r}")
    try:
        return [Formula(text) for text in given]
    except ValueError as error:
        raise ValueError(f"parameter ~mappings/{name}: {error}") from None


def main() -> int:
    node_signals.init_node("joy_remap")
    try:
        remap = Remap(rospy.get_param("~mappings/axes", []), rospy.get_param("~mappings/buttons", []))
    except ValueError as error:
        print(f"joy_remap: {error}", file=sys.stderr)
        return 1
    rospy.loginfo("loaded remapping: %d buttons, %d axes", len(remap.buttons), len(remap.axes))
    for name in ("joy_out", "joy_in"):
        if rospy.remap_name(name) == name:
            rospy.logwarn("topic '%s' is not remapped", name)
    publisher = rospy.Publisher("joy_out", Joy, queue_size=1)
    rospy.Subscriber("joy_in", Joy, lambda seen: publisher.publish(remap.message(seen)), queue_size=rospy.get_param("~queue_size", None))
    node_signals.spin()
    return 0

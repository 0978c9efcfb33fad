"""Expressions on messages, without ROS."""

from types import SimpleNamespace

import pytest
from topic_relays.expressions import ExpressionError, compute, fill, modules

M = SimpleNamespace(data="chassis", x=3.0, points=[1, 2, 3])


def test_fields_are_expressions_and_the_rest_stays():
    tree = {"header": {"seq": 7, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": "m.data"}, "on": True, "x": "m.x * 2", "frame": "base link"}
    assert fill(tree, M) == {
        "header": {"seq": 7, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": "chassis"},
        "on": True,
        "x": 6.0,
        "frame": "base link",
    }
    assert fill(["m.x", 1.5, "now"], M) == [3.0, 1.5, "now"]


def test_what_the_message_lacks_is_said():
    with pytest.raises(ExpressionError, match="'m.y': AttributeError: .*no attribute 'y'"):
        fill({"x": "m.y"}, M)


def test_modules_and_what_is_not_there():
    names, absent = modules(["math", "os.path", "no_such_module"])
    assert absent == ("no_such_module",)
    assert compute("math.sqrt(m.x + 1) + len(os.path.sep)", M, names) == 3.0
    assert compute("[m.x for _ in m.points]", M, names) == [3.0] * 3
    with pytest.raises(ExpressionError, match="NameError: name 'numpy' is not defined"):
        compute("numpy.pi", M, names)

import math
import xml.etree.ElementTree as ET

import pytest
from gazebo_ros import SdfElement


def element(text):
    lines = []
    return SdfElement(ET.fromstring(f"<plugin name='p'>{text}</plugin>"), lines.append), lines


@pytest.mark.parametrize(
    "text, default, value",
    [
        ("<a> 30.0 </a>", 0.0, 30.0),
        ("<a>0.3m</a>", 0.0, 0.3),
        ("<a>-1e-3</a>", 0.0, -1e-3),
        ("<a>.5</a>", 0.0, 0.5),
        ("<a>12.9</a>", 0, 12),
        ("<a>inf</a>", 0.0, math.inf),
        ("<a>TRUE</a>", False, True),
        ("<a>1</a>", False, True),
        ("<a>yes</a>", True, False),
        ("<a>0</a>", True, False),
        ("<a>\n /cmd_vel \n</a>", "x", "/cmd_vel"),
        ("<a/>", "x", ""),
        ("<a/>", 2.0, 2.0),
        ("<a>1 2  3</a>", (0.0, 0.0, 0.0), (1.0, 2.0, 3.0)),
        ("", 2.0, 2.0),
        ("", None, None),
        ("<a> b </a>", None, "b"),
        ("<a>1</a><a>2</a>", 0, 1),
    ],
)
def test_get_is_typed_by_the_default(text, default, value):
    sdf, warnings = element(text)
    got = sdf.get("a", default)
    assert got == value and type(got) is type(value)
    assert warnings == []


@pytest.mark.parametrize("text, value", [("<a> b </a>", "b"), ("<a/>", "x"), ("<a> </a>", "x"), ("", "x")])
def test_a_text_that_must_not_be_empty(text, value):
    assert element(text)[0].text_or("a", "x") == value


@pytest.mark.parametrize(
    "text, default", [("<a>fast</a>", 2.0), ("<a>...</a>", 2.0), ("<a>x 1</a>", (1.0, 2.0)), ("<a>inf</a>", 3), ("<a>nan</a>", 3)]
)
def test_unreadable_value_gives_the_default_and_a_warning(text, default):
    sdf, warnings = element(text)
    assert sdf.get("a", default) == default
    assert len(warnings) == 1 and "<a>" in warnings[0] and str(default) in warnings[0]


def test_numbers_that_are_missing_are_those_of_the_default():
    sdf, warnings = element("<a>1 2</a>")
    assert sdf.get("a", (7.0, 8.0, 9.0)) == (1.0, 2.0, 9.0)
    assert len(warnings) == 1 and "3 numbers expected, using (1.0, 2.0, 9.0)" in warnings[0]


def test_children_and_attributes():
    sdf, _ = element("<!-- c --><joint name='j0'/><joint name='j1'/><rate>5</rate>")
    assert [child.attrib["name"] for child in sdf.children("joint")] == ["j0", "j1"]
    assert [child.name for child in sdf.children()] == ["joint", "joint", "rate"]
    assert sdf.child("rate").text == "5" and sdf.child("none") is None
    assert sdf.has("rate") and not sdf.has("none")
    assert sdf.attrib == {"name": "p"}

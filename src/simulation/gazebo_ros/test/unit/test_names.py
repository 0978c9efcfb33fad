import xml.etree.ElementTree as ET

import pytest
from gazebo_ros import SdfElement, names


def plugin(text):
    return SdfElement(ET.fromstring(f"<plugin>{text}</plugin>"))


MISSING, EMPTY, GIVEN = "", "<robotNamespace/>", "<robotNamespace>/rob/</robotNamespace>"


@pytest.mark.parametrize(
    "rule, text, namespace",
    [
        ("A", MISSING, "/arm"),
        ("A", EMPTY, "/arm"),
        ("A", GIVEN, "/rob"),
        ("B", MISSING, "/"),
        ("B", EMPTY, "/arm"),
        ("B", GIVEN, "/rob"),
        ("C", MISSING, "/"),
        ("C", EMPTY, "/"),
        ("C", GIVEN, "/rob"),
        ("D", MISSING, "/arm"),
        ("D", EMPTY, "/"),
        ("D", GIVEN, "/rob"),
        ("A", "<robotNamespace>/</robotNamespace>", "/"),
        ("C", "<robotNamespace> rob/left </robotNamespace>", "/rob/left"),
    ],
)
def test_rules(rule, text, namespace):
    assert names.robot_namespace(plugin(text), "arm", rule) == namespace


@pytest.mark.parametrize(
    "namespace, name, full",
    [
        ("/", "cmd_vel", "/cmd_vel"),
        ("/rob", "cmd_vel", "/rob/cmd_vel"),
        ("/rob", "/cmd_vel", "/cmd_vel"),
        ("/rob/", "a//b", "/rob/a/b"),
        ("", "x", "/x"),
        ("/rob", "", "/rob"),
    ],
)
def test_join(namespace, name, full):
    assert names.join(namespace, name) == full


@pytest.mark.parametrize(
    "prefix, frame, full",
    [("", "odom", "odom"), ("", "/odom", "odom"), ("rob", "odom", "rob/odom"), ("/rob", "odom", "rob/odom"), ("rob", "/odom", "odom")],
)
def test_resolve_frame(prefix, frame, full):
    assert names.resolve_frame(prefix, frame) == full

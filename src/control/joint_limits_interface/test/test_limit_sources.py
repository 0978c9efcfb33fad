"""Where limits come from, through both faces: upstream's functions in C++ and Python's."""

import pathlib
import subprocess
import xmlrpc.client
from dataclasses import astuple, replace

import pytest
from joint_limits_interface import JointDescription, JointLimits, SoftJointLimits, _limits, limits_from_urdf
from joint_limits_interface.limits import apply_limits, soft_limits_of
from joint_limits_interface.robot_description import Limit
from limit_source_cases import BEFORE, DESCRIPTIONS, PARAMETERS, SOFT_PARAMETERS

PROGRAM = pathlib.Path(_limits.__file__).parents[3] / "joint_limits_interface" / "limit_faces"  # devel/lib


def in_cpp(lines):
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    run = subprocess.run([str(PROGRAM)], input="\n".join(lines), capture_output=True, text=True, timeout=60, check=True)
    answers = [line.split() for line in run.stdout.splitlines()]
    assert len(answers) == len(lines)
    return answers


def limits_of(words):
    return JointLimits(*map(float.fromhex, words[:6]), *(word == "1" for word in words[6:12]))


def of_parameters(values):
    """Limits and soft limits that C++ makes of a map."""
    xml = xmlrpc.client.dumps((values,)).replace("\n", "")
    [words] = in_cpp(["parameters " + xml[xml.index("<value>") : xml.rindex("</param>")]])
    return limits_of(words), SoftJointLimits(*map(float.fromhex, words[13:])) if words[12] == "1" else None


@pytest.mark.parametrize("why, values, changed", PARAMETERS, ids=[case[0] for case in PARAMETERS])
def test_parameters_override(why, values, changed):
    expected = replace(BEFORE, **changed)
    assert apply_limits(values, BEFORE) == expected
    assert of_parameters(values) == (expected, None)


@pytest.mark.parametrize("why, values, expected", SOFT_PARAMETERS, ids=[case[0] for case in SOFT_PARAMETERS])
def test_soft_parameters(why, values, expected):
    soft = None if expected is None else SoftJointLimits(*expected)
    assert soft_limits_of(values) == soft
    assert of_parameters(values) == (BEFORE, soft)


@pytest.mark.parametrize("kind, limit, changed", DESCRIPTIONS)
def test_descriptions(kind, limit, changed):
    expected = replace(BEFORE, **changed)
    lower, upper, velocity, effort = limit
    joint = JointDescription("j", kind, limit=Limit(lower=lower, upper=upper, velocity=velocity, effort=effort))
    assert limits_from_urdf(joint, BEFORE) == expected
    assert limits_of(in_cpp([" ".join(map(str, ("description", kind, *limit)))])[0]) == expected


@pytest.mark.parametrize("text", ["7", "[]", "lots"])
def test_what_is_no_map_says_nothing(text):
    """A student's ``joint_limits/elbow: lots``."""
    value = {"7": "<i4>7</i4>", "[]": "<array><data></data></array>", "lots": "<string>lots</string>"}[text]
    assert limits_of(in_cpp([f"parameters <value>{value}</value>"])[0]) == BEFORE


def test_a_whole_number_beyond_any_double_is_no_limit():
    assert apply_limits({"has_velocity_limits": True, "max_velocity": 10**400}, BEFORE) == BEFORE


def test_every_field_is_told():
    assert len(astuple(BEFORE)) == 12  # those that limit_faces prints

"""The law of joint limits through both faces, upstream's classes in C++ and the handles of Python: one table, and the same bits."""

import math
import pathlib
import random
import struct
import subprocess

import pytest
from hardware_interface import JointHandle, JointStateHandle
from joint_limits_interface import (
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    PositionJointSaturationHandle,
    PositionJointSoftLimitsHandle,
    SoftJointLimits,
    VelocityJointSaturationHandle,
    VelocityJointSoftLimitsHandle,
    _limits,
)
from limit_cases import BOX, CASES, CROSSED, CROSSED_WINDOW, ENDLESS, RAMP, WINDOW, Case

PROGRAM = pathlib.Path(_limits.__file__).parents[3] / "joint_limits_interface" / "limit_faces"  # devel/lib
HANDLES = {
    "position": (PositionJointSaturationHandle, PositionJointSoftLimitsHandle),
    "velocity": (VelocityJointSaturationHandle, VelocityJointSoftLimitsHandle),
    "effort": (EffortJointSaturationHandle, EffortJointSoftLimitsHandle),
}


def in_python(case):
    joint = JointHandle(JointStateHandle("j"))
    hard, soft = HANDLES[case.kind]
    handle = soft(joint, case.limits, case.soft) if case.soft else hard(joint, case.limits)
    commands = []
    for step in case.steps:
        if step == "reset":
            handle.reset()
            continue
        joint.command, joint.state.position, joint.state.velocity, dt = step[:4]
        handle.enforce_limits(dt)
        commands.append(joint.command)
    return commands


def lines_of(case):
    hard, soft = case.limits, case.soft or SoftJointLimits()
    yield (
        "joint",
        case.kind,
        int(case.soft is not None),
        int(hard.has_position_limits),
        int(hard.has_velocity_limits),
        int(hard.has_acceleration_limits),
        int(hard.has_effort_limits),
        hard.min_position,
        hard.max_position,
        hard.max_velocity,
        hard.max_acceleration,
        hard.max_effort,
        soft.min_position,
        soft.max_position,
        soft.k_position,
        soft.k_velocity,
    )
    for step in case.steps:
        yield ("reset",) if step == "reset" else ("step", *map(repr, step[:4]))


def in_cpp(cases):
    """The commands of each case, and the lines of the log."""
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    text = "\n".join(" ".join(map(str, line)) for case in cases for line in lines_of(case))
    run = subprocess.run([str(PROGRAM)], input=text, capture_output=True, text=True, timeout=60, check=True)
    answers = [[float.fromhex(line) for line in part.split()] for part in run.stdout.split("joint")[1:]]
    return answers, run.stderr


def bits(numbers):
    return [struct.pack("d", number) for number in numbers]


@pytest.fixture(scope="module")
def all_in_cpp():
    return in_cpp(CASES)


@pytest.mark.parametrize("number", range(len(CASES)), ids=map(str, CASES))
def test_the_table(number, all_in_cpp, caplog):
    case = CASES[number]
    expected = [step[4] for step in case.steps if step != "reset"]
    assert in_python(case) == expected
    assert all_in_cpp[0][number] == expected
    assert caplog.text.count("is no usable number; holding") == case.warns


def test_each_joint_in_cpp_warns_once(all_in_cpp):
    assert all_in_cpp[1].count("is no usable number; holding") == sum(case.warns for case in CASES)


@pytest.mark.parametrize("kind", HANDLES)
@pytest.mark.parametrize("soft", [None, WINDOW, CROSSED_WINDOW])
def test_both_faces_give_the_same_bits(kind, soft):
    chance = random.Random(f"{kind} {soft}")

    def some(size):
        return chance.choice((math.nan, math.inf, -math.inf, 1e308, -0.0)) if chance.random() < 0.1 else chance.uniform(-size, size)

    cases = [
        Case(
            "chance",
            kind,
            limits,
            [(some(10.0), some(2.0), some(4.0), chance.choice((0.125, 0.0625, 0.0, -0.125))) for _ in range(400)],
            soft,
        )
        for limits in (BOX, ENDLESS, CROSSED, RAMP)
    ]
    for case, answer in zip(cases, in_cpp(cases)[0]):
        assert bits(in_python(case)) == bits(answer)

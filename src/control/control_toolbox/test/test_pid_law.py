"""The law of the PID through both faces, upstream's class in C++ and that of Python: one table, and the same bits."""

import math
import pathlib
import random
import struct
import subprocess

import pytest
from control_toolbox import Gains, Pid, _pid
from pid_cases import ALL, CASES, Case

PROGRAM = pathlib.Path(_pid.__file__).parents[3] / "control_toolbox" / "pid_faces"  # devel/lib


def in_python(case):
    pid, commands = Pid(*case.gains), []
    for step in case.steps:
        if step == "reset":
            pid.reset()
        elif step[0] == "past":
            pid.reset(step[1], step[2])
        elif len(step) == 3:
            commands.append(pid.compute_command(step[0], step[1]))
        else:
            commands.append(pid.compute_command(step[0], step[2], step[1]))
    return commands


def lines_of(case):
    yield ("pid", *map(float, case.gains))
    for step in case.steps:
        if step == "reset":
            yield ("reset",)
        elif step[0] == "past":
            yield step
        else:
            yield ("step" if len(step) == 3 else "slope", *map(repr, step[:-1]))


def in_cpp(cases):
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    text = "\n".join(" ".join(map(str, line)) for case in cases for line in lines_of(case))
    run = subprocess.run([str(PROGRAM)], input=text, capture_output=True, text=True, timeout=60, check=True)
    return [[float.fromhex(line) for line in part.split()] for part in run.stdout.split("pid")[1:]]


@pytest.fixture(scope="module")
def all_in_cpp():
    return in_cpp(CASES)


@pytest.mark.parametrize("number", range(len(CASES)), ids=map(str, CASES))
def test_the_table(number, all_in_cpp):
    case = CASES[number]
    expected = [step[-1] for step in case.steps if step != "reset" and step[0] != "past"]
    assert in_python(case) == expected
    assert all_in_cpp[number] == expected


@pytest.mark.parametrize("antiwindup", [False, True])
def test_both_faces_give_the_same_bits(antiwindup):
    chance = random.Random(antiwindup)

    def error():
        return chance.choice((math.nan, math.inf, 1e308, -1e308, -0.0)) if chance.random() < 0.1 else chance.uniform(-9, 9)

    def step():
        dt = chance.choice((0.125, 0.0625, 0.0, -0.125))
        return (error(), dt, None) if chance.random() < 0.7 else (error(), error(), dt, None)

    cases = [
        Case("chance", gains._replace(antiwindup=antiwindup), [step() for _ in range(500)])
        for gains in (ALL, Gains(1.0, -2.0, 0.0, 3.0, -1.0), Gains(1.0, 2.0, 0.5, -3.0, 1.0), Gains(0.0, 0.0, 1.0, 3.0, -1.0))
    ]
    for case, answer in zip(cases, in_cpp(cases)):
        assert [struct.pack("d", one) for one in in_python(case)] == [struct.pack("d", one) for one in answer]

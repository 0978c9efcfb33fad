"""The law of transmissions through both faces, upstream's classes in C++ and those of Python: one table each, and the same bits."""

import math
import pathlib
import random
import struct
import subprocess

import pytest
from hardware_interface import (
    ActuatorHandle,
    ActuatorStateHandle,
    ActuatorStateInterface,
    EffortActuatorInterface,
    EffortJointInterface,
    JointStateInterface,
    PositionActuatorInterface,
    PositionJointInterface,
    RobotHW,
    VelocityActuatorInterface,
    VelocityJointInterface,
)
from transmission_cases import DESCRIPTIONS, DIFFERENTIAL, FOUR_BAR, GEARS, SIMPLE, Gear
from transmission_interface import (
    DifferentialTransmission,
    FourBarLinkageTransmission,
    RobotTransmissions,
    SimpleTransmission,
    TransmissionError,
    TransmissionInterfaceLoader,
    _law,
    parse_transmissions,
)

PROGRAM = pathlib.Path(_law.__file__).parents[3] / "transmission_interface" / "transmission_faces"  # devel/lib


def in_cpp(lines):
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    run = subprocess.run(
        [str(PROGRAM)], input="\n".join(" ".join(map(str, line)) for line in lines), capture_output=True, text=True, timeout=60, check=True
    )
    return run.stdout.split("\n")[:-1]


def geared_in_cpp(case):
    kind, n, m, offset, crosswise = case.made
    made, *answers = in_cpp(
        [("law", kind, len(n), len(m), len(offset), int(crosswise), *n, *m, *offset), *((way, *values) for way, values, _ in case.ways)]
    )
    return None if made == "refused" else [list(map(float.fromhex, answer.split())) for answer in answers]


def geared_in_python(case):
    kind, n, m, offset, crosswise = case.made
    try:
        made = (
            SimpleTransmission(n[0], offset[0])
            if kind == "simple"
            else FourBarLinkageTransmission(n, m, offset)
            if kind == "four_bar"
            else DifferentialTransmission(n, m, offset, crosswise)
        )
    except TransmissionError:
        return None
    return [list(getattr(made, way)(values)) for way, values, _ in case.ways]


def described_in_cpp(urdf):
    return in_cpp([("robot", urdf)])


def described_in_python(urdf):
    parsed = " ".join(
        f"{info.name}:{''.join(joint.name for joint in info.joints)}/{''.join(one.name for one in info.actuators)}"
        for info in parse_transmissions(urdf)[0]
    )
    hw, states = RobotHW(), [ActuatorStateHandle(name, at, at, at) for name, at in (("a", 8.0), ("b", 16.0), ("c", 4.0))]
    hw.register_interface(ActuatorStateInterface(*states))
    for kind, number in ((PositionActuatorInterface, 3), (VelocityActuatorInterface, 2), (EffortActuatorInterface, 2)):
        hw.register_interface(kind(*(ActuatorHandle(state) for state in states[:number])))
    transmissions = RobotTransmissions()
    if not TransmissionInterfaceLoader(hw, transmissions).load(urdf):
        return [f"{parsed}|none"]
    transmissions.actuator_to_joint_state.propagate()
    kinds = [
        (letter, hw.get(kind))
        for letter, kind in (("p", PositionJointInterface), ("v", VelocityJointInterface), ("e", EffortJointInterface))
    ]
    return [
        f"{parsed}|"
        + ", ".join(
            f"{handle.name} {handle.position:g} {''.join(letter for letter, one in kinds if one and handle.name in one)}"
            for handle in sorted(hw.get(JointStateInterface).handles(), key=lambda handle: handle.name)
        )
    ]


def bits(rows):
    return rows and [[struct.pack("d", one) if not math.isnan(one) else "nan" for one in row] for row in rows]


@pytest.mark.parametrize("face", [geared_in_python, geared_in_cpp])
@pytest.mark.parametrize("case", GEARS, ids=str)
def test_gears(case, face):
    assert bits(face(case)) == (bits([expected for _, _, expected in case.ways]) or None)


@pytest.mark.parametrize("face", [described_in_python, described_in_cpp])
@pytest.mark.parametrize("case", DESCRIPTIONS, ids=str)
def test_descriptions(case, face):
    urdf = f'<robot name="r">{case.xml}</robot>'.replace("\n", " ")
    assert face(urdf)[-1] == f"{case.parsed}|{'none' if case.joints is None else case.joints}"


@pytest.mark.parametrize("made", [SIMPLE, DIFFERENTIAL, FOUR_BAR], ids=lambda made: made[0])
def test_both_faces_give_the_same_bits_and_lead_back(made):
    chance = random.Random(made[0])
    kind, n, *_ = made
    for _ in range(5):
        numbers = [[chance.choice((-1, 1)) * chance.uniform(0.01, 200.0) for _ in n] for _ in range(2)]
        if kind == "simple":
            numbers[1] = [1.0]
        values = [[chance.uniform(-9, 9) for _ in n] for _ in range(20)]
        there = Gear(
            "chance",
            (kind, *numbers, [chance.uniform(-3, 3) for _ in n], False),
            [
                (f"{quantity}_to_{side}", value, None)
                for value in values
                for quantity in ("position", "velocity", "effort")
                for side in ("joint", "actuator")
            ],
        )
        answers = geared_in_python(there)
        assert bits(answers) == bits(geared_in_cpp(there))
        back = there._replace(
            ways=[
                (way.replace("joint", "X").replace("actuator", "joint").replace("X", "actuator"), answer, None)
                for (way, _, _), answer in zip(there.ways, answers)
            ]
        )
        for value, answer in zip((value for _, value, _ in there.ways), geared_in_python(back)):
            assert answer == pytest.approx(value, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("gear", [SimpleTransmission(-7.0, 0.5), DifferentialTransmission([10.0, -20.0], [2.0, -3.0])])
def test_no_power_is_lost(gear):
    chance = random.Random(3)
    for _ in range(20):
        speeds, efforts = ([chance.uniform(-9, 9) for _ in range(gear.num_joints)] for _ in range(2))
        motors = zip(gear.velocity_to_actuator(speeds), gear.effort_to_actuator(efforts))
        assert sum(v * e for v, e in motors) == pytest.approx(sum(v * e for v, e in zip(speeds, efforts)), abs=1e-9)

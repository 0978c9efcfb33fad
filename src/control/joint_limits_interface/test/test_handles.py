"""Enforcement of limits on commands."""

import math

import pytest
from hardware_interface import JointHandle, JointStateHandle
from hypothesis import given
from hypothesis import strategies as st
from joint_limits_interface import (
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    JointLimits,
    JointLimitsError,
    JointLimitsInterface,
    PositionJointSaturationHandle,
    PositionJointSoftLimitsHandle,
    SoftJointLimits,
    VelocityJointSaturationHandle,
    VelocityJointSoftLimitsHandle,
)

DT = 0.1
LIMITS = JointLimits(
    min_position=-1.0,
    max_position=1.0,
    max_velocity=2.0,
    max_acceleration=5.0,
    max_effort=8.0,
    has_position_limits=True,
    has_velocity_limits=True,
    has_effort_limits=True,
)
ACCELERATION = JointLimits(max_velocity=2.0, max_acceleration=5.0, has_velocity_limits=True, has_acceleration_limits=True)
SOFT = SoftJointLimits(min_position=-0.8, max_position=0.8, k_position=20.0, k_velocity=40.0)
NOTHING = JointLimits()
UNBOUNDED = JointLimits(has_velocity_limits=True, max_velocity=math.inf, has_effort_limits=True, max_effort=math.inf)


@pytest.fixture
def joint():
    return JointHandle(JointStateHandle("j"))


def enforce(handle, command, dt=DT):
    handle.joint.command = command
    handle.enforce_limits(dt)
    return handle.joint.command


def test_position_saturation_steps_from_the_last_command(joint):
    handle = PositionJointSaturationHandle(joint, LIMITS)
    joint.state.position = 0.3
    assert enforce(handle, 5.0) == pytest.approx(0.5)  # starts from the measured position
    joint.state.position = -0.9  # later the last output counts
    assert enforce(handle, 5.0) == pytest.approx(0.7)
    assert enforce(handle, 0.65) == 0.65
    for _ in range(5):
        last = enforce(handle, 5.0)
    assert last == 1.0
    handle.reset()
    assert enforce(handle, 5.0) == pytest.approx(-0.7)


def test_position_saturation_reaches_its_target_exactly(joint):
    handle = PositionJointSaturationHandle(joint, JointLimits(has_velocity_limits=True, max_velocity=0.1))
    steps = 0
    while enforce(handle, 1.0, 0.001) != 1.0:
        steps += 1
        assert joint.command == pytest.approx(1e-4 * steps, abs=1e-9)
        assert steps <= 10000
    assert steps == 9999 or steps == 10000


def test_position_saturation_without_velocity_limit(joint):
    limits = JointLimits(has_position_limits=True, min_position=-1.0, max_position=1.0)
    handle = PositionJointSaturationHandle(joint, limits)
    assert enforce(handle, 9.0) == 1.0
    assert enforce(handle, -9.0) == -1.0
    assert enforce(PositionJointSaturationHandle(joint, NOTHING), 1e6) == 1e6


def test_position_soft_limits_slow_down(joint):
    handle = PositionJointSoftLimitsHandle(joint, LIMITS, SOFT)
    previous, steps = 0.0, []
    for _ in range(100):
        command = enforce(handle, 10.0, 0.01)
        steps.append(command - previous)
        previous = command
    assert steps[0] == pytest.approx(0.02)  # far away: the velocity limit
    assert all(later <= earlier + 1e-12 for earlier, later in zip(steps, steps[1:]))
    assert previous == pytest.approx(0.8, abs=2e-3)  # never past the soft limit


def test_position_soft_limits_bring_back_from_outside(joint):
    joint.state.position = 0.95  # between soft and hard limit
    handle = PositionJointSoftLimitsHandle(joint, LIMITS, SOFT)
    assert enforce(handle, 1.0, 0.01) < 0.95


def test_velocity_saturation(joint):
    handle = VelocityJointSaturationHandle(joint, LIMITS)
    assert [enforce(handle, command) for command in (5.0, -5.0, 1.0)] == [2.0, -2.0, 1.0]
    handle = VelocityJointSaturationHandle(joint, ACCELERATION)
    assert [enforce(handle, 5.0) for _ in range(5)] == pytest.approx([0.5, 1.0, 1.5, 2.0, 2.0])
    handle.reset()
    assert enforce(handle, 5.0) == 0.5


def test_velocity_soft_limits(joint):
    handle = VelocityJointSoftLimitsHandle(joint, LIMITS, SOFT)
    assert enforce(handle, 9.0) == 2.0
    joint.state.position = 0.75  # 20 * (0.8 - 0.75) = 1
    assert enforce(handle, 9.0) == pytest.approx(1.0)
    assert enforce(handle, -9.0) == -2.0
    joint.state.position = 0.85  # outside: back
    assert enforce(handle, 9.0) == pytest.approx(-1.0)


def test_effort_saturation(joint):
    handle = EffortJointSaturationHandle(joint, LIMITS)
    assert [enforce(handle, command) for command in (9.0, -9.0, 3.0)] == [8.0, -8.0, 3.0]
    joint.state.position = 1.1  # outside: no effort further out
    assert [enforce(handle, command) for command in (9.0, -9.0)] == [0.0, -8.0]
    joint.state.position = -1.1
    assert [enforce(handle, command) for command in (9.0, -9.0)] == [8.0, 0.0]
    joint.state.position, joint.state.velocity = 0.0, 2.5  # too fast: none in that direction
    assert [enforce(handle, command) for command in (9.0, -9.0)] == [0.0, -8.0]
    joint.state.velocity = -2.5
    assert [enforce(handle, command) for command in (9.0, -9.0)] == [8.0, 0.0]


def test_effort_soft_limits(joint):
    handle = EffortJointSoftLimitsHandle(joint, LIMITS, SOFT)
    assert enforce(handle, 9.0) == 8.0
    joint.state.position = 0.9  # velocity window ends at -2: 40 * (-2) is beyond -8
    assert enforce(handle, 8.0) == -8.0


@pytest.mark.parametrize(
    "kind, limits",
    [
        (PositionJointSoftLimitsHandle, NOTHING),
        (VelocityJointSaturationHandle, NOTHING),
        (EffortJointSaturationHandle, JointLimits(has_velocity_limits=True)),
        (EffortJointSaturationHandle, JointLimits(has_effort_limits=True)),
        (EffortJointSoftLimitsHandle, NOTHING),
    ],
)
def test_missing_limits_are_refused(joint, kind, limits):
    with pytest.raises(JointLimitsError, match="joint 'j'.*no (velocity|effort) limits"):
        kind(joint, limits, *([SOFT] if "Soft" in kind.__name__ else []))


HANDLES = [
    lambda joint, limits: PositionJointSaturationHandle(joint, limits),
    lambda joint, limits: PositionJointSoftLimitsHandle(joint, limits, SOFT),
    lambda joint, limits: VelocityJointSaturationHandle(joint, limits),
    lambda joint, limits: VelocityJointSoftLimitsHandle(joint, limits, SOFT),
    lambda joint, limits: EffortJointSaturationHandle(joint, limits),
    lambda joint, limits: EffortJointSoftLimitsHandle(joint, limits, SOFT),
]


@pytest.mark.parametrize("make", HANDLES)
@pytest.mark.parametrize("limits", [LIMITS, UNBOUNDED])
def test_nan_holds_the_last_command_with_one_warning(joint, make, limits, caplog):
    handle = make(joint, limits)
    good = enforce(handle, 0.1)
    for _ in range(50):
        assert enforce(handle, math.nan) == pytest.approx(good)
    assert caplog.text.count("Joint 'j' was commanded nan") == 1
    assert enforce(handle, 0.05) == pytest.approx(0.05)


@pytest.mark.parametrize("make", HANDLES)
@given(commands=st.lists(st.floats(), min_size=1, max_size=20), position=st.floats(-2.0, 2.0), velocity=st.floats(-4.0, 4.0))
def test_whatever_is_commanded_the_limits_are_kept(make, commands, position, velocity):
    for limits in (LIMITS, UNBOUNDED, ACCELERATION if "Velocity" in repr(make) else LIMITS):
        joint = JointHandle(JointStateHandle("j", position, velocity))
        handle = make(joint, limits)
        for command in commands:
            output = enforce(handle, command, 0.01)
            assert math.isfinite(output)
            if limits is LIMITS and isinstance(handle, VelocityJointSaturationHandle):
                assert abs(output) <= limits.max_velocity
            if limits is LIMITS and isinstance(handle, (EffortJointSaturationHandle, EffortJointSoftLimitsHandle)):
                assert abs(output) <= limits.max_effort


@pytest.mark.parametrize(
    "make, limits",
    [
        (PositionJointSaturationHandle, JointLimits(has_velocity_limits=True, max_velocity=-math.inf)),
        (PositionJointSaturationHandle, JointLimits(has_position_limits=True, min_position=math.inf, max_position=math.inf)),
        (VelocityJointSaturationHandle, JointLimits(has_velocity_limits=True, max_velocity=-math.inf)),
    ],
)
def test_limits_that_are_no_places_to_be_at_give_a_command_that_is_one(joint, make, limits):
    handle = make(joint, limits)
    for command in (0.0, 1.0, math.nan, math.inf):
        assert math.isfinite(enforce(handle, command))


def test_interface_enforces_all_in_name_order():
    order = []

    class Handle:
        def __init__(self, name):
            self.name = name

        def enforce_limits(self, dt):
            order.append(self.name)

        def reset(self):
            order.append(f"reset {self.name}")

    interface = JointLimitsInterface()
    for name in ("b", "c", "a"):
        interface.register_handle(Handle(name))
    interface.enforce_limits(DT)
    interface.reset()
    assert order == ["a", "b", "c", "reset a", "reset b", "reset c"]

"""Grouping of motors into frames, and what motors that do not answer get."""

import pytest
from rm_hw import frames
from rm_hw.actuator import Actuator
from rm_hw.coefficients import Coefficients
from rm_hw.command_frames import CommandFrames

RM = Coefficients(act2pos=1e-3, act2vel=0.1, act2effort=1e-3, effort2act=1000.0, max_out=10000.0)
CHEETAH = Coefficients(
    act2pos=25 / 65535,
    act2vel=130 / 4095,
    act2effort=36 / 4095,
    effort2act=113.75,
    max_out=0.0,
    pos2act=2621.4,
    vel2act=31.5,
    act2pos_offset=-12.5,
    act2vel_offset=-65.0,
    act2effort_offset=-18.0,
)


def motor(identifier, effort=0.0, halted=False, type_name="rm_3508", coefficients=RM):
    actuator = Actuator(f"m{identifier}", type_name, "can0", identifier, coefficients)
    actuator.halted, actuator.executed_effort = halted, effort
    return actuator


def test_motors_share_frames_in_their_slots():
    motors = [motor(0x201, 1.0), motor(0x204, -2.0), motor(0x206, 3.0), motor(0x20A, 50.0)]
    built = dict(CommandFrames(motors).build(0.0))
    assert frames.unpack_command(built[0x200]) == (1000, 0, 0, -2000)
    assert frames.unpack_command(built[0x1FF]) == (0, 3000, 0, 0)
    assert frames.unpack_command(built[0x2FF]) == (0, 10000, 0, 0)


def test_a_silent_motor_gets_zero_beside_one_that_runs():
    built = dict(CommandFrames([motor(0x201, 1.0, halted=True), motor(0x202, 1.0)]).build(0.0))
    assert frames.unpack_command(built[0x200]) == (0, 1000, 0, 0)


def test_silent_groups_get_zero_ten_times_a_second():
    commands = CommandFrames([motor(0x201, 1.0, halted=True)])
    sent = [commands.build(i * 0.001) for i in range(1000)]
    assert 9 <= sum(map(bool, sent)) <= 10
    assert all(data == bytes(8) for built in sent for _, data in built)


def test_zero_frames_name_every_group_once():
    commands = CommandFrames([motor(0x201), motor(0x202), motor(0x205), motor(3, 5.0, type_name="cheetah", coefficients=CHEETAH)])
    zero = dict(commands.zero())
    assert sorted(zero) == [3, 0x1FF, 0x200] and zero[0x200] == zero[0x1FF] == bytes(8)
    position, velocity, kp, kd, effort = frames.unpack_cheetah_command(zero[3])
    assert (kp, kd) == (0, 0)
    assert effort / 113.75 - 18.0 == pytest.approx(0.0, abs=0.01)
    assert position / 2621.4 - 12.5 == pytest.approx(0.0, abs=0.01)
    assert velocity / 31.5 - 65 == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("effort, sent", [(5.0, 5.0), (-17.0, -17.0), (100.0, 18.0), (float("nan"), 0.0)])
def test_cheetah_effort(effort, sent):
    ((_, data),) = CommandFrames([motor(3, effort, type_name="cheetah", coefficients=CHEETAH)]).build(0.0)
    assert frames.unpack_cheetah_command(data)[4] / 113.75 - 18.0 == pytest.approx(sent, abs=0.01)

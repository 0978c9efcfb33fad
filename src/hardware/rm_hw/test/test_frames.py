"""Frames survive a round trip, and their bytes are where the speed controllers' manuals put them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rm_hw import frames

int16 = st.integers(-32768, 32767)
bits12 = st.integers(0, 4095)


@given(st.tuples(int16, int16, int16, int16))
def test_command_round_trip(counts):
    assert frames.unpack_command(frames.pack_command(counts)) == counts


@given(st.tuples(*[st.floats(-1e9, 1e9)] * 4))
def test_command_never_wraps_around(counts):
    for asked, sent in zip(counts, frames.unpack_command(frames.pack_command(counts))):
        assert asked * sent >= 0 and abs(sent) <= min(abs(asked), 32768)


def test_command_bytes():
    assert frames.pack_command([13653, -2, 0, 0x0102]).hex() == "3555fffe00000102"


@given(st.builds(frames.Feedback, st.integers(0, 8191), int16, int16, st.integers(0, 255)))
def test_feedback_round_trip(feedback):
    assert frames.unpack_feedback(frames.pack_feedback(feedback)) == feedback


def test_feedback_bytes():
    assert frames.unpack_feedback(bytes.fromhex("0F3A000000051C00")) == (0x0F3A, 0, 5, 28)
    assert frames.unpack_feedback(bytes.fromhex("1FFFFF9CFFF01900")) == (8191, -100, -16, 25)


@given(st.binary(max_size=8))
def test_any_bytes_are_feedback_or_refused(data):
    try:
        assert 0 <= frames.unpack_feedback(data).angle < 8192
    except ValueError as error:
        assert "feedback frame" in str(error)


@pytest.mark.parametrize(
    "feedback_id, expected",
    [(0x201, (0x200, 0)), (0x204, (0x200, 3)), (0x205, (0x1FF, 0)), (0x208, (0x1FF, 3)), (0x209, (0x2FF, 0)), (0x20B, (0x2FF, 2))],
)
def test_command_slot(feedback_id, expected):
    assert frames.command_slot(feedback_id) == expected


@pytest.mark.parametrize("feedback_id", [0, 0x200, 0x20C, 0x7FF])
def test_command_slot_refuses_others(feedback_id):
    with pytest.raises(ValueError, match="0x201..0x20B"):
        frames.command_slot(feedback_id)


@given(st.tuples(st.integers(0, 65535), bits12, bits12, bits12, bits12))
def test_cheetah_command_round_trip(values):
    assert frames.unpack_cheetah_command(frames.pack_cheetah_command(*values)) == values


def test_cheetah_command_bytes():
    assert frames.pack_cheetah_command(0x1234, 0x567, 0x89A, 0xBCD, 0xEF0).hex() == "123456789abcdef0"


@given(st.builds(frames.CheetahReply, st.integers(0, 255), st.integers(0, 65535), bits12, bits12))
def test_cheetah_reply_round_trip(reply):
    assert frames.unpack_cheetah_reply(frames.pack_cheetah_reply(reply)) == reply


@given(st.builds(frames.ImuGyro, int16, int16, int16, st.integers(-1024, 1023)))
def test_imu_gyro_round_trip(gyro):
    assert frames.unpack_imu_gyro(frames.pack_imu_gyro(gyro)) == gyro


@given(st.builds(frames.ImuAccel, int16, int16, int16, st.booleans(), st.booleans()))
def test_imu_accel_round_trip(accel):
    assert frames.unpack_imu_accel(frames.pack_imu_accel(accel)) == accel

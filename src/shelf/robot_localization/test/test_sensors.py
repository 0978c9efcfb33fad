"""Messages become measurements in the right frames."""

import numpy as np
import pytest
from state_estimation.motion import rotation
from state_estimation.sensors import (
    GRAVITY,
    IDENTITY,
    AccelerationInput,
    FrameMissing,
    Pose,
    PoseInput,
    Transform,
    TwistInput,
    angles,
    flags,
    matrix,
    quaternion_matrix,
)

ALL = [True] * 6


def frames(**known):
    """A look-up of transforms into any frame, by the source's name."""

    def lookup(target, source, _stamp):
        if source in known:
            return known[source]
        if source == target:
            return IDENTITY
        raise FrameMissing(source)

    return lookup


def turned(roll=0.0, pitch=0.0, yaw=0.0, at=(0, 0, 0)):
    return Transform(rotation(np.array([roll, pitch, yaw])), np.array(at, float))


def pose(time, transform, frame="odom", variance=0.01):
    return Pose(frame, None, time, transform, np.eye(6) * variance)


def test_pose_of_another_frame():
    source = PoseInput("pose0", ALL, "odom", "base", frames(map=turned(yaw=np.pi / 2, at=(1, 0, 0))))
    measured = source.measure(pose(3.0, turned(yaw=0.1, at=(2, 0, 0)), "map"))
    np.testing.assert_allclose(measured.values[:6], [1, 2, 0, 0, 0, np.pi / 2 + 0.1], atol=1e-12)
    assert measured.used.tolist() == [True] * 6 + [False] * 9 and measured.time == 3.0


def test_pose_of_another_frame_of_the_robot():
    """A tip 0.5 m ahead of the base stands at (1, 0), turned to the left: the base stands at (1, -0.5)."""
    source = PoseInput("odom0", ALL, "odom", "base", frames(base=turned(at=(-0.5, 0, 0))))
    tip = turned(yaw=np.pi / 2, at=(1, 0, 0))
    measured = source.measure(Pose("odom", None, 0.0, tip, np.eye(6) * 0.01, "tip"))
    np.testing.assert_allclose(measured.values[:6], [1, -0.5, 0, 0, 0, np.pi / 2], atol=1e-12)
    with pytest.raises(FrameMissing):
        PoseInput("odom0", ALL, "odom", "base", frames()).measure(Pose("odom", None, 0.0, tip, np.eye(6), "tip"))


def test_known_axes_turn_with_the_frame():
    source = PoseInput("pose0", [True] + [False] * 5, "odom", "base", frames(map=turned(yaw=np.pi / 2)))
    assert np.flatnonzero(source.measure(pose(0.0, turned(at=(1, 0, 0)), "map")).used).tolist() == [1]


def test_differential():
    source = PoseInput("odom0", ALL, "odom", "base", frames(), differential=True)
    assert source.measure(pose(1.0, turned(yaw=np.pi / 2))) is None
    measured = source.measure(pose(1.5, turned(yaw=np.pi / 2 + 0.1, at=(0, 1, 0))))
    np.testing.assert_allclose(measured.values[6:12], [2, 0, 0, 0, 0, 0.2], atol=1e-12)
    assert measured.covariance[6, 6] == pytest.approx(0.02 / 0.25)
    assert measured.used.tolist() == [False] * 6 + [True] * 6 + [False] * 3


def test_relative():
    source = PoseInput("odom0", ALL, "odom", "base", frames(), relative=True)
    assert source.measure(pose(1.0, turned(yaw=np.pi / 2, at=(5, 5, 0)))).values[:6] == pytest.approx([0] * 6)
    np.testing.assert_allclose(source.measure(pose(2.0, turned(yaw=np.pi / 2, at=(5, 6, 0)))).values[:3], [1, 0, 0], atol=1e-12)


def test_inertial_unit_mounted_sideways():
    source = PoseInput("imu0", [False] * 3 + [True] * 3, "odom", "base", frames(imu=turned(yaw=np.pi / 2)), inertial=True)
    # The robot heads to 0.3 rad and is rolled by 0.2 rad; the unit, turned to the left, feels that as pitch downwards.
    unit = rotation(np.array([0.2, 0.0, 0.0])) @ rotation(np.array([0, 0, np.pi / 2]))
    measured = source.measure(Pose("imu", None, 0.0, Transform(rotation(np.array([0, 0, 0.0])) @ unit, np.zeros(3)), np.eye(6)))
    np.testing.assert_allclose(measured.values[3:6], [0.2, 0, 0], atol=1e-9)


def test_twist_of_a_sensor_beside_the_axis():
    source = TwistInput("twist0", ALL, "base", frames(lidar=turned(yaw=np.pi, at=(1, 0, 0))))
    # The robot turns on the spot at 0.5 rad/s: a sensor 1 m ahead, looking backwards, moves to its own right.
    measured = source.measure("lidar", None, 0.0, np.array([0, -0.5, 0]), np.array([0, 0, 0.5]), np.eye(6) * 0.1)
    np.testing.assert_allclose(measured.values[6:12], [0, 0, 0, 0, 0, 0.5], atol=1e-12)


def test_gravity_is_taken_away():
    tilt = rotation(np.array([0.1, -0.2, 1.0]))
    felt = tilt.T @ np.array([0, 0, GRAVITY]) + [0.5, 0, 0]
    source = AccelerationInput("imu0", [True] * 3, "base", frames(), remove_gravity=True)
    for orientation, state in ((tilt, np.zeros(3)), (None, np.array([0.1, -0.2, 1.0]))):
        measured = source.measure("base", None, 0.0, felt, np.eye(3), orientation, state)
        np.testing.assert_allclose(measured.values[12:], [0.5, 0, 0], atol=1e-12)


def test_unknown_frame():
    with pytest.raises(FrameMissing):
        TwistInput("twist0", ALL, "base", frames()).measure("nowhere", None, 0.0, np.zeros(3), np.zeros(3), np.eye(6))


def test_quaternions():
    np.testing.assert_allclose(angles(quaternion_matrix(0, 0, np.sin(0.2), np.cos(0.2))), [0, 0, 0.4], atol=1e-12)
    assert (quaternion_matrix(0, 0, 0, 0) == np.eye(3)).all()
    for bad in ((0, 0, 0, 2), (0, 0, np.nan, 1)):
        with pytest.raises(ValueError, match="is not a unit quaternion"):
            quaternion_matrix(*bad)


def test_parameters():
    assert flags([True] + [False] * 14, "p").sum() == 1
    assert (matrix(list(range(15)), "p") == np.diag(np.arange(15.0))).all()
    assert matrix(list(range(225)), "p")[1, 0] == 15
    for read, value in ((flags, [True] * 14), (flags, "yes"), (matrix, [1.0] * 16), (matrix, ["x"] * 15)):
        with pytest.raises(ValueError, match="parameter /node/it must be a list of"):
            read(value, "/node/it")

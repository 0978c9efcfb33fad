"""Pose arithmetic against its algebra, and against NumPy matrices."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ode_sim import math3
from ode_sim.description.model import Pose

length = st.floats(-100.0, 100.0)
angle = st.floats(-math.pi, math.pi)
vectors = st.tuples(length, length, length)
quaternions = st.builds(lambda r, p, y: math3.quat_from_rpy(r, p, y), angle, angle, angle)
poses = st.builds(Pose, vectors, quaternions)


def same_turn(a, b, tolerance=1e-9):
    return abs(abs(sum(x * y for x, y in zip(a, b))) - 1.0) < tolerance


def matrix(pose):
    return np.array(math3.to_matrix(pose))


@given(poses, poses)
def test_compose_is_the_matrix_product(a, b):
    assert np.allclose(matrix(math3.compose(a, b)), matrix(a) @ matrix(b), atol=1e-9)


@given(poses)
def test_inverse_undoes(pose):
    assert np.allclose(matrix(math3.compose(pose, math3.inverse(pose))), np.eye(4), atol=1e-9)


@given(poses, poses)
def test_relative_takes_the_first_to_the_second(a, b):
    assert np.allclose(matrix(math3.compose(a, math3.relative(a, b))), matrix(b), atol=1e-9)


@given(poses, vectors)
def test_transform_and_rotate_follow_the_matrix(pose, v):
    m = matrix(pose)
    assert np.allclose(math3.transform(pose, v), m[:3, :3] @ v + m[:3, 3], atol=1e-9)
    assert np.allclose(math3.rotate(pose, v), m[:3, :3] @ v, atol=1e-9)


@given(poses)
def test_matrix_round_trip(pose):
    back = math3.from_matrix(math3.to_matrix(pose))
    assert back.p == pytest.approx(pose.p) and same_turn(back.q, pose.q)


@given(quaternions)
def test_rpy_round_trip(q):
    roll, pitch, yaw = math3.quat_to_rpy(q)
    assert abs(pitch) <= math.pi / 2
    assert same_turn(math3.quat_from_rpy(roll, pitch, yaw), q)


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2, 1.57, 1.5707963])
def test_rpy_near_the_poles(pitch):
    q = math3.quat_from_rpy(0.3, pitch, 1.1)
    assert same_turn(math3.quat_from_rpy(*math3.quat_to_rpy(q)), q, 1e-13)


def test_rpy_is_about_fixed_axes():
    # rolled first, then pitched, then yawed, all about the axes that stand still
    turned = math3.quat_rotate(math3.quat_from_rpy(math.pi / 2, 0.0, math.pi / 2), (0.0, 1.0, 0.0))
    assert turned == pytest.approx((0.0, 0.0, 1.0))
    turned = math3.quat_rotate(math3.quat_from_rpy(0.0, math.pi / 2, math.pi / 2), (1.0, 0.0, 0.0))
    assert turned == pytest.approx((0.0, 0.0, -1.0))


@given(vectors, vectors)
def test_quat_between(a, b):
    if math3.norm(a) > 1e-3 and math3.norm(b) > 1e-3:
        turned = math3.quat_rotate(math3.quat_between(a, b), math3.unit(a))
        assert turned == pytest.approx(math3.unit(b), abs=1e-5)


def test_quat_between_opposite_directions():
    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -2.0)):
        q = math3.quat_between(axis, math3.scale(axis, -3.0))
        assert math3.quat_rotate(q, math3.unit(axis)) == pytest.approx(math3.scale(math3.unit(axis), -1.0))


@given(quaternions, quaternions, st.floats(0.0, 1.0))
def test_slerp_divides_the_turn(a, b, t):
    def turn(p, q):
        return 2.0 * math.acos(min(1.0, abs(sum(x * y for x, y in zip(p, q)))))

    assert turn(a, math3.slerp(a, b, t)) == pytest.approx(t * turn(a, b), abs=2e-4)


def test_a_null_quaternion_means_no_turn():
    assert math3.quat_normalize((0.0, 0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0, 1.0)


@given(quaternions, st.lists(length, min_size=6, max_size=6))
def test_rotate_inertia(q, values):
    xx, xy, xz, yy, yz, zz = values
    i = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    r = np.array(math3.quat_to_matrix(q))
    assert np.allclose(math3.rotate_inertia(q, i.tolist()), r @ i @ r.T, atol=1e-8)

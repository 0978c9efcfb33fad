"""Constraints on joints, positions, orientations and sight."""

import motion
import numpy as np
import pytest
import robots


@pytest.fixture(scope="module")
def scene():
    return motion.PlanningScene(motion.load_model(*robots.arm("ur5")))


def turned(scene, rpy):
    """A state whose tool is turned by rpy from a comfortable pose, and that pose."""
    state = scene.state
    state.set_group("arm", [0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    start = state.pose("tool")
    found = motion.ik(scene, "arm", start * motion.Pose.from_rpy((0, 0, 0), rpy), seed=state, timeout=1.0, random_seed=1)
    state.set_group("arm", found.solutions[0])
    return start, state


@pytest.mark.parametrize("value, satisfied", [(0.5, True), (0.7, True), (0.71, False), (0.4, True), (0.39, False)])
def test_joint(scene, value, satisfied):
    state = scene.state
    state.set("elbow_joint", value)
    (result,) = motion.evaluate(scene, state, motion.Constraints(joint=[motion.JointConstraint("elbow_joint", 0.5, above=0.2, below=0.1)]))
    assert result.satisfied is satisfied and result.distance == pytest.approx(abs(value - 0.5))
    assert ("'elbow_joint'" in result.description) is not satisfied


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    "position, tolerance, value, satisfied",
    [
        (4.0, 0.1, np.pi, True),  # all of it is beyond the limit: the limit is meant
        (4.0, 0.1, 3.14, False),
        (3.2, 0.1, np.pi, True),  # part of it is within: all of it stays what it is
        (3.2, 0.1, 3.101, True),
        (3.2, 0.1, 3.099, False),
        (3.1, 0.1, 3.001, True),
    ],
)
def test_a_joint_constraint_beyond_a_limit(scene, sign, position, tolerance, value, satisfied):
    """As kinematic_constraints::JointConstraint::configure() of MoveIt has it; the joint goes from -pi to pi."""
    state = scene.state
    state.set("elbow_joint", sign * value)
    constraint = motion.JointConstraint("elbow_joint", sign * position, above=tolerance, below=tolerance)
    (result,) = motion.evaluate(scene, state, motion.Constraints(joint=[constraint]))
    assert result.satisfied is satisfied


@pytest.mark.parametrize("turns", [-3, 0, 1, 5])
def test_an_angle_without_limits_is_one_however_often_it_is_turned(turns):
    scene = motion.PlanningScene(motion.load_model(*robots.arm("fetch")))
    state = scene.state
    state.set("wrist_roll_joint", 3.1)
    constraint = motion.JointConstraint("wrist_roll_joint", -3.1 + 2 * np.pi * turns, above=0.1, below=0.1)
    (result,) = motion.evaluate(scene, state, motion.Constraints(joint=[constraint]))
    assert result.satisfied and result.distance == pytest.approx(2 * np.pi - 6.2)


def test_position_of_a_point_of_the_link_in_a_moving_frame(scene):
    state = scene.state
    state.randomize("arm", seed=3)
    point = state.pose("link_2").inverse() * (state.pose("tool") * (0.0, 0.0, 0.1))
    for region, inside in ((motion.Sphere(0.01), True), (motion.Box(0.02, 0.02, 0.02), True)):
        for shift, expected in ((0.0, inside), (0.02, False)):
            c = motion.PositionConstraint("tool", [(region, (point + (shift, 0, 0), (0, 0, 0, 1)))], offset=(0, 0, 0.1), frame="link_2")
            (result,) = motion.evaluate(scene, state, motion.Constraints(position=[c]))
            assert result.satisfied is expected and result.distance == pytest.approx(shift, abs=1e-9)


@pytest.mark.parametrize("parameterization", ["euler", "rotation_vector"])
@pytest.mark.parametrize(
    "rpy, satisfied", [((0.09, 0, 0), True), ((0.11, 0, 0), False), ((0, 0.19, 0), True), ((0, 0.21, 0), False), ((0, 0, 3.0), True)]
)
def test_orientation_tolerances_per_axis(scene, parameterization, rpy, satisfied):
    start, state = turned(scene, rpy)
    c = motion.OrientationConstraint("tool", start.quaternion, (0.1, 0.2, 3.1), parameterization=parameterization)
    assert motion.evaluate(scene, state, motion.Constraints(orientation=[c]))[0].satisfied is satisfied


def test_free_turning_about_y_is_understood(scene):
    start, state = turned(scene, (0, 2.5, 0))
    c = motion.OrientationConstraint("tool", start.quaternion, (0.01, np.pi, 0.01))
    assert motion.evaluate(scene, state, motion.Constraints(orientation=[c]))[0]


def test_projection_reaches_tight_constraints_and_keeps_limits(scene):
    start, state = turned(scene, (0, 0, 0))
    constraints = motion.Constraints(
        orientation=[motion.OrientationConstraint("tool", start.quaternion, (0.02, 0.02, 3.2))],
        position=[motion.PositionConstraint("tool", [(motion.Box(2, 2, 0.02), start)])],
    )
    reached = 0
    for seed in range(50):
        state.randomize("arm", seed=seed)
        if motion._core._project(scene, state, "arm", constraints):
            reached += 1
            assert all(motion.evaluate(scene, state, constraints)) and state.in_bounds("arm")
    assert reached >= 30


def test_sight(scene):
    state = scene.state
    state.set_group("arm", [0, -np.pi / 2, 0, 0, 0, 0])  # straight up
    sensor = motion.Pose.from_rpy((-1, 0, 0.5), (0, np.pi / 2, 0))
    target = motion.Pose.from_rpy((1, 0, 0.5), (0, -np.pi / 2, 0))
    sight = motion.VisibilityConstraint(target, "base_link", 0.05, sensor, "base_link")
    (hidden,) = motion.evaluate(scene, state, motion.Constraints(visibility=[sight]))
    assert not hidden and "between the sensor and the target" in hidden.description
    state.set_group("arm", [np.pi / 2, 0, 0, 0, 0, 0])
    assert motion.evaluate(scene, state, motion.Constraints(visibility=[sight]))[0]
    sight.max_view_angle = 0.1
    sight.sensor_pose = motion.Pose.from_rpy((-1, 0, 0.5), (0, np.pi / 3, 0))
    assert not motion.evaluate(scene, state, motion.Constraints(visibility=[sight]))[0]


@pytest.mark.parametrize(
    "constraints, error, said",
    [
        (motion.Constraints(joint=[motion.JointConstraint("nobody", 0)]), motion.UnknownNameError, "no joint 'nobody'"),
        (motion.Constraints(position=[motion.PositionConstraint("tool", [])]), motion.InvalidInputError, "no region"),
        (
            motion.Constraints(position=[motion.PositionConstraint("none", [(motion.Sphere(1), ((0, 0, 0), (0, 0, 0, 1)))])]),
            motion.UnknownNameError,
            "no link 'none'",
        ),
        (
            motion.Constraints(orientation=[motion.OrientationConstraint("tool", (0, 0, 0, 1), (1, 1, 1), frame="moon")]),
            motion.UnknownNameError,
            "no frame 'moon'",
        ),
        (motion.Constraints(joint=[motion.JointConstraint("elbow_joint", float("nan"))]), motion.InvalidInputError, "must be finite"),
    ],
)
def test_bad_constraints_are_named(scene, constraints, error, said):
    with pytest.raises(error, match=said):
        motion.evaluate(scene, scene.state, constraints)


@pytest.mark.parametrize(
    "joint, goal", [("upperarm_roll_joint", 7.0), ("wrist_roll_joint", -4.0), ("forearm_roll_joint", 10 * np.pi + 0.1)]
)
def test_a_goal_of_one_continuous_joint_may_be_beyond_a_turn(joint, goal):
    model = motion.load_model(*robots.arm("fetch"))
    wanted = motion.Constraints(joint=[motion.JointConstraint(joint, goal, 1e-3, 1e-3)])
    result = motion.plan(motion.PlanningScene(model), motion.MotionRequest("arm", goals=[wanted], seed=1, planning_time=10.0))
    assert result, result.message
    end = result.path[-1][model.group("arm").variables.index(joint)]
    assert abs((end - goal + np.pi) % (2 * np.pi) - np.pi) <= 1.1e-3


@pytest.mark.parametrize("goal, low", [(2.3, 2.2), (2.35, 2.25), (-2.3, 2.2)])
def test_a_goal_that_is_partly_beyond_a_limit_is_reached_within_it(goal, low):
    """The joint goes to 2.251 rad each way."""
    model = motion.load_model(*robots.arm("fetch"))
    wanted = motion.Constraints(joint=[motion.JointConstraint("elbow_flex_joint", goal, 0.1, 0.1)])
    result = motion.plan(motion.PlanningScene(model), motion.MotionRequest("arm", goals=[wanted], seed=1, planning_time=10.0))
    assert result, result.message
    end = result.path[-1][model.group("arm").variables.index("elbow_flex_joint")] * np.sign(goal)
    assert low - 1e-6 <= end <= 2.251 + 1e-6

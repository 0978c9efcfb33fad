"""Times for paths: limits kept, ends at rest, way points passed."""

import motion
import numpy as np
import pytest
import robots

LIMITS = {
    f"{name}": {"has_velocity_limits": True, "max_velocity": v, "has_acceleration_limits": True, "max_acceleration": a}
    for (name, *_), v, a in zip(robots.UR5, (3.15, 3.15, 3.15, 3.2, 3.2, 3.2), (2.0, 1.5, 2.0, 3.0, 3.0, 4.0))
}


@pytest.fixture(scope="module")
def model():
    return motion.load_model(*robots.arm("ur5"), joint_limits=LIMITS)


def path(model, count=40, seed=1):
    """A smooth wandering way."""
    t = np.linspace(0, 1, count)[:, None]
    random = np.random.default_rng(seed)
    phase, size = random.uniform(0, 6, (1, 6)), random.uniform(0.3, 1.0, (1, 6))
    return motion.Trajectory(model, "arm", model.state(), size * np.sin(2.5 * t + phase))


def fine(trajectory, steps=20):
    """Cubic Hermite interpolation between points: (times, positions, velocities, accelerations)."""
    out = []
    for i in range(len(trajectory) - 1):
        h = trajectory.times[i + 1] - trajectory.times[i]
        q0, q1, v0, v1 = trajectory.positions[i], trajectory.positions[i + 1], trajectory.velocities[i], trajectory.velocities[i + 1]
        s = (np.linspace(0, 1, steps, endpoint=False))[:, None]
        v = ((6 * s * s - 6 * s) * q0 + (6 * s - 6 * s * s) * q1) / h + (3 * s * s - 4 * s + 1) * v0 + (3 * s * s - 2 * s) * v1
        out.append(v)
    return np.concatenate(out)


@pytest.mark.parametrize("method", motion.timing_methods())
@pytest.mark.parametrize("velocity, acceleration", [(1.0, 1.0), (0.1, 0.1), (1.0, 0.2)])
def test_limits_are_kept_and_the_ends_are_at_rest(model, method, velocity, acceleration):
    timed = motion.time_parameterize(model, path(model), method, velocity_scaling=velocity, acceleration_scaling=acceleration)
    v_max = np.array([LIMITS[n]["max_velocity"] for n in timed.variables]) * velocity
    a_max = np.array([LIMITS[n]["max_acceleration"] for n in timed.variables]) * acceleration
    assert (np.diff(timed.times) > 0).all() and timed.times[0] == 0
    assert (np.abs(timed.velocities) <= v_max * 1.001).all()
    assert (np.abs(timed.accelerations) <= a_max * 1.0011).all()
    np.testing.assert_allclose(timed.velocities[[0, -1]], 0, atol=1e-9)
    np.testing.assert_allclose(timed.positions[[0, -1]], path(model).positions[[0, -1]], atol=1e-9)
    assert (np.abs(fine(timed)) <= v_max * 1.1).all()


@pytest.mark.parametrize("method", ["iterative_parabolic", "iterative_spline"])
def test_way_points_stay(model, method):
    given = path(model)
    np.testing.assert_array_equal(motion.time_parameterize(model, given, method).positions, given.positions)


def test_one_joint_straight_is_the_textbook_trapeze(model):
    """1.5 rad at 3.15 rad/s and 2 rad/s^2 never cruises: 2 sqrt(1.5 / 2) s."""
    rows = np.zeros((2, 6))
    rows[1, 0] = 1.5
    timed = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), rows), "time_optimal", resample_dt=0.01)
    assert timed.duration == pytest.approx(2 * np.sqrt(1.5 / 2), rel=2e-3)
    assert timed.velocities[:, 0].max() == pytest.approx(2 * np.sqrt(0.75), rel=1e-2)
    slow = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), rows), "time_optimal", velocity_scaling=0.1)
    assert slow.duration == pytest.approx(1.5 / 0.315 + 0.315 / 2, rel=2e-3)


def straight(model, way, count, method, velocity, acceleration):
    """Duration (s) of ``way`` rad of the first joint in ``count`` points, at these limits."""
    rows = np.zeros((count, 6))
    rows[:, 0] = np.linspace(0, way, count)
    trajectory = motion.Trajectory(model, "arm", model.state(), rows)
    scaling = {"velocity_scaling": velocity / 3.15, "acceleration_scaling": acceleration / 2.0}
    return motion.time_parameterize(model, trajectory, method, **scaling).duration


@pytest.mark.parametrize(
    "way, count, velocity, acceleration", [(0.034, 86, 0.1, 0.5), (1.0, 1001, 2.0, 2.0), (0.3, 301, 0.2, 0.4), (1.4, 27, 1.0, 2.0)]
)
def test_parabolic_times_are_the_trapeze_however_dense_the_points(model, way, count, velocity, acceleration):
    """On paper: way / v + v / a, or 2 sqrt(way / a) where it never cruises."""
    trapeze = way / velocity + velocity / acceleration if way > velocity**2 / acceleration else 2 * np.sqrt(way / acceleration)
    assert straight(model, way, count, "iterative_parabolic", velocity, acceleration) == pytest.approx(trapeze, rel=0.01)


@pytest.mark.parametrize(
    "way, count, velocity, acceleration, upstream",
    [(0.034, 86, 0.1, 0.5, 1.013), (0.014, 36, 0.1, 0.5, 0.478), (1.0, 101, 1.0, 1.0, 4.832), (1.4416, 27, 1.0, 2.0, 1.951)],
)
def test_splines_are_as_quick_as_upstreams(model, way, count, velocity, acceleration, upstream):
    """MoveIt's algorithm, without its two more points, for the same points."""
    assert straight(model, way, count, "iterative_spline", velocity, acceleration) == pytest.approx(upstream, rel=0.1)


def test_time_optimal_beats_parabolic_and_rounds_corners_within_tolerance(model):
    corner = np.zeros((3, 6))
    corner[1, :2] = 1.0, 0.0
    corner[2, :2] = 1.0, 1.0
    for tolerance in (0.1, 0.02):
        timed = motion.time_parameterize(
            model, motion.Trajectory(model, "arm", model.state(), corner), "time_optimal", path_tolerance=tolerance, resample_dt=0.005
        )
        nearest = np.linalg.norm(timed.positions - corner[1], axis=1).min()
        assert tolerance * 0.9 <= nearest <= tolerance * 1.1
    assert (
        motion.time_parameterize(model, path(model), "time_optimal").duration
        < motion.time_parameterize(model, path(model), "iterative_parabolic").duration
    )


def test_sharp_corners_come_to_rest(model):
    corner = np.zeros((3, 6))
    corner[1, 0] = corner[2, 0] = corner[2, 1] = 1.0
    timed = motion.time_parameterize(
        model, motion.Trajectory(model, "arm", model.state(), corner), "time_optimal", path_tolerance=0.0, resample_dt=0.01
    )
    at = np.argmin(np.linalg.norm(timed.positions - corner[1], axis=1))
    assert np.abs(timed.velocities[at]).max() < 0.03
    assert timed.duration == pytest.approx(2 * np.sqrt(1 / 2) + 2 * np.sqrt(1 / 1.5), rel=1e-2)


def test_there_and_back_on_the_same_line(model):
    rows = np.zeros((3, 6))
    rows[1, 0] = 1.0
    timed = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), rows), "time_optimal", resample_dt=0.01)
    assert timed.duration == pytest.approx(4 * np.sqrt(1 / 2), rel=1e-2) and timed.positions[:, 0].max() == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("method", motion.timing_methods())
@pytest.mark.parametrize("rows", [np.zeros((1, 6)), np.zeros((0, 6)), np.zeros((2, 6)), np.full((5, 6), 0.3)])
def test_paths_that_go_nowhere(model, method, rows):
    timed = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), rows), method)
    assert timed.duration == 0.0 and len(timed) <= len(rows)


def test_unset_limits_are_one(model):
    free = motion.load_model(robots.arm("ur5")[0].replace('velocity="3"', 'velocity="0"'), robots.arm("ur5")[1])
    rows = np.zeros((2, 6))
    rows[1, 0] = 2.0
    timed = motion.time_parameterize(
        free, motion.Trajectory(free, "arm", free.state(), rows), "time_optimal", velocity_scaling=0.5, acceleration_scaling=0.5
    )
    assert timed.duration == pytest.approx(3.0, rel=2e-3)  # unscaled for this method, as upstream


@pytest.mark.parametrize("scaling", [0.0, -1.0, 2.0])
def test_scalings_outside_mean_one(model, scaling):
    assert (
        motion.time_parameterize(model, path(model), velocity_scaling=scaling, acceleration_scaling=scaling).duration
        == motion.time_parameterize(model, path(model)).duration
    )


def test_many_random_paths_with_corners(model):
    random = np.random.default_rng(5)
    a_max = np.array([LIMITS[n]["max_acceleration"] for n in model.group("arm").variables])
    for _ in range(30):
        rows = random.uniform(-2, 2, (random.integers(3, 12), 6))
        timed = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), rows), "time_optimal", resample_dt=0.02)
        assert (np.abs(timed.accelerations) <= a_max * 1.01).all() and (np.abs(timed.velocities) <= 3.2 * 1.001).all()
        stepped = np.diff(timed.positions, axis=0) / np.diff(timed.times)[:, None]
        assert (np.abs(stepped) <= 3.2 * 1.01).all()


def test_limits_of_zero_and_unknown_methods_are_refused(model):
    limits = dict(LIMITS, elbow_joint={"has_acceleration_limits": True, "max_acceleration": 0.0})
    bad = motion.load_model(*robots.arm("ur5"), joint_limits=limits)
    with pytest.raises(motion.InvalidInputError, match="acceleration limit of joint 'elbow_joint' is 0: it must"):
        motion.time_parameterize(bad, path(bad))
    with pytest.raises(motion.InvalidInputError, match="no timing method 'magic'"):
        motion.time_parameterize(model, path(model), "magic")


def test_industrial_motions_name_a_limit_of_zero_as_well():
    bad = motion.load_model(*robots.arm("ur5"), joint_limits=dict(LIMITS, elbow_joint={"max_acceleration": 0.0}))
    scene = motion.PlanningScene(bad)
    state = scene.state
    state.set_group("arm", [0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    scene.set_state(state)
    tool = state.pose("tool")
    for planner in ("PTP", "LIN"):
        goal = motion.pose_goal("tool", (tool.position + (0.0, 0.1, 0.0), tool.quaternion))
        result = motion.pilz_plan(scene, motion.MotionRequest("arm", planner=planner, goals=[goal]))
        assert not result and "the acceleration limit of joint 'elbow_joint' is 0: it must be above 0" in result.message


def test_cartesian_speed_limit(model):
    timed = motion.time_parameterize(model, path(model))
    slow = motion.limit_cartesian_speed(timed, "tool", 0.1)
    places = np.array([slow.state(i).pose("tool").position for i in range(len(slow))])
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / np.diff(slow.times)
    assert speeds.max() <= 0.1 + 1e-9 and slow.duration > timed.duration


def test_trajectory_tools(model):
    timed = motion.time_parameterize(model, path(model))
    back = timed.reversed()
    np.testing.assert_allclose(back.positions, timed.positions[::-1])
    assert back.duration == pytest.approx(timed.duration) and (np.diff(back.times) >= 0).all()
    both = timed.append(back)
    assert len(both) == 2 * len(timed) - 1 and both.duration == pytest.approx(2 * timed.duration)
    middle = timed.state_at(0.5 * (timed.times[3] + timed.times[4])).get_group("arm")
    np.testing.assert_allclose(middle, 0.5 * (timed.positions[3] + timed.positions[4]), atol=1e-12)
    assert timed.joint_limits_exceeded(0.02) == []
    fast = timed.replaced(velocities=timed.velocities * 50)
    assert any("velocity" in line for line in fast.joint_limits_exceeded())
    with pytest.raises(motion.InvalidInputError, match="shape"):
        motion.Trajectory(model, "arm", model.state(), [[0, 1]])


@pytest.mark.parametrize("method", motion.timing_methods())
@pytest.mark.parametrize("jerk", [10.0, 60.0])
def test_jerks_are_limited(method, jerk):
    limits = {name: {**entry, "has_jerk_limits": True, "max_jerk": jerk} for name, entry in LIMITS.items()}
    model = motion.load_model(*robots.arm("ur5"), joint_limits=limits)
    timed = motion.time_parameterize(model, path(model), method)
    smooth = motion.limit_jerk(timed)
    step = np.diff(smooth.times)[:, None]
    assert (np.abs(np.diff(smooth.accelerations, axis=0) / step) <= jerk * 1.001).all()
    v_max = np.array([LIMITS[n]["max_velocity"] for n in smooth.variables])
    assert (np.abs(smooth.velocities) <= v_max * 1.1).all()
    # velocities and accelerations are those of the positions
    middle = np.diff(smooth.positions, axis=0) / step
    np.testing.assert_allclose(middle, (smooth.velocities[1:] + smooth.velocities[:-1]) / 2, atol=step[0, 0] ** 2 * jerk / 6)
    for rows in (smooth.velocities, smooth.accelerations):
        np.testing.assert_allclose(rows[[0, -1]], 0, atol=1e-6)
    np.testing.assert_allclose(smooth.positions[[0, -1]], timed.positions[[0, -1]], atol=1e-9)
    assert timed.duration < smooth.duration < timed.duration + 2 * 20 / jerk + 0.1
    # it stays on the way: each point is near the straight pieces of the old one
    dense = np.concatenate([np.linspace(a, b, 50) for a, b in zip(timed.positions, timed.positions[1:])])
    assert max(np.abs(dense - point).max(axis=1).min() for point in smooth.positions) < 4.0 * (8 / jerk) ** 2 / 24 + 0.02


def test_the_adapter_limits_jerks_and_times_what_is_untimed():
    model = motion.load_model(*robots.arm("ur5"), joint_limits=LIMITS)
    scene = motion.PlanningScene(model)
    request = motion.MotionRequest("arm", goals=[motion.joint_goal(model, "arm", [0.5, -0.5, 0.5, 0.1, 0.2, 0.3])], seed=1)
    for adapters in (["AddRuckigTrajectorySmoothing", "AddTimeOptimalParameterization"], ["AddRuckigTrajectorySmoothing"]):
        pipeline = motion.Pipeline(["default_planner_request_adapters/" + name for name in adapters])
        assert pipeline.warnings == []
        trajectory = pipeline.generate(scene, request).trajectory
        jerks = np.diff(trajectory.accelerations, axis=0) / np.diff(trajectory.times)[:, None]
        assert 20.0 < np.abs(jerks).max() <= 100.1


@pytest.mark.parametrize("method", motion.timing_methods())
def test_no_two_points_come_at_one_time(model, method):
    """Controllers refuse times that do not rise. Way points that say nothing new (a line that begins where the tool is) go."""
    way = path(model, 12).positions
    doubled = np.repeat(way, 2, axis=0)
    doubled[5] += 1e-12
    timed = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), doubled), method)
    nanoseconds = [round(t * 1e9) for t in timed.times]
    assert all(b > a for a, b in zip(nanoseconds, nanoseconds[1:]))
    np.testing.assert_allclose(timed.positions[[0, -1]], way[[0, -1]], atol=1e-9)
    assert timed.duration == pytest.approx(
        motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), way), method).duration, rel=0.02
    )
    still = motion.time_parameterize(model, motion.Trajectory(model, "arm", model.state(), way[[0, 0, 0]]), method)
    assert len(still) == 1 and still.duration == 0


def test_a_start_put_before_a_motion_that_goes_nowhere_has_a_time_of_its_own():
    """FixStartStateBounds: the goal is the limit that the start is beyond by a little."""
    model = motion.load_model(*robots.arm("ur5"))
    scene, state = motion.PlanningScene(model), model.state()
    values = np.array([0.3, -1.2, 1.4, -0.9, 1.1, 2 * np.pi])
    state.set_group("arm", values + (0, 0, 0, 0, 0, 0.03))
    goal = motion.joint_goal(model, "arm", values)
    result = motion.Pipeline().generate(scene, motion.MotionRequest("arm", goals=[goal], start=state, seed=1))
    assert result, result.message
    assert (np.diff(result.trajectory.times) > 1e-6).all()
    assert result.trajectory.positions[0][5] == pytest.approx(2 * np.pi + 0.03)

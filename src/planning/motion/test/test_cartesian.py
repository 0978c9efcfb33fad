"""Straight lines of a link, the request adapters, industrial motions."""

import motion
import numpy as np
import pytest
import robots
from reaching import HOME, model, moved, off_line, places, request, scene


def test_line_is_straight_in_steps(scene):
    start = scene.state.pose("tool")
    goal = motion.Pose(start.position + (0.1, 0.15, -0.1), start.quaternion)
    result = motion.cartesian_path(scene, "arm", [goal], max_step=0.01)
    points = places(result.trajectory)
    assert result.fraction == 1.0 and result and result.message == ""
    assert len(points) == int(np.linalg.norm((0.1, 0.15, 0.1)) / 0.01) + 2
    assert off_line(points, start.position, goal.position) < 2e-5
    np.testing.assert_allclose(points[-1], goal.position, atol=2e-5)
    np.testing.assert_allclose(result.trajectory.positions[0], HOME)


def test_several_way_points_relative_to_the_link(scene):
    steps = [((0, 0, -0.1), (0, 0, 0, 1)), ((0.05, 0, -0.1), (0, 0, 0, 1)), ((0, 0, 0), (0, 0, 0, 1))]
    result = motion.cartesian_path(scene, "arm", steps, relative=True)
    assert result.fraction == 1.0
    np.testing.assert_allclose(places(result.trajectory)[-1], scene.state.pose("tool").position, atol=3e-5)


def test_it_ends_at_an_obstacle_unless_told_not_to_look(scene):
    start = scene.state.pose("tool")
    goal = motion.Pose(start.position + (0, 0.3, 0), start.quaternion)
    scene.add_object("wall", [motion.Box(2, 0.02, 2)], pose=(start.position + (0, 0.25, 0), (0, 0, 0, 1)))
    stopped = motion.cartesian_path(scene, "arm", [goal])
    assert 0.3 < stopped.fraction < 0.9 and "collide" in stopped.message
    assert scene.path_valid(scene.state, "arm", stopped.trajectory.positions) == []
    assert motion.cartesian_path(scene, "arm", [goal], avoid_collisions=False).fraction == 1.0


def test_it_ends_where_the_arm_does(scene):
    start = scene.state.pose("tool")
    result = motion.cartesian_path(scene, "arm", [motion.Pose(start.position + (2.0, 0, 0), start.quaternion)])
    assert 0 < result.fraction < 1 and "further along the line" in result.message
    assert result.fraction == pytest.approx((len(result.trajectory) - 1) / 201, abs=1e-9)


def test_jumps_end_it(scene):
    start = scene.state.pose("tool")
    goal = motion.Pose(start.position + (0.1, 0.15, -0.1), start.quaternion)
    assert motion.cartesian_path(scene, "arm", [goal], jump_threshold=5.0).fraction == 1.0
    cut = motion.cartesian_path(scene, "arm", [goal], revolute_jump=0.001)
    assert cut.fraction == 0.0 and len(cut.trajectory) == 1 and "jumps" in cut.message
    assert motion.cartesian_path(scene, "arm", [goal], jump_threshold=1.0).fraction < 1.0  # no step above the mean


@pytest.mark.parametrize("angle", [0.5, 2.0])
def test_a_turn_in_place_is_made_in_steps(scene, angle):
    """2 degrees for each centimetre of max_step, as upstream: 3.5 rad/m."""
    start = scene.state.pose("tool")
    goal = start * motion.Pose.from_rpy((0, 0, 0), (0, 0, angle))
    result = motion.cartesian_path(scene, "arm", [goal], max_step=0.01, avoid_collisions=False)
    assert result, result.message
    assert len(result.trajectory) == int(angle / 0.035) + 2
    between = [
        a.interpolate(b, share)
        for a, b in zip(*[[result.trajectory.state(i) for i in range(k, len(result.trajectory) - 1 + k)] for k in (0, 1)])
        for share in (0.25, 0.5, 0.75)
    ]
    assert max(np.linalg.norm(state.pose("tool").position - start.position) for state in between) < 1e-3
    alone = motion.cartesian_path(scene, "arm", [goal], max_step=0.01, avoid_collisions=False, position_only=True)
    assert len(alone.trajectory) == 2  # arms whose orientation is free have no turn to make


def test_a_turn_in_place_meets_what_is_in_its_way():
    """A stick on the hand sweeps over a post that neither its start nor its end touches."""
    model = motion.load_model(*robots.arm("ur5"))
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", HOME)
    state.attach(
        motion.AttachedBody(
            "stick", "tool", [motion.Box(0.4, 0.02, 0.02)], pose=((0.25, 0, 0.05), (0, 0, 0, 1)), touch_links=["link_6", "link_5", "tool"]
        )
    )
    scene.set_state(state)
    tool = state.pose("tool")
    aside = tool * motion.Pose.from_rpy((0, 0, 0), (0, 0, 0.8)) * motion.Pose((0.4, 0, 0.05), (0, 0, 0, 1))
    scene.add_object("post", [motion.Sphere(0.03)], pose=aside)
    goal = tool * motion.Pose.from_rpy((0, 0, 0), (0, 0, 1.6))
    result = motion.cartesian_path(scene, "arm", [goal])
    assert 0.2 < result.fraction < 0.6 and "collide" in result.message
    assert motion.cartesian_path(scene, "arm", [goal], avoid_collisions=False)


def wrist_before_its_limit(scene, joint="wrist_3_joint", value=6.1):
    state = scene.state
    state.set(joint, value)
    scene.set_state(state)
    return state


def test_a_line_ends_at_a_joints_limit_and_no_joint_spins_back(scene):
    state = wrist_before_its_limit(scene)  # 0.18 rad before 2 pi
    axis_turn = motion.Pose.from_rpy((0, 0, 0), (0, 0, 0.6))
    for way in (axis_turn, axis_turn.inverse()):
        goal = state.pose("tool") * way
        result = motion.cartesian_path(scene, "arm", [goal], avoid_collisions=False)
        steps = np.abs(np.diff(result.trajectory.positions, axis=0)).max()
        assert steps < 0.1
        wrist = result.trajectory.positions[-1][5]
        assert (0.2 < result.fraction < 0.4 and "'wrist_3_joint'" in result.message and wrist > 6.2) or (
            result.fraction == 1.0 and wrist == pytest.approx(5.5, abs=1e-3)
        )
    lin = [
        motion.pilz_plan(scene, moved(scene, (0, 0, 0), "LIN", goals=[motion.pose_goal("tool", state.pose("tool") * way)]))
        for way in (axis_turn, axis_turn.inverse())
    ]
    assert sorted(result.status for result in lin) == ["no_ik_solution", "solved"]
    (good,) = (result for result in lin if result)
    assert np.abs(np.diff(good.trajectory.positions, axis=0)).max() < 0.5


def test_a_joint_without_a_limit_goes_on_past_half_a_turn():
    model = motion.load_model(*robots.arm("fetch"))
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", [0.2, 0.5, 0.3, -1.2, 0.1, 1.0, 3.0])
    scene.set_state(state)
    goal = state.pose("tool") * motion.Pose.from_rpy((0, 0, 0), (0.6, 0, 0))
    line = motion.time_parameterize(model, motion.cartesian_path(scene, "arm", [goal], avoid_collisions=False).trajectory)
    asked = motion.MotionRequest(
        "arm", goals=[motion.pose_goal("tool", goal)], planner="LIN", velocity_scaling=0.1, acceleration_scaling=0.1
    )
    for trajectory in (line, motion.pilz_plan(scene, asked).trajectory):
        assert trajectory.positions[-1][6] > 3.3  # a redundant arm does some of it with other joints
        assert np.abs(np.diff(trajectory.positions, axis=0)).max() < 0.2


def test_constraints_are_kept(scene):
    start = scene.state.pose("tool")
    keep = motion.Constraints(joint=[motion.JointConstraint("elbow_joint", 1.4, 0.05, 0.05)])
    result = motion.cartesian_path(scene, "arm", [motion.Pose(start.position + (0.2, 0, 0), start.quaternion)], constraints=keep)
    assert 0 < result.fraction < 1 and "'elbow_joint'" in result.message


@pytest.mark.parametrize(
    "change, error",
    [
        ({"max_step": 0.0}, motion.InvalidInputError),
        ({"link": "nobody"}, motion.UnknownNameError),
        ({"max_step": 1e-8}, motion.InvalidInputError),
    ],
)
def test_bad_cartesian_requests(scene, change, error):
    start = scene.state.pose("tool")
    with pytest.raises(error):
        motion.cartesian_path(scene, "arm", [motion.Pose(start.position + (0.1, 0, 0), start.quaternion)], **change)


# ---------------------------------------------------------------- pipeline


def test_pipeline_times_what_it_plans(scene):
    pipeline = motion.Pipeline()
    assert pipeline.warnings == []
    result = pipeline.generate(scene, request(scene, velocity_scaling=0.5, acceleration_scaling=0.5))
    assert result and result.trajectory.duration > 0.5 and result.trajectory.joint_limits_exceeded(0.02) == []
    faster = pipeline.generate(scene, request(scene))
    assert faster.trajectory.duration < result.trajectory.duration


def test_unknown_adapters_are_named():
    pipeline = motion.Pipeline(["default_planner_request_adapters/AddTimeOptimalParameterization", "my_adapters/Magic"])
    assert (
        len(pipeline.warnings) == 1
        and "'my_adapters/Magic'" in pipeline.warnings[0]
        and pipeline.adapters == ["AddTimeOptimalParameterization"]
    )


def test_a_start_slightly_outside_is_brought_in(scene):
    state = scene.state
    state.set("wrist_1_joint", -2 * np.pi - 0.04)
    result = motion.Pipeline().generate(scene, request(scene, start=state))
    assert result and result.added_prefix == [0]
    assert result.trajectory.positions[0][3] == pytest.approx(-2 * np.pi - 0.04) and result.trajectory.positions[1][3] == pytest.approx(
        -2 * np.pi
    )
    state.set("wrist_1_joint", -2 * np.pi - 0.2)
    assert motion.Pipeline().generate(scene, request(scene, start=state)).code == -26


def test_a_start_that_touches_is_freed(scene):
    tool = scene.state.pose("link_6").position
    scene.add_object("cup", [motion.Sphere(0.02)], pose=(tool + (0.058, 0, 0), (0, 0, 0, 1)))
    assert scene.check()
    result = motion.Pipeline(params={"jiggle_fraction": 0.02}).generate(scene, request(scene))
    assert result and result.added_prefix == [0]
    scene.add_object("block", [motion.Box(0.5, 0.5, 0.5)], pose=(tool, (0, 0, 0, 1)))
    assert motion.Pipeline().generate(scene, request(scene)).code == -10


def test_a_start_off_the_path_constraints_is_led_to_them(scene):
    keep = motion.Constraints(joint=[motion.JointConstraint("elbow_joint", 1.1, 0.2, 0.2)])
    result = motion.Pipeline().generate(scene, request(scene, path_constraints=keep))
    assert result and result.added_prefix
    kept = result.trajectory.positions[len(result.added_prefix) :, 2]
    assert (np.abs(kept - 1.1) <= 0.2 + 1e-6).all()


def test_what_a_planner_gets_wrong_is_found_by_the_last_check(scene):
    goal = [-0.5, -1.6, 1.1, -0.5, 0.9, -1.0]
    middle = scene.state.interpolate(scene.state, 0.0)
    middle.set_group("arm", 0.5 * (np.array(HOME) + goal))
    scene.add_object("ball", [motion.Sphere(0.05)], pose=(middle.pose("link_6").position, (0, 0, 0, 1)))

    def blind(scene, request, cancel):
        line = motion.Trajectory(scene.model, "arm", scene.state, np.linspace(HOME, goal, 30))
        return motion.PlanResult("solved", trajectory=line)

    result = motion.Pipeline().generate(scene, request(scene), planner=blind)
    assert not result and result.code == -2 and result.invalid and "'ball'" in result.message and result.contacts


def test_cartesian_speed_adapter(scene):
    result = motion.Pipeline().generate(scene, request(scene, cartesian_link="tool", cartesian_speed=0.05))
    speeds = np.linalg.norm(np.diff(places(result.trajectory), axis=0), axis=1) / np.diff(result.trajectory.times)
    assert speeds.max() <= 0.05 + 1e-9

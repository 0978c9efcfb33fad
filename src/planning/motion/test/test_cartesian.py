"""Straight lines of a link, the request adapters, industrial motions."""
import numpy as np
import pytest

import motion
import robots

HOME = [0.3, -1.2, 1.4, -0.9, 1.1, 0.5]


@pytest.fixture(scope="module")
def model():
    return motion.load_model(*robots.arm("ur5"))


@pytest.fixture
def scene(model):
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", HOME)
    scene.set_state(state)
    return scene


def places(trajectory, link="tool"):
    return np.array([trajectory.state(i).pose(link).position for i in range(len(trajectory))])


def off_line(points, a, b):
    way = (b - a) / np.linalg.norm(b - a)
    rest = points - a
    return np.linalg.norm(rest - np.outer(rest @ way, way), axis=1).max()


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

def request(scene, goal=(-0.5, -1.6, 1.1, -0.5, 0.9, -1.0), **more):
    return motion.MotionRequest("arm", goals=[motion.joint_goal(scene.model, "arm", list(goal))], seed=1, planning_time=60.0, **more)


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
    assert result.trajectory.positions[0][3] == pytest.approx(-2 * np.pi - 0.04) and result.trajectory.positions[1][
        3
    ] == pytest.approx(-2 * np.pi)
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
    kept = result.trajectory.positions[len(result.added_prefix):, 2]
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


# ---------------------------------------------------------------- industrial motions

def moved(scene, offset, planner, **more):
    start = scene.state.pose("tool")
    goal = motion.pose_goal("tool", (start.position + offset, start.quaternion))
    return motion.MotionRequest("arm", goals=[goal], planner=planner, velocity_scaling=0.2, acceleration_scaling=0.2, **more)


def test_ptp_moves_all_joints_together(scene):
    result = motion.pilz_plan(scene, request(scene, planner="PTP"))
    t = result.trajectory
    assert result and t.duration > 0 and (t.velocities[[0, -1]] == 0).all()
    way = t.positions[-1] - t.positions[0]
    shares = (t.positions - t.positions[0]) / way
    np.testing.assert_allclose(shares, np.broadcast_to(shares[:, :1], shares.shape), atol=1e-9)
    np.testing.assert_allclose(t.positions[-1], [-0.5, -1.6, 1.1, -0.5, 0.9, -1.0], atol=1e-9)
    # the longest way is 1.5 rad; 3 rad/s, 1 rad/s^2
    assert t.duration == pytest.approx(2 * np.sqrt(np.abs(way).max()), rel=1e-6)


def test_lin_is_straight_with_the_speed_asked_for(scene):
    result = motion.pilz_plan(scene, moved(scene, (0.1, 0.15, -0.1), "LIN"))
    assert result, result.message
    points = places(result.trajectory)
    assert off_line(points, points[0], points[-1]) < 5e-5
    speeds = np.linalg.norm(np.diff(points, axis=0), axis=1) / np.diff(result.trajectory.times)
    assert 0.15 < speeds.max() <= 0.2 + 1e-6  # 1 m/s scaled by 0.2


@pytest.mark.parametrize("kind", ["interim", "center"])
def test_circ_keeps_its_distance_from_the_centre(scene, kind):
    start = scene.state.pose("tool").position
    centre = start + (0, 0.1, 0)
    point = centre if kind == "center" else centre + (0, 0, 0.1)
    extra = motion.Constraints(position=[motion.PositionConstraint("tool", [(motion.Sphere(0.001), (point, (0, 0, 0, 1)))])], name=kind)
    goal = (0, 0.1, 0.1) if kind == "center" else (0, 0.2, 0)
    result = motion.pilz_plan(scene, moved(scene, goal, "CIRC", path_constraints=extra))
    assert result, result.message
    points = places(result.trajectory)
    np.testing.assert_allclose(np.linalg.norm(points - centre, axis=1), 0.1, atol=5e-5)
    np.testing.assert_allclose(points[-1], start + goal, atol=5e-5)
    if kind == "interim":
        assert points[:, 2].max() > start[2] + 0.09


@pytest.mark.parametrize("planner, offset, change, status", [
    ("LIN", (2, 0, 0), {}, "no_ik_solution"), ("CIRC", (0, 0.2, 0), {}, "no_goal"), ("SPIN", (0, 0, 0), {}, "unknown_planner"),
    ("LIN", (0.1, 0, 0), {"velocity_scaling": 0.0}, "failed"), ("LIN", (0.1, 0, 0), {"goals": []}, "no_goal")])
def test_industrial_motions_that_cannot_be(scene, planner, offset, change, status):
    wanted = moved(scene, offset, planner)
    for key, value in change.items():
        setattr(wanted, key, value)
    result = motion.pilz_plan(scene, wanted)
    assert result.status == status and result.message and result.trajectory is None


def test_sequence_stops_between_motions_or_blends_them(scene):
    start = scene.state.pose("tool")
    goals = [motion.pose_goal("tool", (start.position + offset, start.quaternion)) for offset in ((0, 0.15, 0), (0, 0.15, -0.15))]
    requests = [motion.MotionRequest("arm", goals=[g], planner="LIN", velocity_scaling=0.1, acceleration_scaling=0.1) for g in goals]
    corner = start.position + (0, 0.15, 0)
    stopping = motion.pilz_sequence(scene, [(requests[0], 0.0), (requests[1], 0.0)])
    assert stopping and len(stopping.trajectories) == 1
    assert np.linalg.norm(places(stopping.trajectories[0]) - corner, axis=1).min() < 1e-4
    blended = motion.pilz_sequence(scene, [(requests[0], 0.05), (requests[1], 0.0)])
    assert blended, blended.message
    trajectory, = blended.trajectories
    nearest = np.linalg.norm(places(trajectory) - corner, axis=1).min()
    assert 0.005 < nearest < 0.05 and trajectory.duration < stopping.trajectories[0].duration
    np.testing.assert_allclose(places(trajectory)[-1], start.position + (0, 0.15, -0.15), atol=1e-4)
    assert (np.diff(trajectory.times) > 0).all()
    too_wide = motion.pilz_sequence(scene, [(requests[0], 0.5), (requests[1], 0.0)])
    assert not too_wide and "blend radius" in too_wide.message
    assert not motion.pilz_sequence(scene, [(requests[0], 0.1)])


def test_a_stretched_arm_can_be_drawn_in():
    """The first centimetre takes the elbow of a stretched arm far: further than the joints' values follow in one step."""
    model, done = motion.load_model(*robots.arm("fetch")), 0
    scene = motion.PlanningScene(model)
    for seed in range(100):
        state = model.state()
        state.randomize("arm", seed=seed)
        values = state.get_group("arm")
        values[3] = 0.001 * (seed % 5)  # with 0, no joint's motion begins to draw it in
        state.set_group("arm", values)
        here, back = state.pose("tool"), state.pose("link_2").position - state.pose("tool").position
        goal = (here.position + 0.05 * back / np.linalg.norm(back), here.quaternion)
        done += bool(motion.cartesian_path(scene, "arm", [goal], start=state, avoid_collisions=False))
    assert done >= 96  # the others meet a joint's limit


@pytest.mark.parametrize("name, way", [("fetch", (-0.05, 0, 0)), ("ur5", (-0.05, 0, 0)), ("iiwa", (0, 0, -0.05))])
def test_an_arm_that_is_quite_straight_can_be_drawn_in(name, way):
    model = motion.load_model(*robots.arm(name))
    state = model.state()
    here = state.pose("tool")
    line = motion.cartesian_path(motion.PlanningScene(model), "arm", [(here.position + way, here.quaternion)], start=state,
                                 avoid_collisions=False)
    assert line, line.message
    assert np.abs(np.diff(line.trajectory.positions, axis=0)).max() < 0.5


def test_an_arm_of_four_joints_follows_positions():
    """It cannot keep the orientation of its hand; with position_only it need not."""
    links = "".join(f'<link name="l{i}"/>' for i in range(6))
    joints = "".join(
        f'<joint name="j{i}" type="revolute"><parent link="l{i}"/><child link="l{i + 1}"/><origin xyz="0 0 {0.3 if i else 0.1}"/>'
        f'<axis xyz="{axis}"/><limit lower="-2.5" upper="2.5" velocity="1" effort="1"/></joint>'
        for i, axis in enumerate(("0 0 1", "0 1 0", "0 1 0", "0 1 0"))
    )
    model = motion.load_model(f'<robot name="small">{links}{joints}<joint name="end" type="fixed"><parent link="l4"/><child link="l5"/>'
                              '<origin xyz="0 0 0.2"/></joint></robot>',
                              '<robot name="small"><group name="arm"><chain base_link="l0" tip_link="l5"/></group></robot>')
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", [0.3, 0.5, 1.0, 0.4])
    here = state.pose("l5")
    goal = (here.position + (0.0, 0.1, 0.05), here.quaternion)
    assert motion.cartesian_path(scene, "arm", [goal], start=state).fraction < 0.5
    line = motion.cartesian_path(scene, "arm", [goal], start=state, position_only=True)
    assert line.fraction == 1.0
    assert off_line(places(line.trajectory, "l5"), here.position, goal[0]).max() < 2e-5

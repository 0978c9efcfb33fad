"""Industrial motions, one and several: their shapes, speeds and limits."""

import motion
import numpy as np
import pytest
import robots
from reaching import HOME, model, moved, off_line, places, request, scene


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


def test_ptp_brakes_as_the_strictest_joint_may(scene):
    """On paper: sqrt(2 way up down / (up + down)) is reached after top / up, and braked from for top / down."""
    limits = motion.CartesianLimits(joint_deceleration={"shoulder_pan_joint": -0.5, "elbow_joint": -0.25})
    t = motion.pilz_plan(scene, request(scene, planner="PTP"), limits=limits).trajectory
    way = np.abs(t.positions[-1] - t.positions[0]).max()
    top = np.sqrt(2 * way * 1.0 * 0.25 / 1.25)
    assert t.duration == pytest.approx(top / 1.0 + top / 0.25, rel=1e-6)
    slowing = t.accelerations[t.velocities * t.accelerations < 0]
    assert np.abs(slowing).max() == pytest.approx(0.25, rel=1e-6)
    wrong = motion.CartesianLimits(joint_deceleration={"elbow_joint": 0.25})
    assert (
        "max_deceleration of joint 'elbow_joint' has to be negative"
        in motion.pilz_plan(scene, request(scene, planner="PTP"), limits=wrong).message
    )


def test_lin_is_refused_where_a_joint_would_have_to_brake_too_hard(scene):
    asked = moved(scene, (0.1, 0.15, -0.1), "LIN")
    limits = motion.CartesianLimits(joint_deceleration={"elbow_joint": -0.01})
    result = motion.pilz_plan(scene, asked, limits=limits)
    assert not result and "above its deceleration limit 0.01" in result.message


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


def auxiliary(kind, position, **fields):
    return motion.AuxiliaryPoint(kind, tuple(position), **fields)


def test_circs_auxiliary_point_is_no_constraint(scene):
    """A small region about the point that it is given by is not where the path has to stay; other constraints of it hold."""
    start = scene.state.pose("tool").position
    extra = motion.Constraints(
        position=[motion.PositionConstraint("tool", [(motion.Sphere(0.01), (start + (0, 0.1, 0.1), (0, 0, 0, 1)))])], name="interim"
    )
    asked = moved(scene, (0, 0.2, 0), "CIRC", path_constraints=extra)
    result = motion.Pipeline([]).generate(scene, asked, planner=motion.pilz_plan)
    assert result, result.message
    extra.joint = [motion.JointConstraint("elbow_joint", 1.4, 0.001, 0.001)]
    kept = motion.Pipeline([]).generate(scene, moved(scene, (0, 0.2, 0), "CIRC", path_constraints=extra), planner=motion.pilz_plan)
    assert kept.status == "invalid_plan" and "'elbow_joint'" in kept.message


def test_circ_to_joint_values_moves_the_link_of_the_auxiliary_point(scene):
    state = scene.state
    state.set_group("arm", np.array(HOME) + (0.4, 0.1, 0, 0, 0, 0))
    links = {link: (scene.state.pose(link).position, state.pose(link).position) for link in ("tool", "link_6")}
    for link, (first, last) in links.items():
        point = (first + last) / 2 + (0, 0, 0.1)
        asked = motion.MotionRequest(
            "arm",
            goals=[motion.joint_goal(scene.model, "arm", state.get_group("arm"))],
            planner="CIRC",
            velocity_scaling=0.1,
            acceleration_scaling=0.1,
            auxiliary=auxiliary("interim", point, link=link),
        )
        result = motion.pilz_plan(scene, asked)
        assert result, result.message
        path = places(result.trajectory, link)
        normal = np.cross(point - first, last - first)
        assert np.abs((path - first) @ normal / np.linalg.norm(normal)).max() < 1e-4  # in the circle's plane
        assert path[:, 2].max() > max(first[2], last[2])
        assert np.abs(result.trajectory.positions[-1] - state.get_group("arm")).max() < 1e-3
    asked.auxiliary = auxiliary("interim", point, link="claw")
    assert motion.pilz_plan(scene, asked).code == -18  # INVALID_LINK_NAME


def test_the_point_that_is_moved_may_be_beside_its_link(scene):
    """A position constraint's target_point_offset: that point goes straight, whatever the link does about it."""
    start = scene.state.pose("tool")
    offset = np.array((0.0, 0.05, 0.2))
    turn = motion.Pose.from_rpy((0, 0, 0), (0, 0.5, 0.3))
    there = start * turn
    point = start * offset + np.array((0.0, 0.1, -0.05))
    goal = motion.Constraints(
        position=[motion.PositionConstraint("tool", [(motion.Sphere(1e-4), (point, (0, 0, 0, 1)))], offset=offset)],
        orientation=[motion.OrientationConstraint("tool", there.quaternion, (1e-3,) * 3)],
    )
    result = motion.pilz_plan(scene, moved(scene, (0, 0, 0), "LIN", goals=[goal], velocity_scaling=0.05, acceleration_scaling=0.05))
    assert result, result.message
    path = np.array([result.trajectory.state(i).pose("tool") * offset for i in range(len(result.trajectory))])
    assert off_line(path, start * offset, point) < 1e-4
    np.testing.assert_allclose(path[-1], point, atol=1e-4)


def test_lin_and_circ_keep_the_joints_accelerations():
    """As upstream: refused where a joint would have to speed up faster than it can; smaller scalings help."""
    limits = {name: {"max_acceleration": 0.5} for name, *_ in robots.UR5}
    scene = motion.PlanningScene(motion.load_model(*robots.arm("ur5"), joint_limits=limits))
    state = scene.state
    state.set_group("arm", HOME)
    scene.set_state(state)
    start, statuses = state.pose("tool").position, []
    for planner, extra in (("LIN", None), ("CIRC", auxiliary("interim", start + (0, 0.1, 0.05)))):
        for scale in (1.0, 0.3, 0.02):
            asked = moved(scene, (0, 0.2, 0), planner, velocity_scaling=scale, acceleration_scaling=scale, auxiliary=extra)
            result = motion.pilz_plan(scene, asked)
            statuses.append(result.status)
            if result:
                assert np.abs(result.trajectory.accelerations).max() <= 0.5 * 1.001
            else:
                assert result.code == -1 and "acceleration" in result.message and "0.5" in result.message
    assert statuses == ["failed", "failed", "solved"] * 2


def test_last_intervals_are_not_so_short_that_rounding_speeds_a_joint_up():
    from motion.pilz import _Trapeze

    for length in np.linspace(0.05, 0.5, 400):
        times = _Trapeze(length, 0.2, 0.45, 1.0).times()
        assert times[0] == 0 and (np.diff(times) >= 0.02 - 1e-9).all() and np.diff(times).max() < 0.12 + 1e-9


@pytest.mark.parametrize(
    "planner, offset, change, status",
    [
        ("LIN", (2, 0, 0), {}, "no_ik_solution"),
        ("CIRC", (0, 0.2, 0), {}, "invalid_plan"),
        ("SPIN", (0, 0, 0), {}, "unknown_planner"),
        ("CIRC", (0, 0.2, 0), {"auxiliary": auxiliary("center", (9, 9, 9))}, "invalid_plan"),
        ("CIRC", (0, 0.2, 0), {"auxiliary": auxiliary("interim", (0, 0, 0), frame="nowhere")}, "unknown_frame"),
        ("LIN", (0.1, 0, 0), {"velocity_scaling": 0.0}, "invalid_plan"),
        ("LIN", (0.1, 0, 0), {"goals": []}, "no_goal"),
    ],
)
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
    (trajectory,) = blended.trajectories
    nearest = np.linalg.norm(places(trajectory) - corner, axis=1).min()
    assert 0.005 < nearest < 0.05 and trajectory.duration < stopping.trajectories[0].duration
    np.testing.assert_allclose(places(trajectory)[-1], start.position + (0, 0.15, -0.15), atol=1e-4)
    assert (np.diff(trajectory.times) > 0).all()
    too_wide = motion.pilz_sequence(scene, [(requests[0], 0.5), (requests[1], 0.0)])
    assert not too_wide and "blend radius" in too_wide.message and too_wide.trajectories == []
    assert motion.pilz_sequence(scene, [(requests[0], 0.1)]).code == -2  # INVALID_MOTION_PLAN


def sequence_requests(scene, *offsets):
    start = scene.state.pose("tool")
    return [
        motion.MotionRequest(
            "arm",
            goals=[motion.pose_goal("tool", (start.position + offset, start.quaternion))],
            planner="LIN",
            velocity_scaling=0.1,
            acceleration_scaling=0.1,
        )
        for offset in offsets
    ]


def test_what_upstream_refuses_in_a_sequence(scene):
    first, second, third = sequence_requests(scene, (0, 0.1, 0), (0, 0.1, -0.1), (0, 0, -0.1))
    overlap = motion.pilz_sequence(scene, [(first, 0.06), (second, 0.06), (third, 0.0)])
    assert overlap.code == -2 and "overlap" in overlap.message
    assert motion.pilz_sequence(scene, [(first, 0.04), (second, 0.04), (third, 0.0)])
    assert motion.pilz_sequence(scene, [(first, -0.01), (second, 0.0)]).code == -2
    second.start = scene.state
    started = motion.pilz_sequence(scene, [(first, 0.0), (second, 0.0)])
    assert started.code == -17 and "motion 2" in started.message and not started.trajectories  # INVALID_ROBOT_STATE


def test_motions_of_a_sequence_go_through_the_pipeline(scene):
    """What a pipeline checks of one motion is checked of each: upstream plans every item with the whole of it."""
    requests = sequence_requests(scene, (0, 0.15, 0), (0, 0.15, -0.15))
    middle = scene.state.pose("link_6").position + (0, 0.15, -0.07)
    scene.add_object("post", [motion.Sphere(0.02)], pose=(middle, (0, 0, 0, 1)))
    pipeline = motion.Pipeline([])

    def plan(scene, request, cancel):
        return pipeline.generate(scene, request, cancel, motion.pilz_plan)

    refused = motion.pilz_sequence(scene, [(requests[0], 0.0), (requests[1], 0.0)], plan=plan)
    assert refused.code == -2 and "motion 2" in refused.message and "'post'" in refused.message and refused.contacts


def test_a_blend_is_looked_at_for_collisions(scene):
    """It cuts the corner: what stands inside is touched by neither motion."""
    requests = sequence_requests(scene, (0, 0.2, 0), (0, 0.2, -0.2))
    corner = scene.state.pose("tool").position + (0, 0.2, 0)
    free = motion.pilz_sequence(scene, [(requests[0], 0.15), (requests[1], 0.0)])
    path = places(free.trajectories[0])
    inside = path[np.argmin(np.linalg.norm(path - corner, axis=1))]
    state = scene.state
    state.attach(motion.AttachedBody("pin", "tool", [motion.Sphere(0.005)]))
    scene.set_state(state)
    away = inside + 0.004 * (inside - corner) / np.linalg.norm(inside - corner)
    scene.add_object("grain", [motion.Sphere(0.003)], pose=(away, (0, 0, 0, 1)))
    assert motion.pilz_sequence(scene, [(requests[0], 0.0), (requests[1], 0.0)])
    touched = motion.pilz_sequence(scene, [(requests[0], 0.15), (requests[1], 0.0)])
    assert touched.code == -2 and "'grain'" in touched.message


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
    line = motion.cartesian_path(
        motion.PlanningScene(model), "arm", [(here.position + way, here.quaternion)], start=state, avoid_collisions=False
    )
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
    model = motion.load_model(
        f'<robot name="small">{links}{joints}<joint name="end" type="fixed"><parent link="l4"/><child link="l5"/>'
        '<origin xyz="0 0 0.2"/></joint></robot>',
        '<robot name="small"><group name="arm"><chain base_link="l0" tip_link="l5"/></group></robot>',
    )
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", [0.3, 0.5, 1.0, 0.4])
    here = state.pose("l5")
    goal = (here.position + (0.0, 0.1, 0.05), here.quaternion)
    assert motion.cartesian_path(scene, "arm", [goal], start=state).fraction < 0.5
    line = motion.cartesian_path(scene, "arm", [goal], start=state, position_only=True)
    assert line.fraction == 1.0
    assert off_line(places(line.trajectory, "l5"), here.position, goal[0]).max() < 2e-5
    asked = motion.MotionRequest(
        "arm", goals=[motion.pose_goal("l5", goal)], start=state, planner="LIN", velocity_scaling=0.1, acceleration_scaling=0.1
    )
    assert motion.pilz_plan(scene, asked).code == -31  # NO_IK_SOLUTION
    asked.position_only = True
    for planner in ("LIN", "PTP"):
        asked.planner = planner
        found = motion.pilz_plan(scene, asked)
        assert found, found.message
        np.testing.assert_allclose(places(found.trajectory, "l5")[-1], goal[0], atol=1e-5)
        if planner == "LIN":
            assert off_line(places(found.trajectory, "l5"), here.position, goal[0]).max() < 2e-5

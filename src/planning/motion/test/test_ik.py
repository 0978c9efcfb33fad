"""Inverse kinematics on the published protocol: random reachable poses, 1e-5, 5 ms."""

import motion
import numpy as np
import pytest
import robots

POSES = 2000


@pytest.mark.parametrize("name", robots.ARMS)
def test_random_poses_from_random_seeds(name):
    """At least 99.6 % (TRAC-IK's published rate). A restart budget instead of 5 ms: the machine may be busy."""
    model = motion.load_model(*robots.arm(name))
    state, seed = model.state(), model.state()
    solved, restarts = 0, []
    lower, upper = model.group("arm").position_limits()
    for i in range(POSES):
        state.randomize("arm", seed=2 * i)
        seed.randomize("arm", seed=2 * i + 1)
        goal = state.pose("tool")
        found = motion.ik(model, "arm", goal, seed=seed, timeout=1.0, max_restarts=200, random_seed=i)
        restarts.append(found.restarts)
        if not found:
            continue
        (solution,) = found.solutions
        seed.set_group("arm", solution)
        reached = seed.pose("tool")
        error = np.linalg.norm(reached.position - goal.position) + np.linalg.norm((reached.inverse() * goal).rpy())
        assert error < 3e-5 and (solution >= lower - 1e-12).all() and (solution <= upper + 1e-12).all()
        solved += 1
    assert solved >= 0.996 * POSES
    assert np.median(restarts) <= 3  # some 0.02 ms each


def test_all_eight_families_of_a_ur5():
    model = motion.load_model(*robots.arm("ur5"))
    state = model.state()
    state.set_group("arm", [0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    goal = state.pose("tool")
    found = motion.ik(model, "arm", goal, seed=state, solutions=8, timeout=1.0, max_restarts=2000, random_seed=1)
    assert len(found.solutions) == 8
    np.testing.assert_allclose(found.solutions[0], state.get_group("arm"), atol=1e-9)  # nearest to the seed first
    wrists = {(round(np.sin(q[4]), 3) > 0, round(np.sin(q[2]), 3) > 0) for q in found.solutions}
    assert len(wrists) == 4


def test_joints_that_turn_the_other_way_have_the_angles_with_the_other_sign():
    """An axis that is turned round, the one of the frame's z among them, changes an angle's sign and nothing else."""
    axes = {"0.0 0.0 1.0": "0 0 -3", "0.0 1.0 0.0": "0 -1e-4 0"}  # lengths do not matter
    urdf, srdf = robots.arm("ur5")
    turned = urdf
    for axis, other in axes.items():
        assert axis in urdf
        turned = turned.replace(f'<axis xyz="{axis}"/>', f'<axis xyz="{other}"/>')
    values = np.array([0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    models = [motion.load_model(text, srdf) for text in (urdf, turned)]
    states = [model.state() for model in models]
    for state, sign in zip(states, (1, -1)):
        state.set_group("arm", sign * values)
    goal = states[0].pose("tool")
    np.testing.assert_allclose(states[1].pose("tool").matrix(), goal.matrix(), atol=1e-12)
    found = motion.ik(models[1], "arm", goal, seed=states[1], solutions=8, timeout=1.0, max_restarts=2000, random_seed=1)
    assert len(found.solutions) == 8
    np.testing.assert_allclose(found.solutions[0], -values, atol=1e-9)


def test_position_only_leaves_the_rest_free():
    model = motion.load_model(*robots.arm("panda"))
    goal = ((0.4, 0.2, 0.5), (0, 0, 0, 1))
    found = motion.ik(model, "arm", goal, position_only=True, random_seed=3, timeout=1.0)
    state = model.state()
    state.set_group("arm", found.solutions[0])
    np.testing.assert_allclose(state.pose("tool").position, goal[0], atol=1e-5)


def test_consistency_limits_keep_near_the_seed():
    model = motion.load_model(*robots.arm("iiwa"))
    state, seed = model.state(), model.state()
    seed.set_group("arm", [0.2, 0.4, 0.1, -1.2, 0.3, 0.9, 0.2])
    state.set_group("arm", seed.get_group("arm") + 0.05)
    near = motion.ik(model, "arm", state.pose("tool"), seed=seed, consistency=[0.15] * 7, timeout=1.0, random_seed=1)
    assert near and np.abs(near.solutions[0] - seed.get_group("arm")).max() <= 0.15 + 1e-9
    assert not motion.ik(model, "arm", state.pose("tool"), seed=seed, consistency=[0.001] * 7, max_restarts=50, timeout=1.0)


def test_solutions_are_put_to_the_validity_test():
    model = motion.load_model(*robots.arm("ur5"))
    state = model.state()
    state.set_group("arm", [0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    found = motion.ik(model, "arm", state.pose("tool"), seed=state, valid=lambda q: q[2] < 0, timeout=1.0, random_seed=1)
    assert found and found.solutions[0][2] < 0 and found.rejected > 0


def test_out_of_reach_is_no_exception_and_says_how_far():
    model = motion.load_model(*robots.arm("ur5"))
    found = motion.ik(model, "arm", ((3.0, 0, 0), (0, 0, 0, 1)), max_restarts=20, timeout=1.0, random_seed=1)
    assert not found and len(found.solutions) == 0 and "out of reach" in found.message and found.error > 1.5
    near = motion.ik(model, "arm", ((3.0, 0, 0), (0, 0, 0, 1)), max_restarts=20, timeout=1.0, random_seed=1, return_approximate=True)
    assert not near and near.approximate and near.solutions.shape == (1, 6)


def test_several_tips_at_once():
    """Two arms on one turning torso reach two poses together."""
    left, _ = robots.arm("ur5")
    body = ""
    for side, y in (("l", 0.3), ("r", -0.3)):
        parent = "torso"
        for i, (joint, xyz, rpy, axis, lower, upper) in enumerate(robots.UR5):
            xyz = (xyz[0], xyz[1] + (y if i == 0 else 0), xyz[2])
            body += (
                f'<link name="{side}{i}"/><joint name="{side}_{joint}" type="revolute"><parent link="{parent}"/><child link="{side}{i}"/>'
                f'<origin xyz="{robots._numbers(xyz)}" rpy="{robots._numbers(rpy)}"/><axis xyz="{robots._numbers(axis)}"/>'
                f'<limit lower="{lower}" upper="{upper}" velocity="1" effort="1"/></joint>'
            )
            parent = f"{side}{i}"
    urdf = (
        '<robot name="two"><link name="base"/><link name="torso"/><joint name="torso_joint" type="revolute"><parent link="base"/>'
        '<child link="torso"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>' + body + "</robot>"
    )
    srdf = (
        '<robot name="two"><group name="left"><chain base_link="torso" tip_link="l5"/></group>'
        '<group name="right"><chain base_link="torso" tip_link="r5"/></group>'
        '<group name="both"><joint name="torso_joint"/><group name="left"/><group name="right"/></group></robot>'
    )
    model = motion.load_model(urdf, srdf)
    state = model.state()
    state.randomize("both", seed=5)
    goals = {"l5": state.pose("l5"), "r5": state.pose("r5")}
    assert model.group("both").tips == ["l5", "r5"]
    found = motion.ik(model, "both", goals, timeout=5.0, max_restarts=500, random_seed=1)
    assert found
    state.set_group("both", found.solutions[0])
    for link, goal in goals.items():
        np.testing.assert_allclose(state.pose(link).matrix(), goal.matrix(), atol=2e-5)


def test_links_bolted_to_the_tip_and_attached_bodies_can_be_asked_for():
    model = motion.load_model(
        *robots.arm(
            "ur5",
            extra='<link name="pen"/><joint name="pen_joint" type="fixed">'
            '<parent link="tool"/><child link="pen"/><origin xyz="0 0 0.1"/></joint>',
        )
    )
    state = model.state()
    state.set_group("arm", [0.3, -1.2, 1.4, -0.9, 1.1, 0.5])
    state.attach(
        motion.AttachedBody(
            "cup", "tool", [motion.Sphere(0.02)], pose=((0, 0, 0.2), (0, 0, 0, 1)), subframes={"rim": ((0, 0, 0.03), (0, 0, 0, 1))}
        )
    )
    for frame in ("pen", "cup", "cup/rim"):
        goal = state.pose(frame)
        found = motion.ik(model, "arm", goal, link=frame, seed=state, timeout=1.0, random_seed=1)
        np.testing.assert_allclose(found.solutions[0], state.get_group("arm"), atol=1e-9)


@pytest.mark.parametrize(
    "pose, said",
    [
        (((0, 0, 0), (0, 0, 0, 0)), "quaternion of a pose is zero"),
        (((0, np.nan, 0), (0, 0, 0, 1)), "not finite"),
        (((0, 0), (0, 0, 0, 1)), "3 numbers are needed"),
    ],
)
def test_bad_poses_are_refused(pose, said):
    with pytest.raises(motion.InvalidInputError, match=said):
        motion.ik(motion.load_model(*robots.arm("ur5")), "arm", pose)


def test_links_that_the_group_does_not_move_are_refused():
    with pytest.raises(motion.InvalidInputError, match="does not move link 'base_link'"):
        motion.ik(motion.load_model(*robots.arm("ur5")), "arm", ((0, 0, 0), (0, 0, 0, 1)), link="base_link")

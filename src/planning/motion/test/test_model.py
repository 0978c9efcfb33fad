"""Robots of URDF and SRDF: joints, groups, limits, states, kinematics."""

import os

import motion
import numpy as np
import pytest
import robots
from motion.files import find_package, resolve

GRIPPER = """
<robot name="hand">
  <link name="base"/>
  <link name="column"><collision><geometry><box size="0.1 0.1 0.4"/></geometry></collision></link>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="column"/><axis xyz="0 0 2"/>
    <limit lower="0.1" upper="0.5" velocity="0.2" effort="1"/></joint>
  <link name="palm"/>
  <joint name="turn" type="continuous"><parent link="column"/><child link="palm"/><origin xyz="0 0 0.2"/>
    <axis xyz="0 0 1"/><limit velocity="2" effort="1"/></joint>
  <link name="left"/><link name="right"/><link name="tip"/>
  <joint name="b_left" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" velocity="0.2" effort="1"/></joint>
  <joint name="a_right" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="0 1 0"/>
    <limit lower="-0.08" upper="0" velocity="0.2" effort="1"/><mimic joint="b_left" multiplier="-2" offset="-0.001"/></joint>
  <joint name="tip_joint" type="fixed"><parent link="left"/><child link="tip"/><origin xyz="0 0 0.05" rpy="0 0 1.5707963267948966"/></joint>
</robot>"""
HAND_SRDF = """
<robot name="hand">
  <group name="arm"><chain base_link="base" tip_link="palm"/></group>
  <group name="fingers"><link name="left"/><joint name="a_right"/></group>
  <group name="all"><group name="arm"/><group name="fingers"/></group>
  <group name="loop"><group name="pool"/></group><group name="pool"><group name="loop"/></group>
  <group name="nothing"/>
  <group_state name="up" group="arm"><joint name="lift" value="0.5"/><joint name="turn" value="1"/></group_state>
  <end_effector name="hand" parent_link="palm" group="fingers"/>
  <virtual_joint name="drive" type="planar" parent_frame="odom" child_link="base"/>
  <passive_joint name="a_right"/>
  <joint_property joint_name="drive" property_name="angular_distance_weight" value="0.5"/>
  <disable_default_collisions link="column"/>
  <enable_collisions link1="column" link2="left"/>
  <disable_collisions link1="column" link2="palm" reason="Adjacent"/>
</robot>"""


@pytest.fixture(scope="module")
def hand():
    return motion.load_model(GRIPPER, HAND_SRDF)


def test_joints_are_depth_first_with_siblings_by_name(hand):
    assert hand.joints == ["drive", "lift", "turn", "a_right", "b_left", "tip_joint"]
    assert hand.links == ["base", "column", "palm", "right", "left", "tip"]
    assert hand.variables == ["drive/x", "drive/y", "drive/theta", "lift", "turn", "a_right", "b_left"]
    assert hand.active_joints == ["drive", "lift", "turn", "b_left"]


def test_planar_virtual_joint_makes_its_parent_the_planning_frame(hand):
    assert (hand.frame, hand.root_link, hand.root_joint) == ("odom", "base", "drive")
    assert hand.joint("drive").type == "planar" and hand.joint("drive").distance_weight == 0.5
    state = hand.state()
    state.set_joint("drive", [1.0, 2.0, np.pi / 2])
    np.testing.assert_allclose(state.pose("palm").position, [1, 2, 0.5])
    np.testing.assert_allclose(state.pose("palm").rpy(), [0, 0, np.pi / 2], atol=1e-12)


def test_fixed_virtual_joint_below_an_empty_world_link_names_the_root_joint():
    urdf = (
        '<robot name="r"><link name="world"/><link name="a"/><joint name="j" type="fixed"><parent link="world"/>'
        '<child link="a"/></joint></robot>'
    )
    srdf = (
        '<robot name="r"><virtual_joint name="one" type="fixed" parent_frame="world" child_link="a"/>'
        '<virtual_joint name="two" type="fixed" parent_frame="a" child_link="b"/></robot>'
    )
    model = motion.load_model(urdf, srdf)
    assert (model.frame, model.root_joint, model.warnings) == ("world", "two", [])


def test_virtual_joint_elsewhere_is_left_out_with_a_warning():
    model = motion.load_model(
        GRIPPER, '<robot name="hand"><virtual_joint name="v" type="floating" parent_frame="w" child_link="palm"/></robot>'
    )
    assert model.frame == "base" and model.root_joint == "ASSUMED_FIXED_ROOT_JOINT"
    assert any("'v'" in line and "'palm'" in line for line in model.warnings)


def test_floating_joint_has_seven_variables_and_a_unit_quaternion():
    model = motion.load_model(
        GRIPPER, '<robot name="hand"><virtual_joint name="v" type="floating" parent_frame="w" child_link="base"/></robot>'
    )
    state = model.state()
    assert state.get("v/rot_w") == 1.0 and model.frame == "w"
    state.randomize(seed=4)
    assert np.linalg.norm(state.get_joint("v")[3:]) == pytest.approx(1)
    state.set_joint("v", [1, 2, 3, 0, 0, 2, 0])
    assert not state.in_bounds()
    state.enforce_bounds()
    np.testing.assert_allclose(state.pose("base").quaternion, [0, 0, 1, 0], atol=1e-12)


def test_groups_of_chains_links_joints_and_groups(hand):
    assert hand.groups == ["arm", "fingers", "all"]
    arm, fingers, both = (hand.group(name) for name in hand.groups)
    assert arm.joints == ["lift", "turn"] and arm.is_chain and (arm.base_link, arm.tip_link) == ("base", "palm")
    assert arm.updated_links == ["column", "palm", "right", "left", "tip"]
    assert fingers.joints == ["a_right", "b_left"] and fingers.active_joints == ["b_left"] and not fingers.is_chain
    assert both.subgroups == ["arm", "fingers"] and both.variables == ["lift", "turn", "b_left"]
    assert arm.is_subgroup_of("all") and not both.is_subgroup_of("arm")
    said = "\n".join(hand.warnings)
    assert "'loop'" in said and "'nothing' has no joints" in said


def test_chain_between_branches_goes_over_the_common_ancestor():
    model = motion.load_model(GRIPPER, '<robot name="hand"><group name="g"><chain base_link="tip" tip_link="right"/></group></robot>')
    assert model.group("g").joints == ["a_right", "b_left", "tip_joint"]


def test_end_effectors_find_the_smallest_parent_group(hand):
    (effector,) = hand.end_effectors
    assert (effector.name, effector.group, effector.parent_link, effector.parent_group) == ("hand", "fingers", "palm", "arm")
    assert hand.group("arm").attached_end_effectors == ["hand"] and hand.group("fingers").end_effector == "hand"


def test_named_states(hand):
    state = hand.state()
    assert hand.group("arm").named_state("up") == {"lift": [0.5], "turn": [1.0]}
    assert state.set_named("arm", "up") and not state.set_named("arm", "down")
    assert state.get_group("arm").tolist() == [0.5, 1.0]
    with pytest.raises(motion.UnknownNameError, match="no state 'down' in group 'arm' .*'up'"):
        hand.group("arm").named_state("down")


def test_defaults_mimic_and_passive(hand):
    state = hand.state()
    assert state.get("lift") == pytest.approx(0.3)  # zero is outside: the middle
    state.set("b_left", 0.03)
    assert state.get("a_right") == pytest.approx(-0.061)
    np.testing.assert_allclose(state.pose("right").position - state.pose("palm").position, [0, -0.061, 0], atol=1e-12)
    assert hand.joint("a_right").passive and hand.joint("a_right").mimic == ("b_left", -2.0, -0.001)


def test_a_projection_may_name_what_follows(hand):
    goal = motion.joint_goal(hand, "fingers", [0.03])
    asked = motion.MotionRequest("fingers", goals=[goal], seed=1, projection="joints(b_left,a_right)", planner="KPIECE")
    result = motion.plan(motion.PlanningScene(hand), asked)
    assert result and result.warnings == []


def test_joint_limits_yaml_wins_over_the_urdf():
    limits = {
        "lift": {
            "max_position": 0.45,
            "has_velocity_limits": False,
            "max_velocity": 0,
            "has_acceleration_limits": True,
            "max_acceleration": 3,
        },
        "turn": {"min_position": -1, "has_velocity_limits": True, "max_velocity": 0.7},
        "ghost": {"max_velocity": 1},
    }
    model = motion.load_model(GRIPPER, HAND_SRDF, joint_limits={"default_velocity_scaling_factor": 0.1, "joint_limits": limits})
    lift, turn = model.variable_limits("lift"), model.variable_limits("turn")
    assert (lift.min_position, lift.max_position, lift.has_velocity, lift.has_acceleration, lift.max_acceleration) == (
        0.1,
        0.45,
        False,
        True,
        3,
    )
    assert not turn.has_position and turn.max_velocity == 0.7
    assert any("'ghost'" in line for line in model.warnings) and any("'turn'" in line for line in model.warnings)


def test_a_limit_counts_without_its_flag_and_the_flag_takes_it_back():
    """As upstream's loader has it: a max_... sets has_..., then a has_... that is given wins."""
    limits = {
        "lift": {"max_velocity": 0.1, "max_acceleration": 0.3, "max_jerk": 9},
        "b_left": {"has_acceleration_limits": False, "max_acceleration": 2},
        "turn": {"has_velocity_limits": False},
    }
    model = motion.load_model(GRIPPER, HAND_SRDF, joint_limits=limits)
    lift, left, turn = (model.variable_limits(name) for name in ("lift", "b_left", "turn"))
    assert (lift.has_velocity, lift.max_velocity, lift.has_acceleration, lift.max_acceleration) == (True, 0.1, True, 0.3)
    assert (lift.has_jerk, lift.max_jerk, left.has_acceleration, turn.has_velocity) == (True, 9, False, False)
    assert (left.has_velocity, left.max_velocity) == (True, 0.2)  # the URDF's stay


def test_a_flag_without_a_number_makes_no_limit():
    """One of 0 would stop the whole group."""
    limits = {"lift": {"has_acceleration_limits": True, "has_velocity_limits": True}, "drive": {"x": {"has_velocity_limits": True}}}
    model = motion.load_model(GRIPPER, HAND_SRDF, joint_limits=limits)
    lift, x = model.variable_limits("lift"), model.variable_limits("drive/x")
    assert (lift.has_acceleration, x.has_velocity, lift.has_velocity) == (False, False, True)  # the URDF has a velocity
    assert [line for line in model.warnings if "joint_limits" in line] == [
        f"joint_limits: joint '{name}' has has_{what}_limits: true, but no max_{what}: it counts as not limited"
        for name, what in (("drive/x", "velocity"), ("lift", "acceleration"))
    ]


def test_the_variables_of_a_planar_joint_have_limits_of_their_own():
    limits = {
        "drive": {"x": {"max_velocity": 0.2, "min_position": -1, "max_position": 2}, "theta": {"max_acceleration": 3, "max_position": 1}},
        "drive/y": {"max_velocity": 0.4},
    }
    model = motion.load_model(GRIPPER, HAND_SRDF, joint_limits=limits)
    x, y, theta = model.joint("drive").limits
    assert (x.has_velocity, x.max_velocity, x.has_position, x.min_position, x.max_position) == (True, 0.2, True, -1, 2)
    assert (y.max_velocity, y.has_position, theta.has_velocity, theta.max_acceleration) == (0.4, False, False, 3)
    assert not theta.has_position and any("'drive/theta'" in line and "without end" in line for line in model.warnings)
    state = model.state()
    state.set("drive/x", 2.5)
    assert state.violations() == [("drive/x", 2.5, -1.0, 2.0)]
    whole = motion.load_model(GRIPPER, HAND_SRDF, joint_limits={"drive": {"max_velocity": 0.2}})
    assert not whole.joint("drive").limits[0].has_velocity
    assert any("'drive'" in line and "x, y, theta" in line for line in whole.warnings)


def test_the_variables_of_a_floating_joint_have_limits_of_their_own():
    srdf = HAND_SRDF.replace('type="planar"', 'type="floating"')
    model = motion.load_model(
        GRIPPER,
        srdf,
        joint_limits={"drive": {"trans_z": {"min_position": 0.5, "max_position": 3, "max_velocity": 1}, "rot_w": {"max_position": 0.5}}},
    )
    height = model.variable_limits("drive/trans_z")
    assert (height.has_position, height.min_position, height.max_velocity) == (True, 0.5, 1)
    assert model.variable_limits("drive/rot_w").max_position == 1.0 and any("'drive/rot_w'" in line for line in model.warnings)


def test_soft_limits_narrow_the_range():
    urdf = GRIPPER.replace(
        'upper="0.5" velocity="0.2" effort="1"/>',
        'upper="0.5" velocity="0.2" effort="1"/>'
        '<safety_controller soft_lower_limit="0.2" soft_upper_limit="9" k_position="1" k_velocity="1"/>',
    )
    limits = motion.load_model(urdf).variable_limits("lift")
    assert (limits.min_position, limits.max_position) == (0.2, 0.5)


def test_bounds_and_violations(hand):
    state = hand.state()
    assert state.in_bounds() and state.violations() == []
    state.set({"lift": 0.52, "turn": 4.0, "drive/theta": 4.0})
    assert not state.in_bounds("arm") and state.in_bounds("fingers")
    assert state.violations("arm", margin=0.03) == [] and state.in_bounds("arm", 0.03)  # continuous: any turn will do, as upstream
    assert [v[:2] for v in state.violations()] == [("drive/theta", 4.0), ("lift", 0.52)]
    state.enforce_bounds()
    assert state.get("lift") == 0.5 and state.get("turn") == pytest.approx(4 - 2 * np.pi)


def test_distance_is_the_weighted_sum_and_interpolation_takes_the_short_way(hand):
    a, b = hand.state(), hand.state()
    a.set({"turn": 3.0, "lift": 0.2})
    b.set({"turn": -3.0, "lift": 0.4, "drive/x": 3, "drive/y": 4, "drive/theta": 1})
    assert a.distance(b, "arm") == pytest.approx(2 * np.pi - 6 + 0.2)
    assert a.distance(b) == pytest.approx(2 * np.pi - 6 + 0.2 + 3 * (5 + 0.5))
    assert abs(a.interpolate(b, 0.5).get("turn")) == pytest.approx(np.pi)


@pytest.mark.parametrize("name", robots.ARMS)
def test_jacobian_is_the_derivative_of_forward_kinematics(name):
    model = motion.load_model(*robots.arm(name))
    state, step = model.state(), 1e-6
    state.randomize("arm", seed=7)
    J = state.jacobian("arm", "tool", (0.1, 0.2, 0.3))
    q = state.get_group("arm")
    for column in range(len(q)):
        ends = []
        for sign in (-1, 1):
            moved = q.copy()
            moved[column] += sign * step
            state.set_group("arm", moved)
            ends.append(state.pose("tool"))
        v = (ends[1] * (0.1, 0.2, 0.3) - ends[0] * (0.1, 0.2, 0.3)) / (2 * step)
        turned = ends[1].rotation @ ends[0].rotation.T
        w = np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]) / (4 * step)
        np.testing.assert_allclose(J[:, column], np.concatenate([v, w]), atol=1e-8)


def test_ur5_at_zero_is_where_the_maker_says():
    """The arm straight out along x, the tool 0.1915 m aside and 5.5 mm below the shoulder's 0.089 m less 0.0947 m."""
    state = motion.load_model(*robots.arm("ur5")).state()
    np.testing.assert_allclose(state.pose("tool").position, [0.81725, 0.19145, -0.005491], atol=1e-9)


def test_copies_are_apart(hand):
    state = hand.state()
    other = state.copy()
    other.set("lift", 0.4)
    assert state.get("lift") == pytest.approx(0.3)


@pytest.mark.parametrize(
    "urdf, srdf, said",
    [
        ("<robot", None, "URDF cannot be read"),
        ("", None, "URDF cannot be read"),
        ("<robot name='r'/>", None, "URDF"),
        (GRIPPER, "<robot", "SRDF is not well-formed XML near line 1"),
        (GRIPPER, "<nothing/>", "no <robot>"),
        (GRIPPER.replace('effort="1"', 'effort="x"', 1), None, "URDF cannot be read: effort value"),
    ],
)
def test_bad_descriptions_are_refused_in_one_line(urdf, srdf, said):
    with pytest.raises(motion.ModelError, match=said) as error:
        motion.load_model(urdf, srdf)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "change, said",
    [
        (('lower="0.1"', 'lower="0.9"'), "joint 'lift': its lower limit 0.900000 is above its upper limit"),
        (('xyz="0 0 2"', 'xyz="0 0 0"'), "joint 'lift': <axis xyz> is zero"),
    ],
)
def test_what_moveit_loads_is_loaded_with_one_error(change, said):
    """MoveIt checks neither (RobotModel::jointBoundsFromURDF): the robot is there, and what moves that joint cannot be planned."""
    model = motion.load_model(GRIPPER.replace(*change), HAND_SRDF)
    (line,) = (warning for warning in model.warnings if warning.startswith("error: "))
    assert said in line and "lift" in model.joints
    if "limit" in said:
        assert not model.state().in_bounds("arm")


def test_a_fault_that_urdfdom_forgives_is_told():
    model = motion.load_model(GRIPPER.replace('size="0.1 0.1 0.4"', 'size="0.1 0.4"'))
    (line,) = (warning for warning in model.warnings if "collision" in warning)
    assert "its <collision> is at fault (Parser found 2 elements but 3 expected" in line


@pytest.mark.parametrize(
    "call, said",
    [
        (lambda s: s.set_group("arm", [1.0]), "2 numbers are needed, not 1"),
        (lambda s: s.set_group("arm", [1.0, np.nan]), "number 2 is not finite"),
        (lambda s: s.set("turn", np.inf), "'turn'.*not finite"),
        (
            lambda s: motion.load_model(GRIPPER, joint_limits={"lift": {"max_velocity": "fast"}}),
            "max_velocity of joint 'lift' is no number",
        ),
        (lambda s: s.attach(motion.AttachedBody("x", "palm", [])), "no shapes"),
    ],
)
def test_bad_values_are_refused_and_change_nothing(hand, call, said):
    state = hand.state()
    before = state.positions
    with pytest.raises(motion.InvalidInputError, match=said) as error:
        call(state)
    assert isinstance(error.value, ValueError) and (state.positions == before).all()


def test_unknown_names_say_what_there_is(hand):
    for call in (hand.link, hand.joint, hand.group, hand.variable_index, hand.state().pose):
        with pytest.raises(motion.UnknownNameError, match="'nobody'.*there is: '") as error:
            call("nobody")
        assert isinstance(error.value, LookupError)


def test_meshes_are_found_by_package_and_scaled(tmp_path):
    (tmp_path / "box.stl").write_text(
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n"
    )
    urdf = (
        '<robot name="r"><link name="a"><collision><geometry><mesh filename="package://shop/box.stl" scale="2 3 1"/></geometry></collision>'
        '<collision><geometry><mesh filename="package://shop/none.stl"/></geometry></collision></link></robot>'
    )
    model = motion.load_model(urdf, find_package=lambda name: str(tmp_path) if name == "shop" else None)
    (shape,) = model.link("a").shapes
    np.testing.assert_allclose(shape.bounds(), [[0, 0, 0], [2, 3, 0]])
    assert len(shape.vertices) == 3 and "none.stl" in model.warnings[0]


def test_packages_are_found_by_the_name_in_their_manifest(tmp_path, monkeypatch):
    inside = tmp_path / "outside" / "arm_description"
    inside.mkdir(parents=True)
    (inside / "package.xml").write_text("<package><!-- <name>old_name</name> -->\n<name>vendor_arm_description</name></package>")
    (inside / "part.stl").write_text("solid")
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "linked").symlink_to(inside)
    (tmp_path / "src" / "up").symlink_to(tmp_path)
    ignored = tmp_path / "src" / "ignored"
    ignored.mkdir()
    (ignored / "CATKIN_IGNORE").touch()
    (ignored / "package.xml").write_text("<package><name>ignored</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    found = resolve("package://vendor_arm_description/part.stl")
    assert found and os.path.samefile(found, inside / "part.stl")
    assert resolve("package://arm_description/part.stl") == resolve("package://old_name/part.stl") == ""
    assert find_package("ignored") is None


def test_a_chain_that_begins_with_a_fixed_joint_does_not_move_its_base():
    """A robot stands on the floor of its scene; a group that begins at its base_footprint is asked about what it moves alone."""
    box = '<collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision>'
    model = motion.load_model(
        f'<robot name="r"><link name="base_footprint"/><link name="base">{box}</link><link name="arm">{box}</link>'
        '<joint name="foot" type="fixed"><parent link="base_footprint"/><child link="base"/></joint>'
        '<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>',
        '<robot name="r"><group name="chain"><chain base_link="base_footprint" tip_link="arm"/></group></robot>',
    )
    assert model.group("chain").updated_links == ["arm"]
    scene = motion.PlanningScene(model)
    scene.add_object("floor", [motion.Box(6, 6, 0.05)])
    assert scene.check() and not scene.check(group="chain")

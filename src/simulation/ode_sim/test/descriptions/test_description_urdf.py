"""URDF to a model, rule by rule (sdformat 9's conversion as Gazebo Classic 11 uses it)."""

import numpy as np
import pytest
from ode_sim import math3
from ode_sim.description import DescriptionError, read_model
from urdf_texts import FINDER, LIMIT, box, convert, joint, link, messages, names, one

# ---------------------------------------------------------------------------------------------- tree and joints


def test_links_and_poses_follow_the_joints():
    model, problems = convert(
        link("base"),
        link("a"),
        link("b"),
        joint("ja", "base", "a", "revolute", "1 0 0", "0 0 1.5707963267948966", LIMIT),
        joint("jb", "a", "b", "prismatic", "0 2 0", body='<axis xyz="0 0 -2"/>' + LIMIT),
    )
    assert model.name == "r" and names(model.links) == ["base", "a", "b"] and not problems
    assert one(model.links, "b").pose.p == pytest.approx((-1.0, 0.0, 0.0))
    ja, jb = model.joints
    assert (ja.type, ja.parent, ja.child, ja.pose.p) == ("revolute", "base", "a", (0.0, 0.0, 0.0))
    assert (ja.axes[0].xyz, ja.axes[0].lower, ja.axes[0].upper) == ((1.0, 0.0, 0.0), -1.0, 2.0)
    assert (ja.axes[0].effort, ja.axes[0].velocity) == (3.0, 4.0)
    assert jb.type == "prismatic" and jb.axes[0].xyz == (0.0, 0.0, -1.0)


def test_children_come_in_the_order_of_joint_names():
    model, _ = convert(
        link("base"), link("x"), link("y"), joint("z_first_in_file", "base", "x", "continuous"), joint("a_last", "base", "y", "continuous")
    )
    assert names(model.links) == ["base", "y", "x"] and names(model.joints) == ["a_last", "z_first_in_file"]


def test_continuous_has_no_limits_and_keeps_its_urdf_type():
    model, _ = convert(link("base"), link("a"), joint("j", "base", "a", "continuous"))
    axis = model.joints[0].axes[0]
    assert (model.joints[0].type, model.joints[0].urdf_type) == ("revolute", "continuous")
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == (-1e16, 1e16, -1.0, -1.0)


def test_continuous_takes_effort_and_velocity_of_its_limit():
    model, _ = convert(link("base"), link("a"), joint("j", "base", "a", "continuous", body=LIMIT))
    axis = model.joints[0].axes[0]
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == (-1e16, 1e16, 3.0, 4.0)


def test_limits_the_wrong_way_round_are_switched():
    model, problems = convert(
        link("base"), link("a"), joint("j", "base", "a", "revolute", body='<limit lower="1" upper="-1" effort="0" velocity="0"/>')
    )
    assert (model.joints[0].axes[0].lower, model.joints[0].axes[0].upper) == (-1.0, 1.0)
    assert "switching the two" in messages(problems)


def test_dynamics_and_mimic():
    model, _ = convert(
        link("base"),
        link("a"),
        link("b"),
        joint("j", "base", "a", "continuous", body='<dynamics damping="0.5" friction="0.25"/>'),
        joint("k", "base", "b", "continuous", body='<mimic joint="j" multiplier="-2" offset="0.1"/>'),
    )
    assert (model.joints[0].axes[0].damping, model.joints[0].axes[0].friction) == (0.5, 0.25)
    mimic = model.joints[1].mimic
    assert (mimic.joint, mimic.multiplier, mimic.offset) == ("j", -2.0, 0.1)


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_floating_and_planar_leave_the_child_free(kind):
    model, _ = convert(link("base"), link("a"), joint("j", "base", "a", kind, "1 0 0"))
    assert names(model.links) == ["base", "a"] and model.joints == ()
    assert one(model.links, "a").pose.p == (1.0, 0.0, 0.0)


def test_robot_origin_is_the_pose_of_the_model():
    model, _ = convert('<origin xyz="1 2 3" rpy="0 0 1"/>', link("base"))
    assert model.pose.p == (1.0, 2.0, 3.0) and math3.to_rpy(model.pose) == pytest.approx((0.0, 0.0, 1.0))


def test_link_and_joint_of_the_same_name():
    model, problems = convert(
        link("base"),
        link("arm"),
        link("tip"),
        joint("arm", "base", "arm", "continuous", "1 0 0"),
        joint("tip", "arm", "tip", "continuous", "0 1 0"),
    )
    assert one(model.links, "tip").pose.p == (1.0, 1.0, 0.0) and not problems
    assert one(model.joints, "tip").pose.p == (0.0, 0.0, 0.0)


# ---------------------------------------------------------------------------------------------- the world link


def test_world_link_bolts_its_children():
    model, _ = convert(link("world", None), link("base"), joint("bolt", "world", "base", "fixed", "0 0 1"))
    assert names(model.links) == ["base"] and model.links[0].pose.p == (0.0, 0.0, 1.0)
    (bolt,) = model.joints
    assert (bolt.type, bolt.parent, bolt.child, bolt.axes) == ("fixed", "world", "base", ())


def test_fixed_children_of_a_bolted_link_are_lumped():
    model, _ = convert(link("world", None), link("base"), link("top"), joint("bolt", "world", "base"), joint("f", "base", "top"))
    assert names(model.links) == ["base"] and names(model.joints) == ["bolt"]
    assert model.links[0].inertial.mass == 2.0


# ---------------------------------------------------------------------------------------------- lumping


def test_lumped_mass_is_combined_about_the_common_centre():
    model, _ = convert(link("base", 1.0), link("tip", 3.0), joint("f", "base", "tip", xyz="4 0 0"))
    inertial = model.links[0].inertial
    assert inertial.mass == 4.0 and inertial.pose.p == pytest.approx((3.0, 0.0, 0.0))
    # two unit tensors, and 1 kg at 3 m, 3 kg at 1 m from the centre
    assert (inertial.ixx, inertial.iyy, inertial.izz) == pytest.approx((2.0, 14.0, 14.0))


def test_lumped_tensor_is_turned():
    slim = (
        '<inertial><origin xyz="0 0 1" rpy="0 0 0"/><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/></inertial>'
    )
    model, _ = convert(link("base", None), f'<link name="tip">{slim}</link>', joint("f", "base", "tip", rpy="0 1.5707963267948966 0"))
    inertial = model.links[0].inertial
    assert inertial.mass == 2.0 and inertial.pose.p == pytest.approx((1.0, 0.0, 0.0))
    assert (inertial.ixx, inertial.iyy, inertial.izz) == pytest.approx((3.0, 2.0, 1.0))
    assert (inertial.ixy, inertial.ixz, inertial.iyz) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_an_unlumped_inertial_keeps_its_own_axes():
    turned = (
        '<inertial><origin xyz="0 0 1" rpy="0.5 0 0"/><mass value="2"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/></inertial>'
    )
    model, _ = convert(f'<link name="base">{turned}</link>')
    inertial = model.links[0].inertial
    assert (inertial.ixx, inertial.iyy, inertial.izz) == (1.0, 2.0, 3.0)
    assert math3.to_rpy(inertial.pose) == pytest.approx((0.5, 0.0, 0.0))


def test_lumped_shapes_move_and_take_long_names():
    model, _ = convert(
        link("base", body=box() + box() + box("visual")),
        link("tip", body=box(xyz="0 0 1") + box("visual")),
        joint("f", "base", "tip", xyz="1 0 0", rpy="0 1.5707963267948966 0"),
    )
    (base,) = model.links
    assert names(base.collisions) == ["base_collision", "base_collision_1", "base_fixed_joint_lump__tip_collision_2"]
    assert names(base.visuals) == ["base_visual", "base_fixed_joint_lump__tip_visual_1"]
    assert base.collisions[2].pose.p == pytest.approx((2.0, 0.0, 0.0))


def test_lumping_runs_up_several_joints():
    model, _ = convert(
        link("base"),
        link("mid", None),
        link("tip", body=box()),
        link("wheel"),
        joint("f1", "base", "mid", xyz="1 0 0"),
        joint("f2", "mid", "tip", xyz="0 1 0"),
        joint("j", "tip", "wheel", "continuous", "0 0 1"),
    )
    assert names(model.links) == ["base", "wheel"]
    assert names(model.links[0].collisions) == ["base_fixed_joint_lump__tip_collision"]
    assert model.links[0].collisions[0].pose.p == (1.0, 1.0, 0.0)
    assert (model.joints[0].parent, model.joints[0].child) == ("base", "wheel")
    assert model.links[1].pose.p == (1.0, 1.0, 1.0)


def test_a_named_shape_that_does_not_start_with_the_link_name():
    model, _ = convert(link("base", body=box(name="shell") + box(name="base_lower")), '<gazebo reference="base"><mu1>0.25</mu1></gazebo>')
    shell, lower = model.links[0].collisions
    assert (shell.name, lower.name) == ("base_fixed_joint_lump__shell_collision", "base_lower_collision_1")
    assert (shell.surface.mu, lower.surface.mu) == (1.0, 0.25)  # as sdformat: the odd name loses its extensions


def test_preserve_fixed_joint():
    model, _ = convert(
        link("base"),
        link("tip"),
        joint("f", "base", "tip", xyz="1 0 0"),
        '<gazebo reference="f"><preserveFixedJoint>true</preserveFixedJoint></gazebo>',
    )
    assert names(model.links) == ["base", "tip"] and model.joints[0].type == "fixed"


SCALE = '<sensor name="ft" type="force_torque"><update_rate>50</update_rate></sensor>'


@pytest.mark.parametrize(
    "kind, opt",
    [
        ("revolute", ""),
        ("fixed", "<preserveFixedJoint>true</preserveFixedJoint>"),
        ("fixed", "<disableFixedJointLumping>true</disableFixedJointLumping>"),
    ],
)
def test_a_joint_has_its_force_torque_sensor(kind, opt):
    model, problems = convert(
        link("base"), link("tip"), joint("f", "base", "tip", kind, body=LIMIT), f'<gazebo reference="f">{opt}{SCALE}</gazebo>'
    )
    (sensor,) = model.joints[0].sensors
    assert (sensor.name, sensor.type, sensor.update_rate) == ("ft", "force_torque", 50.0) and not problems


def test_the_sensor_of_a_joint_that_is_lumped_is_one_line():
    model, problems = convert(link("base"), link("tip"), joint("f", "base", "tip"), f'<gazebo reference="f">{SCALE}</gazebo>')
    assert names(model.links) == ["base"] and not model.joints
    assert "sensor 'ft' is left out: its joint 'f' is fixed" in messages(problems) and "preserveFixedJoint" in messages(problems)


@pytest.mark.parametrize("kind, holder", [("fixed", "base"), ("revolute", "cam")])
def test_a_link_and_its_joint_of_one_name_and_the_link_s_sensor(kind, holder):
    """As sdformat does for Gazebo 11.1 (gz sdf -p): the link has it, lumped or not."""
    ray = '<sensor name="eye" type="ray"><update_rate>5</update_rate></sensor>'
    model, problems = convert(
        link("base"), link("cam"), joint("cam", "base", "cam", kind, body=LIMIT), f'<gazebo reference="cam">{ray}</gazebo>'
    )
    assert {each.name: names(each.sensors) for each in model.links if each.sensors} == {holder: ["eye"]}
    assert not any(each.sensors for each in model.joints) and not problems


def test_disable_fixed_joint_lumping_makes_a_locked_hinge():
    model, _ = convert(
        link("base"),
        link("tip"),
        joint("f", "base", "tip"),
        '<gazebo reference="f"><disableFixedJointLumping>true</disableFixedJointLumping></gazebo>',
    )
    (hinge,) = model.joints
    assert (hinge.type, hinge.axes[0].lower, hinge.axes[0].upper, hinge.urdf_type) == ("revolute", 0.0, 0.0, "fixed")


def test_a_joint_that_closes_a_loop_has_its_axis_in_its_own_frame():
    """URDF becomes SDF 1.7, where <use_parent_model_frame> is not known any more; legs of a delta robot would jam each other."""
    closing = (
        '<gazebo><joint name="closing" type="revolute"><parent>base</parent><child>tip</child><axis><xyz>0 1 0</xyz>'
        "<use_parent_model_frame>1</use_parent_model_frame></axis></joint></gazebo>"
    )
    model, problems = convert(link("base"), link("tip"), joint("hip", "base", "tip", "continuous", rpy="0 0 2.0943951"), closing)
    assert one(model.joints, "closing").axes[0].xyz == (0.0, 1.0, 0.0)
    assert len(problems) == 1 and "write <xyz expressed_in='__model__'>" in messages(problems)


def test_preserve_wins_over_disable():
    model, _ = convert(
        link("base"),
        link("tip"),
        joint("f", "base", "tip"),
        '<gazebo reference="f">'
        "<disableFixedJointLumping>true</disableFixedJointLumping>"
        "<preserveFixedJoint>true</preserveFixedJoint></gazebo>",
    )
    assert model.joints[0].type == "fixed"


# ---------------------------------------------------------------------------------------------- mass


def test_massless_root_takes_the_mass_of_a_fixed_child():
    model, problems = convert(
        link("base_footprint", None), link("base_link", 5.0), joint("f", "base_footprint", "base_link", xyz="0 0 0.1")
    )
    assert names(model.links) == ["base_footprint"] and not problems
    assert model.links[0].inertial.mass == 5.0 and model.links[0].inertial.pose.p == (0.0, 0.0, 0.1)


@pytest.mark.parametrize("mass", [None, 0, -1])
def test_a_massless_link_takes_its_sub_tree_with_it(mass):
    model, problems = convert(
        link("base"),
        link("a", mass),
        link("b"),
        link("c"),
        joint("ja", "base", "a", "continuous"),
        joint("jb", "a", "b", "continuous"),
        joint("jc", "b", "c"),
    )
    assert names(model.links) == ["base"] and model.joints == ()
    text = messages(problems)
    assert "link 'a' has no mass" in text and "b, c" in text and "joint 'ja'" in text and "<inertial>" in text


def test_a_massless_link_behind_a_fixed_joint_is_fine():
    model, problems = convert(
        link("base"),
        link("mount", None, box("visual")),
        link("wheel"),
        joint("f", "base", "mount", xyz="0 1 0"),
        joint("j", "mount", "wheel", "continuous"),
    )
    assert names(model.links) == ["base", "wheel"] and not problems
    assert one(model.links, "wheel").pose.p == (0.0, 1.0, 0.0)


def test_a_robot_without_any_mass_is_refused():
    with pytest.raises(DescriptionError, match="no link with a mass"):
        convert(link("base", None, box()))


def test_a_robot_whose_only_mass_is_negative_hears_of_it():
    with pytest.raises(DescriptionError, match="its mass of -2 kg is negative, so robot 'r' has no link"):
        convert(link("base", -2))


def test_a_mass_beyond_all_reason_is_refused():
    with pytest.raises(DescriptionError, match="1e\\+?300"):
        convert(link("base", 1e300))


def test_xacro_that_was_not_run_is_recognised():
    with pytest.raises(DescriptionError, match="rosrun xacro xacro"):
        convert(link("base", "${mass}"))


def test_singular_and_huge_inertias_are_kept():
    tensor = '<inertia ixx="200" ixy="200" ixz="200" iyy="200" iyz="200" izz="1.5e8"/>'
    model, problems = convert(f'<link name="base"><inertial><mass value="0.1"/>{tensor}</inertial></link>')
    i = model.links[0].inertial
    assert (i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz) == (200, 200, 200, 200, 200, 1.5e8) and not problems


# ---------------------------------------------------------------------------------------------- untidy originals


def test_plugin_names_with_blanks_and_a_body_of_dots():
    model, _ = convert(
        link("base"),
        '<gazebo><plugin name=" ctl " filename=" libgazebo_ros_control.so\n ">'
        " ... <robotNamespace>/arm</robotNamespace> ...</plugin></gazebo>",
    )
    (plugin,) = model.plugins
    assert (plugin.name, plugin.filename) == ("ctl", "libgazebo_ros_control.so")
    assert plugin.element.find("robotNamespace").text == "/arm"


def test_unknown_elements_and_stray_text_are_ignored():
    model, problems = convert(
        '<arg name="hardware_interface" default="x"/>',
        "some words",
        '<transmission name="t"><robotNamespace>/arm</robotNamespace></transmission>',
        "<!-- a comment -- with dashes -->",
        link("base", body='<origin xyz="1 1 1"/>'),
        link("tip"),
        joint("f", "base", "tip", body='<axis xyz="0 0 1"/>' + LIMIT),
    )
    assert names(model.links) == ["base"] and not problems


def test_inertias_of_100_million_behind_fixed_joints_into_massless_revolute_children():
    """The homework arm: empty links under revolute joints whose fixed children bring all the mass."""
    big = '<inertial><mass value="0.1"/><inertia ixx="1.5e8" ixy="0" ixz="0" iyy="1e8" iyz="0" izz="1e8"/></inertial>'
    model, problems = convert(
        link("base_link"),
        '<link name="dyn2_r"/>',
        f'<link name="f4">{big}</link>',
        f'<link name="dyn3">{big}</link>',
        joint("j0", "base_link", "dyn2_r", "revolute", body=LIMIT),
        joint("a", "dyn2_r", "f4"),
        joint("b", "f4", "dyn3", xyz="0 0 0.1"),
    )
    assert names(model.links) == ["base_link", "dyn2_r"] and not problems
    assert model.links[1].inertial.mass == pytest.approx(0.2) and model.links[1].inertial.ixx > 3e8 - 1


def test_xml_declaration_behind_a_blank_line():
    assert read_model('\n  <?xml version="1.0"?>\n<robot name="r">' + link("base") + "</robot>", finder=FINDER)[0]


def test_a_name_may_be_given_from_outside():
    assert read_model('<robot name="r">' + link("base") + "</robot>", name="left", finder=FINDER)[0].name == "left"


@pytest.mark.parametrize("tag", ["visual", "collision"])
@pytest.mark.parametrize("geometry", ["", "<geometry/>"])
def test_shape_without_geometry_is_one_warning_and_the_link_stays(tag, geometry):
    model, problems = convert(link("a", body=f"<{tag}>{geometry}</{tag}>" + box(tag)))
    assert len(getattr(one(model.links, "a"), tag + "s")) == 1
    assert len(problems) == 1
    assert f"link 'a': it has no shape in its <geometry>; the <{tag}> is left out" in messages(problems)


def test_missing_mesh_is_one_warning_and_the_link_stays():
    mesh = '<{0}><geometry><mesh filename="package://gone/m.stl" scale="0.001 0.001 0.001"/></geometry></{0}>'
    model, problems = convert(link("base", body=mesh.format("visual") + mesh.format("collision")))
    assert len(problems) == 1 and "package://gone/m.stl" in messages(problems)
    assert "no ROS package 'gone'" in messages(problems)
    geometry = model.links[0].visuals[0].geometry
    assert (geometry.path, geometry.uri, geometry.scale) == ("", "package://gone/m.stl", (0.001, 0.001, 0.001))


def test_two_readings_are_equal():
    parts = (
        link("base", body=box() + box("visual")),
        link("a"),
        link("t"),
        joint("j", "base", "a", "continuous", "1 2 3", "0.1 0.2 0.3"),
        joint("f", "a", "t", rpy="1 1 1"),
    )
    assert convert(*parts)[0] == convert(*parts)[0]


def test_poses_survive_the_conversion_exactly():
    model, _ = convert(link("base"), link("a"), joint("j", "base", "a", "continuous", rpy="-1.57 1.5707963 0.7"))
    expected = math3.quat_from_rpy(-1.57, 1.5707963, 0.7)
    assert np.allclose(model.links[1].pose.q, expected, rtol=0.0, atol=1e-15)

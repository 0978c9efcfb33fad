"""What <gazebo> elements of a URDF add to links, shapes and joints."""

import math

import pytest
from ode_sim import math3
from ode_sim.description.model import Pose
from ode_sim.description.urdf_extensions import given_offset, merged_at
from urdf_texts import box, convert, joint, link, messages


def test_link_extensions():
    model, problems = convert(
        link("base", body=box() + box("visual")),
        """
        <gazebo reference="base">
          <material>Gazebo/Orange</material> <mu1>0.1</mu1> <mu2 value="0.2"/> <fdir1>1 0 0</fdir1>
          <kp>1000</kp> <kd>2</kd> <maxVel>0.5</maxVel> <minDepth>0.003</minDepth> <maxContacts>4</maxContacts>
          <laserRetro>7</laserRetro> <selfCollide>true</selfCollide> <turnGravityOff>true</turnGravityOff>
          <dampingFactor>0.01</dampingFactor> <stopKp>3</stopKp>
        </gazebo>""",
    )
    (base,) = model.links
    surface = base.collisions[0].surface
    assert (surface.mu, surface.mu2, surface.fdir1) == (0.1, 0.2, (1.0, 0.0, 0.0))
    assert (surface.kp, surface.kd, surface.max_vel, surface.min_depth) == (1000.0, 2.0, 0.5, 0.003)
    assert (base.collisions[0].max_contacts, base.collisions[0].laser_retro) == (4, 7.0)
    assert (base.self_collide, base.gravity, base.linear_decay, base.angular_decay) == (True, False, 0.01, 0.01)
    assert base.visuals[0].material.diffuse == (1.0, 0.5088, 0.0468, 1.0)
    assert not problems


@pytest.mark.parametrize("text, gravity", [("false", True), ("0", True), ("no", True), ("true", False), ("on", False)])
def test_turn_gravity_off(text, gravity):
    model, _ = convert(link("base"), f'<gazebo reference="base"><turnGravityOff>{text}</turnGravityOff></gazebo>')
    assert model.links[0].gravity is gravity


def test_gravity_of_a_link_that_is_lumped_is_that_of_what_it_is_lumped_into():
    """As sdformat 9 has it: the lumped link's blocks come after its parent's, so the last that says something counts."""
    block = '<gazebo reference="{}"><turnGravityOff>{}</turnGravityOff></gazebo>'.format
    for blocks, gravity in ((block("tip", "true"), False), (block("tip", "false") + block("base", "true"), True)):
        model, problems = convert(link("base"), link("tip"), joint("f", "base", "tip"), blocks)
        assert model.links[0].gravity is gravity
        assert all(problem.severity == "note" for problem in problems)


def test_extensions_stay_with_the_shapes_of_their_own_link():
    model, _ = convert(
        link("base", body=box() + box("visual")),
        link("tip", body=box() + box("visual")),
        joint("f", "base", "tip"),
        '<gazebo reference="base"><mu1>0.1</mu1><material>Gazebo/Red</material></gazebo>'
        '<gazebo reference="tip"><mu1>0.9</mu1><material>Gazebo/Blue</material></gazebo>',
    )
    (base,) = model.links
    assert [c.surface.mu for c in base.collisions] == [0.1, 0.9]
    assert [v.material.name for v in base.visuals] == ["Gazebo/Red", "Gazebo/Blue"]


def test_the_later_of_two_values_counts():
    model, problems = convert(
        link("base", body=box()), '<gazebo reference="base"><mu1>0.1</mu1></gazebo><gazebo reference="base"><mu1>0.2</mu1></gazebo>'
    )
    assert model.links[0].collisions[0].surface.mu == 0.2 and "given twice" in messages(problems)
    assert [problem.severity for problem in problems] == ["note"]  # robots with lumped links do this all the time


def test_blocks_inside_visual_and_collision():
    model, _ = convert(
        link("base", body=box() + box("visual")),
        """
        <gazebo reference="base">
          <visual><material><diffuse>0.1 0.2 0.3 1</diffuse></material><transparency>0.5</transparency></visual>
          <collision><surface><friction><ode><mu>0.7</mu></ode></friction></surface></collision>
        </gazebo>""",
    )
    (base,) = model.links
    assert base.visuals[0].material.diffuse == (0.1, 0.2, 0.3, 1.0) and base.visuals[0].transparency == 0.5
    assert base.collisions[0].surface.mu == 0.7


def test_urdf_colours_are_dropped_and_white_is_the_default():
    coloured = '<visual><geometry><sphere radius="1"/></geometry><material name="m"><color rgba="1 0 0 1"/></material></visual>'
    model, _ = convert(link("base", body=coloured), '<material name="m"><color rgba="1 0 0 1"/></material>')
    assert model.links[0].visuals[0].material.name == "Gazebo/White"


def test_joint_extensions():
    model, _ = convert(
        link("base"),
        link("a"),
        joint("j", "base", "a", "continuous"),
        """
        <gazebo reference="j"><stopCfm>0.1</stopCfm><stopErp>0.3</stopErp><provideFeedback>1</provideFeedback>
        <implicitSpringDamper>true</implicitSpringDamper><springReference>0.5</springReference>
        <springStiffness>9</springStiffness><fudgeFactor>0.4</fudgeFactor></gazebo>""",
    )
    (j,) = model.joints
    assert (j.limit_cfm, j.limit_erp, j.provide_feedback, j.implicit_spring_damper) == (0.1, 0.3, True, True)
    assert (j.axes[0].spring_reference, j.axes[0].spring_stiffness, j.fudge_factor) == (0.5, 9.0, 0.4)


def test_wrong_reference_is_a_warning():
    model, problems = convert(link("base"), '<gazebo reference="bose"><mu1>1</mu1></gazebo>')
    assert "'bose'" in messages(problems) and model.links


def test_static_robot():
    assert convert(link("base"), "<gazebo><static>true</static></gazebo>")[0].static is True


def test_sensor_of_a_lumped_link_moves_with_its_pose():
    model, _ = convert(
        link("base"),
        link("cam", None),
        joint("f", "base", "cam", xyz="1 0 0", rpy="0 0 1.5707963267948966"),
        """<gazebo reference="cam"><sensor type="camera" name="eye"><pose>1 0 0 0 0.1 0</pose>
                       <update_rate>30</update_rate><always_on>true</always_on>
                       <plugin name="ctl" filename="libgazebo_ros_camera.so"><frameName>cam</frameName></plugin>
                       </sensor></gazebo>""",
    )
    (sensor,) = model.links[0].sensors
    assert (sensor.name, sensor.type, sensor.update_rate, sensor.always_on) == ("eye", "camera", 30.0, True)
    assert sensor.pose.p == pytest.approx((1.0, 1.0, 0.0))
    assert math3.to_rpy(sensor.pose) == pytest.approx((0.0, 0.1, math.pi / 2))
    assert sensor.plugins[0].element.find("frameName").text == "cam"  # inside a sensor: left alone


def test_model_plugin_names_follow_a_lumped_link():
    model, _ = convert(
        link("base"),
        link("imu", None),
        joint("f", "base", "imu", xyz="1 0 0"),
        '<gazebo><plugin name="p" filename="libx.so"><bodyName>imu</bodyName><xyzOffset>0 2 0</xyzOffset></plugin></gazebo>',
    )
    element = model.plugins[0].element
    assert element.find("bodyName").text == "base"
    assert [float(v) for v in element.find("xyzOffset").text.split()] == [1.0, 2.0, 0.0]
    assert [float(v) for v in element.find("rpyOffset").text.split()] == [0.0, 0.0, 0.0]


def test_where_a_lumped_link_was_and_what_the_file_gave_can_be_asked():
    """Two fixed joints: 1 m ahead and turned to the left, then 2 m ahead of that."""
    model, _ = convert(
        link("base"),
        link("mast", None),
        link("imu", None),
        joint("f", "base", "mast", xyz="1 0 0", rpy="0 0 1.5707963267948966"),
        joint("g", "mast", "imu", xyz="2 0 0"),
        '<gazebo><plugin name="p" filename="libx.so"><bodyName>imu</bodyName><xyzOffset>0 0 3</xyzOffset></plugin></gazebo>',
        '<gazebo><plugin name="q" filename="libx.so"><bodyName>base</bodyName>'
        '<xyzOffset given="a" bodyName="1 2">1 0 0</xyzOffset></plugin></gazebo>',
    )
    merged, plain = (plugin.element for plugin in model.plugins)
    at = merged_at(merged, "bodyName")
    assert at.p == pytest.approx((1.0, 2.0, 0.0)) and math3.to_rpy(at)[2] == pytest.approx(math.pi / 2)
    assert given_offset(merged) == ((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    assert merged_at(merged, "frameName") == Pose()
    assert merged_at(plain, "bodyName") == Pose() and given_offset(plain) is None


def test_contact_sensor_of_a_lumped_link_names_what_sdformat_makes_of_it():
    model, _ = convert(
        link("base"),
        link("bumper", None, box()),
        joint("f", "base", "bumper"),
        '<gazebo reference="bumper"><sensor type="contact" name="c"><contact>'
        "<collision>bumper_collision</collision></contact></sensor></gazebo>",
    )
    assert model.links[0].sensors[0].element.find("contact/collision").text == "base_collision_bumper"

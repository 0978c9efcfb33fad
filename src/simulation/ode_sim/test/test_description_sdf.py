"""SDF worlds and models of all versions in use, and what happens when they are not right."""
import math

import pytest

from ode_sim import math3
from ode_sim.description import (
    DescriptionError, ResourceFinder, load_world, read_light, read_model, read_sdf_model, root_kind)
from ode_sim.description.model import Box, Capsule, Cylinder, Heightmap, Inertial, Mesh, Plane, Polyline, Sphere

BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
MODEL = """<?xml version="1.0"?>
<sdf version="1.6"><model name="{name}"><pose>9 9 9 0 0 0</pose>
<link name="body"><pose>0 0 1 0 0 0</pose></link><link name="tip"/>
<joint name="j" type="revolute"><parent>body</parent><child>tip</child></joint>
<plugin name="own" filename="libown.so"/></model></sdf>"""


@pytest.fixture
def models(tmp_path):
    def add(name, sdf, config='<model><sdf version="1.6">model.sdf</sdf></model>'):
        folder = tmp_path / "models" / name
        folder.mkdir(parents=True)
        (folder / "model.config").write_text(config)
        (folder / "model.sdf").write_text(sdf)
        return folder
    add.finder = ResourceFinder([tmp_path / "models"], [tmp_path], environment=False, stock="/nowhere",
                                package_path=lambda name: None)
    return add


@pytest.fixture
def finder(models):
    return models.finder


def world(body, finder, version="1.6"):
    return load_world(f'<sdf version="{version}"><world name="w">{body}</world></sdf>', finder)


def model(body, finder, version="1.6"):
    return read_sdf_model(f'<sdf version="{version}"><model name="m">{body}</model></sdf>', finder=finder)


def text(problems):
    return "\n".join(str(problem) for problem in problems)


def names(items):
    return [item.name for item in items]


# ---------------------------------------------------------------------------------------------- defaults

def test_an_empty_world_has_gazebos_defaults(finder):
    w, problems = world("", finder)
    assert (w.name, w.gravity, w.models, w.lights, w.state) == ("w", (0.0, 0.0, -9.8), (), (), None)
    assert (w.physics.max_step_size, w.physics.real_time_update_rate, w.physics.iters) == (0.001, 1000.0, 50)
    assert w.scene.ambient == (0.4, 0.4, 0.4, 1.0) and not problems


def test_world_settings(finder):
    w, problems = world("""
        <gravity>0 0 -1</gravity><magnetic_field>1 2 3</magnetic_field><gui fullscreen="1"><camera name="c"/></gui>
        <physics type="ode"><max_step_size>0.01</max_step_size><real_time_update_rate>100</real_time_update_rate>
          <max_contacts>7</max_contacts><ode><solver><type>world</type><iters>20</iters><sor>1.0</sor></solver>
          <constraints><cfm>0.1</cfm><erp>0.3</erp><contact_surface_layer>0.002</contact_surface_layer></constraints>
          </ode></physics>
        <scene><ambient>0.1 0.2 0.3 1</ambient><background>0 0 0</background><shadows>0</shadows><sky/></scene>
        <atmosphere type="adiabatic"/><wind/><audio/>
        <spherical_coordinates><latitude_deg>48</latitude_deg><heading_deg>90</heading_deg></spherical_coordinates>
        <plugin name="p" filename=" libp.so "/>""", finder)
    p = w.physics
    assert (w.gravity, w.magnetic_field, p.max_step_size, p.real_time_update_rate, p.max_contacts) == (
        (0.0, 0.0, -1.0), (1.0, 2.0, 3.0), 0.01, 100.0, 7)
    assert (p.solver, p.iters, p.sor, p.cfm, p.erp, p.contact_surface_layer) == ("world", 20, 1.0, 0.1, 0.3, 0.002)
    assert (w.scene.ambient, w.scene.background, w.scene.shadows, w.scene.sky) == (
        (0.1, 0.2, 0.3, 1.0), (0.0, 0.0, 0.0, 1.0), False, True)
    assert w.spherical_coordinates == (48.0, 0.0, 0.0, 90.0) and w.plugins[0].filename == "libp.so" and not problems


def test_the_default_physics_block_counts(finder):
    w, _ = world('<physics name="a"><max_step_size>0.1</max_step_size></physics>'
                 '<physics name="b" default="true"><max_step_size>0.2</max_step_size></physics>', finder)
    assert w.physics.max_step_size == 0.2


def test_link_defaults_and_surface(finder):
    m, _ = model(f"""<link name="a"><collision name="c">{BOX}</collision></link>
        <link name="b"><gravity>0</gravity><self_collide>1</self_collide><kinematic>true</kinematic>
        <velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>
        <inertial><mass>2</mass><pose>1 0 0 0 0 0</pose><inertia><ixx>3</ixx><ixy>0.1</ixy></inertia></inertial>
        <collision name="c"><max_contacts>3</max_contacts><laser_retro>5</laser_retro>{BOX}<surface>
        <friction><ode><mu>0.1</mu><mu2>0.2</mu2><fdir1>0 1 0</fdir1><slip1>0.3</slip1></ode>
        <torsional><coefficient>0.4</coefficient></torsional></friction>
        <bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0.01</threshold></bounce>
        <contact><collide_bitmask>0x02</collide_bitmask><collide_without_contact>1</collide_without_contact>
        <ode><kp>6</kp><kd>7</kd><max_vel>8</max_vel><min_depth>9</min_depth></ode></contact>
        </surface></collision></link>""", finder)
    a, b = m.links
    plain = a.collisions[0]
    assert a.inertial == Inertial() and a.gravity and a.self_collide is None
    assert (plain.surface.mu, plain.surface.kp, plain.max_contacts, plain.surface.torsional_mu) == (1.0, 1e12, 10, None)
    assert (b.gravity, b.self_collide, b.kinematic, b.linear_decay, b.angular_decay) == (False, True, True, 0.1, 0.2)
    assert (b.inertial.mass, b.inertial.pose.p, b.inertial.ixx, b.inertial.ixy) == (2.0, (1.0, 0.0, 0.0), 3.0, 0.1)
    s = b.collisions[0].surface
    assert (s.mu, s.mu2, s.fdir1, s.slip1, s.torsional_mu) == (0.1, 0.2, (0.0, 1.0, 0.0), 0.3, 0.4)
    assert (s.restitution, s.bounce_threshold, s.collide_bitmask, s.collide_without_contact) == (0.5, 0.01, 2, True)
    assert (s.kp, s.kd, s.max_vel, s.min_depth) == (6.0, 7.0, 8.0, 9.0)
    assert (b.collisions[0].max_contacts, b.collisions[0].laser_retro) == (3, 5.0)


def test_a_plugin_of_a_link_is_one_warning(finder):
    _, problems = model('<link name="l"><plugin name="p" filename="libgazebo_ros_p3d.so"/></link>', finder)
    assert len(problems) == 1 and "libgazebo_ros_p3d.so: a plugin inside a link is never started" in str(problems[0])


def test_a_plugin_of_a_visual_is_one_warning(finder):
    m, problems = model(f'<link name="l"><visual name="v">{BOX}<plugin name="p" filename="libgazebo_ros_video.so"/></visual>'
                        '</link>', finder)
    assert m.links[0].visuals[0].geometry == Box((1.0, 2.0, 3.0))
    assert len(problems) == 1 and "libgazebo_ros_video.so: plugins of a visual" in str(problems[0])


@pytest.mark.parametrize("shape, expected", [
    ("<box><size>1 2 3</size></box>", Box((1.0, 2.0, 3.0))),
    ("<sphere><radius>2</radius></sphere>", Sphere(2.0)),
    ("<cylinder><radius>2</radius><length>3</length></cylinder>", Cylinder(2.0, 3.0)),
    ("<capsule><radius>2</radius><length>3</length></capsule>", Capsule(2.0, 3.0)),
    ("<plane><normal>0 2 0</normal><size>5 6</size></plane>", Plane((0.0, 1.0, 0.0), (5.0, 6.0))),
    ("<polyline><point>0 0</point><point>1 0</point><point>1 1</point><height>4</height></polyline>",
     Polyline(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), 4.0)),
    ("<empty/>", None), ("<image/>", None)])
def test_geometry(finder, shape, expected):
    m, _ = model(f'<link name="a"><visual name="v"><geometry>{shape}</geometry></visual></link>', finder)
    assert m.links[0].visuals[0].geometry == expected


def test_meshes_and_heightmaps_resolve(models, finder):
    folder = models("thing", MODEL.format(name="thing"))
    (folder / "a.dae").write_text("x")
    m, problems = model("""<link name="a">
        <visual name="v"><geometry><mesh><uri>model://thing/a.dae</uri><scale>2 2 2</scale>
          <submesh><name>s</name><center>true</center></submesh></mesh></geometry></visual>
        <visual name="h"><geometry><heightmap><uri>file://models/thing/a.dae</uri><size>4 5 6</size></heightmap>
        </geometry></visual></link>""", finder)
    mesh, height = (visual.geometry for visual in m.links[0].visuals)
    assert mesh == Mesh(str(folder / "a.dae"), "model://thing/a.dae", (2.0, 2.0, 2.0), "s", True)
    assert isinstance(height, Heightmap) and height.path == str(folder / "a.dae") and height.size == (4.0, 5.0, 6.0)
    assert not problems


def test_sensor_light_and_plugins_of_a_link(finder):
    m, _ = model("""<link name="a"><pose>1 0 0 0 0 0</pose>
        <sensor name="s" type="ray"><pose>0 0 1 0 0 0</pose><update_rate>5</update_rate><ray><range/></ray>
          <plugin name="p" filename="
            libp.so"/></sensor>
        <light name="l" type="spot"><pose>0 0 2 0 0 0</pose><spot><inner_angle>0.1</inner_angle></spot></light>
        </link>""", finder)
    a, = m.links
    assert (a.sensors[0].pose.p, a.sensors[0].update_rate) == ((0.0, 0.0, 1.0), 5.0)
    assert a.sensors[0].element.find("ray/range") is not None and a.sensors[0].plugins[0].filename == "libp.so"
    assert (a.lights[0].type, a.lights[0].pose.p, a.lights[0].spot) == ("spot", (0.0, 0.0, 2.0), (0.1, 0.0, 0.0))


# ---------------------------------------------------------------------------------------------- frames and joints

TWO_LINKS = '<link name="a"><pose>1 0 0 0 0 1.5707963267948966</pose></link>' \
            '<link name="b"><pose>1 2 0 0 0 3.141592653589793</pose></link>'


def hinge(inside="", kind="revolute"):
    return f'<joint name="j" type="{kind}"><parent>a</parent><child>b</child>{inside}</joint>'


def test_an_axis_of_1_4_is_in_the_model_frame(finder):
    m, _ = model(TWO_LINKS + hinge("<axis><xyz>1 0 0</xyz></axis>"), finder, "1.4")
    assert m.joints[0].axes[0].xyz == pytest.approx((-1.0, 0.0, 0.0))  # b is turned by half a circle


def test_an_axis_of_1_5_is_in_the_joint_frame_unless_it_says_otherwise(finder):
    m, _ = model(TWO_LINKS + hinge("<axis><xyz>1 0 0</xyz></axis>"), finder, "1.5")
    assert m.joints[0].axes[0].xyz == (1.0, 0.0, 0.0)
    m, _ = model(TWO_LINKS + hinge("<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>"),
                 finder, "1.5")
    assert m.joints[0].axes[0].xyz == pytest.approx((-1.0, 0.0, 0.0))


def test_an_axis_of_1_7_names_its_frame(finder):
    m, _ = model(TWO_LINKS + hinge('<axis><xyz expressed_in="a">1 0 0</xyz></axis>'), finder, "1.7")
    # x of a is y of the model, which is -y of b
    assert m.joints[0].axes[0].xyz == pytest.approx((0.0, -1.0, 0.0), abs=1e-12)


def test_joint_pose_is_in_the_child(finder):
    m, _ = model(TWO_LINKS + hinge("<pose>0.5 0 0 0 0 0</pose>"), finder)
    assert m.joints[0].pose.p == pytest.approx((0.5, 0.0, 0.0))


def test_relative_to_and_frames(finder):
    m, problems = model("""
        <frame name="f" attached_to="a"><pose>0 1 0 0 0 0</pose></frame>
        <link name="a"><pose>1 0 0 0 0 1.5707963267948966</pose></link>
        <link name="b"><pose relative_to="f">0 0 5 0 0 0</pose>
          <visual name="v"><pose relative_to="a">0 0 0 0 0 0</pose><geometry><empty/></geometry></visual></link>
        <joint name="j" type="revolute"><pose relative_to="a"/><parent>a</parent><child>b</child></joint>
        <link name="c"><pose relative_to="j">0 0 1 0 0 0</pose></link>""", finder, "1.7")
    a, b, c = m.links
    assert b.pose.p == pytest.approx((0.0, 0.0, 5.0))  # y of a is -x of the model
    assert b.visuals[0].pose.p == pytest.approx((0.0, -1.0, -5.0)) and not problems
    assert c.pose.p == pytest.approx((1.0, 0.0, 1.0))
    assert m.joints[0].pose.p == pytest.approx((0.0, -1.0, -5.0))


def test_poses_in_a_circle_are_refused(finder):
    with pytest.raises(DescriptionError, match="refers to itself"):
        model('<link name="a"><pose relative_to="b"/></link><link name="b"><pose relative_to="a"/></link>', finder)


def test_the_empty_frame_attribute_of_old_files(finder):
    m, problems = model("<pose frame=''>1 2 3 0 -0 0</pose><link name='a'><pose frame=''>0 0 1 0 0 0</pose></link>", finder)
    assert (m.pose.p, m.links[0].pose.p, problems) == ((1.0, 2.0, 3.0), (0.0, 0.0, 1.0), [])


def test_joint_values(finder):
    m, _ = model(TWO_LINKS + hinge("""<axis><limit><lower>-1</lower><upper>1</upper><effort>2</effort>
        <velocity>3</velocity></limit><dynamics><damping>4</damping><friction>5</friction>
        <spring_reference>6</spring_reference><spring_stiffness>7</spring_stiffness></dynamics></axis>
        <physics><provide_feedback>1</provide_feedback><ode><limit><erp>0.1</erp><cfm>0.2</cfm></limit>
        <implicit_spring_damper>1</implicit_spring_damper><fudge_factor>0.3</fudge_factor></ode></physics>"""), finder)
    j, = m.joints
    a, = j.axes
    assert (a.xyz, a.lower, a.upper, a.effort, a.velocity, a.damping, a.friction) == (
        (0.0, 0.0, 1.0), -1.0, 1.0, 2.0, 3.0, 4.0, 5.0)
    assert (a.spring_reference, a.spring_stiffness, j.limit_erp, j.limit_cfm, j.fudge_factor) == (6.0, 7.0, 0.1, 0.2, 0.3)
    assert j.provide_feedback and j.implicit_spring_damper


def test_two_axes_and_none(finder):
    m, _ = model(TWO_LINKS + hinge("<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>", "universal"), finder)
    assert [axis.xyz for axis in m.joints[0].axes] == [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    assert model(TWO_LINKS + hinge(kind="ball"), finder)[0].joints[0].axes == ()


@pytest.mark.parametrize("joint, message", [
    ('<joint name="j" type="revolute"><parent>a</parent><child>zz</child></joint>', "child link 'zz'"),
    ('<joint name="j" type="spiral"><parent>a</parent><child>b</child></joint>', "unknown joint type 'spiral'"),
    ('<joint name="j" type="fixed"><parent>a</parent><child>world</child></joint>', "cannot join"),
])
def test_a_joint_that_cannot_be_is_left_out(finder, joint, message):
    m, problems = model(TWO_LINKS + joint, finder)
    assert m.joints == () and message in text(problems) and problems[0].severity == "error"


def test_a_joint_to_the_world(finder):
    m, problems = model(TWO_LINKS + '<joint name="j" type="fixed"><parent>world</parent><child>b</child></joint>', finder)
    assert m.joints[0].parent == "world" and not problems


# ---------------------------------------------------------------------------------------------- include, nesting

def test_include_changes_what_it_says(models, finder):
    models("thing", MODEL.format(name="Thing"))
    w, problems = world("""<include><uri>model://thing</uri></include>
        <include><uri>model://thing</uri><name>other</name><pose>1 0 0 0 0 0</pose><static>true</static>
        <plugin name="more" filename="libmore.so"/></include>""", finder)
    first, other = w.models
    assert (first.name, first.pose.p, first.static, names(first.plugins)) == ("Thing", (9.0, 9.0, 9.0), False, ["own"])
    assert (other.name, other.pose.p, other.static, names(other.plugins)) == ("other", (1.0, 0.0, 0.0), True, ["own", "more"])
    assert not problems


def test_include_of_a_light(models, finder):
    models("lamp", '<sdf version="1.6"><light name="lamp" type="point"/></sdf>')
    w, _ = world("<include><uri>model://lamp</uri><pose>0 0 3 0 0 0</pose></include>", finder)
    assert (w.lights[0].name, w.lights[0].pose.p) == ("lamp", (0.0, 0.0, 3.0))


def test_a_missing_model_is_one_warning_and_the_rest_loads(models, finder):
    models("thing", MODEL.format(name="thing"))
    w, problems = world("<include><uri>model://gone</uri></include><include><uri>model://thing</uri></include>"
                        "<include><uri>model://gone</uri></include>", finder)
    assert names(w.models) == ["thing"] and len(problems) == 1
    assert "model://gone" in text(problems) and finder.model_paths[0] in text(problems)


def test_the_network_is_never_used_but_a_local_model_of_that_name_is(models, finder):
    models("ground_plane", MODEL.format(name="floor"))
    w, problems = world("<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri></include>"
                        "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Tree</uri></include>", finder)
    assert names(w.models) == ["floor"] and "the network is never used" in text(problems)


def test_duplicate_names_keep_the_first(models, finder):
    models("thing", MODEL.format(name="thing"))
    w, problems = world("<include><uri>model://thing</uri></include>" * 2, finder)
    assert len(w.models) == 1 and "'thing' is there already" in text(problems)


def test_nested_models_are_flattened_with_scoped_names(models, finder):
    models("thing", MODEL.format(name="thing"))
    m, problems = model("""<link name="base"/>
        <include><uri>model://thing</uri><name>t</name><pose>0 5 0 0 0 0</pose></include>
        <model name="s"><pose>1 0 0 0 0 1.5707963267948966</pose><link name="l"><pose>1 0 0 0 0 0</pose></link></model>
        <joint name="weld" type="fixed"><parent>base</parent><child>t::body</child></joint>""", finder)
    assert names(m.links) == ["base", "s::l", "t::body", "t::tip"]
    by_name = {link.name: link.pose.p for link in m.links}
    assert by_name["t::body"] == (0.0, 5.0, 1.0) and by_name["s::l"] == pytest.approx((1.0, 1.0, 0.0))
    assert [(j.name, j.parent, j.child) for j in m.joints] == [
        ("weld", "base", "t::body"), ("t::j", "t::body", "t::tip")]
    assert names(m.plugins) == ["own"] and not problems


def test_what_is_static_in_a_model_that_moves_stays_where_it_is(finder):
    """Warehouses name their floor so: a <model> with nothing but the <include> of one that is static."""
    slab = '<model name="slab"><static>1</static><link name="l"/></model>'
    m, problems = model(f"<pose>0 0 3 0 0 0</pose>{slab}", finder)
    assert m.static and not m.joints and not problems
    m, problems = model(f'<link name="base"/><model name="room"><link name="door"/>{slab}</model>', finder)
    assert not m.static and not problems
    assert [(j.name, j.type, j.parent, j.child) for j in m.joints] == [
        ("room::slab::l::static", "fixed", "world", "room::slab::l")]


def test_a_model_that_includes_itself_is_stopped(models, finder):
    models("ring", '<sdf version="1.6"><model name="ring"><link name="l"/>'
                   '<include><uri>model://ring</uri></include></model></sdf>')
    w, problems = world("<include><uri>model://ring</uri></include>", finder)
    assert names(w.models[0].links) == ["l"] and "includes itself" in text(problems)


def test_bad_models_of_a_world_are_left_out_one_by_one(models, finder):
    models("broken", "<sdf version='1.6'><model name='x'>")
    models("config", MODEL.format(name="x"), config="<model/>")
    w, problems = world("""<include><uri>model://broken</uri></include><include><uri>model://config</uri></include>
        <model name="none"/><model name="light"><link name="l"><inertial><mass>0</mass></inertial></link></model>
        <model name="fat"><link name="l"><collision name="c"><geometry><sphere><radius>-1</radius></sphere></geometry>
        </collision></link></model><model name="good"><link name="l"/></model>""", finder)
    assert names(w.models) == ["good"] and len(problems) == 5
    for part in ("model.sdf:1: not well-formed", "<sdf version='1.6'>model.sdf</sdf>", "has no <link>", "positive mass",
                 "sizes must be positive"):
        assert part in text(problems)


def test_static_models_may_have_any_mass(finder):
    m, _ = model('<static>1</static><link name="l"><inertial><mass>0</mass><inertia><ixx>nan</ixx></inertia></inertial>'
                 "</link>", finder)
    assert m.static and m.links[0].inertial == Inertial()


def test_nan_inertia_of_a_moving_model_is_refused(finder):
    with pytest.raises(DescriptionError, match="finite"):
        model('<link name="l"><inertial><inertia><ixx>nan</ixx></inertia></inertial></link>', finder)


def test_the_newest_supported_file_of_a_model_config_is_taken(models, finder):
    folder = models("thing", MODEL.format(name="new"), config="""<model><sdf version="1.3">old.sdf</sdf>
        <sdf version="1.6">model.sdf</sdf><sdf version="1.9">future.sdf</sdf></model>""")
    (folder / "old.sdf").write_text(MODEL.format(name="old"))
    (folder / "future.sdf").write_text(MODEL.format(name="future"))
    assert names(world("<include><uri>model://thing</uri></include>", finder)[0].models) == ["new"]


# ---------------------------------------------------------------------------------------------- state, population

def test_state_of_a_saved_world(finder):
    w, _ = world("""<model name="m"><link name="l"/></model><state world_name="w"><sim_time>12 500000000</sim_time>
        <iterations>12500</iterations>
        <model name="m"><pose>1 0 0 0 0 0</pose><scale>2 2 2</scale>
          <link name="l"><pose>1 2 3 0 0 1</pose><velocity>1 2 3 4 5 6</velocity></link>
          <model name="sub"><link name="k"><pose>4 5 6 0 0 0</pose></link></model></model>
        <light name="sun"><pose>0 0 7 0 0 0</pose></light>
        <insertions><model name="late"><link name="l"/></model></insertions>
        <deletions><name>m</name></deletions></state>
        <state world_name="w"><sim_time>99 0</sim_time></state>""", finder)
    state = w.state
    assert (state.sim_time, state.iterations, state.deletions) == (12.5, 12500, ("m",))
    m, = state.models
    assert (m.pose.p, m.scale) == ((1.0, 0.0, 0.0), (2.0, 2.0, 2.0))
    assert [(link.name, link.pose.p) for link in m.links] == [("l", (1.0, 2.0, 3.0)), ("sub::k", (4.0, 5.0, 6.0))]
    assert (m.links[0].linear, m.links[0].angular) == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    assert state.light_poses[0][0] == "sun" and names(w.models) == ["m", "late"]


def test_what_was_stretched_in_the_window_is_as_large_as_it_was(finder):
    shapes = {"box": "<box><size>1 1 1</size></box>", "ball": "<sphere><radius>0.5</radius></sphere>",
              "post": "<cylinder><radius>0.5</radius><length>1</length></cylinder>"}
    parts = "".join(f'<collision name="{name}"><pose>0 0 3 0 0 0</pose><geometry>{shape}</geometry></collision>'
                    f'<visual name="{name}"><geometry>{shape}</geometry></visual>' for name, shape in shapes.items())
    models = "".join(f'<model name="{name}"><link name="l">{parts}</link></model>' for name in ("wall", "crate", "odd"))
    w, problems = world(f"""{models}<state world_name="w">
        <model name="wall"><scale>0.2 7.5 2</scale></model><model name="crate"><scale>1 1 1</scale></model>
        <model name="odd"><scale>1 0 1</scale></model></state>""", finder)
    wall, crate, odd = (m.links[0] for m in w.models)
    for parts in (wall.collisions, wall.visuals):
        assert [part.geometry for part in parts] == [Box((0.2, 7.5, 2.0)), Sphere(3.75), Cylinder(3.75, 2.0)]
    assert wall.collisions[0].pose.p == (0.0, 0.0, 3.0) and wall.inertial == Inertial()
    for link in (crate, odd):
        assert [part.geometry for part in link.collisions] == [Box(), Sphere(0.5), Cylinder(0.5, 1.0)]
    assert "model 'odd': scale 1 0 1" in text(problems)


@pytest.mark.parametrize("distribution, region", [
    ("<type>random</type>", "<box><size>4 4 0.1</size></box>"),
    ("<type>uniform</type>", "<box><size>4 4 0.1</size></box>"),
    ("<type>random</type>", "<cylinder><radius>2</radius><length>1</length></cylinder>"),
    ("<type>linear-x</type>", "<box><size>4 4 0.1</size></box>")])
def test_population(finder, distribution, region):
    body = f"""<population name="p"><pose>10 0 0 0 0 0</pose>{region}<model_count>9</model_count>
        <distribution>{distribution}</distribution>
        <model name="can"><pose>0 0 0.5 0 0 0</pose><link name="l"/></model></population>"""
    w, problems = world(body, finder)
    assert names(w.models) == [f"can_clone_{i}" for i in range(9)] and not problems
    places = [m.pose.p for m in w.models]
    assert len(set(places)) == 9 and all(abs(x - 10) <= 2 and abs(y) <= 2 for x, y, z in places)
    assert places == [m.pose.p for m in world(body, finder)[0].models]  # every time the same


def test_population_grid(finder):
    w, _ = world("""<population name="p"><model name="m"><link name="l"/></model><distribution><type>grid</type>
        <rows>2</rows><cols>3</cols><step>1 2 0</step></distribution></population>""", finder)
    assert sorted({m.pose.p[0] for m in w.models}) == [-1.0, 0.0, 1.0]
    assert sorted({m.pose.p[1] for m in w.models}) == [-1.0, 1.0]


def test_actors_and_roads_are_named_and_left_out(finder):
    w, problems = world('<actor name="walker"/><road name="street"/><model name="m"><link name="l"/></model>', finder)
    assert names(w.models) == ["m"] and "actors" in text(problems) and "roads" in text(problems)


# ---------------------------------------------------------------------------------------------- texts to spawn

def test_kinds_of_text(models, finder):
    models("thing", MODEL.format(name="thing"))
    include = "<sdf version='1.4'><world name='default'><include><uri>model://thing</uri><name>{}</name>" \
              "<pose>1 2 3 0 0 0</pose></include></world></sdf>"
    assert root_kind("<robot name='r'/>") == "urdf"
    assert root_kind("<sdf version='1.6'><light name='l'/></sdf>") == "light"
    assert root_kind(include.format("x"), finder) == "model"
    m, _ = read_model(include.format("x"), finder=finder)
    assert (m.name, m.pose.p) == ("x", (1.0, 2.0, 3.0))
    light, _ = read_light("<sdf version='1.6'><light name='l' type='spot'><diffuse>1 0 0</diffuse></light></sdf>")
    assert (light.name, light.type, light.diffuse) == ("l", "spot", (1.0, 0.0, 0.0, 1.0))


@pytest.mark.parametrize("spawned, message", [
    ("<sdf version='1.6'/>", "holds no <model>"), ("<html/>", "expected <robot> or <sdf>"), ("", "empty"),
    ("<sdf version='1.6'><world name='w'><include><uri>model://gone</uri></include></world></sdf>", "model://gone"),
    ("<sdf version='x'><model name='m'/></sdf>", "'x' is no SDF version"),
    ("<sdf version='1.6'><light name='l'/></sdf>", "is no <model>")])
def test_texts_that_are_no_model(finder, spawned, message):
    with pytest.raises(DescriptionError, match=message) as caught:
        read_model(spawned, finder=finder)
    assert "\n" not in str(caught.value)


def test_a_world_that_is_not_there_names_those_that_are(tmp_path):
    (tmp_path / "worlds").mkdir()
    (tmp_path / "worlds/empty.world").write_text("<sdf version='1.6'><world name='default'/></sdf>")
    finder = ResourceFinder(environment=False, stock=str(tmp_path))
    assert load_world("worlds/empty.world", finder)[0].name == "default"
    with pytest.raises(DescriptionError, match="cannot find world 'worlds/moon.world'.*: worlds/empty.world"):
        load_world("worlds/moon.world", finder)


def test_warnings_name_file_and_line(tmp_path, finder):
    file = tmp_path / "a.world"
    file.write_text("<sdf version='1.6'>\n<world name='w'>\n<gravity>0 0</gravity>\n</world></sdf>")
    w, problems = load_world(str(file), finder)
    assert w.gravity == (0.0, 0.0, -9.8) and text(problems).startswith(f"{file}:3 <gravity>: '0 0' is not 3 numbers")


def test_colours_of_gazebo_and_of_a_model(models, finder):
    folder = models("thing", MODEL.format(name="thing"))
    (folder / "materials/scripts").mkdir(parents=True)
    (folder / "materials/textures").mkdir()
    (folder / "materials/textures/t.png").write_text("x")
    (folder / "materials/scripts/t.material").write_text("""
        material Other/One { technique { pass { ambient 1 1 1 } } }
        // material Thing/Skin in a comment
        material Thing/Skin : Other/One
        {
          technique { pass { ambient 0.1 0.2 0.3
            diffuse 0.4 0.5 0.6 0.7
            texture_unit { texture t.png } } }
        }""")
    script = "<material><script><uri>{}</uri><name>{}</name></script>{}</material>"
    visual = '<visual name="{}"><geometry><empty/></geometry>{}</visual>'
    m, problems = model('<link name="l">' + "".join(visual.format(i, content) for i, content in enumerate([
        script.format("file://media/materials/scripts/gazebo.material", "Gazebo/Grey", ""),
        script.format("model://thing/materials/scripts", "Thing/Skin", ""),
        script.format("file://media/materials/scripts/gazebo.material", "Gazebo/Mauve", ""),
        script.format("", "Gazebo/Red", "<ambient>1 1 1 1</ambient>"),
        "<material><diffuse>0 1 0 1</diffuse></material>", ""])) + "</link>", finder)
    grey, skin, mauve, red, green, none = (visual.material for visual in m.links[0].visuals)
    assert (grey.diffuse, grey.ambient) == ((0.7, 0.7, 0.7, 1.0), (0.3, 0.3, 0.3, 1.0))
    assert (skin.ambient, skin.diffuse) == ((0.1, 0.2, 0.3, 1.0), (0.4, 0.5, 0.6, 0.7))
    assert skin.texture == str(folder / "materials/textures/t.png")
    assert mauve.diffuse is None and "no material 'Gazebo/Mauve'" in text(problems) and len(problems) == 1
    assert (red.diffuse, red.ambient) == ((1.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0))
    assert green.diffuse == (0.0, 1.0, 0.0, 1.0) and none is None


def test_pose_as_quaternion_is_read(finder):
    m, _ = model('<link name="l"><pose rotation_format="quat_xyzw">1 2 3 0 0 2 2</pose></link>', finder)
    assert math3.to_rpy(m.links[0].pose) == pytest.approx((0.0, 0.0, math.pi / 2))

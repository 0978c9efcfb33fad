"""Texts that nobody writes for a robot: too large, too deep, absurd numbers, traps. Refused, or read with a problem, at once."""

import time

import pytest
from ode_sim import math3
from ode_sim.description import DescriptionError, ResourceFinder, load_world, read_model, read_sdf_model, read_urdf, xmlsource
from ode_sim.description.model import FARTHEST, Physics
from ode_sim.description.xmlsource import parse_xml

FINDER = ResourceFinder(environment=False, stock="/nowhere", package_path=lambda name: None)
INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
HUGE = "9" * 400  # no float


def world(body, version="1.6"):
    return load_world(f'<sdf version="{version}"><world name="w">{body}</world></sdf>', FINDER)


def model(body, version="1.6"):
    return read_sdf_model(f'<sdf version="{version}"><model name="m">{body}</model></sdf>', finder=FINDER)


def robot(body):
    return read_urdf(f'<robot name="r">{body}</robot>', finder=FINDER)


def one_line(error):
    text = str(error)
    assert text and "\n" not in text and len(text) < 1100
    return text


def text(problems):
    return "\n".join(one_line(problem) for problem in problems)


# ---------------------------------------------------------------------------------------------- the text itself


def seconds(function, *arguments):
    begin = time.process_time()
    with pytest.raises(DescriptionError):
        function(*arguments)
    return time.process_time() - begin


def test_comments_that_do_not_end_take_linear_time():
    short, long = (min(seconds(parse_xml, "<sdf>" + "<!--" * n) for _ in range(5)) for n in (20_000, 160_000))
    assert long < 40 * short + 0.01  # square: 64 times


def test_text_in_many_pieces_takes_linear_time():
    def read(pieces):
        begin = time.process_time()
        assert len(parse_xml("<a>" + "x&#10;" * pieces + "</a>").text) == 2 * pieces
        return time.process_time() - begin

    short, long = (min(read(n) for _ in range(3)) for n in (100_000, 800_000))
    assert long < 40 * short + 0.01


@pytest.mark.parametrize(
    "text, message",
    [
        ("<x>" * 1500 + "</x>" * 1500, "text:1: <x> lies more than 100 elements deep"),
        ("<x>\n" * 101, "text:101: <x> lies more than 100 elements deep"),
        ('<!DOCTYPE x [<!ENTITY a "b">]>\n<x>&a;</x>', "text:1: declares the entity 'a'"),
        ('<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/hostname">]><x>&a;</x>', "declares the entity 'a'"),
        ('<!DOCTYPE x [\n<!ENTITY % a SYSTEM "file:///etc/hostname">\n%a;]><x/>', "text:2: declares the entity 'a'"),
    ],
)
def test_what_is_too_deep_or_has_entities_is_refused(text, message):
    with pytest.raises(DescriptionError) as error:
        parse_xml(text)
    assert message in one_line(error.value)


def test_an_entity_bomb_is_refused_before_it_grows():
    bomb = "".join(f'<!ENTITY {"abcdefghij"[i]} "{("&" + "abcdefghij"[i - 1] + ";") * 10 if i else "ha" * 50}">' for i in range(10))
    for read in (parse_xml, load_world, read_model):
        assert seconds(read, f"<!DOCTYPE sdf [{bomb}]><sdf version='1.6'>&j;</sdf>") < 1.0


def test_a_document_type_alone_is_no_harm():
    assert parse_xml('<!DOCTYPE robot SYSTEM "http://nowhere/robot.dtd"><robot name="r">&#65;</robot>').text == "A"


def test_a_text_that_is_too_long_or_has_too_many_elements_is_refused(monkeypatch):
    monkeypatch.setattr(xmlsource, "MOST_ELEMENTS", 1000)
    monkeypatch.setattr(xmlsource, "MOST_BYTES", 10_000_000)
    with pytest.raises(DescriptionError, match="text:1: more than 1000 elements"):
        parse_xml("<a>" + "<b/>" * 1000 + "</a>")
    with pytest.raises(DescriptionError, match="is longer than 10 MB"):
        parse_xml(" " * 10_000_001)
    assert len(parse_xml("<a>" + "<b/>" * 999 + "</a>")) == 999


@pytest.mark.parametrize(
    "text",
    [
        f"<{'a' * 100000}>",
        f"<sdf version='{'9' * 100000}'/>",
        f"<robot name='{'x' * 100000}'/>",
        "<robot name='a&#10;b&#13;&#9;c'><link name='l&#10;m'/><link name='l&#10;m'/></robot>",
        f"<sdf version='1.6'><model name='{'n' * 100000}'/></sdf>",
        f"<sdf version='1.6'><model name='m'><pose>{'nan ' * 100000}</pose><link name='l'/></model></sdf>",
        f"<robot name='r'><link name='l'><inertial><mass value='{'k' * 100000}'/><inertia/></inertial></link></robot>",
        f"<robot name='r'><link name='l'/><joint name='j' type='{'t' * 9999}'/></robot>",
        f"<robot name='r'><link name='l'/><joint name='j' type='fixed'><parent link='{'p' * 9999}'/></joint></robot>",
    ],
    ids=range(9),
)
def test_a_message_holds_one_shortened_line_of_the_text(text):
    with pytest.raises(DescriptionError) as error:
        read_model(text, finder=FINDER)
    assert len(one_line(error.value)) < 400


# ---------------------------------------------------------------------------------------------- numbers


@pytest.mark.parametrize(
    "value, used",
    [
        ("0", 20),
        ("-1000000.0", 20),
        ("1e20", 10_000_000),
        ("1e300", 10_000_000),
        (HUGE, 10_000_000),
        ("inf", 10_000_000),
        ("-inf", 20),
        ("7", 7),
    ],
    ids=lambda value: str(value)[:9],
)
def test_max_contacts_of_a_world(value, used):
    w, problems = world(f"<physics type='ode'><max_contacts>{value}</max_contacts></physics>")
    assert w.physics.max_contacts == used and type(w.physics.max_contacts) is int
    assert ("max_contacts" in text(problems)) == (used != 7)


@pytest.mark.parametrize("value", ["1e300", "-1", "inf", HUGE], ids=lambda value: value[:6])
@pytest.mark.parametrize(
    "path",
    [
        "max_step_size",
        "real_time_update_rate",
        "real_time_factor",
        "ode/solver/iters",
        "ode/solver/precon_iters",
        "ode/solver/sor",
        "ode/constraints/cfm",
        "ode/constraints/erp",
        "ode/constraints/contact_max_correcting_vel",
        "ode/constraints/contact_surface_layer",
    ],
)
def test_absurd_physics_is_brought_within_bounds_and_said(path, value):
    from ode_sim.physics import check_physics

    if (path, value) == ("real_time_update_rate", "-1"):
        pytest.skip("as fast as possible: test_an_update_rate_below_0_is_as_fast_as_possible")
    tags = path.split("/")
    w, problems = world(
        "<physics type='ode'>" + "".join(f"<{tag}>" for tag in tags) + value + "".join(f"</{tag}>" for tag in reversed(tags)) + "</physics>"
    )
    assert check_physics(w.physics) == w.physics
    assert "text:1 <physics>: " in text(problems) and tags[-1] in text(problems)


def test_absurd_gravity_and_field_are_left_at_their_defaults():
    w, problems = world("<gravity>0 0 -1e300</gravity><magnetic_field>0 inf 0</magnetic_field>")
    assert w.gravity == (0.0, 0.0, -9.8) and all(abs(v) < 1e-3 for v in w.magnetic_field)
    assert "<gravity>: '0 0 -1e300' is beyond 1e+06; using" in text(problems) and "<magnetic_field>" in text(problems)


@pytest.mark.parametrize(
    "pose",
    ["1e9 0 0 0 0 0", "0 0 1e400 0 0 0", "0 0 inf", "-inf 0 0", "1e8 0 0", "0 0 0 inf 0 0", f"0 0 {HUGE}"],
    ids=lambda pose: pose[:12],
)
def test_what_lies_too_far_away_is_left_out_of_a_world_and_refused_alone(pose):
    with pytest.raises(DescriptionError, match="<pose>"):
        model(f"<pose>{pose}</pose><link name='l'/>")
    with pytest.raises(DescriptionError, match="<pose>"):
        model(f"<link name='l'><pose>{pose}</pose></link>")
    w, problems = world(
        f"<model name='far'><pose>{pose}</pose><link name='l'/></model><light name='lamp'><pose>{pose}"
        "</pose></light><model name='near'><link name='l'/></model>"
    )
    assert [m.name for m in w.models] == ["near"] and not w.lights
    assert "model 'far' is left out" in text(problems) and "light 'lamp' is left out" in text(problems)


@pytest.mark.parametrize("q", ["0 0 0 1e200", "nan 0 0 1", "inf 0 0 0", "1e300 1e300 1e300 1e300"])
def test_a_rotation_that_is_none_is_refused(q):
    with pytest.raises(DescriptionError, match="<pose>"):
        model(f"<link name='l'><pose rotation_format='quat_xyzw'>0 0 0 {q}</pose></link>")


@pytest.mark.parametrize(
    "shape",
    [
        "<box><size>1 1 1e10</size></box>",
        "<sphere><radius>1e300</radius></sphere>",
        "<sphere><radius>inf</radius></sphere>",
        "<cylinder><radius>1</radius><length>1e8</length></cylinder>",
        "<capsule><radius>-1</radius><length>1</length></capsule>",
        "<heightmap><uri>x.png</uri><size>1 1e300 1</size></heightmap>",
        "<polyline><height>-1</height></polyline>",
    ],
)
def test_shapes_beyond_the_limit_are_left_out_one_by_one(shape):
    m, problems = model(
        f"<link name='l'><collision name='c'><geometry>{shape}</geometry></collision><visual name='v'><geometry>{shape}"
        "</geometry></visual><collision name='d'><geometry><box/></geometry></collision></link>"
    )
    assert [c.name for c in m.links[0].collisions] == ["d"] and not m.links[0].visuals
    assert text(problems).count("sizes must be positive and finite, and at most 1e+07 m; ") == 2
    assert "collision 'c' of link 'l' is left out" in text(problems) and "visual 'v' of link 'l' is left out" in text(problems)


def test_numbers_of_shapes_that_make_no_sense_are_replaced():
    m, problems = model(
        "<link name='l'>"
        + "".join(
            f"<visual name='{i}'><geometry>{shape}</geometry></visual>"
            for i, shape in enumerate(
                (
                    "<plane><normal>0 1e300 0</normal><size>1e300 1</size></plane>",
                    "<mesh><uri>x.stl</uri><scale>1e300 1 1</scale></mesh>",
                    "<heightmap><sampling>1e300</sampling><pos>0 inf 0</pos></heightmap>",
                    "<polyline>" + "<point>0 0</point>" * 1001 + "</polyline>",
                )
            )
        )
        + "</link>"
    )
    plane, mesh, heightmap, polyline = (visual.geometry for visual in m.links[0].visuals)
    assert (plane.normal, plane.size, mesh.scale) == ((0.0, 0.0, 1.0), (1.0, 1.0), (1.0, 1.0, 1.0))
    assert (heightmap.sampling, heightmap.pos, polyline) == (2, (0.0, 0.0, 0.0), None)
    for word in ("<normal>", "<size>", "<scale>", "<sampling>", "<pos>", "an outline of 1001 points"):
        assert word in text(problems)


def test_offsets_of_a_plugin_that_make_no_sense_are_left_out():
    m, problems = robot(
        f'<link name="a">{INERTIAL}</link><link name="b"/><joint name="j" type="fixed"><parent link="a"/>'
        '<child link="b"/></joint><gazebo><plugin name="p" filename="q"><bodyName>b</bodyName>'
        "<xyzOffset>0 1e300 0</xyzOffset><rpyOffset>0 inf 0</rpyOffset></plugin></gazebo>"
    )
    (plugin,) = m.plugins
    assert plugin.element.findtext("bodyName") == "a" and plugin.element.findtext("xyzOffset") == "0.0 0.0 0.0"
    assert "<xyzOffset>: '0 1e300 0' is beyond" in text(problems) and "<rpyOffset>" in text(problems)


def test_a_scale_that_makes_a_saved_model_too_large_is_ignored():
    w, problems = world(
        f"<model name='m'><link name='l'><collision name='c'>{BOX}</collision></link></model>"
        "<state><model name='m'><scale>1 1e7 1</scale></model></state>"
    )
    assert w.models[0].links[0].collisions[0].geometry.size == (1.0, 2.0, 3.0)
    assert "makes it larger than 1e+07 m; the model keeps its size" in text(problems)


@pytest.mark.parametrize("value", ["inf", "-1", "1e300", "nan", HUGE, "x"], ids=lambda value: value[:6])
def test_absurd_times_of_a_saved_world(value):
    w, problems = world(f"<state><sim_time>{value} 0</sim_time></state>")
    assert w.state.sim_time == 0.0 and "is no time; starting from 0" in text(problems)


def test_absurd_iterations_of_a_saved_world():
    w, problems = world("<state><iterations>1e300</iterations></state>")
    assert w.state.iterations == 0 and "<iterations>" in text(problems)


def test_the_limit_is_no_limit_for_the_earth():
    m, problems = model(
        "<pose>6371000 0 0 0 0 0</pose><link name='l'><collision name='c'><geometry><sphere>"
        "<radius>6371000</radius></sphere></geometry></collision></link>"
    )
    assert m.links[0].collisions[0].geometry.radius < FARTHEST and not problems and Physics().max_contacts == 20


# ---------------------------------------------------------------------------------------------- long and deep


def chain(count, kind="continuous"):
    return "".join(f'<link name="l{i}">{INERTIAL}</link>' for i in range(count)) + "".join(
        f'<joint name="j{i}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/></joint>' for i in range(count - 1)
    )


def test_a_chain_of_any_length_is_read():
    m, problems = robot(chain(5000))
    assert len(m.links) == 5000 and len(m.joints) == 4999 and not problems
    massless = chain(5000).replace('<mass value="1"/>', '<mass value="0"/>').replace('value="0"', 'value="1"', 1)
    m, problems = robot(massless)
    assert len(m.links) == 1 and "link 'l1' has no mass, so it is left out and with it l2, l3" in text(problems)


def test_fixed_joints_in_a_row():
    m, _ = robot(chain(200, "fixed"))
    assert len(m.links) == 1 and m.links[0].inertial.mass == 200
    with pytest.raises(DescriptionError, match="more than 200 fixed joints hang one behind the other"):
        robot(chain(300, "fixed"))


def test_poses_given_in_each_other_to_any_depth():
    m, problems = model(
        "<link name='l0'><pose>1 0 0 0 0 0</pose></link>"
        + "".join(f"<link name='l{i}'><pose relative_to='l{i - 1}'>1 0 0 0 0 0</pose></link>" for i in range(1, 3000)),
        "1.7",
    )
    assert m.links[-1].pose.p == (3000.0, 0.0, 0.0) and not problems


def test_a_circle_of_joints_beside_the_robot_is_refused():
    ring = "".join(f'<joint name="{a}{b}" type="continuous"><parent link="{a}"/><child link="{b}"/></joint>' for a, b in ("bc", "cb"))
    with pytest.raises(DescriptionError, match="<link name='b'>: its joints form a circle, apart from the root link 'a'"):
        robot("".join(f'<link name="{name}">{INERTIAL}</link>' for name in "abc") + ring)


@pytest.mark.parametrize(
    "text",
    [
        '<robot name="m"><link name="l"/><gazebo><plugin name="p" filename="q">'
        + "<x>" * 1500
        + "</x>" * 1500
        + "</plugin></gazebo></robot>",
        "<sdf version='1.6'>" + "<model name='m'>" * 1500 + "</model>" * 1500 + "</sdf>",
    ],
    ids=["plugin", "models"],
)
def test_what_nests_too_deep_is_refused_by_every_reader(text):
    from ode_sim.description import read_light, root_kind

    for read in (read_model, read_urdf, read_sdf_model, read_light, root_kind, load_world):
        with pytest.raises(DescriptionError, match="lies more than 100 elements deep"):
            read(text)


def test_models_in_models_as_deep_as_allowed():
    depth = xmlsource.DEEPEST - 2
    m, _ = read_sdf_model(
        "<sdf version='1.6'>" + "".join(f"<model name='m{i}'>" for i in range(depth)) + "<link name='l'/>" + "</model>" * depth + "</sdf>",
        finder=FINDER,
    )
    assert m.links[0].name == "::".join(f"m{i}" for i in range(1, depth)) + "::l"


def cpu(function, *arguments):
    begin = time.process_time()
    function(*arguments)
    return time.process_time() - begin


def urdf_star(count):
    return (
        "<link name='root'>"
        + INERTIAL
        + "</link>"
        + "".join(
            f'<link name="l{i}">{INERTIAL}<visual><geometry><box size="1 1 1"/></geometry></visual></link>'
            f'<joint name="j{i}" type="{"fixed" if i % 2 else "continuous"}"><parent link="root"/>'
            f'<child link="l{i}"/></joint><gazebo reference="l{i}"><mu1>{i}</mu1></gazebo>'
            f'<gazebo><plugin name="p{i}" filename="q"><bodyName>l{i}</bodyName></plugin></gazebo>'
            for i in range(count)
        )
    )


def sdf_rows(count):
    return "".join(
        f"<link name='l{i}'><pose>{i} 0 0 0 0 0</pose><collision name='c'>{BOX}</collision></link>" for i in range(count)
    ) + "".join(f"<joint name='j{i}' type='revolute'><parent>l{i}</parent><child>l{i + 1}</child></joint>" for i in range(count - 1))


def sdf_models(count):
    return "".join(f"<model name='m{i}'><link name='l'/><bad/></model><model name='m{i}'><link name='l'/></model>" for i in range(count))


@pytest.mark.parametrize(
    "read, body", [(robot, chain), (robot, urdf_star), (model, sdf_rows), (world, sdf_models)], ids=["chain", "star", "rows", "models"]
)
def test_time_grows_with_the_size_of_the_description(read, body):
    short, long = (min(cpu(read, body(n)) for _ in range(2)) for n in (200, 2000))
    assert long < 30 * short  # square: 100 times


def test_two_models_that_include_the_next_twice_do_not_grow_without_end(tmp_path, monkeypatch):
    from ode_sim.description.sdf import SdfReader

    for i in range(25):
        folder = tmp_path / f"m{i}"
        folder.mkdir()
        (folder / "model.config").write_text('<model><sdf version="1.6">model.sdf</sdf></model>')
        (folder / "model.sdf").write_text(
            "<sdf version='1.6'><model name='m'><link name='l'/>"
            + "".join(f"<include><uri>model://m{i + 1}</uri><name>{name}</name></include>" for name in "ab")
            + "</model></sdf>"
        )
    finder = ResourceFinder([tmp_path], environment=False, stock="/nowhere", package_path=lambda name: None)
    monkeypatch.setattr(SdfReader, "MOST_COPIED", 3000)
    w, problems = load_world("<sdf version='1.6'><world name='w'><include><uri>model://m0</uri></include></world></sdf>", finder)
    assert len(w.models[0].links) < 3000
    assert "lies more than 20 models deep" in text(problems) and "more than 3000 elements" in text(problems)


@pytest.mark.parametrize(
    "body",
    [
        "<model_count>1e300</model_count>",
        "<model_count>1000000</model_count>",
        "<distribution><type>grid</type><rows>1e6</rows><cols>1e6</cols></distribution>",
        "<distribution><type>grid</type><rows>-1</rows><cols>inf</cols></distribution>",
    ],
)
def test_a_population_of_millions_is_left_out(body):
    w, problems = world(f"<population name='p'><model name='m'><link name='l'/></model>{body}</population>")
    assert len(w.models) <= 1 and problems


# ---------------------------------------------------------------------------------------------- old SDF


def test_joints_of_sdf_1_0_name_their_links_in_attributes():
    m, problems = model(
        "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
        "</joint><joint name='k' type='fixed'><parent link='world'/><child link='a'/></joint>",
        "1.0",
    )
    assert [(j.parent, j.child) for j in m.joints] == [("a", "b"), ("world", "a")] and not problems


def test_max_contacts_of_a_collision():
    def contacts(value):
        m, problems = model(f"<link name='l'><collision name='c'><max_contacts>{value}</max_contacts>{BOX}</collision></link>")
        return m.links[0].collisions[0].max_contacts, bool(problems)

    assert [contacts(value) for value in ("0", "3", "-1", "4294967295", "1e20", "1e300", HUGE, "inf")] == [(0, False), (3, False)] + [
        (10, True)
    ] * 6


def test_names_made_unique_are_those_of_nobody_else():
    names = ("c_1", "c", "c", "c_1", "c", "c_2")
    read, problems = model("<link name='l'>" + "".join(f"<collision name='{name}'>{BOX}</collision>" for name in names) + "</link>")
    assert [shape.name for shape in read.links[0].collisions] == ["c_1", "c", "c_3", "c_1_1", "c_4", "c_2"]
    assert sum("used twice" in problem.message for problem in problems) == 3


@pytest.mark.parametrize(
    "written, xyz, rpy",
    [
        ("1 2 3 0.1 0.2", (1, 2, 3), (0.1, 0.2, 0)),
        ("1 2", (1, 2, 0), (0, 0, 0)),
        ("1 2 3", (1, 2, 3), (0, 0, 0)),
        ("1 2 3 0.1 0.2 0.3 0.4", (1, 2, 3), (0.1, 0.2, 0.3)),
        ("1 2 3m 0.1 0 0", (1, 2, 3), (0, 0, 0)),
        ("1,2,3,0,0,0", (1, 0, 0), (0, 0, 0)),
    ],
)
def test_numbers_that_stand_first_in_a_pose_count(written, xyz, rpy):
    w, problems = load_world(
        f"<sdf version='1.6'><world name='w'><model name='m'><pose>{written}</pose><link name='l'/></model></world></sdf>"
    )
    pose = w.models[0].pose
    assert pose.p == pytest.approx(xyz) and math3.to_rpy(pose) == pytest.approx(rpy)
    short = len(written.split()) not in (3, 6, 7) or "m" in written
    assert short == ("is not 6 numbers; using" in " ".join(map(str, problems)))


def test_missing_numbers_of_other_elements_are_the_defaults():
    w, problems = load_world(
        "<sdf version='1.6'><world name='w'><gravity>1 2</gravity><model name='m'><link name='l'>"
        "<collision name='c'><geometry><box><size>0.5 0.6cm</size></box></geometry></collision>"
        "</link></model></world></sdf>"
    )
    assert w.gravity == (1.0, 2.0, -9.8)
    assert w.models[0].links[0].collisions[0].geometry.size == (0.5, 0.6, 1.0)
    assert len(problems) == 2

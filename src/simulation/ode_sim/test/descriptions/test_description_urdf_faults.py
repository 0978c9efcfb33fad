"""Faults of URDF: what costs its part in one warning, and what costs the robot, as urdfdom has it."""

import pytest
from ode_sim.description import DescriptionError, read_urdf
from urdf_texts import FINDER, INERTIA, box, convert, joint, link, messages, names, one


@pytest.mark.parametrize("mass", ["nan", "inf", "heavy", ""])
def test_a_mass_that_is_no_number_is_refused(mass):
    with pytest.raises(DescriptionError, match="mass"):
        convert(link("base", mass))


INERTIAL = f'<inertial><mass value="1"/>{INERTIA}</inertial>'


@pytest.mark.parametrize(
    "inertial, mass, ixx, message",
    [
        ('<inertial><mass value="2"/></inertial>', 2.0, 0.0, "<inertia> is missing; its mass counts without it"),
        ('<inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"/></inertial>', 2.0, 0.0, "'iyz' is missing"),
        (f'<inertial><origin xyz="0 0 O"/><mass value="2"/>{INERTIA}</inertial>', 2.0, 1.0, "xyz='0 0 O' is not 3 numbers"),
    ],
)
def test_a_fault_of_an_inertial_is_one_warning_with_its_line(inertial, mass, ixx, message):
    model, problems = convert(link("base"), f"\n<link name='tool'>{inertial}{box()}</link>", joint("j", "base", "tool", "continuous"))
    tool = one(model.links, "tool")
    assert (tool.inertial.mass, tool.inertial.ixx, tool.inertial.pose.p, len(tool.collisions)) == (mass, ixx, (0.0, 0.0, 0.0), 1)
    assert names(model.joints) == ["j"] and len(problems) == 1 and problems[0].source.line == 2 and message in messages(problems)


@pytest.mark.parametrize("mass", ["heavy", "1,5", "", "1 kg"])
def test_a_mass_that_is_no_number_costs_its_link_alone_in_one_warning(mass):
    model, problems = convert(link("base"), "\n", link("tool", mass), joint("j", "base", "tool", "continuous"))
    assert names(model.links) == ["base"] and len(problems) == 1 and problems[0].source.line == 2
    assert f"link 'tool' has no mass (value='{mass}' is not a number" in messages(problems)
    model, problems = convert(link("base"), "\n", link("tool", mass, box()), joint("j", "base", "tool"))
    assert model.links[0].inertial.mass == 1.0 and len(model.links[0].collisions) == 1
    assert len(problems) == 1 and "it counts as massless" in messages(problems)


@pytest.mark.parametrize("tag", ["visual", "collision"])
@pytest.mark.parametrize(
    "part, message",
    [
        ('<geometry><box size="0,1 0,1 0,1"/></geometry>', "is not 3 numbers; decimals are written with a point"),
        ('<geometry><box size="1 2"/></geometry>', "size='1 2' is not 3 numbers"),
        ("<geometry><box/></geometry>", "'size' is missing"),
        ('<geometry><cylinder radius="0.1"/></geometry>', "'length' is missing"),
        ('<geometry><sphere radius="r"/></geometry>', "not a number"),
        ('<geometry><mesh scale="1 1 1"/></geometry>', "'filename' is missing"),
        ("<geometry><cone/></geometry>", "unknown shape"),
        ('<geometry><box size="-1 1 1"/></geometry>', "must be positive"),
        ('<origin xyz="0 0 O"/><geometry><box size="1 1 1"/></geometry>', "xyz='0 0 O'"),
        ('<origin rpy="0 0"/><geometry><box size="1 1 1"/></geometry>', "rpy='0 0'"),
    ],
)
def test_a_fault_of_a_shape_is_one_warning_with_its_line_and_the_rest_stays(tag, part, message):
    model, problems = convert(f"<link name='a'>{INERTIAL}\n<{tag}>{part}</{tag}>", box("visual"), box(), "</link>")
    assert len(model.links[0].visuals) == len(model.links[0].collisions) == 1 and model.links[0].inertial.mass == 1.0
    assert len(problems) == 1 and problems[0].source.line == 2 and message in messages(problems)
    assert f"the <{tag}> is left out" in messages(problems)


def test_a_mimic_of_nothing_is_one_warning_and_the_joint_moves_by_itself():
    model, problems = convert(link("a"), link("b"), "\n", joint("j", "a", "b", "continuous", body='<mimic joint=""/>'))
    assert names(model.joints) == ["j"] and model.joints[0].mimic is None
    assert len(problems) == 1 and problems[0].source.line == 2 and "mimics a joint without a name" in messages(problems)


@pytest.mark.parametrize(
    "head, message", [('version="1.1"', "there is URDF 1.0 only"), ('version="1"', "there is URDF 1.0 only"), ('version="1.0"', "")]
)
def test_another_version_of_urdf_is_refused_as_in_urdfdom(head, message):
    text = f'<robot name="r" {head}>{link("a")}</robot>'
    if not message:
        assert not read_urdf(text, finder=FINDER)[1]
        return
    with pytest.raises(DescriptionError, match=message):
        read_urdf(text, finder=FINDER)


@pytest.mark.parametrize(
    "parts, message",
    [
        ([link("a"), link("b")], "several root links"),
        ([link("a"), link("b"), joint("j", "a", "b"), joint("k", "b", "a")], "circle|child of joint"),
        ([link("a"), link("b"), joint("j", "a", "c")], "'c' is not in the robot"),
        ([link("a"), link("a")], "named 'a' is there already"),
        ([link("a"), link("b"), link("c"), joint("j", "a", "b"), joint("j", "a", "c")], "named 'j' is there already"),
        ([link("a"), link("b"), link("c"), joint("j", "a", "c"), joint("k", "b", "c")], "must be a tree"),
        ([link("a"), link("b"), joint("j", "a", "b", "revolute")], "needs <limit"),
        ([link("a"), link("b"), joint("j", "a", "b", "hinge")], "unknown type 'hinge'"),
        ([link("a"), link("b"), joint("j", "a", "b", "prismatic", body='<limit lower="0" upper="1"/>')], "'effort' is missing"),
        ([link("a"), link("b"), joint("j", "a", "b", body="<limit/>")], "'effort' is missing"),
        ([link("a"), link("b"), joint("j", "a", "b", body="<dynamics/>")], "neither 'damping' nor 'friction'"),
        ([link("a"), link("b"), joint("j", "a", "b", body="<mimic/>")], "'joint' is missing"),
        ([link("a"), link("b"), joint("j", "a", "b", xyz="0,1 0 0")], "xyz='0,1 0 0' is not 3 numbers; decimals are written with a point"),
        ([], "has no <link>"),
    ],
)
def test_what_urdfdom_refuses_is_refused_in_one_line(parts, message):
    with pytest.raises(DescriptionError, match=message) as caught:
        convert(*parts)
    assert "\n" not in str(caught.value)


def test_errors_name_file_and_line():
    text = '<robot name="r">\n  <link name="a"/>\n  <link\n name="a"/>\n</robot>'
    with pytest.raises(DescriptionError, match=r"arm\.urdf:3"):
        read_urdf(text, finder=FINDER, file="arm.urdf")


def test_malformed_xml_names_the_line_and_quotes_it():
    with pytest.raises(DescriptionError, match=r"arm\.urdf:3: not well-formed XML, mismatched tag, at: </lonk>"):
        read_urdf('<robot name="r">\n<link name="a">\n</lonk></robot>', finder=FINDER, file="arm.urdf")

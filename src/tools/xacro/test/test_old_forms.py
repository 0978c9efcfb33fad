"""Elements without prefix: what is right for Noetic's xacro means the same here, and what older robots write is understood.

Noetic's xacro leaves every element without the prefix alone, so the values below are what stands in the files.
"""

import os
import subprocess
from xml.etree.ElementTree import canonicalize

import pytest

COMMAND = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "xacro")


def expand(folder, body, root="robot", **others):
    """What the command makes of ``body``: its lines without blanks, and what it says."""
    for name, content in others.items():
        (folder / f"{name}.xacro").write_text(f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{content}</robot>')
    path = folder / "r.xacro"
    path.write_text(f'<{root} xmlns:xacro="http://ros.org/wiki/xacro">{body}</{root}>')
    result = subprocess.run([COMMAND, str(path)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    text = canonicalize(result.stdout, strip_text=True)
    return text.removeprefix(f"<{root}>").removesuffix(f"</{root}>"), result.stderr


def same(text):
    """``text`` in the form of what ``expand`` returns."""
    return canonicalize(f"<a>{text}</a>")[3:-4]


NOETIC = {
    "SRDF's own element": (
        '<xacro:macro name="end_effector" params="n"><end_effector name="${n}" parent_link="l" group="g"/></xacro:macro>'
        '<xacro:end_effector n="x"/>',
        '<end_effector name="x" parent_link="l" group="g"/>',
    ),
    "a plugin's element": (
        '<xacro:macro name="bumper" params="n"><gazebo><plugin><bumper>${n}</bumper></plugin></gazebo></xacro:macro><xacro:bumper n="x"/>',
        "<gazebo><plugin><bumper>x</bumper></plugin></gazebo>",
    ),
    "the macro's own element": ('<xacro:macro name="m" params="a:=1"><m a="${a}"/></xacro:macro><xacro:m/>', '<m a="1"/>'),
    "its own element by way of another": (
        '<xacro:macro name="in"><out/></xacro:macro><xacro:macro name="out"><xacro:in/></xacro:macro><xacro:out/>',
        "<out/>",
    ),
    "a block inside of its own macro": (
        '<xacro:macro name="m" params="*b"><m><xacro:insert_block name="b"/></m></xacro:macro><xacro:m><x/></xacro:m>',
        "<m><x/></m>",
    ),
    "called with prefix elsewhere": ('<xacro:macro name="m"><x/></xacro:macro><m/><xacro:m/>', "<m/><x/>"),
    "called by xacro:call": ('<xacro:macro name="m"><x/></xacro:macro><m/><xacro:call macro="m"/>', "<m/><x/>"),
    "another attribute": ('<xacro:macro name="m" params="a"><x/></xacro:macro><m a="1" b="2"/>', '<m a="1" b="2"/>'),
    "an attribute too few": ('<xacro:macro name="m" params="a b:=1"><x/></xacro:macro><m b="2"/>', '<m b="2"/>'),
    "a text": ('<xacro:macro name="m"><x/></xacro:macro><m>1</m>', "<m>1</m>"),
    "a child too many": ('<xacro:macro name="m"><x/></xacro:macro><m><y/></m>', "<m><y/></m>"),
    "a child too few": ('<xacro:macro name="m" params="*b"><x/></xacro:macro><m/>', "<m/>"),
    "content of a sensor": ('<xacro:macro name="m"><x/></xacro:macro><sensor><m/></sensor>', "<sensor><m/></sensor>"),
    "content of gazebo, by a macro": (
        '<xacro:macro name="m"><x/></xacro:macro><xacro:macro name="n"><m/></xacro:macro><gazebo><xacro:n/></gazebo>',
        "<gazebo><m/></gazebo>",
    ),
    "made by xacro:element": ('<xacro:macro name="m"><x/></xacro:macro><xacro:element xacro:name="m"/>', "<m/>"),
    "the name of a namespace": ('<xacro:include filename="other.xacro" ns="m"/><m/><m.k/><xacro:m.k/>', "<m/><m.k/><x/>"),
    "a property beside those with prefix": (
        '<xacro:property name="a" value="1"/><property name="b" value="${a}"/>',
        '<property name="b" value="1"/>',
    ),
    "a property of a sensor": ('<sensor><property name="b" value="1"/></sensor>', '<sensor><property name="b" value="1"/></sensor>'),
    "an include with content": ('<include filename="other.xacro"><tag/></include>', '<include filename="other.xacro"><tag/></include>'),
    "an include of nothing": ('<include filename="none.xacro"/>', '<include filename="none.xacro"/>'),
    "an include by nobody's name": ('<include filename="${2}/$(env NO_SUCH)"/>', None),
}


@pytest.mark.parametrize("case", NOETIC)
def test_what_is_right_for_noetic_stays_as_it_is(tmp_path, case):
    body, expected = NOETIC[case]
    if expected is None:  # an error, as of any attribute that cannot be evaluated
        with pytest.raises(AssertionError, match="NO_SUCH"):
            expand(tmp_path, body)
        return
    found, _ = expand(tmp_path, body, other='<xacro:macro name="k"><x/></xacro:macro>')
    assert found == same(expected)


SRDF = "group group_state chain subgroup end_effector virtual_joint passive_joint disable_collisions link_sphere_approximation"


@pytest.mark.parametrize("name", [*SRDF.split(), "transmission", "mimic", "pose", "uri", "mu1"])
def test_names_of_srdf_urdf_and_sdf_are_never_macros(tmp_path, name):
    found, said = expand(tmp_path, f'<xacro:macro name="{name}" params="name:=1"><x/></xacro:macro><{name}/><{name} name="2"/>')
    assert (found, said) == (same(f'<{name}/><{name} name="2"/>'), "")


def test_arguments_of_a_launch_file_are_its_own(tmp_path):
    body = '<arg name="a" default="1"/><xacro:if value="1"><include file="b"/></xacro:if>'
    assert expand(tmp_path, body, root="launch") == (same('<arg name="a" default="1"/><include file="b"/>'), "")


OLD = {
    "a macro of another file": ('<include filename="other.xacro"/><wheel side="left"/>', '<l n="left_wheel"/>'),
    "with a default": ('<macro name="w" params="a b:=2"><l n="${a}${b}"/></macro><w a="1"/>', '<l n="12"/>'),
    "with a block": (
        '<macro name="w" params="*o"><j><insert_block name="o"/></j></macro><w><origin xyz="1 2 3"/></w>',
        '<j><origin xyz="1 2 3"/></j>',
    ),
    "with a block that is handed on": (
        '<macro name="w" params="*o"><j><insert_block name="o"/></j></macro>'
        '<macro name="v" params="*o"><w><insert_block name="o"/></w></macro><v><origin xyz="1 2 3"/></v>',
        '<j><origin xyz="1 2 3"/></j>',
    ),
    "in a link": ('<macro name="cube" params="m"><mass value="${m}"/></macro><link><cube m="2"/></link>', '<link><mass value="2"/></link>'),
    "from a macro with prefix": ('<macro name="in"><x/></macro><macro name="out"><in/></macro><xacro:out/>', "<x/>"),
    "a condition in gazebo": ('<gazebo><if value="1"><x/></if><unless value="1"><y/></unless></gazebo>', "<gazebo><x/></gazebo>"),
}


@pytest.mark.parametrize("case", OLD)
def test_what_older_robots_write_is_understood(tmp_path, case):
    body, expected = OLD[case]
    other = '<property name="p" value="wheel"/><macro name="wheel" params="side"><l n="${side}_${p}"/></macro>'
    found, said = expand(tmp_path, body, other=other)
    assert found == same(expected) and "is written without prefix" in said


@pytest.mark.parametrize(
    "body, said",
    [
        (
            '<xacro:macro name="w" params="a"><x/></xacro:macro><w/><w/>',
            "<w> stays as it is, though there is a macro of that name, which needs 'a'",
        ),
        (
            '<xacro:macro name="w"><x/></xacro:macro><xacro:w/><w/><w/>',
            "<w> stays as it is, though there is a macro of that name and it is called with",
        ),
        ('<xacro:if value="1"/><if value="1"/>', "<if> without prefix stays as it is, since <xacro:if> is written in this file, too"),
        ('<include filename="none.xacro"/>', "<include> is written without prefix and names no file that is there; it stays as it is"),
    ],
)
def test_a_likely_slip_is_told_once(tmp_path, body, said):
    _, complaint = expand(tmp_path, body)
    assert said in complaint and "r.xacro:1: " in complaint and len(complaint.splitlines()) == 1


def test_one_document_knows_nothing_of_the_one_before(tmp_path):
    """``import xacro``: what the first calls with prefix, the second may call without."""
    code = "import sys, xacro\nfor name in sys.argv[1:]: print(xacro.process_file(name).documentElement.toxml())"
    for name, call in (("a", "<xacro:m/>"), ("b", "<m/>")):
        body = f'<xacro:macro name="m"><x/></xacro:macro>{call}'
        (tmp_path / f"{name}.xacro").write_text(f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{body}</robot>')
    arguments = [str(tmp_path / f"{name}.xacro") for name in "ab"]
    result = subprocess.run(["python3", "-c", code, *arguments], capture_output=True, text=True)
    assert result.stdout.split() == ["<robot><x/></robot>"] * 2, result

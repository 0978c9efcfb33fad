"""Files that are included with ``ns=``: names of arguments, defaults and blocks, by the rule of Noetic's xacro.

What Noetic says: handle_macro_call of xacro 1.14 evaluates all three among the names of the file that has the macro. What it refuses
(names of the caller alone) is expanded as by xacro 2.1.
"""

import os
import re
import subprocess

import pytest

COMMAND = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "xacro")
FILE = """
<xacro:property name="a" value="inner"/>
<xacro:property name="p" value="P"/>
<xacro:macro name="deflt" params="x:=${a}"><k x="${x}"/></xacro:macro>
<xacro:macro name="given" params="x"><k x="${x}"/></xacro:macro>
<xacro:macro name="forward" params="a:=^"><k x="${a}"/></xacro:macro>
<xacro:macro name="forward_or" params="c:=^|none"><k x="${c}"/></xacro:macro>
<xacro:macro name="block" params="**b"><xacro:insert_block name="b"/></xacro:macro>
<xacro:macro name="own" params="x"><own a="${a}" x="${x}"/></xacro:macro>
"""
NESTED = '<xacro:include filename="file.xacro" ns="M"/><xacro:property name="a" value="middle"/>'
HERE = """
<xacro:include filename="file.xacro" ns="N"/><xacro:include filename="nested.xacro" ns="D"/>
<xacro:property name="a" value="outer"/><xacro:property name="o" value="only outer"/>
<xacro:macro name="local" params="x"><local x="${x}"/></xacro:macro>
"""
NOETIC = {
    "a default": ("<xacro:N.deflt/>", '<k x="inner"/>'),
    "an argument that both know": ('<xacro:N.given x="${a}"/>', '<k x="inner"/>'),
    "an argument that the file knows": ('<xacro:N.given x="${p}"/>', '<k x="P"/>'),
    "an argument from above": ('<xacro:N.given x="${o}"/>', '<k x="only outer"/>'),
    "by name of the namespace": ('<xacro:N.given x="${N.a} ${D.a} ${D.M.a}"/>', '<k x="inner middle inner"/>'),
    "a namespace in a namespace": ('<xacro:D.M.given x="${a}"/>', '<k x="inner"/>'),
    "a name that is handed on": ("<xacro:N.forward/>", '<k x="inner"/>'),
    "one that is not the file's": (
        '<xacro:macro name="m" params="c"><xacro:N.forward_or/></xacro:macro><xacro:m c="callers"/>',
        '<k x="none"/>',
    ),
    "a block": ('<xacro:N.block><e><f x="${a}"/></e></xacro:N.block>', '<f x="inner"/>'),
    "a macro of the file in a block": ('<xacro:N.block><e><xacro:own x="${a}"/></e></xacro:N.block>', '<own a="inner" x="inner"/>'),
    "a property set in a block": (
        '<xacro:N.block><e><xacro:property name="a" value="set"/></e></xacro:N.block><xacro:N.deflt/><f x="${a}"/>',
        '<k x="set"/><f x="outer"/>',
    ),
    "by xacro:call": ('<xacro:call macro="N.deflt"/>', '<k x="inner"/>'),
}
NEWER = {
    "an argument of the calling macro": (
        '<xacro:macro name="m" params="v"><xacro:N.given x="${v}"/></xacro:macro><xacro:m v="1"/>',
        '<k x="1"/>',
    ),
    "together with one of the file": (
        '<xacro:macro name="m" params="v"><xacro:N.given x="${v} ${p} ${a}"/></xacro:macro><xacro:m v="1"/>',
        '<k x="1 P inner"/>',
    ),
    "a block of the calling macro": (
        '<xacro:macro name="m" params="**b"><xacro:N.block><e><xacro:insert_block name="b"/></e></xacro:N.block></xacro:macro>'
        "<xacro:m><e><g/></e></xacro:m>",
        "<g/>",
    ),
    "a macro of the caller in a block": ('<xacro:N.block><e><xacro:local x="${o}"/></e></xacro:N.block>', '<local x="only outer"/>'),
    "a call in the block of a call": (
        '<xacro:macro name="m" params="v"><xacro:N.block><e><xacro:D.M.given x="${v}"/></e></xacro:N.block></xacro:macro><xacro:m v="1"/>',
        '<k x="1"/>',
    ),
}


def expand(folder, body):
    for name, content in (("file", FILE), ("nested", NESTED), ("r", HERE + body)):
        (folder / f"{name}.xacro").write_text(f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{content}</robot>')
    return subprocess.run([COMMAND, str(folder / "r.xacro")], capture_output=True, text=True)


@pytest.mark.parametrize("case", [*NOETIC, *NEWER])
def test_names_are_those_of_the_file_then_those_of_the_caller(tmp_path, case):
    body, expected = {**NOETIC, **NEWER}[case]
    result = expand(tmp_path, body)
    found = re.sub(r">\s+<", "><", re.search(r"<robot>\s*(.*?)\s*</robot>", result.stdout, re.S)[1]) if result.returncode == 0 else ""
    assert (found, result.stderr) == (expected, "")


def test_the_body_of_a_macro_knows_nothing_of_its_caller(tmp_path):
    result = expand(tmp_path, '<xacro:macro name="m" params="a"><xacro:N.deflt/></xacro:macro><xacro:m a="callers"/>')
    assert 'x="inner"' in result.stdout


@pytest.mark.parametrize(
    "call, said", [("<xacro:N.none/>", "unknown macro name: xacro:N.none"), ('<xacro:N.given x="${q}"/>', "name 'q' is not")]
)
def test_what_nobody_knows_is_refused_with_its_place(tmp_path, call, said):
    result = expand(tmp_path, call)
    assert result.returncode == 2 and said in result.stderr and f"{tmp_path / 'r.xacro'}:5: " in result.stderr

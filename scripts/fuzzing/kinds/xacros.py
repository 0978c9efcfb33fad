"""Xacro files, expanded by the command xacro."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

from fuzzing import programs, seeds, xml_cases
from fuzzing.findings import Found, check_message, of_output, of_stack
from fuzzing.kinds import Kind

_SNIPPETS = b"""<snippets xmlns:xacro="http://www.ros.org/wiki/xacro">
<in tag="robot">
<xacro:property name="p" value="${p + 1}"/><xacro:macro name="m" params="a b:=1 *c **d"><xacro:m a="1"/></xacro:macro>
<xacro:include filename="$(find arm_description)/urdf/arm.gazebo.xacro"/><xacro:include filename="case.xacro"/>
<xacro:arg name="a" default="1"/>
<xacro:if value="${1 == 1}"><link name="conditional"/></xacro:if><xacro:unless value="maybe"/><xacro:insert_block name="c"/>
<xacro:property name="q" value="${[x for x in range(10 ** 9)]}"/><xacro:property name="r" value="${'a' * 10 ** 6}"/>
<xacro:property name="s" value="${9**9**9}" lazy_eval="false"/>
<xacro:property name="t" value="${round(7, 1 &lt;&lt; 60)}" lazy_eval="false"/>
<xacro:property name="u" value="${'%9999999999d' % 1}" lazy_eval="false"/>
<xacro:property name="v" value="${'v'.ljust(10**11)}" lazy_eval="false"/>
<link name="${1 &lt;&lt; 10**12}"/><link name="${'a' * 10**11}"/><link name="${sum([a * b for a in range(10**5) for b in range(10**5)])}"/>
<link name="${math.factorial(10**9)}"/><xacro:property name="y" value="${xacro.load_yaml('/no/such.yaml')}"/>
<xacro:element xacro:name="link" name="made"/><link name="$(anon a)"/><link name="$(env NO_SUCH)"/><link name="$(eval 9**9**9)"/>
<link name="$(optenv NO_SUCH a b)"/><link name="$(bogus x)"/><link name="$(dirname)"/>
<link name="${list(map(lambda x: list(map(lambda y: x, range(90000))), range(90000)))}"/>
<link name="${[list(map(list, [range(90000)] * 90000)), 1][1]}"/><link name="${str([[0] * 10 ** 6] * 10 ** 6)}"/>
<link name="$(anon a b)"/><link name="$(anon)"/><link name="${filter(None, [1])}"/><link name="${list(filter(lambda x: x, range(10**9)))}"/>
<link name="${sorted(range(9), key=lambda x: -x)}"/>
<link name="${(lambda f: f(f, 40))(lambda f, n: n if n &lt; 2 else f(f, n - 1) + f(f, n - 2))}"/>
<xacro:macro name="twice"><xacro:m2/><xacro:m2/></xacro:macro><xacro:macro name="m2"><xacro:m/><xacro:m/></xacro:macro><xacro:twice/></in>
<in tag="link"><xacro:attribute name="name" value="other"/><xacro:m a="$(arg a)"/></in></snippets>"""
_MOST_LINES = 12  # of an error with the places it went through


class XacroKind(Kind):
    """Xacro files of the workspace, changed. What they expand to is a case of kind ``urdf``."""

    name, suffix = "xacro", ".xacro"
    time_limit = 60.0
    silent = False

    def prepare(self) -> None:
        seeds.robots()  # imports xacro
        self._mutator = xml_cases.XmlMutator([path.read_bytes() for path in seeds.files(".xacro")], _SNIPPETS)
        self._script = Path(seeds.packages()["xacro"]) / "xacro"

    def generate(self, random: Random) -> bytes:
        return self._mutator.case(random)

    def smaller(self, case: bytes) -> Iterator[bytes]:
        return xml_cases.smaller(case)

    def run(self, case: bytes) -> None:
        Path("case.xacro").write_bytes(case)
        ended = programs.run(self._script, ["case.xacro"], "")
        if ended.hung:
            raise Found.of(of_stack("hang", ended.errors))
        if ended.code < 0 and not ended.interrupted:
            raise Found.of(of_stack(f"process ended by signal {-ended.code}", ended.errors))
        if "Traceback (most recent call last)" in ended.errors:
            raise Found.of(of_output(ended.errors[ended.errors.index("Traceback (most") :]))
        if ended.code not in (0, 2) and not ended.interrupted:
            raise Found("exit code", "xacro", f"{ended.code}: {programs.last_line(ended.errors)}")
        lines = [line for line in ended.errors.splitlines() if line.strip() and "warning" not in line]
        if ended.code == 2 and not ended.interrupted and not 1 <= len(lines) <= _MOST_LINES:
            raise Found("message of many lines" if lines else "fails without a word", "xacro", ended.errors)
        for line in lines:
            check_message(line, "xacro's message")

"""The xacro commands as a student types them."""

import os
import re
import signal
import subprocess
import time

import psutil
import pytest

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEADER = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


def run(path, *arguments, command="xacro"):
    return subprocess.run([os.path.join(HERE, command), str(path), *arguments], capture_output=True, text=True)


@pytest.fixture
def write(tmp_path):
    def write_file(body, name="r.xacro", header=HEADER):
        path = tmp_path / name
        path.write_text(header + body + "\n</robot>\n")
        return path

    return write_file


@pytest.mark.parametrize("command", ["xacro", "xacro.py"])
def test_expands_macros_arguments_and_expressions(write, command):
    path = write(
        '<xacro:arg name="n" default="a"/><xacro:macro name="m" params="v"><link name="${v}_$(arg n)"/></xacro:macro><xacro:m v="${1+1}"/>'
    )
    result = run(path, "--inorder", "n:=b", command=command)
    assert result.returncode == 0 and '<link name="2_b"/>' in result.stdout


def test_find_goes_through_rospkg(write):
    result = run(write('<link name="$(find xacro)"/>'))
    assert f'<link name="{HERE}"/>' in result.stdout


def test_unknown_package_is_named_with_place_and_remedy(write):
    path = write('<link name="a"/>\n<xacro:include filename="$(find no_such_pkg)/a.xacro"/>')
    result = run(path)
    assert result.returncode == 2
    assert f"{path}:3: package 'no_such_pkg' not found" in result.stderr and "Traceback" not in result.stderr


def test_error_inside_an_included_macro_names_its_own_file_and_line(write):
    write('\n<xacro:macro name="m">\n<link name="${nope}"/></xacro:macro>', name="inner.xacro")
    outer = write('<xacro:include filename="inner.xacro"/>\n<xacro:m/>')
    result = run(outer)
    assert result.returncode == 2 and "inner.xacro:4: name 'nope' is not defined" in result.stderr


def test_malformed_xml_names_file_and_line(write):
    path = write("<link>\n</lnk>")
    result = run(path)
    assert result.returncode == 2 and f"{path}:3: not well-formed XML" in result.stderr


def test_ctrl_c_ends_it_without_a_traceback(write):
    path = write('<a b="${[x * 0.5 for x in range(90000)][0]}"/>' * 2000)
    process = subprocess.Popen([os.path.join(HERE, "xacro"), str(path)], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        while sum(psutil.Process(process.pid).cpu_times()[:2]) < 3.0:  # it expands, and would for hours
            assert process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, complaint = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode != 0 and "Traceback" not in complaint


def test_an_expression_without_end_is_refused_in_one_line_with_its_place(write):
    path = write('<link name="a"/>\n<link name="${9**9**9}"/>')
    result = run(path)
    assert result.returncode == 2
    assert f"{path}:3: 9 to the power of 387420489 is too much for a robot description" in result.stderr.splitlines()[0]
    assert "Traceback" not in result.stderr


def test_missing_file(tmp_path):
    result = run(tmp_path / "none.xacro")
    assert result.returncode == 2 and "No such file" in result.stderr and "Traceback" not in result.stderr


def test_output_option_and_old_namespaces(write, tmp_path):
    path = write(
        '<xacro:property name="x" value="3"/><link name="${x}"/>', header='<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">\n'
    )
    out = tmp_path / "out.urdf"
    assert run(path, "-o", str(out)).returncode == 0
    assert '<link name="3"/>' in out.read_text()


def test_a_broken_manifest_elsewhere_is_not_blamed_on_the_file(write, tmp_path, monkeypatch):
    broken = tmp_path / "workspace" / "broken"
    broken.mkdir(parents=True)
    (broken / "package.xml").write_text("<package><name>x</nam></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "workspace"))
    result = run(write('<link name="$(find broken)"/>'))
    assert result.returncode == 2 and "some package.xml on ROS_PACKAGE_PATH is not well-formed" in result.stderr


def test_a_macro_without_prefix_is_expanded_with_one_warning(write):
    path = write(
        '<xacro:macro name="wheel" params="side"><link name="${side}_wheel"/></xacro:macro>\n'
        '<xacro:macro name="camera"><link name="never"/></xacro:macro>\n'
        '<wheel side="left"/><wheel side="right"/><sensor><camera name="head"/></sensor>'
    )
    result = run(path)
    assert result.returncode == 0
    assert '<link name="left_wheel"/>' in result.stdout and '<link name="right_wheel"/>' in result.stdout
    assert '<camera name="head"/>' in result.stdout and "never" not in result.stdout
    assert result.stderr.count("is called without prefix") == 1 and f"{path}:4" in result.stderr


def test_words_without_prefix_are_understood_with_one_warning(write):
    path = write(
        '<property name="r" value="0.3"/>\n<macro name="wheel" params="side"><link name="${side}_${r}"/></macro>\n'
        '<if value="${r > 1}"><link name="never"/></if>\n<xacro:wheel side="left"/>\n'
        '<gazebo><plugin name="p"><property name="kept" value="1"/></plugin></gazebo>'
    )
    result = run(path)
    assert result.returncode == 0
    assert '<link name="left_0.3"/>' in result.stdout and "never" not in result.stdout
    assert '<property name="kept" value="1"/>' in result.stdout
    assert result.stderr.count("is written without prefix") == 1 and f"{path}:2: <property>" in result.stderr


BOMB = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10 if i else "ha" * 50}">' for i in range(10))


@pytest.mark.parametrize(
    "entities, use",
    [
        ('<!ENTITY a "b">', "&a;"),
        ('<!ENTITY a SYSTEM "file:///etc/hostname">', "&a;"),
        ('<!ENTITY % a SYSTEM "file:///etc/hostname"> %a;', ""),
        (BOMB.replace("a0 ", "a ").replace("&a0;", "&a;"), "&a9;"),
    ],
    ids=["internal", "external", "parameter", "bomb"],
)
def test_entities_are_refused(write, entities, use):
    path = write(f'<link name="l">{use}</link>', header=f"<!DOCTYPE robot [\n{entities}]>\n{HEADER}")
    result = run(path)
    assert result.returncode == 2 and f"{path}:2: declares the entity 'a'; entities are not read" in result.stderr
    assert len(result.stderr.splitlines()) == 2 and "Traceback" not in result.stderr


def test_a_document_type_alone_is_no_harm(write):
    result = run(write('<link name="l"/>', header='<!DOCTYPE robot SYSTEM "http://nowhere/robot.dtd">\n' + HEADER))
    assert result.returncode == 0 and '<link name="l"/>' in result.stdout


@pytest.mark.parametrize(
    "body",
    ['<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', '<xacro:include filename="r.xacro"/>', "<a>" * 3000 + "</a>" * 3000],
    ids=["macro", "include", "nested"],
)
def test_what_calls_itself_is_a_short_message(write, body):
    result = run(write(body))
    assert result.returncode == 2 and "nests too deep; does a macro or a file include itself?" in result.stderr
    assert len(result.stderr.splitlines()) <= 21 and "Traceback" not in result.stderr


def test_anon_is_one_name_of_its_own_in_the_whole_file(write):
    """As roslaunch's: the name with host, process and a random number behind it."""
    write('<link name="$(anon base)"/>', name="inner.xacro")
    path = write('<link name="$(anon base)"/><xacro:include filename="inner.xacro"/><link name="$(anon arm)_x"/>')
    first, second = run(path), run(path)
    names = [re.findall('<link name="([^"]*)"', result.stdout) for result in (first, second)]
    assert first.returncode == 0 and all(re.fullmatch(r"base_\w+_\d+_\d+", name) for name in names[0][:2]), first
    assert names[0][0] == names[0][1] and re.fullmatch(r"arm_\w+_\d+_\d+_x", names[0][2]) and names[0] != names[1]


def test_substitutions_of_every_kind(write, monkeypatch):
    monkeypatch.setenv("SIDE", "left")
    path = write(
        '<xacro:arg name="n" default="2"/><a b="$(env SIDE) $(optenv SIDE x) $(optenv NO_SUCH a b) $(optenv NO_SUCH)|'
        '$(arg n) $(eval n * 3) $(eval 2 ** 10)"/>'
    )
    result = run(path)
    assert '<a b="left left a b |2 6 1024"/>' in result.stdout, result


@pytest.mark.parametrize(
    "written, said",
    [
        ("$(env NO_SUCH)", "environment variable 'NO_SUCH' is not set"),
        ("$(env)", "only accepts one argument"),
        ("$(arg x)", "argument x"),
        ("$(anon)", "must specify a name"),
        ("$(anon a b)", "may only specify one name"),
        ("$(bogus x)", "there are find, env, optenv"),
        ("$(find a b)", "exactly one argument"),
        ("$(eval 1/0)", "division by zero"),
        ("$(eval nope)", "'nope' is not defined"),
        ("$(eval 9**9**9)", "9 to the power of 387420489 is too much"),
        ("$(eval [0]*10**10)", "is too much"),
        ("$(optenv)", "must specify"),
    ],
)
def test_a_substitution_that_fails_is_told_once(write, written, said):
    path = write(f'<link name="a"/>\n<link name="{written}"/>')
    result = run(path)
    assert result.returncode == 2 and f"{path}:3: " in result.stderr and "Traceback" not in result.stderr and "<class" not in result.stderr
    assert result.stderr.count(said) == 1 and len(result.stderr.splitlines()) == 2


def test_a_loop_by_map_is_refused_in_one_line(write):
    path = write('<link name="${[list(map(lambda x: list(map(lambda y: x, range(90000))), range(90000))), 1][1]}"/>')
    result = run(path)
    assert result.returncode == 2 and "a loop of more than 5000000 rounds is too much for a robot description" in result.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    "body",
    [
        "".join(f'<xacro:property name="a{i}" value="{f"${{a{i - 1}}}" * 10 if i else "ha" * 50}"/>' for i in range(12))
        + '<a b="${a11}"/>',
        '<xacro:macro name="m0"><a/></xacro:macro>'
        + "".join(f'<xacro:macro name="m{i}">{f"<xacro:m{i - 1}/>" * 10}</xacro:macro>' for i in range(1, 12))
        + "<xacro:m11/>",
    ],
    ids=["properties", "macros"],
)
def test_what_doubles_and_doubles_again_is_refused(write, body):
    result = run(write(body))
    assert result.returncode == 2 and ("too much for a robot description" in result.stderr or "expands to more than" in result.stderr)
    assert max(map(len, result.stderr.splitlines())) < 400


def test_a_message_quotes_a_shortened_line(write):
    result = run(write(f'<link name="${{{"x" * 5000}}}"/>'))
    assert result.returncode == 2 and max(map(len, result.stderr.splitlines())) < 400

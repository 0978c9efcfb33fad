"""rosmon's additions to launch files; the rest is roslaunch's loader."""

import pytest
from rosmon_core import RosmonError
from rosmon_core.cli import Options
from rosmon_core.launch_file import list_arguments, load

NODE = '<node name="{}" pkg="p" type="t" {}/>'


@pytest.fixture
def write(tmp_path):
    def write(body, name="x.launch", attributes="", **options):
        path = tmp_path / name
        path.write_text(f"<launch {attributes}>{body}</launch>")
        return Options(file=str(path), **options)

    return write


def test_attributes_are_inherited_from_launch_group_and_include(write, tmp_path):
    write(NODE.format("inner", "") + NODE.format("own", 'rosmon-stop-timeout="3"'), "inner.launch")
    launch_file = load(
        write(
            f'<group rosmon-memory-limit="1kB"><include file="{tmp_path}/inner.launch" rosmon-cpu-limit="0.5"/></group>'
            + NODE.format("outer", 'rosmon-spawn-delay="0.5"'),
            attributes='rosmon-stop-timeout="7"',
        )
    )
    inner, own, outer = launch_file.nodes
    assert (inner.stop_timeout, inner.memory_limit, inner.cpu_limit) == (7.0, 1000, 0.5)
    assert (own.stop_timeout, own.memory_limit) == (3.0, 1000)
    assert (outer.stop_timeout, outer.cpu_limit, outer.spawn_delay, inner.spawn_delay) == (7.0, 0.9, 0.5, 0.0)
    assert launch_file.problems == []


def test_arguments_are_read_before_anything_else(write):
    launch_file = load(write('<param name="p" value="$(arg a)"/><arg name="a" default="5"/>', arguments=["a:=6"]))
    assert launch_file.params == {"/p": 6}


def test_imported_arguments_flow_up(write, tmp_path):
    write('<arg name="from_child" value="9"/>', "child.launch")
    body = '<include file="{}/child.launch" {}/><param name="p" value="$(arg from_child)"/>'
    assert load(write(body.format(tmp_path, 'rosmon-import-args="true"'))).params == {"/p": 9}
    with pytest.raises(RosmonError, match="from_child"):
        load(write(body.format(tmp_path, "")))


def test_output_attribute(write):
    body = NODE.format("none", "") + NODE.format("log", 'output="log"') + NODE.format("screen", 'output="screen"')
    assert [n.show_stdout for n in load(write(body)).nodes] == [True, False, True]
    assert [n.show_stdout for n in load(write(body, obey_output=True)).nodes] == [False, False, True]


def test_spawn_delays_increment(write):
    """LaunchConfig::applyAutoIncrementSpawnDelayToAll: nodes with a delay of their own keep it and are not counted."""
    body = NODE.format("a", "") + NODE.format("b", 'rosmon-spawn-delay="1"') + NODE.format("c", "") + NODE.format("d", "")
    assert [n.spawn_delay for n in load(write(body, spawn_increment=6.0)).nodes] == [0.0, 1.0, 6.0, 12.0]


def test_tests_and_machines_are_skipped(write):
    launch_file = load(
        write('<machine name="m" address="elsewhere"/><test test-name="t" pkg="p" type="t"/>' + NODE.format("n", 'machine="m"'))
    )
    assert [n.full_name for n in launch_file.nodes] == ["/n"]


def test_private_parameters_are_cleared_first(write):
    launch_file = load(write('<node name="n" pkg="p" type="t" clear_params="true"><param name="x" value="1"/></node>'))
    assert launch_file.clear_params == ["/n/"] and launch_file.params == {"/n/x": 1}


def test_launch_attributes(write):
    options = write("", attributes='rosmon-name="me" rosmon-disable-ui="true"')
    assert load(options).attributes["rosmon-name"] == "me"
    assert options.disable_ui


@pytest.mark.parametrize(
    "body, remedy",
    [
        ("<node", "Could not load"),
        (NODE.format("a", "") * 2, "multiple nodes named"),
        (NODE.format("a", 'output="x"'), "output"),
        (NODE.format("a", 'rosmon-memory-limit="x"'), "15MB"),
        (NODE.format("a", 'rosmon-spawn-delay="x"'), "node 'a'"),
        ('<param name="p" value="$(arg missing)"/>', "missing"),
        ('<param name="p" value="$(find no_pkg)"/>', "no_pkg"),
        ('<include file="x" ns="y" clear_params="true"/>', "not supported"),
        ('<include file="/no/file.launch"/>', "/no/file"),
    ],
)
def test_mistakes_are_one_line_with_the_file(write, body, remedy):
    options = write(body)
    with pytest.raises(RosmonError, match=remedy) as error:
        load(options)
    assert options.file in str(error.value) and "\n" not in str(error.value)


def test_list_arguments_needs_no_values(write):
    options = write('<arg name="b"/><arg name="a" default="1"/><param name="p" value="$(arg b)"/>')
    assert list_arguments(options) == ["b", "a"]

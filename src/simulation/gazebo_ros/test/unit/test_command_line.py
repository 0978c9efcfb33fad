import pytest
from gazebo_ros.commands import command_line


def test_what_the_launch_file_passes():
    options = command_line.parse("-u -r --verbose -e ode --seed 7 --lockstep worlds/shapes.world".split())
    assert (options.pause, options.verbose, options.lockstep, options.seed) == (True, True, True, 7)
    assert options.world == "worlds/shapes.world"


def test_defaults():
    options = command_line.parse([])
    assert options.world == "worlds/empty.world" and not options.pause and options.seed is None and options.iters == 0
    assert command_line.remarks(options) == []


@pytest.mark.parametrize("value, waits", [("1", True), ("0", False), ("", False)])
def test_lock_step_can_be_asked_for_in_the_environment(monkeypatch, value, waits):
    monkeypatch.setenv("ODE_SIM_LOCKSTEP", value)
    assert command_line.parse([]).lockstep is waits


def test_only_the_first_world_counts_and_plugins_may_repeat():
    options = command_line.parse("a.world b.world -s liba.so -s libb.so --minimal_comms".split())
    assert options.world == "a.world" and options.server_plugin == ["liba.so", "libb.so"]


@pytest.mark.parametrize(
    "arguments, said", [("-e bullet", "bullet"), ("-e havok", "havok"), ("-r", "rosbag"), ("--warp", "--warp"), ("-p log", "log")]
)
def test_what_has_no_effect_is_said_once(arguments, said):
    options = command_line.parse(arguments.split())
    lines = command_line.remarks(options)
    assert len(lines) == 1 and said in lines[0]
    assert options.world == "worlds/empty.world"


def test_version_and_wrong_numbers_end(capsys):
    with pytest.raises(SystemExit) as end:
        command_line.parse(["--version"])
    assert end.value.code == 0 and "version" in capsys.readouterr().out
    with pytest.raises(SystemExit) as end:
        command_line.parse(["--iters", "many"])
    assert end.value.code == 2

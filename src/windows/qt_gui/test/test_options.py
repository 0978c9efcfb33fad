"""The command line, without a window."""

import pytest
from qt_gui.application.options import parse
from qt_gui.errors import UsageError


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["-f"], "--freeze-layout can only be used together with --lock-perspective"),
        (["--args", "a"], "--args can only be used together with --standalone"),
        (["-p", "a", "--perspective-file", "/b"], "only one of --perspective and --perspective-file"),
        (["--perspective-file", "/no/such"], "/no/such does not"),
        (["--command-pid", "3"], "--command-pid can only be used together"),
        (["--command-start-plugin", "a", "--command-switch-perspective", "b"], "only one --command-\\* option"),
        (["--list-plugins", "--command-start-plugin", "a"], "cannot be used together"),
        (["--list-plugins", "--list-perspectives"], "only one of --list-perspectives and --list-plugins"),
    ],
)
def test_options_that_cannot_be_obeyed(arguments, said):
    with pytest.raises(UsageError, match=said):
        parse("rqt", arguments)


@pytest.mark.parametrize("arguments", [["--standalone"], ["-s"], ["--no-such"], ["--command-pid", "x"]])
def test_what_argparse_refuses(arguments, capsys):
    with pytest.raises(SystemExit) as ended:
        parse("rqt", arguments)
    assert ended.value.code == 2 and "rqt: error:" in capsys.readouterr().err


def test_all_after_args_is_the_plugins():
    options = parse("rqt", ["-s", "x", "-v", "--args", "-s", "y", "--verbose", "--args"])
    assert options.plugin_args == ["-s", "y", "--verbose", "--args"] and options.standalone_plugin == "x"
    assert options.lock_perspective and options.verbose


def test_own_command_of_a_plugin_has_fewer_options_and_those_of_the_plugin(capsys):
    def add(parser):
        parser.add_argument("-P", "--pause", action="store_true")
        parser.add_argument("topics", nargs="*")

    options = parse("rqt_x", ["-ht", "--pause", "-t", "/a", "/b"], "rqt_x", add)
    assert options.plugin_args == ["--pause", "/a", "/b"] and options.hide_title and options.on_top
    with pytest.raises(SystemExit):
        parse("rqt_x", ["--lock-perspective"], "rqt_x", add)
    with pytest.raises(SystemExit) as ended:
        parse("rqt_x", ["--help"], "rqt_x", add)
    text = capsys.readouterr().out
    assert ended.value.code == 0 and "--pause" in text and "--clear-config" in text and "--list-plugins" not in text

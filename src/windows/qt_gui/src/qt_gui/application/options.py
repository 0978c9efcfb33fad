"""The command line of the window. Knows no Qt, so that a wrong option is answered at once."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable

from qt_gui.errors import UsageError


def _common(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    group = parser.add_argument_group("Options for GUI instance")
    group.add_argument("-b", "--qt-binding", metavar="BINDING", help="choose Qt bindings to be used [pyqt|pyside]")
    group.add_argument(
        "--clear-config", action="store_true", help="clear the configuration (including all perspectives and plugin settings)"
    )
    group.add_argument(
        "--force-discover", action="store_true", help="look for plugins anew, which every start does: nothing is cached here"
    )
    group.add_argument("-h", "--help", action="help", help="show this help message and exit")
    group.add_argument("-ht", "--hide-title", action="store_true", help="hide the title label, the icon, and the help button of docks")
    group.add_argument("--reload-import", action="store_true", help="reload every module that a plugin imports")
    group.add_argument("-t", "--on-top", action="store_true", help="set window mode to always on top")
    group.add_argument("-v", "--verbose", action="store_true", help="output debug messages, and tracebacks of plugins")
    return group


def _full(parser: argparse.ArgumentParser, group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "-f",
        "--freeze-layout",
        action="store_true",
        help="freeze the layout of the GUI (prevent rearranging widgets, disable undock/redock); needs -l",
    )
    group.add_argument(
        "-l",
        "--lock-perspective",
        action="store_true",
        help="lock the GUI to the used perspective (hide menu bar and close buttons of plugins)",
    )
    group.add_argument("-p", "--perspective", metavar="PERSPECTIVE", help="start with this named perspective")
    group.add_argument("--perspective-file", metavar="PERSPECTIVE_FILE", help="start with a perspective loaded from a file")
    group.add_argument(
        "-s",
        "--standalone",
        dest="standalone_plugin",
        metavar="PLUGIN",
        help="start only this plugin (implies -l); to pass arguments to it use --args",
    )
    group.add_argument(
        "--args",
        dest="plugin_args",
        nargs="*",
        default=[],
        help="all that follows is passed to the plugin (only with -s or --command-start-plugin)",
    )
    query = parser.add_argument_group("Options to query information without starting a GUI instance")
    query.add_argument("--list-perspectives", action="store_true", help="list available perspectives")
    query.add_argument("--list-plugins", action="store_true", help="list available plugins")
    command = parser.add_argument_group(
        "Options to operate on a running GUI instance", "They reach it over D-Bus, which a desktop session has."
    )
    command.add_argument("--command-pid", type=int, metavar="PID", help="pid of the GUI instance, defaults to the oldest one")
    command.add_argument("--command-start-plugin", metavar="PLUGIN", help="start plugin")
    command.add_argument("--command-switch-perspective", metavar="PERSPECTIVE", help="switch perspective")


def parse(
    program: str, arguments: list[str], standalone: str | None = None, plugin_arguments: Callable | None = None
) -> argparse.Namespace:
    """The options of one start.

    :param program: its name in messages
    :param arguments: without the program's name
    :param standalone: the plugin of a command of its own, say ``rqt_graph``; it has fewer options, and those of the plugin
    :param plugin_arguments: adds the plugin's options to a parser
    :raises UsageError: options which do not go together.
    :raises SystemExit: --help, or what argparse does not know.
    """
    own = argparse.ArgumentParser(program, add_help=False, formatter_class=argparse.RawDescriptionHelpFormatter)
    group = _common(own)
    if standalone is not None:
        whole = argparse.ArgumentParser(program, add_help=False)
        _common(whole)
        if plugin_arguments is not None:
            plugin_arguments(whole)
        whole.parse_args(arguments)  # --help and wrong options of either end here
        options, rest = own.parse_known_args(arguments)
        return argparse.Namespace(
            **{
                "freeze_layout": False,
                "lock_perspective": True,
                "perspective": None,
                "perspective_file": None,
                "standalone_plugin": standalone,
                "plugin_args": rest,
                "list_perspectives": False,
                "list_plugins": False,
                "command_pid": None,
                "command_start_plugin": None,
                "command_switch_perspective": None,
                **vars(options),
            }
        )
    _full(own, group)
    rest = []
    if "--args" in arguments:  # the plugin's own options begin with dashes, which argparse would take for ours
        at = arguments.index("--args")
        arguments, rest = arguments[:at], arguments[at + 1 :]
    options = own.parse_args(arguments)
    options.plugin_args = rest
    _check(options)
    options.lock_perspective = options.lock_perspective or options.standalone_plugin is not None
    return options


def _check(options: argparse.Namespace) -> None:
    if options.plugin_args and not options.standalone_plugin and not options.command_start_plugin:
        raise UsageError("option --args can only be used together with --standalone or --command-start-plugin")
    if options.freeze_layout and not options.lock_perspective:
        raise UsageError("option --freeze-layout can only be used together with --lock-perspective")
    if options.list_perspectives and options.list_plugins:
        raise UsageError("only one of --list-perspectives and --list-plugins can be used at a time")
    commands = [options.command_start_plugin, options.command_switch_perspective]
    if all(command is not None for command in commands):
        raise UsageError("only one --command-* option can be used at a time (beside --command-pid)")
    if options.command_pid is not None and commands == [None, None]:
        raise UsageError("option --command-pid can only be used together with another --command-* option")
    if (options.list_perspectives or options.list_plugins) and commands != [None, None]:
        raise UsageError("--list-* and --command-* options cannot be used together")
    if options.perspective is not None and options.perspective_file is not None:
        raise UsageError("only one of --perspective and --perspective-file can be used at a time")
    if options.perspective_file is not None and not os.path.isfile(options.perspective_file):
        raise UsageError(f"option --perspective-file must name a file that exists; {options.perspective_file} does not")

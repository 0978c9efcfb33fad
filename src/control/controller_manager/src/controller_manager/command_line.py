"""The commands ``controller_manager`` and ``controller_group``."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import node_signals
import rospy
from controller_manager_msgs.srv import ListControllers
from controller_manager_msgs.utils import describe_controller_managers
from node_signals.services import wait_for_service

from . import controller_manager_interface as manager

_USAGE = """Commands:
    load <name>                     load the controllers of these names
    unload <name>                   unload them
    start <name>                    start them
    stop <name>                     stop them
    spawn <name>                    load and start them
    kill <name>                     stop and unload them
    list                            the loaded controllers and their states
    list-types                      the controller types that can be loaded
    reload-libraries [--restore]    look for controller types again; with --restore load and start
                                    again what was there before"""

_ALIASES = {"lc": "list", "lt": "list-types", "sp": "spawn", "kl": "kill"}

#: command -> what is done to every name, one pass after the other
_PASSES = {
    "load": [manager.load_controller],
    "unload": [manager.unload_controller],
    "start": [manager.start_controller],
    "stop": [manager.stop_controller],
    "spawn": [manager.load_controller, manager.start_controller],
    "kill": [manager.stop_controller, manager.unload_controller],
}


def controller_manager_main(arguments: Sequence[str]) -> int:
    """:param arguments: without the program's name and without ROS remappings. :return: exit code."""
    if not arguments:
        print(_USAGE)
        return 0
    command, names = _ALIASES.get(arguments[0], arguments[0]), arguments[1:]
    if command not in _PASSES and command not in ("list", "list-types", "reload-libraries"):
        print(_USAGE)
        return 1
    node_signals.init_node("controller_manager", anonymous=True)
    try:
        if command == "list":
            manager.list_controllers()
        elif command == "list-types":
            manager.list_controller_types()
        elif command == "reload-libraries":
            manager.reload_libraries(True, restore="--restore" in names)
        else:
            for action in _PASSES[command]:
                for name in names:
                    action(name)
    except rospy.ROSInterruptException:
        return 0
    except rospy.ServiceException as error:
        rospy.logerr("the controller manager did not answer: %s", error)
    return 0


def _groups() -> dict[str, list[str]]:
    groups = rospy.get_param("controller_groups", {})
    if not isinstance(groups, dict) or not all(isinstance(members, list) for members in groups.values()):
        rospy.logerr("parameter %s must map each group to a list of controllers, it is %r", rospy.resolve_name("controller_groups"), groups)
        return {}
    return groups


def _members(group: str) -> list[str] | None:
    members = list(dict.fromkeys(_groups().get(group, [])))
    if not members:
        rospy.logerr(
            "There is no controller defined in group %s (parameter %s has: %s)",
            group,
            rospy.resolve_name("controller_groups"),
            ", ".join(sorted(_groups())) or "no groups",
        )
    return members or None


def _list_groups(_arguments: argparse.Namespace) -> None:
    groups = _groups()
    print(f"Number of groups: {len(groups)}")
    for group, members in sorted(groups.items()):
        print(f"  {group}")
        for member in members:
            print(f"      {member}")


def _spawn_group(arguments: argparse.Namespace) -> None:
    members = _members(arguments.group) or []
    for name in members:
        manager.load_controller(name)
    for name in members:
        manager.start_controller(name)


def _switch_group(arguments: argparse.Namespace) -> None:
    members = _members(arguments.group)
    if members is None:
        return
    service = rospy.resolve_name("controller_manager/list_controllers")
    try:
        wait_for_service(service, timeout=5.0)
    except rospy.ROSException:
        rospy.logerr("there is no service %s. %s", service, describe_controller_managers())
        return
    states = {controller.name: controller.state for controller in rospy.ServiceProxy(service, ListControllers).call().controller}
    for name, state in states.items():
        if state not in ("running", "stopped"):
            rospy.logerr("Unknown controller state %s (controller '%s')", state, name)
    others = dict.fromkeys(name for group in _groups().values() for name in group if name not in members)
    stop = [name for name in others if states.get(name) == "running"]
    for name in members:
        if name not in states and not manager.load_controller(name):
            print("Cancel group switching")
            return
    start = [name for name in members if states.get(name) != "running"]
    manager.start_stop_controllers(start_controllers=start, stop_controllers=stop)


def controller_group_main(arguments: Sequence[str]) -> int:
    """:param arguments: without the program's name and without ROS remappings. :return: exit code."""
    parser = argparse.ArgumentParser(
        prog="controller_group",
        description="Starts and switches groups of controllers, "
        "which the parameter controller_groups maps from a name to a list of controllers.",
    )
    commands = parser.add_subparsers(title="Commands", metavar="")
    commands.add_parser("list", help="list available groups").set_defaults(run=_list_groups)
    spawn = commands.add_parser("spawn", help="load and start the controllers of a group")
    spawn.add_argument("group", help="name of the group to start")
    spawn.set_defaults(run=_spawn_group)
    switch = commands.add_parser("switch", help="start a group and stop the controllers of all other groups")
    switch.add_argument("group", help="name of the group to switch to")
    switch.set_defaults(run=_switch_group)
    parsed = parser.parse_args(arguments)
    if "run" not in parsed:
        parser.print_usage()
        return 0
    try:
        parsed.run(parsed)
    except rospy.ServiceException as error:
        rospy.logerr("the controller manager did not answer: %s", error)
    return 0

"""Launch files through roslaunch's own loader, with rosmon's additions."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import roslaunch.config
import roslaunch.loader
import rospkg
from roslaunch.core import Node, RLException
from roslaunch.xmlloader import XmlLoader, XmlParseException

from rosmon_core import RosmonError
from rosmon_core.cli import Options, parse_memory, parse_number

_INHERITED = ("rosmon-stop-timeout", "rosmon-memory-limit", "rosmon-cpu-limit", "enable-coredumps")
_OF_NODE = ("rosmon-spawn-delay", "rosmon-restart-warn-threshold")
_OF_INCLUDE = ("rosmon-import-args",)
_OF_LAUNCH = ("rosmon-name", "rosmon-window-title", "rosmon-disable-ui")
_TRUE, _FALSE = ("true", "1"), ("false", "0")


@dataclass
class NodeSpec:
    """One node to run. Times in s, ``memory_limit`` in bytes, ``cpu_limit`` in cores."""

    node: Node
    show_stdout: bool
    stop_timeout: float
    memory_limit: int
    cpu_limit: float
    spawn_delay: float
    restart_warn_threshold: int
    coredumps: bool

    @property
    def full_name(self) -> str:
        return self.node.namespace + self.node.name


@dataclass
class LaunchFile:
    """A loaded launch file."""

    nodes: list[NodeSpec] = field(default_factory=list)
    params: dict[str, Any] = field(default_factory=dict)
    clear_params: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    attributes: dict[str, str] = field(default_factory=dict)


def _boolean(text: str, what: str) -> bool:
    if text.lower() not in _TRUE + _FALSE:
        raise XmlParseException(f"{what} is '{text}': write true or false")
    return text.lower() in _TRUE


class _Loader(XmlLoader):
    """roslaunch's loader that also reads rosmon's attributes and, as rosmon does, all args of a scope first."""

    ignore_unset_args = False

    def __init__(self, options: Options) -> None:
        super().__init__()
        self.specs: list[NodeSpec] = []
        self.attributes: dict[str, str] = {}
        self._options = options
        self._inherited: list[dict[str, str]] = [{}]
        self._scope: Any = None  # the LoaderContext of what was read last

    def _check_attrs(self, tag, context, ros_config, attrs):
        super()._check_attrs(tag, context, ros_config, [*attrs, *_INHERITED, *_OF_NODE, *_OF_INCLUDE])

    def _attributes_of(self, tag, context) -> dict[str, str]:
        """rosmon's attributes of ``tag`` and of everything around it, the innermost winning."""
        chain = []
        while tag is not None and tag.nodeType == tag.ELEMENT_NODE:
            chain.append(tag)
            tag = tag.parentNode
        found = dict(self._inherited[-1])
        for element in reversed(chain):
            names = _INHERITED + (_OF_NODE if element is chain[0] else ())
            found.update({name: self.resolve_args(element.getAttribute(name), context) for name in names if element.hasAttribute(name)})
        return found

    def _recurse_load(self, ros_config, tags, context, default_machine, is_core, verbose):
        elements = [t for t in tags if t.nodeType == t.ELEMENT_NODE]
        elements.sort(key=lambda t: t.tagName != "arg")
        elements = [t for t in elements if t.tagName not in ("machine", "test")]
        result = super()._recurse_load(ros_config, elements, context, default_machine, is_core, verbose)
        self._scope = context
        return result

    def _include_tag(self, tag, context, ros_config, default_machine, is_core, verbose):
        if (self.resolve_args(tag.getAttribute("clear_params"), context) or "false").lower() in _TRUE:
            raise XmlParseException(
                "<include> with clear_params is not supported by rosmon: clear the parameters with "
                '<rosparam command="delete" param="..."/> or clear_params of the node'
            )
        self._inherited.append(self._attributes_of(tag, context))
        try:
            result = super()._include_tag(tag, context, ros_config, default_machine, is_core, verbose)
        finally:
            self._inherited.pop()
        if self.resolve_args(tag.getAttribute("rosmon-import-args"), context).lower() in _TRUE:
            for name, value in self._scope.resolve_dict.get("arg", {}).items():
                context.resolve_dict.setdefault("arg", {}).setdefault(name, value)
        return result

    def _node_tag(self, tag, context, ros_config, default_machine, is_test=False, verbose=True):
        if tag.hasAttribute("machine"):
            tag.removeAttribute("machine")  # everything runs here
        node = super()._node_tag(tag, context, ros_config, None, is_test, verbose)
        if node is not None and not is_test:
            self.specs.append(self._spec(node, self._attributes_of(tag, context)))
        return node

    def _spec(self, node: Node, given: dict[str, str]) -> NodeSpec:
        options, what = self._options, f"node '{node.name}': "
        threshold = given.get("rosmon-restart-warn-threshold", "0")
        if not re.fullmatch(r"-?\d+", threshold):
            raise XmlParseException(f"{what}rosmon-restart-warn-threshold is '{threshold}': write a whole number")
        try:
            return NodeSpec(
                node,
                show_stdout=node.output == "screen" or (node.output is None and not options.obey_output),
                stop_timeout=parse_number(given.get("rosmon-stop-timeout", str(options.stop_timeout)), what + "rosmon-stop-timeout"),
                memory_limit=parse_memory(given.get("rosmon-memory-limit", str(options.memory_limit))),
                cpu_limit=parse_number(given.get("rosmon-cpu-limit", str(options.cpu_limit)), what + "rosmon-cpu-limit"),
                spawn_delay=parse_number(given.get("rosmon-spawn-delay", "0"), what + "rosmon-spawn-delay"),
                restart_warn_threshold=int(threshold),
                coredumps=_boolean(given.get("enable-coredumps", "true"), what + "enable-coredumps"),
            )
        except RosmonError as error:
            raise XmlParseException(str(error)) from None

    def _load_launch(self, launch, ros_config, is_core=False, filename=None, argv=None, verbose=True):
        super()._load_launch(launch, ros_config, is_core, filename, argv, verbose)
        self.attributes = {
            name: self.resolve_args(launch.getAttribute(name), self.root_context) for name in _OF_LAUNCH if launch.hasAttribute(name)
        }


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


_LOAD_ERRORS = (RLException, roslaunch.loader.LoadException, rospkg.ResourceNotFound, OSError, ValueError, KeyError)


def load(options: Options) -> LaunchFile:
    """Read ``options.file`` with ``options.arguments``. :raises RosmonError: it cannot be launched."""
    config, loader = roslaunch.config.ROSLaunchConfig(), _Loader(options)
    try:
        loader.load(options.file, config, argv=["rosmon", *options.arguments], verbose=False)
        disable_ui = _boolean(loader.attributes.get("rosmon-disable-ui", "false"), "rosmon-disable-ui")
    except rospkg.ResourceNotFound as error:
        raise RosmonError(f"{options.file}: package '{error.args[0]}' was not found: is it built and sourced?") from None
    except _LOAD_ERRORS as error:
        raise RosmonError(f"Could not load launch file {options.file}: {_one_line(error)}") from None
    options.disable_ui = options.disable_ui or disable_ui
    for index, spec in enumerate(spec for spec in loader.specs if spec.spawn_delay == 0.0):
        spec.spawn_delay = index * options.spawn_increment
    return LaunchFile(
        loader.specs,
        {key: param.value for key, param in config.params.items()},
        config.clear_params,
        [_one_line(p) for p in config.config_errors],
        loader.attributes,
    )


def list_arguments(options: Options) -> list[str]:
    """Names of the launch file's arguments. :raises RosmonError: it cannot be read."""
    loader = XmlLoader(resolve_anon=False, args_only=True)
    loader.ignore_unset_args = True
    try:
        loader.load(options.file, roslaunch.config.ROSLaunchConfig(), argv=["rosmon", *options.arguments], verbose=False)
    except _LOAD_ERRORS as error:
        raise RosmonError(f"Could not load launch file {options.file}: {_one_line(error)}") from None
    return list(loader.root_context.resolve_dict.get("arg_doc", {}))

"""Compiled controllers: classes in C++ that packages export for pluginlib."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence

import compiled_plugins
from controller_interface import ControllerBase, ControllerState, NodeHandle
from hardware_interface import InterfaceResources, RobotHW
from hardware_interface.compiled import twin
from plugin_loader import PluginClass, PluginError

from . import _compiled

_BASE = "controller_interface::ControllerBase"

#: in the order of C++
_STATES = (
    ControllerState.CONSTRUCTED,
    ControllerState.INITIALIZED,
    ControllerState.RUNNING,
    ControllerState.STOPPED,
    ControllerState.WAITING,
    ControllerState.ABORTED,
)


class CompiledController(ControllerBase):
    """A controller in C++. What it raises comes out as ``_compiled.Failed``, with its type in the text."""

    def __init__(self, core: _compiled.Controller):
        super().__init__()
        self._core = core
        self.update = core.update  # type: ignore[assignment]  # nothing between the loop and it

    def init_request(self, robot_hw: RobotHW, root_nh: NodeHandle, controller_nh: NodeHandle) -> tuple[InterfaceResources, ...]:
        controller_nh.own(self)
        self._robot = twin(robot_hw)
        claimed = self._core.init(self._robot.address, root_nh.namespace, controller_nh.namespace)
        self.state = ControllerState.INITIALIZED
        return tuple(InterfaceResources(interface, tuple(resources)) for interface, resources in claimed)

    def start_request(self, time: float) -> bool:
        return self._ask(self._core.start, time)

    def stop_request(self, time: float) -> bool:
        return self._ask(self._core.stop, time)

    def wait_request(self, time: float) -> bool:
        return self._ask(self._core.wait, time)

    def abort_request(self, time: float) -> bool:
        return self._ask(self._core.abort, time)

    def _ask(self, request: Callable[[float], bool], time: float) -> bool:
        done = request(time)
        self.state = _STATES[self._core.state]
        return done

    def stopping(self, time: float) -> None:
        self._core.brake(time)

    def fail(self) -> None:
        self.state = ControllerState.ABORTED
        self._core.state = _STATES.index(self.state)

    def stopped_itself(self, error: Exception) -> bool:
        if not isinstance(error, _compiled.Left):
            return False
        self.state = _STATES[self._core.state]
        return True

    @property
    def address(self) -> int:
        """Of the C++ object."""
        return self._core.address

    def shutdown(self) -> None:
        """Destroy it: its topics and services end."""
        self._core.destroy()


class CompiledTypes:
    """The compiled classes of plugin descriptions.

    :param descriptions: files.
    """

    def __init__(self, descriptions: Sequence[str]):
        #: moves the clock of compiled code, s; None: it has the clock of the system
        self.set_time: Callable[[float], None] | None = None
        if compiled_plugins.start_roscpp():
            self.set_time = compiled_plugins.set_time
        self._classes = _compiled.Classes(list(dict.fromkeys(descriptions)))

    def create(self, plugin: PluginClass, name: str) -> CompiledController:
        """An instance of the class that ``plugin`` describes, for the controller ``name``.

        :raises PluginError: its library is not there or cannot be loaded, or has no such controller.
        """
        what = f"'{plugin.name}' of package {plugin.package}"
        if plugin.base != _BASE:
            raise PluginError(f'{what} is no controller: {plugin.file} gives it base_class_type="{plugin.base}", a controller has {_BASE}')
        library = self._classes.library(plugin.name)
        if not library:
            folders = [os.path.join(prefix, "lib") for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":") if prefix]
            raise PluginError(
                f"{what}: its library {os.path.basename(plugin.path)}.so is not found in "
                f"{', '.join(folders) or 'CMAKE_PREFIX_PATH, which is not set'}; is the package built, and was its "
                "workspace sourced where this node was started?"
            )
        problem = compiled_plugins.why_not(library)
        if problem:
            raise PluginError(f"{what}: {problem}")
        try:
            label = f"controller '{name}' ({plugin.name}, {os.path.normpath(library)})"
            return CompiledController(self._classes.create(plugin.name, label))
        except _compiled.Failed as error:
            raise PluginError(f"{what}: {_explained(str(error), plugin, library)}") from error

    def take(self, pointer: int, plugin: PluginClass, name: str) -> CompiledController:
        """A controller that somebody else has made.

        :param pointer: address of a shared pointer to it, which is freed.
        :param plugin: its type, for messages.
        :param name: of the controller.
        """
        return CompiledController(_compiled.take(pointer, f"controller '{name}' ({plugin.name})"))

    def unload(self) -> None:
        """Unload the libraries; no instance may be left."""
        self._classes.unload()


def _explained(error: str, plugin: PluginClass, library: str) -> str:
    if error.startswith(("class_loader::CreateClassException", "pluginlib::CreateClassException")):
        return f"the library {library} exports no controller {plugin.type}: its source needs PLUGINLIB_EXPORT_CLASS({plugin.type}, {_BASE})"
    if error.startswith(("class_loader::", "pluginlib::")):
        return f"the library {library} cannot be loaded: {error.partition(': ')[2]}"
    return f"its constructor raised {error}"

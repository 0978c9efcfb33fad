"""The controller types that packages export, found when first needed."""

from __future__ import annotations

import difflib
import importlib
import sys
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

import rospy
from controller_interface import ControllerBase
from plugin_loader import PluginClass, PluginError, find_plugins

if TYPE_CHECKING:
    from .compiled import CompiledTypes


class ControllerTypes:
    """Classes exported for ``controller_interface``, Python's and compiled ones. Thread-safe.

    ``set_time`` moves the clock of compiled code, s; None where there is none, or where it has the clock of the system.
    """

    def __init__(self) -> None:
        self.set_time: Callable[[float], None] | None = None
        self._compiled: CompiledTypes | None = None
        self._loaders: list[tuple[str, Callable[[], list[str]], Callable[[str], int]]] = []
        self._makers: dict[str, Callable[[str], int]] = {}  # what makes those of loaders that were found
        self._lock = threading.Lock()
        self._known: dict[str, PluginClass] | None = None
        self._imported: set[str] = set()

    def _plugins(self) -> dict[str, PluginClass]:
        with self._lock:
            if self._known is None:
                self._known, problems = find_plugins("controller_interface")
                for problem in problems:
                    rospy.logwarn("controller types: %s", problem)
            return self._known

    def all(self) -> list[PluginClass]:
        """Types that can be loaded here, by name."""
        known = {name: PluginClass(name, name, base, "", "", "") for base, names, _ in self._loaders for name in names()}
        known.update(self._plugins())
        return [plugin for _, plugin in sorted(known.items())]

    def find(self, name: str) -> PluginClass | None:
        """The type ``name``, of a package or a loader, or None."""
        found = self._plugins().get(name)
        if found is not None:
            return found
        for base, names, create in self._loaders:
            if name in names():  # asked once for each controller, as upstream's manager does
                self._makers[name] = create
                return PluginClass(name, name, base, "", "", "")
        return None

    def add_loader(self, base: str, names: Callable[[], list[str]], create: Callable[[str], int]) -> None:
        """Take the types of a loader in C++ too.

        :param base: C++ name of the class that they derive from.
        :param names: gives the names of its types; asked again for each controller.
        :param create: makes one of the type that it is given, and gives the address of a shared pointer to it.
        """
        self._loaders.append((base, names, create))

    def suggestion(self, name: str) -> str:
        """', did you mean X?' of a type ``name`` that there is not, or ''."""
        close = difflib.get_close_matches(name, [plugin.name for plugin in self.all()], n=1, cutoff=0.75)
        return f" (did you mean '{close[0]}'?)" if close else ""

    def create(self, plugin: PluginClass) -> ControllerBase:
        """An instance of the class that ``plugin`` describes.

        :raises PluginError: it cannot be imported or is no controller.
        """
        controller = plugin.load()()
        self._imported.add(plugin.type.rpartition(".")[0])
        if not isinstance(controller, ControllerBase):
            raise PluginError(
                f"'{plugin.name}' of package {plugin.package} is no controller: {plugin.type} must "
                f"derive from controller_interface.Controller or MultiInterfaceController"
            )
        return controller

    def create_compiled(self, plugin: PluginClass, name: str) -> ControllerBase:
        """An instance of ``plugin``, a class in C++, for the controller ``name``.

        :raises PluginError: its library is not there or cannot be loaded, or has no such controller.
        """
        try:
            from .compiled import CompiledTypes  # brings roscpp along, which most robots do without
        except ModuleNotFoundError as error:
            raise PluginError(
                f"'{plugin.name}' of package {plugin.package} is compiled, and this installation of noetic_labs was "
                f"built without what compiled controllers need (no {error.name}): run scripts/setup there"
            ) from None
        plugins = self._plugins().values()
        with self._lock:
            if self._compiled is None:
                self._compiled = CompiledTypes([known.file for known in plugins if known.compiled])
                self.set_time = self._compiled.set_time
            compiled = self._compiled
        if not plugin.file:
            return compiled.take(self._makers[plugin.name](plugin.name), plugin, name)
        return compiled.create(plugin, name)

    def reload(self) -> None:
        """Forget what was found, and import the controllers' modules anew, so that edited files take effect."""
        with self._lock:
            self._known = None
            compiled, self._compiled = self._compiled, None
            if compiled is not None:
                compiled.unload()
            modules, self._imported = self._imported, set()
        for name in sorted(modules):
            try:
                importlib.reload(sys.modules[name])
            except Exception as error:  # the edited file may be broken in any way; the old module stays
                rospy.logerr("module %s cannot be reloaded: %s: %s", name, type(error).__name__, error)

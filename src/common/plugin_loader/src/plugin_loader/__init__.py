"""Python plugin classes found through package.xml exports.

A package that depends on ``base`` (the package that defines the plugin base class) declares ::

    <export><BASE plugin="${prefix}/plugins.xml"/></export>

and plugins.xml lists classes in pluginlib's format, with a Python class where pluginlib has a C++ one::

    <library path="src">
      <class name="my_pkg/MyPlugin" type="my_pkg.module.MyPlugin" base_class_type="...">
        <description>...</description></class>
    </library>

``path`` is relative to plugins.xml and is put on ``sys.path`` before the import.
A ``type`` with ``::``, or without a dot, is a compiled C++ class: it is listed, and loaded by those who can.
"""

from __future__ import annotations

import importlib
import os
import re
import sys
import threading
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Optional

import rospkg

_DEPEND_TAGS = {"depend", "run_depend", "exec_depend"}
#: Two robots of one simulator load plugins at the same time; Python lets one of them see a package half imported.
_importing = threading.RLock()


class PluginError(Exception):
    """A plugin cannot be loaded; one line saying which, why and what to do."""


@dataclass(frozen=True)
class PluginClass:
    """One exported class. ``name`` is what users write, ``type`` the Python path ``module.Class``."""

    name: str
    type: str
    base: str
    package: str
    file: str
    path: str
    description: str = ""

    @property
    def compiled(self) -> bool:
        return "::" in self.type or "." not in self.type  # of Python there is at least module.Class

    def load(self) -> Any:
        """Import and return the class.

        :raises PluginError: compiled class, module or class missing, or an exception while importing.
        """
        if self.compiled:
            raise PluginError(
                f"'{self.name}' of package {self.package} is a compiled C++ plugin ({self.type}); only Python plugins can be loaded here"
            )
        module_name, _, class_name = self.type.rpartition(".")
        try:
            with _importing:
                if self.path not in sys.path:
                    sys.path.append(self.path)
                return getattr(importlib.import_module(module_name), class_name)
        except Exception as error:  # a third party's module may raise anything; it must not take the host down
            raise PluginError(
                f"'{self.name}' of package {self.package} cannot be imported: {type(error).__name__}: {error} (declared in {self.file})"
            ) from error


def _exports(rospack: rospkg.RosPack, base: str, attribute: str) -> Iterator[tuple[str, str, str]]:
    """(package, package directory, exported value) of every package that depends on ``base``, sorted by name."""
    for package in sorted(rospack.list()):
        directory = rospack.get_path(package)
        try:
            root = ET.parse(os.path.join(directory, "package.xml")).getroot()
        except (OSError, ET.ParseError):
            continue
        if package != base and not any(c.tag in _DEPEND_TAGS and (c.text or "").strip() == base for c in root):
            continue
        for element in root.iterfind(f"export/{base}"):
            value = element.get(attribute)
            if value:
                yield package, directory, value.replace("${prefix}", directory)


def exported_values(base: str, attribute: str, rospack: rospkg.RosPack | None = None) -> list[str]:
    """Values of ``<export><base attribute="..."/>`` with ``${prefix}`` replaced by the package directory.

    As ``rospack plugins`` does, only packages that directly depend on ``base`` (and ``base`` itself) are read.
    """
    return [value for _, _, value in _exports(rospack or rospkg.RosPack(), base, attribute)]


def _plugin_description(file: str) -> ET.Element:
    """An element with all that the file holds: pluginlib takes several <library> elements without one around them."""
    with open(file, encoding="utf-8", errors="replace") as description:
        text = re.sub(r"<\?xml[^>]*\?>|<!DOCTYPE[^>]*>", "", description.read())
    return ET.fromstring(f"<file>{text}</file>")


def find_plugins(base: str, attribute: str = "plugin", rospack: rospkg.RosPack | None = None) -> tuple[dict[str, PluginClass], list[str]]:
    """All classes exported for ``base``: (name -> PluginClass, problems as lines). The first package wins a name.

    :param attribute: of the export that names the file of descriptions
    :param rospack: where packages are looked for; None: a new ``rospkg.RosPack``
    """
    found: dict[str, PluginClass] = {}
    problems: list[str] = []
    for package, _, file in _exports(rospack or rospkg.RosPack(), base, attribute):
        try:
            root = _plugin_description(file)
        except (OSError, ET.ParseError) as error:
            problems.append(f"package {package}: plugin description {file} cannot be read: {error}")
            continue
        for library in root.iter("library"):
            path = os.path.normpath(os.path.join(os.path.dirname(file), library.get("path", "src")))
            for entry in library.iterfind("class"):
                type_name = (entry.get("type") or "").strip()
                plugin = PluginClass(
                    name=(entry.get("name") or type_name).strip(),
                    type=type_name,
                    base=(entry.get("base_class_type") or "").strip(),
                    package=package,
                    file=file,
                    path=path,
                    description=(entry.findtext("description") or "").strip(),
                )
                found.setdefault(plugin.name, plugin)
    return found, problems

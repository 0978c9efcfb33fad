"""Plugins described by files which packages export: reading the files, importing the classes."""

import importlib
import inspect
import os
import sys
from typing import Any
from xml.etree import ElementTree

from python_qt_binding.QtCore import qWarning
from qt_gui.errors import PluginLoadError
from qt_gui.plugin_descriptor import PluginDescriptor
from qt_gui.plugin_provider import PluginProvider


class RosPluginProvider(PluginProvider):
    """Base of providers which know the description files; a derived class finds these.

    :param export_tag: in ``package.xml``: ``qt_gui`` or ``rqt_gui``
    :param base_class_type: only classes that are described with this base
    """

    def __init__(self, export_tag, base_class_type):
        super().__init__()
        self.setObjectName("RosPluginProvider")
        self._export_tag = export_tag
        self._base_class_type = base_class_type
        self._plugin_descriptors = {}

    def discover(self, discovery_data):
        for package, path in self._find_plugins(self._export_tag, discovery_data):
            for descriptor in self._read(package, path):
                self._plugin_descriptors.setdefault(descriptor.plugin_id(), descriptor)
        return list(self._plugin_descriptors.values())

    def _find_plugins(self, export_tag, discovery_data):
        """(package, description file) pairs."""
        raise NotImplementedError

    def load(self, plugin_id, plugin_context):
        """An instance of the class; a provider, which has no context, gets none if its constructor takes none."""
        attributes = self._plugin_descriptors[plugin_id].attributes()
        path = os.path.join(attributes["plugin_path"], attributes["library_path"])
        if path not in sys.path:
            sys.path.append(path)
        module = importlib.import_module(attributes["module_name"])
        cls = getattr(module, attributes["class_from_class_type"], None)
        if cls is None:
            raise PluginLoadError(
                f"module {attributes['module_name']} ({getattr(module, '__file__', '')}) has no class {attributes['class_from_class_type']}"
            )
        if plugin_context is None and _takes_nothing(cls):
            return cls()
        return cls(plugin_context)

    def _read(self, package, path):
        """The descriptors of the classes in one file that have this provider's base; what is wrong with it is a line."""
        root = _parse(package, path)
        if root is None:
            return
        for library in root.iter("library"):
            for element in library.iter("class"):
                if self._accepts(element.get("base_class_type")):
                    descriptor = self._descriptor(package, path, library, element)
                    if descriptor is not None:
                        yield descriptor

    def _accepts(self, base_class_type):
        return base_class_type == self._base_class_type

    def _descriptor(self, package, path, library, element):
        type_name = (element.get("type") or "").strip()
        module, _, cls = type_name.rpartition(".")
        if not module or "::" in type_name:
            qWarning(f"package {package}: {path}: class type '{type_name}' is not a Python class (module.Class); left out")
            return None
        name = element.get("name")
        plugin_id = f"{package}/{name}" if name else package
        attributes = {f"class_{key}": value for key, value in element.items()}
        attributes.update(
            package_name=package,
            plugin_path=os.path.dirname(path),
            package_path=self.package_path(package, path),
            library_path=library.get("path") or ".",
            plugin_id=plugin_id,
            module_name=module,
            class_from_class_type=cls,
            not_available="",
        )
        return describe_menu(PluginDescriptor(plugin_id, attributes), element)

    def package_path(self, package, path):
        """The folder of ``package``, whose description file is ``path``."""
        return os.path.dirname(path)


_parsed: dict[Any, Any] = {}  # (path, time) -> root, None for what is broken: several providers read the same file, one line is enough


def _parse(package, path):
    key: tuple[str, int | None]
    try:
        key = path, os.stat(path).st_mtime_ns
        if key not in _parsed:
            _parsed[key] = None
            _parsed[key] = ElementTree.parse(path).getroot()
    except OSError as error:
        key = path, None
        if key not in _parsed:
            _parsed[key] = None
            qWarning(f"package {package}: plugin description {path} cannot be read: {error.strerror}")
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        qWarning(f"package {package}: plugin description {path} is not XML: {error}")
    return _parsed[key]


def describe_menu(descriptor, element):
    """Give ``descriptor`` the menu entry and the groups that ``<qtgui>`` of a class, ``element``, names; returns it."""
    gui = element.find("qtgui")
    if gui is not None:
        action = _action(gui, descriptor.plugin_id().split("/")[-1])
        descriptor.set_action_attributes(action["label"], action["statustip"], action["icon"], action["icontype"])
        for group in gui.iter("group"):
            action = _action(group, "Others")
            descriptor.add_group_attributes(action["label"], action["statustip"], action["icon"], action["icontype"])
    return descriptor


def _action(element, label):
    icon = element.find("icon")
    return {
        "label": (element.findtext("label") or "").strip() or label,
        "statustip": " ".join((element.findtext("statustip") or "").split()) or None,
        "icon": ((icon.text or "").strip() or None) if icon is not None else None,
        "icontype": icon.get("type") if icon is not None else None,
    }


def _takes_nothing(cls):
    try:
        return not [
            p
            for p in inspect.signature(cls.__init__).parameters.values()
            if p.name != "self" and p.default is p.empty and p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)
        ]
    except (TypeError, ValueError):
        return False

"""Finds description files in the packages on ROS_PACKAGE_PATH.

Every start reads all manifests anew: two hundred take some ten milliseconds, and a plugin that was built a moment ago is there.
"""

import os
import re
import xml.etree.ElementTree as ET
from typing import Any

import rospkg
from python_qt_binding.QtCore import qWarning
from qt_gui.errors import PluginLoadError
from qt_gui.plugin_descriptor import PluginDescriptor

from rqt_gui.ros_plugin_provider import RosPluginProvider, describe_menu

_MANIFESTS = ("package.xml", "manifest.xml")
_WINDOWS = ("qt_gui", "rqt_gui")  # looked for together, at every start


class RospkgPluginProvider(RosPluginProvider):
    """See :class:`rqt_gui.ros_plugin_provider.RosPluginProvider`."""

    rospack = None  # a rospkg.RosPack that all providers share

    def __init__(self, export_tag, base_class_type):
        super().__init__(export_tag, base_class_type)
        self.setObjectName("RospkgPluginProvider")
        if RospkgPluginProvider.rospack is None:
            RospkgPluginProvider.rospack = rospkg.RosPack()

    def _find_plugins(self, export_tag, discovery_data):
        tags = _WINDOWS if export_tag in _WINDOWS else (export_tag,)
        return [(package, path) for package, tag, path in exports(RospkgPluginProvider.rospack, tags) if tag == export_tag]

    def package_path(self, package, path):
        return _known["paths"][package]


class CompiledPluginProvider(RospkgPluginProvider):
    """Plugins in C++: they are in the menu, greyed, and whoever asks for one by name is told why it does not start."""

    def __init__(self):
        super().__init__("rqt_gui", "rqt_gui_cpp::Plugin")

    def _find_plugins(self, export_tag, discovery_data):
        return super()._find_plugins("rqt_gui", None) + super()._find_plugins("qt_gui", None)

    def _accepts(self, base_class_type):
        return base_class_type in ("rqt_gui_cpp::Plugin", "qt_gui_cpp::Plugin")

    def _descriptor(self, package, path, library, element):
        name, kind = element.get("name") or package, element.get("type") or ""
        reason = f"'{name}' of package {package} is a compiled C++ plugin ({kind}); only Python plugins can be loaded here"
        return describe_menu(
            PluginDescriptor(
                name, {"package_name": package, "plugin_path": os.path.dirname(path), "class_type": kind, "not_available": reason}
            ),
            element,
        )

    def load(self, plugin_id, plugin_context):
        raise PluginLoadError(self._plugin_descriptors[plugin_id].attributes()["not_available"])


_known: dict[Any, Any] = {}  # of the last RosPack asked: several providers ask for the same


def exports(rospack, tags=_WINDOWS):
    """(package, tag, description file) of all exports of plugins under these ``tags``, in the order of the packages' names.

    :param rospack: the ``rospkg.RosPack`` to search; the answer is kept until another one is given
    """
    if _known.get("of") is not rospack:
        _known.clear()
        _known.update(of=rospack, paths=_packages(rospack))
    if tags not in _known:
        mentions = re.compile(rb"<\s*(" + "|".join(map(re.escape, tags)).encode() + rb")\b")
        _known[tags] = [
            entry for package, folder in sorted(_known["paths"].items()) for entry in _of_package(package, folder, tags, mentions)
        ]
    return _known[tags]


def _packages(rospack):
    """Name -> folder of all packages. One manifest that is not XML spoils rospkg's list; then those of its path are left out."""
    try:
        return {name: rospack.get_path(name) for name in rospack.list()}
    except (ET.ParseError, ValueError, LookupError):
        pass
    found = {}
    for path in reversed(rospack.ros_paths):
        for folder, below, files in os.walk(path):
            if "package.xml" in files:
                below.clear()
                try:
                    found[(ET.parse(os.path.join(folder, "package.xml")).findtext("name") or "").strip()] = folder
                except (OSError, ET.ParseError, ValueError, LookupError) as error:
                    qWarning(f"{folder}/package.xml is not XML, so that no ROS tool lists packages any more: {error}")
            elif "CATKIN_IGNORE" in files:
                below.clear()
    return found


def _of_package(package, folder, tags, mentions):
    for manifest in _MANIFESTS:
        path = os.path.join(folder, manifest)
        try:
            with open(path, "rb") as file:
                data = file.read()
        except FileNotFoundError:
            continue
        except OSError as error:
            qWarning(f"package {package}: {path} cannot be read: {error.strerror}")
            return
        if mentions.search(data):  # most packages do not, and parsing is what takes time
            root = ET.fromstring(data)
            for element in root.iterfind("export/*"):
                plugin = element.get("plugin")
                if element.tag in tags and plugin:
                    yield package, element.tag, plugin.replace("${prefix}", folder)
        return

"""Finds description files in the packages on ROS_PACKAGE_PATH.

Every start reads all manifests anew: two hundred take some ten milliseconds, and a plugin that was built a moment ago is there.
"""
import os
import re
import xml.etree.ElementTree as ET

import rospkg
from python_qt_binding.QtCore import qWarning

from rqt_gui.ros_plugin_provider import RosPluginProvider

_MANIFESTS = ("package.xml", "manifest.xml")
_MENTIONS = re.compile(rb"<\s*r?qt_gui\b")


class RospkgPluginProvider(RosPluginProvider):
    """See :class:`rqt_gui.ros_plugin_provider.RosPluginProvider`."""

    rospack = None  # a rospkg.RosPack that all providers share

    def __init__(self, export_tag, base_class_type):
        super().__init__(export_tag, base_class_type)
        self.setObjectName("RospkgPluginProvider")
        if RospkgPluginProvider.rospack is None:
            RospkgPluginProvider.rospack = rospkg.RosPack()

    def _find_plugins(self, export_tag, discovery_data):
        return [(package, path) for package, tag, path in exports(RospkgPluginProvider.rospack) if tag == export_tag]

    def package_path(self, package, path):
        return RospkgPluginProvider.rospack.get_path(package)


_known = {}  # RosPack -> its exports: several providers ask for the same


def exports(rospack):
    """(package, tag, description file) of all exports of plugins, in the order of the packages' names."""
    if _known.get("of") is not rospack:
        _known.update(of=rospack, exports=[entry for package in sorted(rospack.list())
                                           for entry in _of_package(package, rospack.get_path(package))])
    return _known["exports"]


def _of_package(package, folder):
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
        if _MENTIONS.search(data):  # most packages do not, and parsing is what takes time
            try:
                root = ET.fromstring(data)
            except (ET.ParseError, ValueError, LookupError) as error:
                qWarning(f"package {package}: {path} is not XML, its plugins are left out: {error}")
                return
            for element in root.iterfind("export/*"):
                if element.tag in ("qt_gui", "rqt_gui") and element.get("plugin"):
                    yield package, element.tag, element.get("plugin").replace("${prefix}", folder)
        return

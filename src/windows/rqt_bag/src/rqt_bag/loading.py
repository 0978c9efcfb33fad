"""Finds the plugins that packages export for rqt_bag."""
from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from typing import Dict, Iterator, List, Tuple

import rospkg
from python_qt_binding.QtCore import qWarning
from rqt_gui.ros_plugin_provider import RosPluginProvider

from rqt_bag.plugins.raw_view import RawView


class _Provider(RosPluginProvider):
    """Classes that packages export with the tag ``rqt_bag``."""

    def __init__(self):
        super().__init__("rqt_bag", "rqt_bag::Plugin")

    def _find_plugins(self, export_tag: str, discovery_data) -> Iterator[Tuple[str, str]]:
        rospack = rospkg.RosPack()
        for package in rospack.list():
            folder = rospack.get_path(package)
            try:
                with open(os.path.join(folder, "package.xml"), "rb") as file:
                    text = file.read()
                if b"<rqt_bag" in text:  # most packages have none, and parsing is what takes time
                    for export in ET.fromstring(text).iterfind(f"export/{export_tag}[@plugin]"):
                        yield package, export.get("plugin").replace("${prefix}", folder)
            except (OSError, ET.ParseError):
                continue  # other tools tell what is wrong with a manifest


def load_plugins() -> Tuple[Dict[str, List[type]], Dict[str, type]]:
    """Views and renderers of all plugins: type of message -> view classes, type -> renderer class.

    A plugin that cannot be loaded is told, and left out.
    """
    provider = _Provider()
    views: Dict[str, List[type]] = {}
    renderers: Dict[str, type] = {}
    for descriptor in provider.discover(None):
        name = descriptor.plugin_id()
        try:
            plugin = provider.load(name, None)
            if plugin is None:
                continue
            view = plugin.get_view_class()
            renderer = plugin.get_renderer_class() if hasattr(plugin, "get_renderer_class") else None
            kinds = plugin.get_message_types() if hasattr(plugin, "get_message_types") else []
        except Exception as error:  # plugins of others: whatever they raise must not take the window along
            qWarning(f"rqt_bag: plugin {name} is left out: {type(error).__name__}: {error}")
            continue
        if not kinds:
            qWarning(f"rqt_bag: plugin {name} names no message types")
        for kind in kinds:
            if view is not None:
                views.setdefault(kind, []).append(view)
            if renderer is not None:
                renderers[kind] = renderer
    return views, renderers


def views_of(views: Dict[str, List[type]], datatype: str) -> List[type]:
    """Classes that show messages of a type."""
    return [RawView] + views.get("*", []) + views.get(datatype, [])

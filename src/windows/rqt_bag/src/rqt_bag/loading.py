"""Finds the plugins that packages export for rqt_bag."""

from __future__ import annotations

from python_qt_binding.QtCore import qWarning
from rqt_gui.rospkg_plugin_provider import RospkgPluginProvider

from rqt_bag.plugins.raw_view import RawView


def load_plugins() -> tuple[dict[str, list[type]], dict[str, type]]:
    """Views and renderers of all plugins: type of message -> view classes, type -> renderer class.

    A plugin that cannot be loaded is told, and left out.
    """
    provider = RospkgPluginProvider("rqt_bag", "rqt_bag::Plugin")
    views: dict[str, list[type]] = {}
    renderers: dict[str, type] = {}
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


def views_of(views: dict[str, list[type]], datatype: str) -> list[type]:
    """Classes that show messages of the type ``datatype``, among ``views``: type, or ``*`` for any, -> classes."""
    return [RawView] + views.get("*", []) + views.get(datatype, [])

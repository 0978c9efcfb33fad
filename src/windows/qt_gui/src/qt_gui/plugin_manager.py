"""Which plugins there are and which run; loads, unloads, reloads, and restores those of a perspective."""

from typing import Any

from python_qt_binding.QtCore import QObject, Qt, Signal, qCritical, qWarning

from qt_gui.application.reporting import describe
from qt_gui.errors import PluginLoadError
from qt_gui.plugin_descriptor import PluginDescriptor
from qt_gui.plugin_handler import ContainerHandler, PluginHandler
from qt_gui.plugin_instance_id import PluginInstanceId
from qt_gui.reload_importer import ReloadImporter

#: Names under which perspectives have plugins that are called otherwise here: pluginlib's names of compiled ones have no package, and two
#: of this platform's had names of their own once.
OTHER_NAMES = {
    "MultiplotPlugin": "rqt_multiplot/MultiplotPlugin",
    "rosmon": "rqt_rosmon/rosmon",
    "rqt_rosmon/ROSMon": "rqt_rosmon/rosmon",
    "rqt_topic/Topic": "rqt_topic/TopicPlugin",
}
CONTAINER = "__DockWidgetContainer"  # the id under which containers are stored among the plugins


class PluginManager(QObject):
    """The life of all plugins of one window."""

    plugins_about_to_change_signal = Signal()
    plugins_changed_signal = Signal()
    plugin_help_signal = Signal(object)  # PluginDescriptor
    close_window_signal = Signal()
    _reload_later = Signal(str)
    _unload_later = Signal(str)

    def __init__(self, provider, options):
        super().__init__()
        self._provider = provider
        self._options = options
        self._importer = ReloadImporter(everything=options.reload_import)
        self._window = None
        self._menu = None
        self._descriptors: dict[str, Any] = {}  # by plugin id; empty before discover()
        self._running = {}  # str(instance id) -> PluginHandler, in order of loading
        self._absent = {}  # plugins of the perspective that nobody has here: id -> serial numbers, kept for when they are back
        self._global_settings: Any = None  # Settings, from the first restoring on
        self._perspective_settings: Any = None
        queued = Qt.ConnectionType.QueuedConnection  # a plugin must not be deleted while one of its own slots runs
        self._reload_later.connect(self._reload, queued)
        self._unload_later.connect(self._unload_by_user, queued)

    def set_window(self, window, menu=None):
        """:param menu: a :class:`qt_gui.plugin_menu.PluginMenu`, or None in a locked window"""
        self._window = window
        self._menu = menu
        if menu is not None:
            menu.load_plugin_signal.connect(self.load_plugin)
            menu.unload_plugin_signal.connect(self._unload_later)

    def discover(self):
        """Find all plugins, once."""
        if self._descriptors:
            return
        self._descriptors = {d.plugin_id(): d for d in self._provider.discover(None)}
        container = PluginDescriptor(CONTAINER, {"class_type": CONTAINER})
        container.set_action_attributes("Container", "Container for other dock widgets", "folder-new", "theme")
        if self._menu is not None:
            self._menu.add_prefix(container)
            for descriptor in self._descriptors.values():
                if descriptor.action_attributes().get("label"):
                    self._menu.add_plugin(descriptor)
        self._descriptors[CONTAINER] = container

    def get_plugins(self):
        """Id -> class path of each plugin that can run."""
        return self._class_paths(lambda descriptor: not descriptor.attributes().get("not_available"))

    def _class_paths(self, wanted):
        self.discover()
        return {
            i: "/".join(d.attributes().get("class_type", "unknown").split("::"))
            for i, d in self._descriptors.items()
            if i != CONTAINER and wanted(d)
        }

    def find_plugins_by_name(self, name):
        """Those of :meth:`get_plugins` whose id or class path contains ``name``, in upper or lower case. An id, package or
        class path that is ``name`` exactly stands alone."""
        return _fitting(self.get_plugins(), name)

    def reason_against(self, name):
        """Why the plugin that ``name`` fits cannot run, or None when it fits none of these."""
        fitting = _fitting(self._class_paths(lambda descriptor: descriptor.attributes().get("not_available")), name)
        return next((self._descriptors[i].attributes()["not_available"] for i in sorted(fitting)), None)

    def get_plugin_descriptor(self, plugin_id):
        self.discover()
        return self._descriptors.get(plugin_id) or self._descriptors.get(OTHER_NAMES.get(plugin_id, ""))

    def running(self):
        """The handlers of all running plugins, in order of loading."""
        return list(self._running.values())

    def handler(self, instance_id):
        return self._running.get(str(instance_id))

    # loading

    def load_plugin(self, plugin_id, serial_number=None, argv=None):
        """Start the plugin ``plugin_id``; its errors are reported. True when it runs.

        :param serial_number: of the instance; None: the lowest from 1 that is free
        :param argv: its arguments, a list of strings
        """
        self.plugins_about_to_change_signal.emit()
        if serial_number is None:
            used = {h.instance_id().serial_number for h in self._running.values() if h.instance_id().plugin_id == plugin_id}
            serial_number = next(n for n in range(1, len(used) + 2) if n not in used)
        handler = self._start(PluginInstanceId(plugin_id, serial_number), argv)
        if handler is not None:
            self._restore(handler)
            self.plugins_changed_signal.emit()
        return handler is not None

    def _start(self, instance_id, argv=None):
        """The handler of a new running instance, or None after a report."""
        descriptor = self.get_plugin_descriptor(instance_id.plugin_id)
        if descriptor is None:
            qWarning(
                f"could not load plugin '{instance_id.plugin_id}': {self._why_absent(instance_id.plugin_id)}; rqt --list-plugins "
                "shows those that there are"
            )
            return None
        kind = ContainerHandler if instance_id.plugin_id == CONTAINER else PluginHandler
        handler = kind(self._window, descriptor, instance_id, argv)
        try:
            handler.load(self._provider)
        except PluginLoadError as error:
            qWarning(f"could not load plugin '{instance_id.plugin_id}': {error}")
        except Exception as error:  # a third party's constructor may raise anything
            qCritical(f"could not load plugin '{instance_id.plugin_id}': {describe(error)}")
        except SystemExit as error:  # argparse of a plugin that does not like its arguments
            qCritical(f"could not load plugin '{instance_id.plugin_id}': it ended itself with {error.code}")
        else:
            self._importer.note(descriptor)
            self._running[str(instance_id)] = handler
            handler.close_signal.connect(self._unload_later)
            handler.reload_signal.connect(self._reload_later)
            handler.help_signal.connect(self._help)
            if self._menu is not None:
                self._menu.add_instance(descriptor, instance_id)
                handler.label_updated.connect(self._menu.update_instance_label)
                for dock in handler.docks():
                    self._menu.update_instance_label(instance_id, dock.windowTitle())
            return handler
        handler.deleteLater()
        return None

    def _why_absent(self, plugin_id):
        """What is known of a plugin that nobody has: its package is not here, or has others."""
        from node_signals.absent import explanation  # where everything is there it would take its time for nothing

        package = plugin_id.split("/")[0]
        others = sorted(i for i in self._descriptors if i.split("/")[0] == package)
        if others:
            return f"the package {package} has no such plugin, but {', '.join(others)}"
        return f"no package of this workspace has it. {explanation(package).rstrip('.')}"

    def _help(self, instance_id):
        self.plugin_help_signal.emit(self.get_plugin_descriptor(PluginInstanceId(instance_id=instance_id).plugin_id))

    # ending

    def unload_plugin(self, instance_id):
        """Save the settings of a running plugin and end it."""
        handler = self._running.get(str(instance_id))
        if handler is not None:
            self.plugins_about_to_change_signal.emit()
            self._save(handler)
            self._end(handler)

    def _unload_by_user(self, instance_id):
        if self._options.lock_perspective:
            self.close_window_signal.emit()  # nothing else could be opened in its place
        else:
            self.unload_plugin(instance_id)

    def _end(self, handler):
        self._running.pop(str(handler.instance_id()), None)
        if self._menu is not None:
            self._menu.remove_instance(handler.instance_id())
        handler.unload(self._provider)
        handler.deleteLater()

    def _reload(self, instance_id):
        handler = self._running.get(instance_id)
        if handler is None:
            return
        self.plugins_about_to_change_signal.emit()
        self._save(handler)
        self._end(handler)
        self._importer.forget(self.get_plugin_descriptor(handler.instance_id().plugin_id))
        handler = self._start(handler.instance_id(), handler.argv())
        if handler is not None:
            self._restore(handler)
        self.plugins_changed_signal.emit()

    def shutdown(self):
        """End all plugins, the last first, and the providers."""
        for handler in reversed(self.running()):
            self._end(handler)
        self._provider.shutdown()

    # settings

    def _save(self, handler):
        if self._perspective_settings is not None:
            handler.save_settings(*self._settings_of(handler))

    def _restore(self, handler):
        if self._perspective_settings is not None:
            handler.restore_settings(*self._settings_of(handler))

    def _settings_of(self, handler):
        name = handler.instance_id()
        return (
            self._global_settings.get_settings("plugin__" + name.tidy_plugin_str()),
            self._perspective_settings.get_settings("plugin__" + name.tidy_str()),
        )

    def save_settings(self, global_settings, perspective_settings):
        """Store which plugins run, and what each of them wants to keep.

        :param global_settings: of the window, for what all perspectives share
        :param perspective_settings: of the perspective in use
        """
        self._use(global_settings, perspective_settings)
        plugins = {plugin_id: list(numbers) for plugin_id, numbers in self._absent.items()}
        for handler in self._running.values():
            name = handler.instance_id()
            plugins.setdefault(name.plugin_id, []).append(name.serial_number)
        self._perspective_settings.set_value("running-plugins", plugins)
        for handler in self.running():
            self._save(handler)

    def restore_settings(self, global_settings, perspective_settings):
        """Run the plugins of a perspective and no others.

        :param global_settings: of the window, for what all perspectives share
        :param perspective_settings: of the perspective that is wanted
        """
        self._use(global_settings, perspective_settings)
        wanted = self._wanted()
        for name, handler in list(self._running.items()):
            if name not in wanted:
                self._end(handler)
        self._absent = {}
        for name, instance_id in wanted.items():
            if self.get_plugin_descriptor(instance_id.plugin_id) is None:
                self._absent.setdefault(instance_id.plugin_id, []).append(instance_id.serial_number)
            if name not in self._running:
                self._start(instance_id)
        self.restore_settings_without_plugins(global_settings, perspective_settings)

    def restore_settings_without_plugins(self, global_settings, perspective_settings):
        """Give the running plugins their settings, of ``global_settings`` and ``perspective_settings``."""
        self._use(global_settings, perspective_settings)
        for handler in self.running():
            self._restore(handler)
        self.plugins_changed_signal.emit()

    def _use(self, global_settings, perspective_settings):
        self._global_settings = global_settings.get_settings("pluginmanager")
        self._perspective_settings = perspective_settings.get_settings("pluginmanager")

    def _wanted(self):
        """str(instance id) -> instance id of the stored plugins, containers first; what is malformed is left out."""
        stored = self._perspective_settings.value("running-plugins", {})
        if not isinstance(stored, dict):
            qWarning("the perspective's list of running plugins cannot be read; it starts empty")
            return {}
        wanted = {}
        for plugin_id, numbers in sorted(stored.items(), key=lambda item: item[0] != CONTAINER):
            for number in numbers if isinstance(numbers, (list, tuple)) else [numbers]:
                try:
                    instance_id = PluginInstanceId(plugin_id, number)
                except (TypeError, ValueError):
                    qWarning(f"the perspective's instance {number!r} of plugin '{plugin_id}' is not a number; left out")
                    continue
                wanted[str(instance_id)] = instance_id
        return wanted


def _fitting(plugins, name):
    name = name.lower()
    found = {i: path for i, path in plugins.items() if name in i.lower() or name in path.lower()}
    exact = {i: path for i, path in found.items() if name in (i.lower(), path.lower(), i.split("/")[0].lower())}
    return exact if len(exact) == 1 else found

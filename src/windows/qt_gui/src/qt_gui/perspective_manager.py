"""Perspectives: named sets of plugins, places and settings."""

import os
from typing import Any

from python_qt_binding.QtCore import QObject, Signal, qCritical
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QFileDialog, QInputDialog, QMessageBox

from qt_gui.application import perspective_file
from qt_gui.application.compatibility import QAction
from qt_gui.application.perspective_dialog import ask_new_name
from qt_gui.errors import PerspectiveError
from qt_gui.menu_manager import MenuManager
from qt_gui.settings import Settings
from qt_gui.settings_proxy import SettingsProxy

HIDDEN = "@"  # perspectives whose name starts so are in no menu: those of plugins alone in their window, and of files
SUFFIX = ".perspective"


class PerspectiveManager(QObject):
    """Switches between perspectives, each stored in the group ``perspective/NAME`` of the settings."""

    perspective_changed_signal = Signal(str)
    save_settings_signal = Signal(object, object)  # global Settings, those of the perspective
    restore_settings_signal = Signal(object, object)
    restore_settings_without_plugin_changes_signal = Signal(object, object)

    HIDDEN_PREFIX = HIDDEN

    def __init__(self, qsettings):
        super().__init__()
        self._proxy = SettingsProxy(qsettings)
        self._global_settings = Settings(self._proxy, "global")
        self._perspective_settings = None
        self._current: str | None = None
        self._menu: Any = None  # a MenuManager, in a window that has one
        self._folder = os.getcwd()
        names = self._proxy.value("", "perspectives", [])
        names = [names] if isinstance(names, str) else names or []
        self.perspectives = list(dict.fromkeys(str(name) for name in names))

    def current(self):
        return self._current

    # the menu

    def set_menu(self, menu):
        self._menu = MenuManager(menu)
        self._add_command("&Create perspective...", "list-add", self._on_create)
        self._remove_action = self._add_command("&Remove perspective...", "list-remove", self._on_remove)
        self._menu.add_suffix(None)
        self._add_command("&Import...", "document-open", self._on_import)
        self._add_command("&Export...", "document-save-as", self._on_export)
        for name in self.perspectives:
            self._add_action(name)
        self._update_menu()

    def _add_command(self, text, icon, slot):
        action = QAction(QIcon.fromTheme(icon), text, self._menu.menu)
        action.triggered.connect(lambda checked=False: slot())
        self._menu.add_suffix(action)
        return action

    def _add_action(self, name):
        if self._menu is not None and not name.startswith(HIDDEN):
            action = QAction(name, self._menu.menu)
            action.setCheckable(True)
            action.triggered.connect(lambda checked=False: self.switch_perspective(name))
            self._menu.add_item(action)

    def _update_menu(self):
        if self._menu is not None:
            for name in self.perspectives:
                action = self._menu.item(name)
                if action is not None:
                    action.setChecked(name == self._current)
                    action.setEnabled(name != self._current)
            self._remove_action.setEnabled(bool(self._removable()))

    def _removable(self):
        return [name for name in self.perspectives if name != self._current and not name.startswith(HIDDEN)]

    # switching

    def set_perspective(self, name, hide_and_without_plugin_changes=False):
        """The first perspective of a window: the one called ``name``, or the last one used if that is None.

        :param hide_and_without_plugin_changes: the hidden one of a plugin alone, ``name``; no plugin is started or ended
        """
        if name is None:
            name = str(self._proxy.value("", "current-perspective", "Default") or "Default")
        elif hide_and_without_plugin_changes:
            name = HIDDEN + name
        self.switch_perspective(name, save_before=False, without_plugin_changes=hide_and_without_plugin_changes)

    def switch_perspective(self, name, save_before=True, without_plugin_changes=False):
        """Go over to the perspective ``name``, which is made when there is none of that name.

        :param save_before: store the one in use first
        :param without_plugin_changes: the plugins that run get their settings, none is started or ended
        """
        name = name.replace("/", "__")
        if save_before:
            self.save()
        if name not in self.perspectives:
            self._create(name)
        self._current = name
        if not name.startswith(HIDDEN):
            self._proxy.set_value("", "current-perspective", name)
        self._perspective_settings = self._settings_of(name)
        self._update_menu()
        self.perspective_changed_signal.emit(name.lstrip(HIDDEN))
        restore = self.restore_settings_without_plugin_changes_signal if without_plugin_changes else self.restore_settings_signal
        restore.emit(self._global_settings, self._perspective_settings)

    def save(self):
        """Store the present state of the window in the perspective in use."""
        if self._perspective_settings is not None:
            self.save_settings_signal.emit(self._global_settings, self._perspective_settings)

    def _settings_of(self, name):
        return Settings(self._proxy, f"perspective/{name}")

    def _create(self, name):
        self.perspectives.append(name)
        self._proxy.set_value("", "perspectives", self.perspectives)
        self._add_action(name)

    def create_perspective(self, name, clone=True):
        """Make the perspective ``name`` and go over to it.

        :param clone: it starts as a copy of the one in use, and nothing on the screen changes
        """
        name = name.replace("/", "__")
        self.save()
        if clone and self._perspective_settings is not None:
            copy = self._settings_of(name)
            for key in self._perspective_settings.all_keys():
                copy.set_value(key, self._perspective_settings.value(key))
        self._create(name)
        self.switch_perspective(name, save_before=False)

    def remove_perspective(self, name):
        """Forget a perspective, not the one in use."""
        if name not in self.perspectives or name == self._current:
            return
        self.perspectives.remove(name)
        self._proxy.set_value("", "perspectives", self.perspectives)
        self._settings_of(name).remove("")
        if self._menu is not None:
            self._menu.remove_item(name)
        self._update_menu()

    # files

    def import_perspective_from_file(self, path, name):
        """Go over to the perspective in the file ``path``, stored under ``name`` and replacing what had that name.

        :raises PerspectiveError: the file is of no use; nothing has changed then.
        """
        data = perspective_file.read(path)
        self._folder = os.path.dirname(os.path.abspath(path))
        name = name.replace("/", "__")
        self.save()
        if name == self._current:
            self._perspective_settings = None
        settings = self._settings_of(name)
        settings.remove("")
        _store(settings, data)
        self.switch_perspective(name, save_before=False)

    def export_perspective_to_file(self, path):
        """Write the perspective in use into a file.

        :raises PerspectiveError: the file cannot be written.
        """
        self.save()
        perspective_file.write(path, _load(self._perspective_settings))

    # what the menu does

    def _parent(self):
        return self._menu.menu.window()

    def _on_create(self):
        name, clone = ask_new_name(self._parent(), self.perspectives)
        if name:
            self.create_perspective(name, clone)

    def _on_remove(self):
        name, accepted = QInputDialog.getItem(self._parent(), "Remove perspective", "Select the perspective", self._removable(), 0, False)
        if accepted:
            self.remove_perspective(str(name))

    def _on_import(self):
        path, _ = QFileDialog.getOpenFileName(self._parent(), "Import perspective from file", self._folder, f"Perspectives (*{SUFFIX})")
        if not path:
            return
        name = os.path.basename(path)
        name = name[: -len(SUFFIX)] if name.endswith(SUFFIX) else name
        if name in self.perspectives:
            name, _ = ask_new_name(self._parent(), self.perspectives, cloning=False)
        if name:
            self._try(self.import_perspective_from_file, path, name)

    def _on_export(self):
        proposal = os.path.join(self._folder, (self._current or "").lstrip(HIDDEN) + SUFFIX)
        path, _ = QFileDialog.getSaveFileName(self._parent(), "Export perspective to file", proposal, f"Perspectives (*{SUFFIX})")
        if path:
            self._folder = os.path.dirname(path)
            self._try(self.export_perspective_to_file, path)

    def _try(self, function, *arguments):
        try:
            function(*arguments)
        except PerspectiveError as error:
            qCritical(str(error))
            QMessageBox.warning(self._parent(), "Perspective", str(error))


def _store(settings, data):
    for key, value in data["keys"].items():
        settings.set_value(key, value)
    for name, group in data["groups"].items():
        _store(settings.get_settings(name), group)


def _load(settings):
    return {
        "keys": {str(key): settings.value(key) for key in settings.child_keys()},
        "groups": {str(name): _load(settings.get_settings(name)) for name in settings.child_groups()},
    }

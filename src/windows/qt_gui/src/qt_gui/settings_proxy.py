"""A QSettings that several threads may use, addressed by group and key."""

import contextlib
import threading

from python_qt_binding.QtCore import QObject, qWarning


class SettingsProxy(QObject):
    """Serialises access to one ``QSettings``."""

    def __init__(self, qsettings):
        super().__init__()
        self.setObjectName("SettingsProxy")
        self._qsettings = qsettings
        self._lock = threading.RLock()

    @contextlib.contextmanager
    def _within(self, group):
        with self._lock:
            self._qsettings.beginGroup(group)
            try:
                yield self._qsettings
            finally:
                self._qsettings.endGroup()

    def all_keys(self, group):
        with self._within(group) as settings:
            return settings.allKeys()

    def child_groups(self, group):
        with self._within(group) as settings:
            return settings.childGroups()

    def child_keys(self, group):
        with self._within(group) as settings:
            return settings.childKeys()

    def contains(self, group, key):
        with self._within(group) as settings:
            return settings.contains(key)

    def remove(self, group, key):
        with self._within(group) as settings:
            settings.remove(key)

    def set_value(self, group, key, value):
        with self._within(group) as settings:
            settings.setValue(key, value)

    def value(self, group, key, default_value=None):
        """The stored value, or the default when there is none or the file holds something unreadable."""
        with self._within(group) as settings:
            try:
                return settings.value(key, default_value)
            except (TypeError, SystemError, ValueError) as error:  # bytes of another Python object, cut off or not importable
                qWarning(f"settings: {group}/{key} of {settings.fileName()} cannot be read ({error}); its default is used")
                return default_value

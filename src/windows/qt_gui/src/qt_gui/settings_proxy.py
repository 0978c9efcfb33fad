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
        """Whether ``group`` has a value under ``key``."""
        with self._within(group) as settings:
            return settings.contains(key)

    def remove(self, group, key):
        """Forget ``key`` of ``group`` and what is below it; all of the group for an empty key."""
        with self._within(group) as settings:
            settings.remove(key)

    def set_value(self, group, key, value):
        """Store ``value`` under ``key`` of ``group``."""
        with self._within(group) as settings:
            settings.setValue(key, value)

    def value(self, group, key, default_value=None):
        """The value stored under ``key`` of ``group``, or ``default_value`` when there is none or the file holds something unreadable."""
        with self._within(group) as settings:
            try:
                return settings.value(key, default_value)
            except (TypeError, SystemError, ValueError) as error:  # bytes of another Python object, cut off or not importable
                qWarning(f"settings: {group}/{key} of {settings.fileName()} cannot be read ({error}); its default is used")
                return default_value

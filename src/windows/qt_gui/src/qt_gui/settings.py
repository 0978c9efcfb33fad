"""Settings as plugins see them: keys and values within a group."""

from python_qt_binding.QtCore import QObject

_NONE = "__NoneType__"  # how None is written into a file that has no word for it


class Settings(QObject):
    """Keys and values of one group of a :class:`qt_gui.settings_proxy.SettingsProxy`.

    A value that was read from the file may be a string though a number or a boolean was stored.
    """

    def __init__(self, settings_proxy, group):
        super().__init__()
        self.setObjectName("Settings")
        self._settings_proxy = settings_proxy
        self._group = group

    def get_settings(self, prefix):
        """The group ``prefix`` within this one."""
        return Settings(self._settings_proxy, f"{self._group}/{prefix}" if self._group else prefix)

    def all_keys(self):
        """All keys here and in the groups within, as ``group/key``."""
        return self._settings_proxy.all_keys(self._group)

    def child_groups(self):
        return self._settings_proxy.child_groups(self._group)

    def child_keys(self):
        return self._settings_proxy.child_keys(self._group)

    def contains(self, key):
        return self._settings_proxy.contains(self._group, key)

    def remove(self, key):
        """Remove ``key``, or the group of that name; an empty ``key`` removes everything here."""
        self._settings_proxy.remove(self._group, key)

    def set_value(self, key, value):
        """Store ``value`` under ``key`` of this group; None is kept as None."""
        self._settings_proxy.set_value(self._group, key, _NONE if value is None else value)

    def value(self, key, default_value=None):
        """What is stored under ``key`` of this group, or ``default_value`` when there is nothing."""
        value = self._settings_proxy.value(self._group, key, default_value)
        return None if isinstance(value, str) and value == _NONE else value

"""What is known of a plugin before it runs."""


class PluginDescriptor:
    """Id, attributes and place in the menu of one plugin.

    ``attributes``: ``package_name``, ``plugin_path`` (folder of its description), ``library_path``, ``class_type``,
    ``module_name``, ``class_from_class_type``, and ``not_available`` (a reason, empty when it can run).
    """

    def __init__(self, plugin_id, attributes=None):
        self._plugin_id = plugin_id
        self._attributes = attributes or {}
        self._action = {}
        self._groups = []

    def plugin_id(self):
        return self._plugin_id

    def attributes(self):
        return self._attributes

    def action_attributes(self):
        """``label``, ``statustip``, ``icon``, ``icontype`` of its menu entry; empty for what is not in the menu."""
        return self._action

    def set_action_attributes(self, label, statustip=None, icon=None, icontype=None):
        """Say what its menu entry is like.

        :param statustip: one line about it, or None
        :param icon: name of a theme's icon or path of a file, as ``icontype`` says; None: no icon
        :param label: of the entry
        :param icontype: as :func:`qt_gui.icon_loader.get_icon` takes it
        """
        self._action = {"label": label, "statustip": statustip, "icon": icon, "icontype": icontype}

    def groups(self):
        """The submenus that lead to it, outermost first, each with the keys of :meth:`action_attributes`."""
        return self._groups

    def add_group_attributes(self, label, statustip=None, icon=None, icontype=None):
        """A submenu that its menu entry is in, below those added before.

        The parameters ``label``, ``statustip``, ``icon`` and ``icontype`` are those of :meth:`set_action_attributes`, for the submenu.
        """
        self._groups.append({"label": label, "statustip": statustip, "icon": icon, "icontype": icontype})

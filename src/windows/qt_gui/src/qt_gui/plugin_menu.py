"""The menus Plugins (what there is) and Running (what runs)."""

from python_qt_binding.QtCore import QObject, Signal
from python_qt_binding.QtWidgets import QMenu

from qt_gui.application.compatibility import QAction
from qt_gui.icon_loader import get_icon
from qt_gui.menu_manager import MenuManager


class PluginMenu(QObject):
    """Fills the two menus and says what the user chose in them."""

    load_plugin_signal = Signal(str)  # plugin id
    unload_plugin_signal = Signal(str)  # instance id

    def __init__(self, menu_bar):
        super().__init__(menu_bar)
        self._plugins = MenuManager(menu_bar.addMenu("&Plugins"))
        self._running = MenuManager(menu_bar.addMenu("&Running"))
        self._instances = {}  # instance id -> (action, label of the plugin)

    def add_plugin(self, descriptor):
        """An entry below the submenus of its groups."""
        base_path = descriptor.attributes().get("plugin_path")
        manager = self._plugins
        for group in descriptor.groups():
            menu = manager.get_menu(group["label"])
            if menu is None:
                menu = QMenu(group["label"], manager.menu)
                _dress(menu.menuAction(), group, base_path)
                manager.add_item(menu)
            manager = getattr(menu, "items", None) or MenuManager(menu)
            menu.items = manager
        manager.add_item(self._action(descriptor, manager.menu))

    def add_prefix(self, descriptor):
        """An entry above all others."""
        self._plugins.add_prefix(self._action(descriptor, self._plugins.menu))

    def _action(self, descriptor, menu):
        attributes = descriptor.action_attributes()
        action = QAction(attributes["label"], menu)
        _dress(action, attributes, descriptor.attributes().get("plugin_path"))
        action.triggered.connect(lambda checked=False: self.load_plugin_signal.emit(descriptor.plugin_id()))
        reason = descriptor.attributes().get("not_available")
        if reason:
            action.setEnabled(False)
            action.setStatusTip(f"Not available: {reason}")
            action.setToolTip(reason)
        return action

    def add_instance(self, descriptor, instance_id):
        """An entry that closes the plugin of ``descriptor`` which runs as ``instance_id``."""
        label = descriptor.action_attributes()["label"]
        number = instance_id.serial_number
        action = QAction(f"Close: {label}" + (f" ({number})" if number > 1 else ""), self._running.menu)
        _dress(action, descriptor.action_attributes(), descriptor.attributes().get("plugin_path"))
        action.triggered.connect(lambda checked=False: self.unload_plugin_signal.emit(str(instance_id)))
        self._instances[str(instance_id)] = action
        self._running.add_item(action)

    def remove_instance(self, instance_id):
        action = self._instances.pop(str(instance_id), None)
        if action is not None:
            self._running.remove_item(action)
            action.deleteLater()

    def update_instance_label(self, instance_id, label):
        """Call the entry of ``instance_id`` by ``label``: the title of its dock is what the user knows the instance by."""
        if str(instance_id) in self._instances and label:
            self._instances[str(instance_id)].setText(f"Close: {label}")


def _dress(action, attributes, base_path=None):
    if attributes.get("icon"):
        action.setIcon(get_icon(attributes["icon"], attributes.get("icontype"), base_path))
    if attributes.get("statustip"):
        action.setStatusTip(attributes["statustip"])

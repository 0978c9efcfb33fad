"""Browsers of types: messages here, services and actions in packages of their own."""

from python_qt_binding.QtCore import QSize, Qt
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.installed_types import installed_types
from rqt_py_common.message_tree_model import MessageTreeModel
from rqt_py_common.message_tree_widget import MessageTreeWidget

from .definitions import DefinitionError, parts, text


class DefinitionTree(MessageTreeWidget):
    """The chosen types with all their fields."""

    def __init__(self, mode: str):
        super().__init__()
        self.setObjectName("messages_tree_view")
        self._mode = mode
        self.model_ = MessageTreeModel()
        self.model_.setHorizontalHeaderLabels(("Tree", "Type", "Path"))
        self.setModel(self.model_)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setEditTriggers(MessageTreeWidget.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(MessageTreeWidget.SelectionBehavior.SelectRows)
        self.setSelectionMode(MessageTreeWidget.SelectionMode.ExtendedSelection)

    def add(self, type_name: str) -> None:
        """:raises DefinitionError: if it cannot be imported"""
        for part, message in parts(type_name, self._mode):
            self.model_.add_message(message, f"{type_name} {part}".strip(), type_name + part if part else type_name, type_name)

    def _context_menu_add_actions(self, menu, pos):
        super()._context_menu_add_actions(menu, pos)
        if self.selectionModel().hasSelection():
            menu.addAction(QIcon.fromTheme("text-x-generic"), "View Text", self.view_text)
            menu.addAction(QIcon.fromTheme("list-remove"), "Remove Selected", self.remove_selected)

    def selected_types(self) -> list:
        tops = self.model_._get_toplevel_items(self.selectedIndexes())
        return list(dict.fromkeys(item.text().split(" ")[0] for item in tops))

    def remove_selected(self) -> None:
        for row in sorted({item.row() for item in self.model_._get_toplevel_items(self.selectedIndexes())}, reverse=True):
            self.model_.removeRow(row)

    def view_text(self) -> QDialog:
        dialog = QDialog(self)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.resize(600, 500)
        dialog.setWindowTitle(", ".join(self.selected_types()))
        shown = QPlainTextEdit()
        shown.setObjectName("definition_text")
        shown.setReadOnly(True)
        for name in self.selected_types():
            try:
                definition = text(name, self._mode)
            except DefinitionError as error:
                definition = str(error)
            shown.appendPlainText(f"[{name}]:\n{definition}\n")
        QVBoxLayout(dialog).addWidget(shown)
        dialog.show()
        return dialog


class TypesWidget(QWidget):
    """Choose a package and a type, add it to the tree."""

    def __init__(self, mode: str):
        """:param mode: .msg, .srv or .action"""
        super().__init__()
        self._types: dict[str, list[str]] = {}
        self._wanted = ""
        self._background = Background(self)
        self.package_combo, self.type_combo = QComboBox(), QComboBox()
        self.package_combo.setObjectName("package_combo")
        self.type_combo.setObjectName("message_combo")
        for box in (self.package_combo, self.type_combo):
            box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.package_combo.currentTextChanged.connect(self._package_changed)
        self.add_button, self.remove_button = QPushButton(QIcon.fromTheme("list-add"), ""), QPushButton(QIcon.fromTheme("list-remove"), "")
        for button, name, call, mark in (
            (self.add_button, "add_button", self.add_chosen, "+"),
            (self.remove_button, "remove_button", lambda: self._remove_selected(), "-"),
        ):
            button.setObjectName(name)
            button.setText(mark if button.icon().isNull() else "")
            button.clicked.connect(lambda checked=False, call=call: call())
        self.tree = DefinitionTree(mode)
        self.error_label = QLabel()
        self.error_label.setObjectName("error_label")
        self.error_label.setStyleSheet("color: red")
        self.error_label.setWordWrap(True)
        bar = QHBoxLayout()
        for widget in (self.package_combo, QLabel("/"), self.type_combo, self.add_button, self.remove_button):
            bar.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addWidget(self.tree)
        layout.addWidget(self.error_label)
        self._background.run("types", lambda: installed_types(mode), self._set_types)

    def sizeHint(self) -> QSize:
        return QSize(700, 450)

    def _set_types(self, types) -> None:
        self._types = types
        self.package_combo.addItems(list(types))
        if self._wanted in types:
            self.package_combo.setCurrentText(self._wanted)

    def choose_package(self, name: str) -> None:
        """Now, or as soon as the packages are known."""
        self._wanted = name
        self.package_combo.setCurrentText(name)

    def _remove_selected(self) -> None:
        self.tree.remove_selected()

    def _package_changed(self, package: str) -> None:
        self.type_combo.clear()
        self.type_combo.addItems(self._types.get(package, []))

    def add_chosen(self) -> None:
        if self.type_combo.currentText():
            try:
                self.tree.add(f"{self.package_combo.currentText()}/{self.type_combo.currentText()}")
                self.error_label.clear()
            except DefinitionError as error:
                self.error_label.setText(str(error))

    def close_calls(self) -> None:
        self._background.close()


class TypesPlugin(Plugin):
    """A plugin with ``name``, ``title`` and ``mode``."""

    name = title = mode = ""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName(self.name)
        self._widget = TypesWidget(self.mode)
        self._widget.setObjectName(f"{self.name}Widget")
        self._widget.setWindowTitle(self.title + (f" ({context.serial_number()})" if context.serial_number() > 1 else ""))
        context.add_widget(self._widget)

    @property
    def widget(self) -> TypesWidget:
        return self._widget

    def shutdown_plugin(self):
        self._widget.close_calls()

    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("package", self._widget.package_combo.currentText())

    def restore_settings(self, plugin_settings, instance_settings):
        self._widget.choose_package(instance_settings.value("package", "") or "")

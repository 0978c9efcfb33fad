"""The tree of servers on the left, the editors of those chosen on the right."""

import re

import rosservice
from python_qt_binding.QtCore import QSize, Qt
from python_qt_binding.QtGui import QBrush, QColor, QIcon
from python_qt_binding.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QSplitter,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.background import Background

from .param_client_widget import ParamClientWidget

_NODE = Qt.ItemDataRole.UserRole
_ENDING = "/set_parameters"


def list_servers() -> list:
    """Names of all nodes with a service set_parameters, dead ones too; nobody but the master is asked."""
    return sorted(name[: -len(_ENDING)] for name in rosservice.get_service_list() if name.endswith(_ENDING))


class ParamWidget(QWidget):
    def __init__(self, nodes=(), make_client_widget=ParamClientWidget):
        """:param nodes: to open at once"""
        super().__init__()
        self.setObjectName("ParamWidget")
        self.setWindowTitle("Dynamic Reconfigure")
        self._make_client_widget = make_client_widget
        self._wanted = list(nodes)
        self._background = Background(self)
        self.clients: dict[str, ParamClientWidget] = {}
        self._items: dict[str, QTreeWidgetItem] = {}
        self.filter_edit = QLineEdit()
        self.filter_edit.setObjectName("filter_edit")
        self.filter_edit.setPlaceholderText("Filter (regular expression)")
        self.filter_edit.textChanged.connect(lambda text: self._filter())
        self.node_tree = QTreeWidget()
        self.node_tree.setObjectName("node_tree")
        self.node_tree.setHeaderHidden(True)
        self.node_tree.setSelectionMode(QTreeWidget.SelectionMode.ExtendedSelection)
        self.node_tree.itemSelectionChanged.connect(self._selection_changed)
        left, column, buttons = QWidget(), QVBoxLayout(), QHBoxLayout()
        left.setLayout(column)
        for name, text, icon, call in (
            ("collapse_button", "Collapse", "zoom-out", self.node_tree.collapseAll),
            ("expand_button", "Expand", "zoom-in", self.node_tree.expandAll),
            ("refresh_button", "Refresh", "view-refresh", self.refresh),
        ):
            button = QPushButton(QIcon.fromTheme(icon), text)
            button.setObjectName(name)
            button.clicked.connect(lambda checked=False, call=call: call())
            buttons.addWidget(button)
        self.status_label = QLabel()
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        column.addWidget(self.filter_edit)
        column.addWidget(self.node_tree)
        column.addWidget(self.status_label)
        column.addLayout(buttons)
        inside = QWidget()
        self._editors = QVBoxLayout(inside)
        self._editors.addStretch()
        scroll = QScrollArea()
        scroll.setWidgetResizable(True)
        scroll.setWidget(inside)
        self.splitter = QSplitter()
        self.splitter.addWidget(left)
        self.splitter.addWidget(scroll)
        self.splitter.setSizes([220, 500])
        QHBoxLayout(self).addWidget(self.splitter)
        self.resize(760, 480)
        self.refresh()

    def sizeHint(self) -> QSize:
        return QSize(850, 500)

    def refresh(self) -> None:
        """Ask the master for servers anew."""
        self._background.run("nodes", list_servers, self.show_nodes, lambda error: self.status_label.setText(str(error)))

    def show_nodes(self, nodes) -> None:
        for node in [node for node in self._items if node not in nodes]:
            self.close_node(node)
            self._remove_item(self._items.pop(node))
        for node in nodes:
            if node not in self._items:
                self._items[node] = self._add_item(node)
        self.node_tree.expandAll()
        self._filter()
        missing = [node for node in self._wanted if self._resolved(node) not in self._items]
        self.status_label.setText(f"no such dynamic_reconfigure server: {', '.join(missing)}" if missing else "")
        for node in [node for node in self._wanted if self._resolved(node) in self._items]:
            self._wanted.remove(node)
            self._items[self._resolved(node)].setSelected(True)

    @staticmethod
    def _resolved(node: str) -> str:
        return node if node.startswith("/") else "/" + node

    def _add_item(self, node: str) -> QTreeWidgetItem:
        parent = self.node_tree.invisibleRootItem()
        for part in node.strip("/").split("/"):
            found = next((parent.child(n) for n in range(parent.childCount()) if parent.child(n).text(0) == part), None)
            if found is None:
                found = QTreeWidgetItem([part])
                found.setFlags(Qt.ItemFlag.ItemIsEnabled)
                parent.addChild(found)
            parent = found
        parent.setData(0, _NODE, node)
        parent.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        return parent

    def _remove_item(self, item: QTreeWidgetItem) -> None:
        item.setData(0, _NODE, None)
        item.setFlags(Qt.ItemFlag.ItemIsEnabled)
        while item is not None and not item.childCount() and item.data(0, _NODE) is None:
            parent = item.parent()
            (parent or self.node_tree.invisibleRootItem()).removeChild(item)
            item = parent

    def _filter(self) -> None:
        try:
            wanted = re.compile(self.filter_edit.text(), re.IGNORECASE)
        except re.error as error:
            self.filter_edit.setToolTip(f"not a regular expression: {error}")
            return
        self.filter_edit.setToolTip("")

        def show(item) -> bool:
            node = item.data(0, _NODE)
            shown = [show(item.child(n)) for n in range(item.childCount())]  # all of them, not the first that is shown
            visible = any(shown) or node is not None and wanted.search(node) is not None
            item.setHidden(not visible)
            return visible

        for n in range(self.node_tree.topLevelItemCount()):
            show(self.node_tree.topLevelItem(n))

    def _selection_changed(self) -> None:
        chosen = [node for node, item in self._items.items() if item.isSelected()]
        for node in [node for node in self.clients if node not in chosen]:
            self.close_node(node)
        for node in chosen:
            if node not in self.clients:
                self._open(node)

    def _open(self, node: str) -> None:
        client = self._make_client_widget(node)
        client.close_requested.connect(lambda name: self._items[name].setSelected(False))
        client.answered.connect(self._mark)
        self.clients[node] = client
        self._editors.insertWidget(self._editors.count() - 1, client)

    def close_node(self, node: str) -> None:
        client = self.clients.pop(node, None)
        if client is not None:
            client.close_client()
            self._editors.removeWidget(client)
            client.hide()
            client.deleteLater()

    def _mark(self, node: str, alive: bool) -> None:
        if node in self._items:
            self._items[node].setForeground(0, QBrush() if alive else QBrush(QColor("gray")))
            self._items[node].setToolTip(0, "" if alive else "does not answer")

    def close_all(self) -> None:
        self._background.close()
        for node in list(self.clients):
            self.close_node(node)

    def save_settings(self, settings) -> None:
        settings.set_value("splitter", self.splitter.saveState())
        settings.set_value("_PARAM_TEXT_FILTER", self.filter_edit.text())
        settings.set_value("selected_nodes", list(self.clients))

    def restore_settings(self, settings) -> None:
        if settings.contains("splitter"):
            self.splitter.restoreState(settings.value("splitter"))
        self.filter_edit.setText(settings.value("_PARAM_TEXT_FILTER", "") or "")

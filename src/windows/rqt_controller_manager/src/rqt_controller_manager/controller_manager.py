"""The plugin: controllers of a manager, with a light each and a menu."""

from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtGui import QColor, QIcon, QPainter, QPixmap
from python_qt_binding.QtWidgets import (
    QComboBox,
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QMenu,
    QTableWidget,
    QTableWidgetItem,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.empty_text import EmptyText

from .manager_calls import UNINITIALIZED, ManagerCalls

PERIOD = 1000  # ms
_COLORS = {"running": "#2eb82e", "stopped": "#d93030", "initialized": "#d93030", "aborted": "#d93030", "waiting": "#e0b020"}
#: State: (label, steps) of the menu.
_MENUS = {
    "running": (("Stop", ("stop",)), ("Stop and Unload", ("stop", "unload"))),
    "stopped": (("Start again", ("start",)), ("Unload", ("unload",))),
    "initialized": (("Start", ("start",)), ("Unload", ("unload",))),
    UNINITIALIZED: (("Load", ("load",)), ("Load and Start", ("load", "start"))),
}
_MENUS["aborted"] = _MENUS["stopped"]


class ControllerManager(Plugin):
    """Asks once a second, in the background: a manager that hangs or goes away leaves the window alive."""

    def __init__(self, context, calls=None):
        """:param calls: ManagerCalls or the like"""
        super().__init__(context)
        self.setObjectName("ControllerManager")
        self._calls = calls or ManagerCalls()
        self._background = Background(self)
        self._rows, self._wanted, self._lights = [], "", {}
        self._widget = QWidget()
        self._widget.setObjectName("ControllerManagerUi")
        number = context.serial_number()
        self._widget.setWindowTitle("Controller Manager" + (f" ({number})" if number > 1 else ""))
        self.manager_box = QComboBox()
        self.manager_box.setObjectName("cm_combo")
        self.manager_box.currentTextChanged.connect(self._manager_changed)
        self.table = QTableWidget(0, 2)
        self.table.setObjectName("table_view")
        EmptyText(self.table, "No controllers: start a robot with a controller_manager, or load controllers by the right button.")
        self.table.setHorizontalHeaderLabels(("controller", "state"))
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.verticalHeader().setVisible(False)
        self.table.setMinimumSize(420, 200)
        self.table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.table.customContextMenuRequested.connect(self._show_menu)
        self.table.cellDoubleClicked.connect(lambda row, column: self.show_details(row))
        self.status_label = QLabel()
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        top, layout = QHBoxLayout(), QVBoxLayout(self._widget)
        top.addWidget(QLabel("namespace"))
        top.addWidget(self.manager_box, 1)
        layout.addLayout(top)
        layout.addWidget(self.table)
        layout.addWidget(self.status_label)
        context.add_widget(self._widget)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.poll)
        self._timer.start(PERIOD)
        self.poll()

    def poll(self) -> None:
        self._background.run("managers", self._calls.managers, self._show_managers, lambda error: self._show_managers([]))
        manager = self.manager_box.currentText()
        if manager:
            self._background.run(
                ("controllers", manager),
                lambda: self._calls.controllers(manager),
                lambda rows: self._show_rows(manager, rows),
                lambda error: self._gone(manager, error),
            )

    def _show_managers(self, names) -> None:
        box = self.manager_box
        if [box.itemText(n) for n in range(box.count())] == names:
            return
        chosen = box.currentText() or self._wanted
        blocked = box.blockSignals(True)
        box.clear()
        box.addItems(names)
        if chosen in names:
            box.setCurrentText(chosen)
        box.blockSignals(blocked)
        if box.currentText() != chosen or not names:
            self._manager_changed(box.currentText())
        else:
            self.poll()

    def _manager_changed(self, manager: str) -> None:
        self._wanted = manager or self._wanted
        self._fill([])
        self.status_label.setText("" if manager else "there is no controller manager")
        self.poll() if manager else None

    def _gone(self, manager: str, error: Exception) -> None:
        if manager == self.manager_box.currentText():
            self._fill([])
            self.status_label.setText(f"{manager} does not answer: {error}")

    def _show_rows(self, manager: str, rows) -> None:
        if manager == self.manager_box.currentText() and rows != self._rows:
            self._fill(rows)
            self.status_label.clear()

    def _fill(self, rows) -> None:
        selected = {self._rows[index.row()].name for index in self.table.selectionModel().selectedRows() if index.row() < len(self._rows)}
        self._rows = list(rows)
        self.table.clearSelection()
        self.table.setRowCount(len(rows))
        for number, row in enumerate(rows):
            name = QTableWidgetItem(self._light(row.state), row.name)
            name.setToolTip(row.type)
            self.table.setItem(number, 0, name)
            self.table.setItem(number, 1, QTableWidgetItem(row.state))
            if row.name in selected:
                self.table.selectRow(number)

    def _light(self, state: str) -> QIcon:
        if state not in self._lights:
            pixmap = QPixmap(16, 16)
            pixmap.fill(Qt.GlobalColor.transparent)
            painter = QPainter(pixmap)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setBrush(QColor(_COLORS.get(state, "#909090")))
            painter.drawEllipse(2, 2, 11, 11)
            painter.end()
            self._lights[state] = QIcon(pixmap)
        return self._lights[state]

    def row_menu(self, number: int) -> QMenu:
        """The menu of a row."""
        row, menu = self._rows[number], QMenu(self._widget)
        for label, steps in _MENUS.get(row.state, ()):
            menu.addAction(label, lambda steps=steps: self._act(row.name, steps))
        return menu

    def _show_menu(self, place) -> None:
        number = self.table.rowAt(place.y())
        if 0 <= number < len(self._rows):
            self.row_menu(number).popup(self.table.viewport().mapToGlobal(place))

    def _act(self, name: str, steps) -> None:
        manager = self.manager_box.currentText()
        started = self._background.run(("act", manager), lambda: self._calls.act(manager, name, *steps), self._acted, self._not_acted)
        self.status_label.setText(f"{' and '.join(steps)} {name} ..." if started else f"{manager} is still busy with the last request")

    def _acted(self, _result) -> None:
        self.status_label.clear()
        self.poll()

    def _not_acted(self, error: Exception) -> None:
        self.status_label.setText(str(error))
        self.poll()

    def show_details(self, number: int) -> QDialog:
        """Name, type and claimed resources of a controller."""
        row, dialog = self._rows[number], QDialog(self._widget)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setWindowTitle("Controller Information")
        tree = QTreeWidget()
        tree.setObjectName("resource_tree")
        tree.setHeaderLabel("Claimed Resources")
        for interface, joints in row.resources:
            item = QTreeWidgetItem([interface])
            item.addChildren([QTreeWidgetItem([joint]) for joint in joints])
            tree.addTopLevelItem(item)
        tree.expandAll()
        form = QFormLayout(dialog)
        form.addRow("Controller Name", QLabel(row.name))
        form.addRow("Controller Type", QLabel(row.type))
        form.addRow(tree)
        dialog.show()
        return dialog

    def shutdown_plugin(self) -> None:
        self._timer.stop()
        self._background.close()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("cm_ns", self.manager_box.currentText() or self._wanted)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._wanted = instance_settings.value("cm_ns", "") or ""

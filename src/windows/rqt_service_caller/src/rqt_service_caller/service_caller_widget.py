"""What is seen: the request on one side, the response on the other."""

from python_qt_binding.QtCore import QSize, Qt, Signal
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QSplitter,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.expression_tree import ExpressionTree
from rqt_py_common.extended_combo_box import ExtendedComboBox

_ELEMENTS = 500  # of an array that are shown
_TEXT = 2000  # characters of a value that are shown


class ServiceCallerWidget(QWidget):
    refresh_requested = Signal()
    service_chosen = Signal(str)
    call_requested = Signal()
    stop_requested = Signal()

    def __init__(self):
        super().__init__()
        self.setObjectName("ServiceCallerWidget")
        self.setWindowTitle("Service Caller")
        self._waiting = False
        self.services_combo_box = ExtendedComboBox()
        self.services_combo_box.setObjectName("services_combo_box")
        self.services_combo_box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.services_combo_box.currentIndexChanged.connect(lambda index: self.choose(self.services_combo_box.itemText(index)))
        self.refresh_button = QPushButton(QIcon.fromTheme("view-refresh"), "")
        self.refresh_button.setObjectName("refresh_services_button")
        self.refresh_button.setToolTip("Look for services")
        self.refresh_button.clicked.connect(lambda: self.refresh_requested.emit())
        self.call_button = QPushButton(QIcon.fromTheme("call-start"), "Call")
        self.call_button.setObjectName("call_service_button")
        self.call_button.setEnabled(False)
        self.call_button.clicked.connect(lambda: (self.stop_requested if self._waiting else self.call_requested).emit())
        bar = QHBoxLayout()
        bar.addWidget(self.refresh_button)
        bar.addWidget(QLabel("Service"))
        bar.addWidget(self.services_combo_box)
        bar.addWidget(self.call_button)
        self.request_tree = ExpressionTree(("Topic", "Type", "Expression"), 1, 2)
        self.request_tree.setObjectName("request_tree_widget")
        self.response_tree = QTreeWidget()
        self.response_tree.setObjectName("response_tree_widget")
        self.response_tree.setHeaderLabels(("Field", "Type", "Value"))
        self.response_tree.setAlternatingRowColors(True)
        self.splitter = QSplitter(Qt.Orientation.Horizontal)
        for title, tree in (("Request", self.request_tree), ("Response", self.response_tree)):
            side = QWidget()
            column = QVBoxLayout(side)
            column.addWidget(QLabel(title))
            column.addWidget(tree)
            tree.setColumnWidth(0, 160)
            self.splitter.addWidget(side)
        self.error_label = QLabel()
        self.error_label.setObjectName("error_label")
        self.error_label.setStyleSheet("color: red")
        self.error_label.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addWidget(self.splitter)
        layout.addWidget(self.error_label)

    def sizeHint(self) -> QSize:
        return QSize(850, 450)

    def set_services(self, names) -> None:
        """Offer these; what is chosen stays, with its request, even if it is not there at the moment."""
        chosen, box = self.services_combo_box.currentText(), self.services_combo_box
        names = list(names) + ([chosen] if chosen and chosen not in names else [])
        blocked = box.blockSignals(True)
        box.onSetItems(names)
        if chosen in names:
            box.setCurrentIndex(names.index(chosen))
        box.blockSignals(blocked)
        if not chosen and names:
            self.choose(box.currentText())

    def choose(self, service: str) -> None:
        box = self.services_combo_box
        blocked = box.blockSignals(True)
        if service and box.findText(service) < 0:
            box.addItem(service)
        box.setCurrentIndex(box.findText(service))
        box.blockSignals(blocked)
        if service:
            self.service_chosen.emit(service)

    def show_request(self, title: str, template) -> None:
        """Rows for a request.

        :param title: its type
        :param template: a RequestField; None while its type is not known, then no rows
        """
        self.error_label.clear()
        self.request_tree.clear()
        self.response_tree.clear()
        self.call_button.setEnabled(template is not None or self._waiting)
        if template is not None:
            item = QTreeWidgetItem([self.services_combo_box.currentText(), title, ""])
            self.request_tree.addTopLevelItem(item)
            self.request_tree.add_fields(item, template)
            item.setExpanded(True)

    def show_request_error(self, error) -> None:
        if self.request_tree.topLevelItemCount():
            self.request_tree.show_error(self.request_tree.topLevelItem(0), error)
        self.error_label.setText(str(error) if error else "")

    def show_error(self, text: str) -> None:
        self.error_label.setText(text)

    def show_waiting(self, waiting: bool) -> None:
        self._waiting = waiting
        self.call_button.setText("Stop waiting" if waiting else "Call")
        self.call_button.setEnabled(waiting or self.request_tree.topLevelItemCount() > 0)
        if waiting:
            self.response_tree.clear()

    def show_response(self, response) -> None:
        self.response_tree.clear()
        self._add_row(self.response_tree.invisibleRootItem(), "/", response._type, response)
        self.response_tree.expandToDepth(3)

    def show_failure(self, error: Exception) -> None:
        self.response_tree.clear()
        kind = type(error)
        item = QTreeWidgetItem(["ERROR", f"{kind.__module__.split('.')[0]}.{kind.__name__}", str(error)])
        item.setToolTip(2, str(error))
        self.response_tree.addTopLevelItem(item)

    def _add_row(self, parent, name: str, type_name: str, value) -> None:
        item = QTreeWidgetItem([name, type_name, ""])
        parent.addChild(item)
        if hasattr(value, "_slot_types"):
            for slot, kind in zip(value.__slots__, value._slot_types):
                self._add_row(item, slot, kind, getattr(value, slot))
        elif isinstance(value, (list, tuple)) and value and hasattr(value[0], "_slot_types"):
            for index, element in enumerate(value[:_ELEMENTS]):
                self._add_row(item, f"[{index}]", type_name.split("[")[0], element)
        else:
            text = repr(value[:_ELEMENTS] if isinstance(value, (list, tuple, bytes)) else value)
            item.setText(2, text if len(text) <= _TEXT else text[:_TEXT] + "...")
            item.setToolTip(2, item.text(2))

    def flip(self) -> None:
        """Request and response beside each other, or one above the other."""
        self.set_orientation("vertical" if self.orientation() == "horizontal" else "horizontal")

    def orientation(self) -> str:
        return "horizontal" if self.splitter.orientation() == Qt.Orientation.Horizontal else "vertical"

    def set_orientation(self, orientation: str) -> None:
        self.splitter.setOrientation(Qt.Orientation.Vertical if orientation == "vertical" else Qt.Orientation.Horizontal)

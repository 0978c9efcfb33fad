"""The tree of topics and their fields."""

import rospy
from python_qt_binding.QtCore import QMimeData, QSize, Qt, QTimer
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QHeaderView, QMenu, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget
from rqt_py_common.background import Background
from rqt_py_common.empty_text import EmptyText

from .topic_info import TopicInfo

COLUMNS = ("Topic", "Type", "Bandwidth", "Hz", "Value")
PERIOD = 1000  # ms
_PATH = Qt.ItemDataRole.UserRole
_NUMBER = Qt.ItemDataRole.UserRole + 1
_ELEMENTS = 100  # of an array that are shown
_TEXT = 500  # characters of a value that are shown


class TopicItem(QTreeWidgetItem):
    """Bandwidth and rate are sorted by number."""

    def __lt__(self, other):
        column = self.treeWidget().sortColumn()
        if column in (2, 3):
            return (self.data(column, _NUMBER) or 0.0) < (other.data(column, _NUMBER) or 0.0)
        return self.text(column) < other.text(column)


class TopicTree(QTreeWidget):
    """Drags carry the full name of a field as text."""

    def mimeData(self, items):
        data = QMimeData()
        if items:
            data.setText(items[0].data(0, _PATH))
        return data

    def mimeTypes(self):
        return ["text/plain"]


class TopicWidget(QWidget):
    """Topics are listed every second, and listened to only while their box is checked."""

    SELECT_BY_NAME, SELECT_BY_MSGTYPE = 0, 1

    def __init__(self, plugin=None, selected_topics=None, select_topic_type=SELECT_BY_NAME):
        """:param selected_topics: show these only: (name, type) pairs, or type names if SELECT_BY_MSGTYPE"""
        super().__init__()
        self.setObjectName("TopicWidget")
        self.setWindowTitle("Topic Monitor")
        self._selected, self._by_type = selected_topics, select_topic_type == self.SELECT_BY_MSGTYPE
        self._background = Background(self)
        self._rows: dict[str, tuple] = {}  # topic -> (item, TopicInfo)
        self.tree = TopicTree()
        self.tree.setObjectName("topics_tree_widget")
        self.empty_text = EmptyText(self.tree, "There are no topics yet: start a node.")
        self.tree.setColumnCount(len(COLUMNS))
        self.tree.setHeaderLabels(COLUMNS)
        self.tree.setSortingEnabled(True)
        self.tree.sortByColumn(0, Qt.SortOrder.AscendingOrder)
        self.tree.setDragEnabled(True)
        self.tree.setAlternatingRowColors(True)
        header = self.tree.header()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        for column, width in enumerate((260, 200, 90, 80, 200)):
            header.resizeSection(column, width)
        header.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        header.customContextMenuRequested.connect(self._header_menu)
        self.tree.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.tree.customContextMenuRequested.connect(self._item_menu)
        self.tree.itemChanged.connect(self._item_changed)
        self.tree.itemExpanded.connect(lambda item: self.show_values())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.tree)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.refresh_topics)

    def sizeHint(self) -> QSize:
        return QSize(850, 450)

    def start(self) -> None:
        self._timer.start(PERIOD)
        self.refresh_topics()

    def shutdown_plugin(self) -> None:
        self._timer.stop()
        self._background.close()
        for _, info in self._rows.values():
            info.stop_monitoring()

    def set_selected_topics(self, selected_topics) -> None:
        self._selected = selected_topics
        self.refresh_topics()

    def refresh_topics(self) -> None:
        self._background.run("topics", rospy.get_published_topics, self.set_topics, lambda error: None)  # the master is away
        self.show_values()

    def set_topics(self, topics) -> None:
        """Show these: (name, type) pairs. What is shown already stays as it is."""
        wanted = {name: kind for name, kind in topics if self._wanted(name, kind)}
        for name in [name for name, (_, info) in self._rows.items() if wanted.get(name) != info.type_name]:
            item, info = self._rows.pop(name)
            info.stop_monitoring()
            self.tree.takeTopLevelItem(self.tree.indexOfTopLevelItem(item))
        new = [(name, kind) for name, kind in wanted.items() if name not in self._rows]
        self.tree.blockSignals(True)
        items = []
        for name, kind in new:
            item, info = TopicItem([name, kind, "", "", "not monitored"]), TopicInfo(name, kind)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            item.setCheckState(0, Qt.CheckState.Unchecked)
            item.setData(0, _PATH, name)
            item.setToolTip(0, name)
            if info.error:
                item.setText(4, info.error)
            else:
                _add_fields(item, name, info.message_class())
            self._rows[name] = (item, info)
            items.append(item)
        self.tree.addTopLevelItems(items)
        self.tree.blockSignals(False)

    def _wanted(self, name: str, kind: str) -> bool:
        if self._selected is None:
            return True
        return kind in self._selected if self._by_type else any(name == chosen[0] for chosen in self._selected)

    def _item_changed(self, item, column) -> None:
        if column == 0 and item.parent() is None:
            info = self._rows[item.text(0)][1]
            if (item.checkState(0) == Qt.CheckState.Checked) != info.monitoring:
                info.toggle_monitoring()
                self.show_values()

    def show_values(self) -> None:
        """Bring the rows up to date."""
        self.tree.blockSignals(True)
        self.tree.setSortingEnabled(False)  # an item must not move while it is filled
        for item, info in self._rows.values():
            if info.monitoring:
                self._show(item, info)
            elif item.text(4) != "not monitored" and not info.error:
                self._fill_row(item, None, None)
                item.setText(4, "not monitored")
        self.tree.setSortingEnabled(True)
        self.tree.blockSignals(False)
        self.tree.viewport().update()

    def _show(self, item, info) -> None:
        self._fill_row(item, info.get_bw()[0], info.get_hz())
        try:
            message = info.last_message()
        except Exception as error:  # of any kind: another type's bytes
            item.setText(4, f"not a {info.type_name}: {error}")
            return
        item.setText(4, "")
        if message is not None and item.isExpanded():
            _show_fields(item, info.topic_name, message)

    @staticmethod
    def _fill_row(item, bandwidth, rate) -> None:
        item.setData(2, _NUMBER, bandwidth)
        item.setData(3, _NUMBER, rate)
        item.setText(2, "" if item.treeWidget() is None else _bandwidth_text(bandwidth))
        item.setText(3, "unknown" if rate is None else f"{rate:1.2f}")

    def _header_menu(self, place) -> None:
        header, menu, modes = self.tree.header(), QMenu(self), QHeaderView.ResizeMode
        menu.addAction(
            "Toggle Auto-Resize",
            lambda: header.setSectionResizeMode(
                modes.Interactive if header.sectionResizeMode(0) == modes.ResizeToContents else modes.ResizeToContents
            ),
        )
        menu.popup(header.mapToGlobal(place))

    def _item_menu(self, place) -> None:
        item = self.tree.itemAt(place)
        if item is None:
            return
        menu = QMenu(self)
        for icon, text, on in (("zoom-in", "Expand All Children", True), ("zoom-out", "Collapse All Children", False)):
            menu.addAction(QIcon.fromTheme(icon), text, lambda on=on: _expand(item, on))
        menu.popup(self.tree.viewport().mapToGlobal(place))


def _bandwidth_text(value) -> str:
    if value is None:
        return "unknown"
    for unit, size in (("MB/s", 1e6), ("KB/s", 1e3)):
        if value >= size:
            return f"{value / size:.2f}{unit}"
    return f"{value:.2f}B/s"


def _expand(item, on: bool) -> None:
    item.setExpanded(on)
    for row in range(item.childCount()):
        _expand(item.child(row), on)


def _children(value, type_name: str):
    """(name, path ending, value, type) of what is within a field."""
    if hasattr(value, "_slot_types"):
        for name, kind in zip(value.__slots__, value._slot_types):
            yield name, "/" + name, getattr(value, name), kind
    elif isinstance(value, (list, tuple)) and value and hasattr(value[0], "_slot_types"):
        for index, element in enumerate(value[:_ELEMENTS]):
            yield f"[{index}]", f"[{index}]", element, type_name.split("[")[0]


def _add_fields(parent, path: str, value, type_name: str = "") -> None:
    for name, ending, field, kind in _children(value, type_name):
        _add_fields(_add_row(parent, path + ending, name, kind), path + ending, field, kind)


def _add_row(parent, path: str, name: str, kind: str):
    row = TopicItem([name, kind, "", "", ""])
    row.setData(0, _PATH, path)
    row.setToolTip(0, path)
    parent.addChild(row)
    return row


def _show_fields(parent, path: str, value, type_name: str = "") -> None:
    """The values of rows that can be seen."""
    shown = {parent.child(row).data(0, _PATH): parent.child(row) for row in range(parent.childCount())}
    for name, ending, field, kind in _children(value, type_name):
        row = shown.pop(path + ending, None) or _add_row(parent, path + ending, name, kind)
        within = list(_children(field, kind))
        row.setText(4, "" if within else _value_text(field))
        if row.isExpanded() or within and not row.childCount():
            _show_fields(row, path + ending, field, kind)
    for row in shown.values():  # elements that an array has no more
        parent.removeChild(row)


def _value_text(value) -> str:
    if isinstance(value, (list, tuple, bytes)) and len(value) > _ELEMENTS:
        return repr(value[:_ELEMENTS])[:_TEXT] + f"... ({len(value)})"
    text = repr(value)
    return text if len(text) <= _TEXT else text[:_TEXT] + "..."

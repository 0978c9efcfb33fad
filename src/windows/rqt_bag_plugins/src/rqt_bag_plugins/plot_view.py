"""Numbers of a topic over the time of the bag, with the playhead as a line."""

from __future__ import annotations

import threading

import genpy
from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import QSplitter, QTreeWidget, QTreeWidgetItem
from rqt_bag import TopicMessageView
from rqt_bag.bags import BagError
from rqt_plot.data_plot import DataPlot
from rqt_plot.fields import getter

_PATH = Qt.ItemDataRole.UserRole
_MOST_ELEMENTS = 100  # of an array that are offered
_BATCH = 500  # messages that are read before they are drawn


class PlotView(TopicMessageView):
    """A tree of the fields; those that are checked are plotted."""

    name = "Plot"
    _values_read = Signal(int, str, object, object)

    def __init__(self, timeline, parent, topic):
        super().__init__(timeline, parent, topic)
        self.tree = QTreeWidget()
        self.tree.setObjectName("plot_fields")
        self.tree.setHeaderHidden(True)
        self.plot = DataPlot(capacity=None)
        self.plot.set_autoscale(x=False, y=DataPlot.SCALE_VISIBLE)
        splitter = QSplitter()
        splitter.addWidget(self.plot)
        splitter.addWidget(self.tree)
        splitter.setSizes([500, 200])
        parent.layout().addWidget(splitter, 1)
        self._start = timeline._get_start_stamp().to_sec() if timeline._get_start_stamp() else 0.0
        self._round = 0  # number of the last reading: values of older ones are dropped
        self.tree.itemChanged.connect(lambda _item, _column: self._read())
        self._values_read.connect(self._add_values)
        timeline.selected_region_changed.connect(lambda *_: self._read())

    # What is plotted

    def message_viewed(self, bag, msg_details):
        super().message_viewed(bag, msg_details)
        if self.tree.topLevelItemCount() == 0:
            blocked = self.tree.blockSignals(True)
            self._add_fields(self.tree.invisibleRootItem(), "", msg_details[1])
            self.tree.blockSignals(blocked)
        self.plot.vline(msg_details[2].to_sec() - self._start)

    def timeline_changed(self):
        self._read()

    def _add_fields(self, parent: QTreeWidgetItem, path: str, message) -> None:
        for name in message.__slots__:
            value = getattr(message, name)
            self._add_field(parent, f"{path}/{name}", name, value)

    def _add_field(self, parent: QTreeWidgetItem, path: str, label: str, value) -> None:
        if isinstance(value, (str, bytes)):
            return
        item = QTreeWidgetItem(parent, [label])
        if isinstance(value, genpy.Message):
            self._add_fields(item, path, value)
        elif isinstance(value, (list, tuple)):
            for i, element in enumerate(value[:_MOST_ELEMENTS]):
                self._add_field(item, f"{path}[{i}]", f"[{i}]", element)
        else:
            item.setData(0, _PATH, path)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            item.setCheckState(0, Qt.CheckState.Unchecked)

    def _paths(self, parent=None) -> list[str]:
        parent = parent or self.tree.invisibleRootItem()
        found: list[str] = []
        for item in (parent.child(i) for i in range(parent.childCount())):
            if item.data(0, _PATH) and item.checkState(0) == Qt.CheckState.Checked:
                found.append(item.data(0, _PATH))
            found += self._paths(item)
        return found

    def check(self, path: str, checked: bool = True) -> None:
        """Plot the field ``path``, as ``/pose/position/x``, or no longer when not ``checked``."""
        waiting = [self.tree.invisibleRootItem()]
        while waiting:
            item = waiting.pop()
            if item.data(0, _PATH) == path:
                item.setCheckState(0, Qt.CheckState.Checked if checked else Qt.CheckState.Unchecked)
            waiting += [item.child(i) for i in range(item.childCount())]

    # Its values

    def _read(self) -> None:
        self._round += 1
        for curve_id in list(self.plot._curves):
            self.plot.remove_curve(curve_id)
        paths, (start, end) = self._paths(), self.timeline._timeline_frame.play_region
        if not paths or start is None:
            return
        for path in paths:
            self.plot.add_curve(path, path.strip("/"), [], [])
        self.plot.set_xlim([start.to_sec() - self._start, max(end.to_sec() - self._start, start.to_sec() - self._start + 1e-6)])
        threading.Thread(target=self._work, args=(self._round, paths, start, end), daemon=True).start()

    def _work(self, number: int, paths: list[str], start, end) -> None:
        getters = {path: getter(path) for path in paths}
        values: dict[str, tuple] = {path: ([], []) for path in paths}
        count = 0
        try:
            for bag, entry in self.timeline.get_entries_with_bags(self.topic, start, end):
                if number != self._round:
                    return
                _, message, stamp = self.timeline.read_message(bag, entry.position)[:3]
                for path, get in getters.items():
                    try:
                        value = get(message)
                    except (IndexError, AttributeError, TypeError, ValueError):
                        continue  # an array that is shorter this time
                    values[path][0].append(stamp.to_sec() - self._start)
                    values[path][1].append(value)
                count += 1
                if count % _BATCH == 0:
                    self._hand_over(number, values)
        except BagError as error:
            self.timeline.problem.emit(str(error))
        self._hand_over(number, values)

    def _hand_over(self, number: int, values: dict[str, tuple]) -> None:
        for path, (x, y) in values.items():
            if x:
                self._values_read.emit(number, path, list(x), list(y))
                x.clear()
                y.clear()

    def _add_values(self, number: int, path: str, x, y) -> None:
        if number == self._round:
            self.plot.update_values(path, x, y)
            self.plot.redraw()

    def close(self):
        self._round += 1

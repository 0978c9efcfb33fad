"""The plots of a table, side by side; what links them."""

from __future__ import annotations

import threading

from python_qt_binding.QtCore import QTimer, Signal
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import QGridLayout, QWidget

from rqt_multiplot.config import Table
from rqt_multiplot.panel import PlotPanel
from rqt_multiplot.plot_dialog import PlotDialog
from rqt_multiplot.sources import BagError, Topics, read_bag


class TableView(QWidget):
    """All plots of a configuration."""

    changed = Signal()
    problem = Signal(str)
    running_changed = Signal()
    bag_progress = Signal(float)
    bag_done = Signal(str)  #: a sentence on what was read, or why nothing

    def __init__(self, types):
        super().__init__()
        self._types = types
        self._topics = Topics()
        self.table = Table()
        self.panels: list[list[PlotPanel]] = []
        self._layout = QGridLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._dialogs: list[PlotDialog] = []
        self._bag_stop: threading.Event | None = None
        self._bag_timer = QTimer(self)
        self._bag_timer.timeout.connect(self._take_points)
        self.bag_done.connect(self._bag_ended)
        self.set_table(Table())

    @property
    def all_panels(self) -> list[PlotPanel]:
        return [panel for row in self.panels for panel in row]

    def set_table(self, table: Table) -> None:
        """Show another table, or the same after its shape has changed; plots that stay keep their points."""
        self.stop_bag()
        for dialog in self._dialogs:
            dialog.close()
        self._dialogs = []
        old = {id(panel.plot): panel for panel in self.all_panels}
        self.table = table
        self.panels = [[old.pop(id(plot)) if id(plot) in old else self._new_panel(plot) for plot in row] for row in table.plots]
        for panel in old.values():
            panel.pause()
            panel.hide()
            panel.deleteLater()
        for r, row in enumerate(self.panels):
            for c, panel in enumerate(row):
                self._layout.addWidget(panel, r, c)
                panel.show()
        for index in range(max(self._layout.rowCount(), self._layout.columnCount())):
            self._layout.setRowStretch(index, int(index < len(self.panels)))
            self._layout.setColumnStretch(index, int(bool(self.panels) and index < len(self.panels[0])))
        self.apply_look()
        self.running_changed.emit()

    def _new_panel(self, plot) -> PlotPanel:
        panel = PlotPanel(plot, self._topics)
        panel.changed.connect(self.changed)
        panel.problem.connect(self.problem)
        panel.running_changed.connect(self.running_changed)
        panel.configure_wanted.connect(lambda: self._configure(panel))
        panel.maximize_wanted.connect(lambda on: self._maximize(panel if on else None))
        panel.view.cursor_moved.connect(lambda place: self._move_cursor(panel, place))
        panel.view.range_chosen.connect(lambda shown: self._link_range(panel, shown))
        panel.view.home_wanted.connect(lambda: self._link_home(panel))
        return panel

    def apply_look(self) -> None:
        """Take over colours and options of the table."""
        for panel in self.all_panels:
            panel.set_colors(QColor(self.table.background_color), QColor(self.table.foreground_color))
            panel.view.track_points = self.table.track_points

    def _configure(self, panel: PlotPanel) -> None:
        dialog = PlotDialog(panel.plot, self._types, self)
        dialog.accepted.connect(lambda: self._configured(panel, dialog))
        self._dialogs.append(dialog)
        dialog.show()

    def _configured(self, panel: PlotPanel, dialog: PlotDialog) -> None:
        if panel in self.all_panels:
            vars(panel.plot).update(vars(dialog.plot))
            panel.apply()
            self.changed.emit()

    def _maximize(self, chosen: PlotPanel | None) -> None:
        for panel in self.all_panels:
            panel.setVisible(chosen is None or panel is chosen)
        for r, row in enumerate(self.panels):
            self._layout.setRowStretch(r, int(chosen is None or chosen in row))
        for c in range(len(self.panels[0])):
            self._layout.setColumnStretch(c, int(chosen is None or any(row[c] is chosen for row in self.panels)))

    # Links

    def _move_cursor(self, panel: PlotPanel, place) -> None:
        for other in self.all_panels if self.table.link_cursor else [panel]:
            other.show_cursor(place)

    def _link_range(self, panel: PlotPanel, shown) -> None:
        if self.table.link_scale:
            for other in self.all_panels:
                if other is not panel:
                    other.show_range(shown)

    def _link_home(self, panel: PlotPanel) -> None:
        if self.table.link_scale:
            for other in self.all_panels:
                if other is not panel:
                    other.go_home()

    # All plots

    def run_all(self) -> None:
        for panel in self.all_panels:
            panel.run()

    def pause_all(self) -> None:
        for panel in self.all_panels:
            panel.pause()

    def clear_all(self) -> None:
        for panel in self.all_panels:
            panel.clear()

    def _take_points(self) -> None:
        for panel in self.all_panels:
            panel.update_points()

    def load_bag(self, name: str) -> None:
        """Show the messages of a bag in place of all points; `bag_done` tells the end."""
        self.stop_bag()
        self.pause_all()
        self.clear_all()
        samplers = [sampler for panel in self.all_panels for sampler in panel.samplers]
        stop = self._bag_stop = threading.Event()

        def progress(share: float) -> bool:
            self.bag_progress.emit(share)
            return not stop.is_set()

        def work() -> None:
            try:
                count, missing = read_bag(name, samplers, progress)
                text = f"{name}: {count} messages read" + (f"; not in the bag: {', '.join(missing)}" if missing else "")
            except BagError as error:
                text = str(error)
            except Exception as error:  # a message type that is broken in the bag: genpy raises many kinds
                text = f"{name} cannot be read: {type(error).__name__}: {str(error).splitlines()[0][:100] if str(error) else ''}"
            self.bag_done.emit(text)

        self._bag_thread = threading.Thread(target=work, daemon=True)
        self._bag_thread.start()
        self._bag_timer.start(50)

    def _bag_ended(self, _text: str) -> None:
        self._bag_timer.stop()
        self._take_points()

    def stop_bag(self) -> None:
        """Stop reading a bag."""
        if self._bag_stop is not None:
            self._bag_stop.set()
            self._bag_thread.join(5)
            self._bag_stop = None

    def close_all(self) -> None:
        """Stop everything; the view is of no use afterwards."""
        self.stop_bag()
        self._bag_timer.stop()
        for panel in self.all_panels:
            panel.pause()
        self._topics.close()

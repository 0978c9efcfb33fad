"""One plot of the table with its bar: run, pause, clear, export, configure, maximise."""

from __future__ import annotations

from python_qt_binding.QtCore import Qt, QTimer, Signal, qWarning
from python_qt_binding.QtGui import QColor, QIcon
from python_qt_binding.QtWidgets import QFileDialog, QHBoxLayout, QLineEdit, QMenu, QToolButton, QVBoxLayout, QWidget

from rqt_multiplot.config import ConfigError, Plot, ScaleType, read_curve
from rqt_multiplot.export import write_image, write_text
from rqt_multiplot.plot_view import PlotView
from rqt_multiplot.points import Points
from rqt_multiplot.sampling import AXES, Sampler
from rqt_multiplot.sources import Topics

_ROOM = 0.03  # of the extent of values, on either side
CURVE_MIME = "application/x-rqt-multiplot-curve"


def tool_button(name: str, icon: str, text: str, tip: str, checkable: bool = False) -> QToolButton:
    """A button with an icon of the desktop's theme, or ``text`` where the theme lacks it.

    :param name: object name
    :param icon: its name in the theme
    :param tip: tool tip
    :param checkable: it stays down until it is clicked again
    """
    button = QToolButton()
    button.setObjectName(name)
    button.setToolTip(tip)
    button.setCheckable(checkable)
    if QIcon.hasThemeIcon(icon):
        button.setIcon(QIcon.fromTheme(icon))
    else:
        button.setText(text)
    return button


class PlotPanel(QWidget):
    """Runs and shows one plot.

    :param plot: its configuration, changed by the user through this panel. :param topics: where messages come from.
    """

    configure_wanted = Signal()
    maximize_wanted = Signal(bool)
    changed = Signal()  #: the configuration
    problem = Signal(str)
    running_changed = Signal()

    def __init__(self, plot: Plot, topics: Topics):
        super().__init__()
        self.plot = plot
        self._topics = topics
        self.running = False
        self._at_home = True
        self._told: set = set()
        self.samplers: list[Sampler] = []
        self.points: list[Points] = []
        self.view = PlotView()
        self._build()
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.update_points)
        self.view.home_wanted.connect(self.go_home)
        self.view.range_chosen.connect(self._leave_home)
        self.setAcceptDrops(True)
        self.apply()

    def _build(self) -> None:
        self.title = QLineEdit()
        self.title.setObjectName("title")
        self.title.setFrame(False)
        self.title.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.title.editingFinished.connect(self._rename)
        self.run_button = tool_button("run", "media-playback-start", "Run", "Run or pause this plot", True)
        self.clear_button = tool_button("clear", "edit-clear", "Clear", "Forget its points")
        self.export_button = tool_button("export", "document-save", "Export", "Export this plot")
        self.configure_button = tool_button("configure", "document-properties", "Configure", "Configure this plot")
        self.maximize_button = tool_button("maximize", "view-fullscreen", "Max", "This plot alone, or all", True)
        menu = QMenu(self)
        menu.addAction("Export to image file...").triggered.connect(lambda _checked=False: self._export("image"))
        menu.addAction("Export to text file...").triggered.connect(lambda _checked=False: self._export("text"))
        self.export_button.setMenu(menu)
        self.export_button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.run_button.clicked.connect(lambda on: self.run() if on else self.pause())
        self.clear_button.clicked.connect(lambda: self.clear())
        self.configure_button.clicked.connect(lambda: self.configure_wanted.emit())
        self.maximize_button.toggled.connect(self.maximize_wanted)
        bar = QHBoxLayout()
        bar.addWidget(self.title, 1)
        for button in (self.run_button, self.clear_button, self.export_button, self.configure_button, self.maximize_button):
            bar.addWidget(button)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(2, 2, 2, 2)
        layout.setSpacing(0)
        layout.addLayout(bar)
        layout.addWidget(self.view, 1)

    # Configuration

    def apply(self) -> None:
        """Take over the configuration as it is now; points are forgotten, a plot that runs goes on."""
        running = self.running
        self.pause()
        self._told.clear()
        self.title.setText(self.plot.title)
        self.samplers = [Sampler(curve) for curve in self.plot.curves]
        self.points = [Points(curve.data) for curve in self.plot.curves]
        self.view.set_curves(self.plot.curves, self.plot.legend.visible)
        self._timer.setInterval(max(10, round(1000 / self.plot.plot_rate)))
        self._at_home = True
        self._set_titles()
        self._follow()
        if running:
            self.run()

    def _rename(self) -> None:
        if self.title.text() != self.plot.title:
            self.plot.title = self.title.text()
            self.changed.emit()

    def set_colors(self, background: QColor, foreground: QColor) -> None:
        """Draw in ``foreground`` on ``background``, the title too."""
        self.view.set_colors(background, foreground)
        self.title.setStyleSheet(f"background: {background.name()}; color: {foreground.name()}")

    def _set_titles(self) -> None:
        for axis, name, which in ((self.view.x_axis, "x_axis", 0), (self.view.y_axis, "y_axis", 1)):
            shown = [(points, sampler) for points, sampler in zip(self.points, self.samplers) if len(points)]
            times = bool(shown) and all(sampler.is_time(name) for _, sampler in shown)
            axis.set_times_from(min((points.x, points.y)[which][0] for points, _ in shown) if times else None)
        self.view.set_titles(self.plot.axis_title("x_axis"), self.plot.axis_title("y_axis"))

    # Running

    def run(self) -> None:
        """Take points of all curves that are configured wholly."""
        if not self.running:
            self.running = True
            for sampler in self.samplers:
                self._topics.add(sampler)
            self._timer.start()
        self._show_running()

    def pause(self) -> None:
        """Take no more points."""
        if self.running:
            self.running = False
            self._timer.stop()
            for sampler in self.samplers:
                self._topics.remove(sampler)
            self.update_points()
        self._show_running()

    def _show_running(self) -> None:
        self.run_button.setChecked(self.running)
        icon = "media-playback-pause" if self.running else "media-playback-start"
        if QIcon.hasThemeIcon(icon):
            self.run_button.setIcon(QIcon.fromTheme(icon))
        else:
            self.run_button.setText("Pause" if self.running else "Run")
        self.running_changed.emit()

    def clear(self) -> None:
        """Forget all points."""
        for sampler, points in zip(self.samplers, self.points):
            sampler.reset()
            points.clear()
        self._at_home = True
        self._redraw()

    def update_points(self) -> None:
        """Take over the points that came, and draw them."""
        arrived = False
        for sampler, points in zip(self.samplers, self.points):
            new = sampler.take()
            if new:
                points.append(new, sampler.is_time("x_axis"))
                arrived = True
            if sampler.problem and sampler.problem not in self._told:
                self._told.add(sampler.problem)
                self.problem.emit(sampler.problem)
        if arrived:
            self._redraw()

    def _redraw(self) -> None:
        self._set_titles()
        self._follow()
        for index, (curve, points) in enumerate(zip(self.plot.curves, self.points)):
            self.view.draw(index, curve, points)

    # Range

    def preferred_range(self) -> tuple[tuple[float, float] | None, tuple[float, float] | None]:
        """What the scales of the curves want to see: x, y; None while nothing is known."""
        wanted: tuple[list, list] = ([], [])
        for curve, points, sampler in zip(self.plot.curves, self.points, self.samplers):
            bounds = points.bounds()
            for which, (values, axis) in enumerate(((points.x, curve.axes.x_axis), (points.y, curve.axes.y_axis))):
                scale, bound = axis.scale, bounds[which]
                if scale.type == ScaleType.ABSOLUTE:
                    wanted[which].append((scale.absolute_minimum, scale.absolute_maximum))
                elif scale.type == ScaleType.RELATIVE and len(values):
                    wanted[which].append((values[-1] + scale.relative_minimum, values[-1] + scale.relative_maximum))
                elif scale.type == ScaleType.AUTO and bound is not None:
                    low, high = bound
                    room = 0.0 if sampler.is_time(AXES[which]) else _ROOM * (high - low)  # a curve on the frame is not seen
                    wanted[which].append((low - room, high + room))
        x, y = ((min(low for low, _ in pairs), max(high for _, high in pairs)) if pairs else None for pairs in wanted)
        return x, y

    def _follow(self) -> None:
        if self._at_home:
            self.view.show_range(*self.preferred_range())

    def go_home(self) -> None:
        """Show what the scales want to see, from now on."""
        self._at_home = True
        self._redraw()

    def _leave_home(self, _range=None) -> None:
        self._at_home = False
        self._redraw_curves()

    def show_range(self, shown) -> None:
        """Show a range that another plot was moved to."""
        self._at_home = False
        self.view.show_range(*shown)
        self._redraw_curves()

    def _redraw_curves(self) -> None:
        for index, (curve, points) in enumerate(zip(self.plot.curves, self.points)):
            self.view.draw(index, curve, points)

    def show_cursor(self, place) -> None:
        names = {f"{index + 1} {curve.title}": points for index, (curve, points) in enumerate(zip(self.plot.curves, self.points))}
        self.view.show_cursor(place, names)

    # Curves from elsewhere

    def dragEnterEvent(self, event) -> None:
        if event.mimeData().hasFormat(CURVE_MIME):
            event.acceptProposedAction()

    def dropEvent(self, event) -> None:
        self.add_curve_text(bytes(event.mimeData().data(CURVE_MIME)).decode())
        event.acceptProposedAction()

    def add_curve_text(self, text: str) -> None:
        """Add a curve from the clipboard or a drag."""
        try:
            self.plot.curves.append(read_curve(text))
        except ConfigError as error:
            qWarning(f"rqt_multiplot: {error}")
            return
        self.apply()
        self.changed.emit()

    def _export(self, kind: str) -> None:
        suggestion, pattern = {
            "image": ("rqt_multiplot.png", "Portable Network Graphics (*.png)"),
            "text": ("rqt_multiplot.txt", "Text (*.txt)"),
        }[kind]
        name, _ = QFileDialog.getSaveFileName(self, f"Export to {kind} file", suggestion, pattern)
        if name:
            try:
                write_image(name, [[self]]) if kind == "image" else write_text(name, [self])
            except OSError as error:
                self.problem.emit(str(error))

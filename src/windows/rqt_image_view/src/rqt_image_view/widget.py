"""The tool bar of the image view, and the picture below it. It knows no ROS."""

from __future__ import annotations

from python_qt_binding.QtCore import QSize, Qt, Signal, qWarning
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QScrollArea,
    QSizePolicy,
    QSpinBox,
    QToolButton,
    QVBoxLayout,
    QWidget,
)
from qt_gui.application.compatibility import QAction

from rqt_image_view.canvas import Canvas
from rqt_image_view.pictures import COLOR_SCHEMES, DepthView


class _Scroll(QScrollArea):
    """As large as what is in it would like to be."""

    def sizeHint(self) -> QSize:
        return self.widget().sizeHint()


class ImageViewWidget(QWidget):
    """Controls and canvas; who owns it connects them to a topic."""

    depth_changed = Signal(object)  #: DepthView

    def __init__(self):
        super().__init__()
        self.setObjectName("ImageView")
        self.canvas = Canvas()
        self._click_topic_suggested = ""
        self._make_controls()
        self._lay_out()
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.hide_toolbar = self._context_action("Hide toolbar")
        self.hide_toolbar.toggled.connect(lambda hidden: self.toolbar.setHidden(hidden))

    def _context_action(self, text: str) -> QAction:
        made = QAction(text, self)
        made.setCheckable(True)
        self.addAction(made)
        return made

    def _button(self, name: str, icon: str, text: str, tip: str, checkable: bool = False) -> QToolButton:
        button = QToolButton()
        button.setObjectName(name)
        if QIcon.hasThemeIcon(icon):
            button.setIcon(QIcon.fromTheme(icon))
        else:
            button.setText(text)
        button.setToolTip(tip)
        button.setCheckable(checkable)
        return button

    def _make_controls(self) -> None:
        self.topics = QComboBox()
        self.topics.setObjectName("topics_combo_box")
        # A long name must not make the window wide; the list of choices is as wide as it needs.
        self.topics.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.topics.setMinimumContentsLength(12)
        self.topics.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.refresh_button = self._button("refresh_topics_push_button", "view-refresh", "Refresh", "Look for image topics")
        self.zoom = self._button("zoom_1_push_button", "zoom-original", "1:1", "One pixel of the image per pixel of the screen", True)
        self.grid = QSpinBox()
        self.grid.setObjectName("num_gridlines_spin_box")
        self.grid.setPrefix("# ")
        self.grid.setRange(0, 100)
        self.grid.setToolTip("Number of grid lines")
        self.dynamic = QCheckBox("Dynamic depth range")
        self.dynamic.setObjectName("dynamic_range_check_box")
        self.dynamic.setToolTip("From the nearest to the farthest point instead of 0 to the maximum")
        self.max_depth = QDoubleSpinBox()
        self.max_depth.setObjectName("max_range_double_spin_box")
        self.max_depth.setRange(0.01, 10000.0)
        self.max_depth.setValue(10.0)
        self.max_depth.setSuffix(" m")
        self.max_depth.setToolTip("Depth that is shown white")
        self.scheme = QComboBox()
        self.scheme.setObjectName("color_scheme_combo_box")
        self.scheme.addItems(COLOR_SCHEMES)
        self.scheme.setCurrentText(DepthView().scheme)
        self.scheme.setToolTip("Colours of depth images")
        self.save_button = self._button("save_as_image_push_button", "document-save-as", "Save", "Save as image")
        self.smooth = QCheckBox("Smooth scaling")
        self.smooth.setObjectName("smooth_image_check_box")
        self.rotate_left = self._button("rotate_left_push_button", "object-rotate-left", "\u21b6", "Rotate left")
        self.rotate_right = self._button("rotate_right_push_button", "object-rotate-right", "\u21b7", "Rotate right")
        self.rotation = QLabel("0\u00b0")
        self.publish_click = QCheckBox("Publish click location")
        self.publish_click.setObjectName("publish_click_location_check_box")
        self.click_topic = QLineEdit()
        self.click_topic.setObjectName("publish_click_location_topic_line_edit")
        self.click_topic.setToolTip("Topic for the pixel that is clicked, a geometry_msgs/Point")
        self.zoom.toggled.connect(lambda _on: self._look_changed())
        self.grid.valueChanged.connect(lambda _number: self._look_changed())
        self.smooth.toggled.connect(lambda _on: self._look_changed())
        self.rotate_left.clicked.connect(lambda: self._rotate(-1))
        self.rotate_right.clicked.connect(lambda: self._rotate(1))
        self.dynamic.toggled.connect(self._dynamic_changed)
        self.max_depth.valueChanged.connect(lambda _value: self._depth_changed())
        self.scheme.currentTextChanged.connect(lambda _name: self._depth_changed())

    def _lay_out(self) -> None:
        self.toolbar = QWidget()
        grid = QGridLayout(self.toolbar)
        grid.setContentsMargins(0, 0, 0, 0)
        rows = (
            (
                self.topics,
                self.refresh_button,
                self.zoom,
                self.grid,
                self.save_button,
                self.rotate_left,
                self.rotation,
                self.rotate_right,
                self.smooth,
            ),
            (self.dynamic, self.max_depth, self.scheme, self.publish_click, self.click_topic),
        )
        for number, row in enumerate(rows):
            line = QHBoxLayout()
            for widget in row:
                line.addWidget(widget)
            grid.addLayout(line, number, 0)
        scroll = _Scroll()
        scroll.setWidgetResizable(True)
        scroll.setWidget(self.canvas)
        layout = QVBoxLayout(self)
        layout.addWidget(self.toolbar)
        layout.addWidget(scroll, 1)

    def _look_changed(self) -> None:
        self.canvas.original_size = self.zoom.isChecked()
        self.canvas.grid_lines = self.grid.value()
        self.canvas.smooth = self.smooth.isChecked()
        self.rotation.setText(f"{90 * self.canvas.quarters}\u00b0")
        self.canvas.changed()

    def _rotate(self, quarters: int) -> None:
        self.canvas.quarters = (self.canvas.quarters + quarters) % 4
        self._look_changed()

    def depth_view(self) -> DepthView:
        """How depth is to be shown now."""
        return DepthView(self.max_depth.value(), self.dynamic.isChecked(), self.scheme.currentText())

    def _dynamic_changed(self, on: bool) -> None:
        self.max_depth.setEnabled(not on)
        self._depth_changed()

    def _depth_changed(self) -> None:
        self.depth_changed.emit(self.depth_view())

    # Topics

    def list_topics(self, names: list[str]) -> None:
        """Offer these topics and the one that is selected; nothing else changes."""
        selected = self.topics.currentText()
        blocked = self.topics.blockSignals(True)
        self.topics.clear()
        self.topics.addItems([""] + names + ([selected] if selected and selected not in names else []))
        self.topics.setCurrentText(selected)
        self.topics.blockSignals(blocked)

    def select_topic(self, topic: str) -> None:
        if self.topics.findText(topic) < 0:
            self.topics.addItem(topic)
        self.topics.setCurrentText(topic)

    def suggest_click_topic(self, topic: str) -> bool:
        """Name the topic of clicks after an image topic, unless the user has named it. :returns: whether it changed."""
        if self.click_topic.text() != self._click_topic_suggested:
            return False
        self._click_topic_suggested = f"{topic}_mouse_left" if topic else ""
        self.click_topic.setText(self._click_topic_suggested)
        return True

    # Settings, under upstream's names

    def settings(self) -> dict[str, object]:
        return {
            "topic": self.topics.currentText(),
            "zoom1": self.zoom.isChecked(),
            "dynamic_range": self.dynamic.isChecked(),
            "max_range": self.max_depth.value(),
            "publish_click_location": self.publish_click.isChecked(),
            "mouse_pub_topic": self.click_topic.text(),
            "toolbar_hidden": self.hide_toolbar.isChecked(),
            "num_gridlines": self.grid.value(),
            "smooth_image": self.smooth.isChecked(),
            "rotate": self.canvas.quarters,
            "color_scheme": self.scheme.currentIndex(),
        }

    def restore(self, saved: dict[str, object]) -> None:
        """Take over what :meth:`settings` gave; values may have become text. What is unfit is left out with a line."""

        def truth(value):
            return value in (True, "true")

        setters = {
            "zoom1": lambda v: self.zoom.setChecked(truth(v)),
            "dynamic_range": lambda v: self.dynamic.setChecked(truth(v)),
            "max_range": lambda v: self.max_depth.setValue(float(v)),
            "publish_click_location": lambda v: self.publish_click.setChecked(truth(v)),
            "mouse_pub_topic": lambda v: self.click_topic.setText(str(v)),
            "toolbar_hidden": lambda v: self.hide_toolbar.setChecked(truth(v)),
            "num_gridlines": lambda v: self.grid.setValue(int(v)),
            "smooth_image": lambda v: self.smooth.setChecked(truth(v)),
            "rotate": lambda v: setattr(self.canvas, "quarters", int(v) % 4),
            "color_scheme": lambda v: self.scheme.setCurrentIndex(max(0, int(v))),
        }
        for key, value in saved.items():
            try:
                setters.get(key, lambda _value: None)(value)
            except (TypeError, ValueError):
                qWarning(f"rqt_image_view: the saved setting {key} is no number; it is left out")
        self._look_changed()

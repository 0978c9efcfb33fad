"""The window: buttons, the time line, the status."""

from __future__ import annotations

import threading
import time

import rosgraph
from python_qt_binding.QtCore import QSize, Qt, Signal, qWarning
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QFileDialog,
    QGraphicsView,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rqt_bag.bag_helper import filesize_to_str
from rqt_bag.bag_timeline import BagTimeline
from rqt_bag.timeline_frame import TimelineFrame, date_text
from rqt_bag.timeline_menu import TimelinePopupMenu
from rqt_bag.topic_selection import TopicSelection


class BagGraphicsView(QGraphicsView):
    """A plain view, for time lines of other packages that are scenes."""


class BagWidget(QWidget):
    """A time line with its controls. :param publish_clock: publish the playhead's time on /clock while it moves."""

    _topics_found = Signal(object)

    def __init__(self, context, publish_clock: bool = False):
        super().__init__()
        self.setObjectName("BagWidget")
        self.setWindowTitle("Bag")
        self._timeline = timeline = BagTimeline(context, publish_clock)
        self.frame = TimelineFrame(timeline)
        self._popups: dict = {}
        self._build()
        self.frame.menu_wanted.connect(self._open_menu)
        timeline.status_bar_changed_signal.connect(self._update_status)
        timeline.play_state_changed.connect(self._update_controls)
        timeline.messages_changed.connect(self._update_controls)
        timeline.recording_changed.connect(self._update_controls)
        timeline.selected_region_changed.connect(lambda *_: self._update_controls())
        timeline.problem.connect(self.tell)
        timeline.progress.connect(self._show_progress)
        self._topics_found.connect(self._ask_topics)
        self._update_controls()

    def _build(self) -> None:
        timeline, frame, bar = self._timeline, self.frame, QHBoxLayout()
        buttons = (
            ("record", "media-record", "Record", "Record topics, or stop", self.record),
            ("load", "document-open", "Load", "Load bags", self.ask_load),
            ("save", "document-save", "Save", "Save the marked region as a bag", self.ask_save),
            None,
            ("begin", "media-skip-backward", "|<", "To the beginning (Home)", timeline.navigate_start),
            ("slower", "media-seek-backward", "<<", "Slower, or back (-)", timeline.navigate_rewind),
            ("previous", "go-previous", "<", "Previous message", timeline.navigate_previous),
            ("play", "media-playback-start", "Play", "Play or pause (Space)", timeline.toggle_play),
            ("next", "go-next", ">", "Next message", timeline.navigate_next),
            ("faster", "media-seek-forward", ">>", "Faster (+)", timeline.navigate_fastforward),
            ("end", "media-skip-forward", ">|", "To the end (End)", timeline.navigate_end),
            None,
            ("zoom_in", "zoom-in", "+", "Zoom in (Up)", frame.zoom_in),
            ("zoom_out", "zoom-out", "-", "Zoom out (Down)", frame.zoom_out),
            ("zoom_home", "zoom-original", "All", "Show all", frame.reset_zoom),
            None,
            ("thumbnails", "insert-image", "Thumbnails", "Thumbnails on the time line, or none", frame.toggle_renderers),
        )
        self.buttons = {}
        for entry in buttons:
            if entry is None:
                bar.addSpacing(12)
                continue
            name, icon, text, tip, action = entry
            button = self.buttons[name] = QToolButton()
            button.setObjectName(name)
            button.setToolTip(tip)
            if QIcon.hasThemeIcon(icon):
                button.setIcon(QIcon.fromTheme(icon))
            else:
                button.setText(text)
            button.clicked.connect(lambda _checked=False, action=action: action())
            bar.addWidget(button)
        bar.addStretch()
        self.buttons["record"].setCheckable(True)
        scroll = QScrollArea()
        scroll.setWidgetResizable(True)
        scroll.setWidget(self.frame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addWidget(scroll, 1)
        self._build_status(layout)

    def _build_status(self, layout: QVBoxLayout) -> None:
        status = QHBoxLayout()
        self.stamp_label, self.date_label, self.seconds_label, self.speed_label, self.size_label = (QLabel() for _ in range(5))
        for name in ("stamp", "date", "seconds", "speed", "size"):
            label = getattr(self, f"{name}_label")
            label.setObjectName(f"{name}_label")
            status.addWidget(label)
        self.message = QLabel()
        self.message.setObjectName("message")
        self.message.setWordWrap(True)
        self.progress_bar = QProgressBar()
        self.progress_bar.hide()
        status.addStretch()
        status.addWidget(self.progress_bar)
        layout.addWidget(self.message)
        layout.addLayout(status)
        self.message.hide()

    def sizeHint(self) -> QSize:
        return QSize(860, 420)

    # State

    def tell(self, text: str) -> None:
        """Show a line below the time line, and on the terminal."""
        qWarning(f"rqt_bag: {text}")
        self.message.setText(text)
        self.message.show()

    def _show_progress(self, text: str, share: float) -> None:
        self.progress_bar.setVisible(bool(text))
        self.progress_bar.setFormat(text)
        self.progress_bar.setMaximum(100 if share else 0)
        self.progress_bar.setValue(round(100 * share))

    def _update_controls(self) -> None:
        there = self.frame.start_stamp is not None
        for name, button in self.buttons.items():
            button.setEnabled(there or name in ("record", "load"))
        playing = bool(self._timeline.play_speed)
        icon = "media-playback-pause" if playing else "media-playback-start"
        if QIcon.hasThemeIcon(icon):
            self.buttons["play"].setIcon(QIcon.fromTheme(icon))
        else:
            self.buttons["play"].setText("Pause" if playing else "Play")
        self.buttons["record"].setChecked(self._timeline.recording)
        self.size_label.setText(filesize_to_str(self._timeline.file_size()))
        self._update_status()

    def _update_status(self) -> None:
        stamp = self.frame.playhead
        if stamp is None:
            return
        self.stamp_label.setText(f"{stamp.to_sec():.9f}s")
        self.date_label.setText(date_text(stamp))
        self.seconds_label.setText(f"{(stamp - self.frame.start_stamp).to_sec():.3f}s")
        speed = self._timeline.play_speed
        self.speed_label.setText(
            ""
            if not speed
            else f"{'>' if speed > 0 else '<'} {abs(speed):g}x"
            if abs(speed) >= 1
            else f"{'>' if speed > 0 else '<'} 1/{1 / abs(speed):g}x"
        )

    def _open_menu(self, place, topic) -> None:
        self._menu = TimelinePopupMenu(self._timeline, topic, self._popups, self)
        self._menu.popup(place)

    def keyPressEvent(self, event) -> None:
        key, timeline, frame = Qt.Key, self._timeline, self.frame
        actions = {
            key.Key_Space: timeline.toggle_play,
            key.Key_Home: timeline.navigate_start,
            key.Key_End: timeline.navigate_end,
            key.Key_Plus: timeline.navigate_fastforward,
            key.Key_Equal: timeline.navigate_fastforward,
            key.Key_Minus: timeline.navigate_rewind,
            key.Key_Left: frame.translate_timeline_left,
            key.Key_Right: frame.translate_timeline_right,
            key.Key_Up: frame.zoom_in,
            key.Key_PageUp: frame.zoom_in,
            key.Key_Down: frame.zoom_out,
            key.Key_PageDown: frame.zoom_out,
        }
        if event.key() in actions:
            actions[event.key()]()
        else:
            super().keyPressEvent(event)

    # Files

    def load_bag(self, name: str) -> None:
        """Open a bag in the background and add it."""
        self._timeline.load_bag(name)

    def ask_load(self) -> None:
        names, _ = QFileDialog.getOpenFileNames(self, "Load from Files", "", "Bag files (*.bag *.mcap);;All files (*)")
        for name in names:
            self.load_bag(name)

    def ask_save(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, "Save selected region", time.strftime("%Y-%m-%d-%H-%M-%S.bag"), "Bag files (*.bag)")
        if name:
            self._timeline.copy_region_to_bag(name)

    def record(self) -> None:
        """Stop recording, or ask what to record."""
        self.buttons["record"].setChecked(self._timeline.recording)
        if self._timeline.recording:
            self._timeline.stop_recording()
            return

        def look() -> None:
            try:
                self._topics_found.emit([name for name, _ in rosgraph.Master("/rqt_bag").getPublishedTopics("/")])
            except (rosgraph.MasterException, OSError) as error:
                self._timeline.problem.emit(f"nothing can be recorded: the master does not answer: {error}")

        threading.Thread(target=look, daemon=True).start()

    def _ask_topics(self, topics) -> None:
        self.selection = TopicSelection(topics)
        self.selection.recordSettingsSelected.connect(self._ask_record_name)
        self.selection.show()

    def _ask_record_name(self, all_topics: bool, topics) -> None:
        name, _ = QFileDialog.getSaveFileName(self, "Select name for new bag", time.strftime("%Y-%m-%d-%H-%M-%S.bag"), "Bag files (*.bag)")
        if name:
            self._timeline.record_bag(name, all_topics, topics)

    def shutdown_all(self) -> None:
        """Stop everything; the window is of no use afterwards."""
        if getattr(self, "selection", None) is not None:
            self.selection.close()
        self._timeline.handle_close()

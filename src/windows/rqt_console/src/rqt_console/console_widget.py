"""The console: table, buttons, rules."""

from types import SimpleNamespace

import rospy
from python_qt_binding.QtCore import QSize, Qt
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QApplication,
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QMenu,
    QMessageBox,
    QPushButton,
    QSplitter,
    QTableView,
    QToolButton,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.empty_text import EmptyText

from . import saved_messages
from .filters import stored
from .message import SEVERITIES
from .message_data_model import COLUMNS, MessageDataModel
from .rule_widgets import RuleBox
from .text_browse_dialog import TextBrowseDialog

_WIDTHS = (60, 320, 70, 140, 240, 140, 200)  # px


class ConsoleWidget(QWidget):
    """``model`` holds the messages; whoever receives them calls :meth:`take`, or inserts them into the model.

    :param proxy_model: a MessageProxyModel of a MessageDataModel to show; a model is made without. :param rospack: not needed here.
    :param minimal: for dashboards: no files, the rules folded away.
    """

    def __init__(self, proxy_model=None, rospack=None, minimal: bool = False, message_limit: int = 20000):
        super().__init__()
        self.setObjectName("ConsoleWidget")
        self.setWindowTitle("Console")
        self.model = MessageDataModel(message_limit) if proxy_model is None else proxy_model.sourceModel()
        exclude, highlight = self.model.exclude_filters, self.model.highlight_filters
        self.exclude_box = RuleBox("Exclude Messages...", exclude, self.model)
        self.highlight_box = RuleBox("Highlight Messages...", highlight, self.model)
        exclude.changed.connect(self.model.refilter)
        highlight.changed.connect(self._highlight_changed)
        self.paused = False
        self.table_view = self._table()
        self._buttons()
        self._arrange()
        if minimal:
            for button in (self.load_button, self.save_button, self.column_button):
                button.hide()
            self.splitter.setSizes([1, 0, 0])
        self.model.counts_changed.connect(self._show_counts)
        self._show_counts()

    def sizeHint(self) -> QSize:
        return QSize(1000, 640)

    def take(self, messages) -> None:
        """Show new messages, unless paused."""
        if messages and not self.paused:
            self.model.insert_rows(messages)

    @property
    def _paused(self) -> bool:  # dashboards look here before they insert messages
        return self.paused

    def get_message_summary(self, start_time_offset: float = 240, end_time_offset: float = 0) -> SimpleNamespace:
        """How many messages of each severity there were, as attributes ``fatal``, ``error``, ``warn``, ``info`` and ``debug``.

        :param start_time_offset: s before now from which on. :param end_time_offset: s before now until when.
        """
        now = rospy.get_time()
        counts = dict.fromkeys(SEVERITIES, 0)
        for message in self.model.messages_since(now - start_time_offset):
            if message.severity in counts and message.stamp[0] + message.stamp[1] * 1e-9 <= now - (end_time_offset or 0):
                counts[message.severity] += 1
        return SimpleNamespace(**{name.lower(): counts[level] for level, name in SEVERITIES.items()})

    def cleanup_browsers_on_close(self) -> None:
        """Close the windows with messages in full."""
        for dialog in self.findChildren(TextBrowseDialog):
            dialog.close()

    def _table(self) -> QTableView:
        table = QTableView()
        table.setObjectName("table_view")
        table.setModel(self.model)
        EmptyText(table, "No message has come yet: nodes write here what they log.")
        table.setSelectionBehavior(QTableView.SelectionBehavior.SelectRows)
        table.setWordWrap(False)
        table.setShowGrid(False)
        table.setAlternatingRowColors(True)
        rows = table.verticalHeader()
        rows.setVisible(False)
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        rows.setDefaultSectionSize(table.fontMetrics().height() + 4)
        header = table.horizontalHeader()
        header.setSortIndicator(0, Qt.SortOrder.DescendingOrder)
        header.setSectionsMovable(True)
        header.setStretchLastSection(True)
        table.setSortingEnabled(True)
        for column, width in enumerate(_WIDTHS):
            table.setColumnWidth(column, width)
        header.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        header.customContextMenuRequested.connect(self._choose_columns)
        table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        table.customContextMenuRequested.connect(lambda place: self.row_menu().popup(table.viewport().mapToGlobal(place)))
        table.doubleClicked.connect(lambda index: self.browse([self.model.message_of_row(index.row())]))
        return table

    def _buttons(self) -> None:
        def button(name, icon, text, tip, call):
            made = QPushButton(QIcon.fromTheme(icon), text)
            made.setObjectName(name)
            made.setToolTip(tip)
            made.clicked.connect(lambda: call())
            return made

        self.load_button = button("load_button", "document-open", "Load", "Load messages from a file; pauses", self.ask_and_load)
        self.save_button = button("save_button", "document-save", "Save", "Save the messages to a file", self.ask_and_save)
        self.pause_button = button(
            "pause_button", "media-playback-pause", "Pause", "Drop new messages", lambda: self.set_paused(not self.paused)
        )
        self.clear_button = button("clear_button", "edit-clear", "Clear", "Delete all messages", self.model.clear)
        self.column_button = button(
            "column_resize_button",
            "zoom-fit-best",
            "Fit Columns",
            "Fit the columns to their contents",
            self.table_view.resizeColumnsToContents,
        )
        self.only_button = QToolButton()
        self.only_button.setObjectName("show_highlighted_button")
        self.only_button.setCheckable(True)
        self.only_button.setText("Show only highlighted rows")
        self.only_button.toggled.connect(self._show_only_highlighted)
        self.counts_label = QLabel()
        self.counts_label.setObjectName("messages_label")

    def _arrange(self) -> None:
        top = QHBoxLayout()
        for widget in (self.load_button, self.save_button, self.pause_button, self.counts_label):
            top.addWidget(widget)
        top.addStretch()
        for widget in (self.clear_button, self.column_button):
            top.addWidget(widget)
        below = QWidget()
        lower = QVBoxLayout(below)
        lower.setContentsMargins(0, 0, 0, 0)
        lower.addWidget(self.highlight_box)
        lower.addWidget(self.only_button)
        self.splitter = QSplitter(Qt.Orientation.Vertical)
        for widget, share in ((self.table_view, 5), (self.exclude_box, 1), (below, 1)):
            self.splitter.addWidget(widget)
            self.splitter.setStretchFactor(self.splitter.count() - 1, share)
        self.splitter.setSizes([380, 90, 120])
        layout = QVBoxLayout(self)
        layout.addLayout(top)
        layout.addWidget(self.splitter)

    def _show_counts(self) -> None:
        self.counts_label.setText(f"Displaying {self.model.rowCount()} of {self.model.message_count} messages")

    def _highlight_changed(self) -> None:
        if self.model.only_highlighted:
            self.model.refilter()
        else:
            self.table_view.viewport().update()

    def _show_only_highlighted(self, on: bool) -> None:
        self.model.only_highlighted = on
        self.model.refilter()

    def set_paused(self, paused: bool) -> None:
        self.paused = paused
        self.pause_button.setText("Resume" if paused else "Pause")
        self.pause_button.setIcon(QIcon.fromTheme("media-record" if paused else "media-playback-pause"))

    # rows

    def selected_messages(self) -> list:
        return [self.model.message_of_row(index.row()) for index in self.table_view.selectionModel().selectedRows()]

    def row_menu(self) -> QMenu:
        """The menu of the selected rows."""
        menu, selected = QMenu(self), self.selected_messages()
        for title, box in (("Exclude", self.exclude_box), ("Highlight", self.highlight_box)):
            into = menu.addMenu(title)
            into.setEnabled(bool(selected))
            for label, kind, values in (
                ("Severity", "severity", lambda m: [m.severity]),
                ("Node", "node", lambda m: [m.node]),
                ("Topic", "topic", lambda m: m.topics),
                ("Selected Message(s)", "message", lambda m: [m.message]),
            ):
                into.addAction(
                    label,
                    lambda box=box, kind=kind, values=values: [
                        box.add_value(kind, value) for value in sorted({v for m in selected for v in values(m)})
                    ],
                )
        menu.addSeparator()
        menu.addAction("Copy Selected", lambda: QApplication.clipboard().setText("".join(m.pretty_print() for m in selected)))
        menu.addAction("Browse Selected", lambda: self.browse(selected))
        return menu

    def browse(self, messages) -> QDialog:
        """Messages in full, to read and copy."""
        dialog = TextBrowseDialog("".join(message.pretty_print() for message in messages), parent=self)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setWindowTitle("Message" if len(messages) == 1 else f"{len(messages)} messages")
        dialog.show()
        return dialog

    def keyPressEvent(self, event) -> None:
        if event.key() == Qt.Key.Key_Delete and self.table_view.hasFocus() and self.model.message_count:
            selected = self.selected_messages()
            if selected:
                self.model.remove_messages(selected)
            elif QMessageBox.question(self, "Delete messages", "Delete all messages?") == QMessageBox.StandardButton.Yes:
                self.model.clear()
        else:
            super().keyPressEvent(event)

    def _choose_columns(self, place) -> None:
        header, menu = self.table_view.horizontalHeader(), QMenu(self)
        for column, name in enumerate(COLUMNS):
            action = menu.addAction(name)
            action.setCheckable(True)
            action.setChecked(not header.isSectionHidden(column))
            action.setEnabled(header.isSectionHidden(column) or header.hiddenSectionCount() < len(COLUMNS) - 1)
            action.toggled.connect(lambda on, column=column: header.setSectionHidden(column, not on))
        menu.popup(header.mapToGlobal(place))

    # files

    def ask_and_load(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, "Load messages", ".", "Messages (*.csv);;All files (*)")
        if path:
            self.load(path)

    def load(self, path: str) -> None:
        try:
            messages = saved_messages.load(path)
        except saved_messages.SavedMessagesError as error:
            QMessageBox.warning(self, "Load messages", str(error))
            return
        self.set_paused(True)
        self.model.clear()
        self.model.insert_rows(messages)

    def ask_and_save(self) -> None:
        path, _ = QFileDialog.getSaveFileName(self, "Save messages", "messages.csv", "Messages (*.csv);;All files (*)")
        if path:
            try:
                saved_messages.save(path if "." in path.rsplit("/", 1)[-1] else path + ".csv", self.model.messages())
            except OSError as error:
                QMessageBox.warning(self, "Save messages", f"{path}: {error.strerror}")

    # settings

    def save_settings(self, plugin_settings, settings) -> None:
        """Store columns, rules and what is paused in ``settings``, of the instance; ``plugin_settings`` are left alone."""
        header = self.table_view.horizontalHeader()
        settings.set_value("hidden_columns", [str(column) for column in range(len(COLUMNS)) if header.isSectionHidden(column)])
        settings.set_value("header_state", header.saveState())
        settings.set_value("splitter_sizes", self.splitter.saveState())
        stored.store(settings, "exclude", self.exclude_box.state())
        stored.store(settings, "highlight", self.highlight_box.state())
        settings.set_value("show_highlighted_only", self.only_button.isChecked())
        settings.set_value("paused", self.paused)

    def restore_settings(self, plugin_settings, settings) -> None:
        """Take back what :meth:`save_settings` stored in ``settings``; ``plugin_settings`` are not read."""
        for key, restore in (
            ("header_state", self.table_view.horizontalHeader().restoreState),
            ("splitter_sizes", self.splitter.restoreState),
        ):
            if settings.contains(key):
                restore(settings.value(key))
        self.exclude_box.restore(stored.load(settings, "exclude", [["severity", True, {}]]))
        self.highlight_box.restore(stored.load(settings, "highlight", [["message", True, {}]]))
        self.only_button.setChecked(settings.value("show_highlighted_only") in (True, "true"))
        self.set_paused(settings.value("paused") in (True, "true"))

"""The window: which configuration, the bar of the table, the table."""

from __future__ import annotations

from pathlib import Path

from python_qt_binding.QtCore import QSize, Signal, qWarning
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QMenu,
    QMessageBox,
    QProgressBar,
    QSpinBox,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rqt_multiplot.config import ConfigError, Table, read, write
from rqt_multiplot.curve_dialog import ColorButton
from rqt_multiplot.export import write_image, write_text
from rqt_multiplot.panel import tool_button
from rqt_multiplot.table_view import TableView
from rqt_multiplot.urls import UrlError, to_path, to_url

MOST_HISTORY = 10


class MultiplotWidget(QWidget):
    """A table of plots with its configuration file.

    :param types: knows the topics that there are, as `rqt_plot.rosplot.TopicTypes`.
    """

    title_changed = Signal(str)

    def __init__(self, types):
        super().__init__()
        self.setObjectName("MultiplotWidget")
        self.url = ""  # of the configuration that is shown; empty for one without a file
        self.modified = False
        self.view = TableView(types)
        self._build()
        self.view.changed.connect(self._changed)
        self.view.problem.connect(self.tell)
        self.view.bag_progress.connect(lambda share: self.progress.setValue(round(100 * share)))
        self.view.bag_done.connect(self._bag_done)
        self._show_table()

    def _build(self) -> None:
        config_bar = QHBoxLayout()
        self.history = QComboBox()
        self.history.setObjectName("configs")
        self.history.setEditable(True)
        self.history.setToolTip("Configuration: a file, or file://, home://, package://NAME/...; Enter opens it")
        self.history.activated.connect(lambda _index: self._open_typed())
        self.history.lineEdit().returnPressed.connect(self._open_typed)
        config_bar.addWidget(QLabel("Config"))
        config_bar.addWidget(self.history, 1)
        for name, icon, text, tip, action in (
            ("new", "document-new", "New", "New configuration", self.new),
            ("open", "document-open", "Open", "Open configuration", self.ask_open),
            ("save", "document-save", "Save", "Save configuration", self.save),
            ("save_as", "document-save-as", "Save as", "Save configuration as", self.ask_save_as),
        ):
            button = tool_button(name, icon, text, tip)
            button.clicked.connect(lambda _checked=False, action=action: action())
            config_bar.addWidget(button)
        self.status = QLabel()
        self.status.setObjectName("status")
        self.status.setWordWrap(True)
        self.status.hide()
        self.progress = QProgressBar()
        self.progress.hide()
        layout = QVBoxLayout(self)
        layout.addLayout(config_bar)
        layout.addLayout(self._table_bar())
        layout.addWidget(self.view, 1)
        layout.addWidget(self.progress)
        layout.addWidget(self.status)

    def _table_bar(self) -> QHBoxLayout:
        bar = QHBoxLayout()
        self.rows, self.columns = QSpinBox(), QSpinBox()
        for label, box in (("Rows", self.rows), ("Columns", self.columns)):
            box.setRange(1, 10)
            box.setObjectName(label.lower())
            box.valueChanged.connect(lambda _value: self._reshape())
            bar.addWidget(QLabel(label))
            bar.addWidget(box)
        self.background = ColorButton("#ffffff", lambda color: self._set("background_color", color))
        self.foreground = ColorButton("#000000", lambda color: self._set("foreground_color", color))
        self.background.setToolTip("Background colour")
        self.foreground.setToolTip("Foreground colour")
        bar.addWidget(self.background)
        bar.addWidget(self.foreground)
        self.options = {}
        for key, text in (("link_scale", "Link scale"), ("link_cursor", "Link cursor"), ("track_points", "Track points")):
            box = self.options[key] = QCheckBox(text)
            box.setObjectName(key)
            box.clicked.connect(lambda on, key=key: self._set(key, on))
            bar.addWidget(box)
        bar.addStretch()
        for name, icon, text, tip, action in (
            ("run_all", "media-playback-start", "Run", "Run all plots", self.view.run_all),
            ("pause_all", "media-playback-pause", "Pause", "Pause all plots", self.view.pause_all),
            ("clear_all", "edit-clear", "Clear", "Clear all plots", self.view.clear_all),
        ):
            button = tool_button(name, icon, text, tip)
            button.clicked.connect(lambda _checked=False, action=action: action())
            bar.addWidget(button)
        menu = QMenu(self)
        for text, action in (
            ("Import from bag file...", self.ask_bag),
            ("Export to image file...", self.ask_image),
            ("Export to text file...", self.ask_text),
        ):
            menu.addAction(text).triggered.connect(lambda _checked=False, action=action: action())
        files = tool_button("files", "document-save-as", "Import/Export", "Import from bag file, export to image or text")
        files.setText("Import/Export")
        files.setMenu(menu)
        files.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        bar.addWidget(files)
        return bar

    def sizeHint(self) -> QSize:
        return QSize(900, 600)

    # The table

    def tell(self, text: str) -> None:
        """Show a line below the table, and on the terminal."""
        qWarning(f"rqt_multiplot: {text}")
        self.status.setText(text)
        self.status.setVisible(bool(text))

    def _changed(self) -> None:
        self.modified = True
        self._show_title()

    def _set(self, key: str, value) -> None:
        setattr(self.view.table, key, value)
        self.view.apply_look()
        self._changed()

    def _reshape(self) -> None:
        shape = self.rows.value(), self.columns.value()
        if shape != self.view.table.shape:
            self.view.table.resize(*shape)
            self.view.set_table(self.view.table)
            self._changed()

    def _show_table(self) -> None:
        table = self.view.table
        for box, value in zip((self.rows, self.columns), table.shape):
            blocked = box.blockSignals(True)
            box.setMaximum(max(10, value))
            box.setValue(value)
            box.blockSignals(blocked)
        self.background.set_color(table.background_color)
        self.foreground.set_color(table.foreground_color)
        for key, box in self.options.items():
            box.setChecked(getattr(table, key))
        self._show_title()

    def _show_title(self) -> None:
        name = Path(self.url.partition("://")[2] or self.url).name if self.url else ""
        self.history.setEditText(self.url)
        self.title_changed.emit("Multiplot" + (f" - {name}" if name else "") + ("*" if self.modified else ""))

    # Configurations

    def may_leave(self) -> bool:
        """Ask what to do with changes that are not saved. :returns: whether to go on."""
        if not self.modified:
            return True
        button = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self, "rqt_multiplot", "The configuration has been changed. Save it?", button.Save | button.Discard | button.Cancel, button.Save
        )
        return self.save() if answer == button.Save else answer == button.Discard

    def unsaved(self) -> str:
        """The configuration as text if it has changes that no file has, else ""."""
        return write(self.view.table) if self.modified else ""

    def restore_unsaved(self, text: str, url: str) -> None:
        """Take up again ``text``, what :meth:`unsaved` gave when the window was closed.

        :param url: of the file that it was read from; "" for none
        """
        try:
            self._take(read(text)[0], url)
        except ConfigError as error:
            self.tell(str(error))
            return
        self._changed()

    def new(self) -> None:
        if self.may_leave():
            self._take(Table(), "")

    def _take(self, table: Table, url: str) -> None:
        self.view.set_table(table)
        self.url, self.modified = url, False
        if url:
            self.set_history([url] + self.get_history())
        self._show_table()

    def load(self, url: str) -> bool:
        """Show the configuration of a URL or file; what is wrong is told, and the table stays as it is."""
        try:
            path = to_path(url)
            table, problems = read(path.read_text(encoding="utf-8"), str(path))
        except (ConfigError, UrlError) as error:
            self.tell(str(error))
            return False
        except (OSError, UnicodeDecodeError) as error:
            self.tell(f"{url} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}")
            return False
        self._take(table, url if "://" in url else to_url(path))
        self.tell("; ".join(problems)) if problems else self.status.hide()
        return True

    def save(self) -> bool:
        """Write the configuration to its file; asks for one if there is none. :returns: whether it is saved."""
        return self.save_as(self.url) if self.url else self.ask_save_as()

    def save_as(self, url: str) -> bool:
        try:
            path = to_path(url)
            path.write_text(write(self.view.table), encoding="utf-8")
        except (OSError, UrlError) as error:
            self.tell(f"{url} cannot be written: {getattr(error, 'strerror', None) or error}")
            return False
        self.url, self.modified = url if "://" in url else to_url(path), False
        self.set_history([self.url] + self.get_history())
        self._show_title()
        return True

    def _open_typed(self) -> None:
        url = self.history.currentText().strip()
        if url and url != self.url and self.may_leave():
            self.load(url)

    def ask_open(self) -> None:
        if self.may_leave():
            name, _ = QFileDialog.getOpenFileName(self, "Open Configuration", "", "Multiplot configurations (*.xml);;All files (*)")
            if name:
                self.load(name)

    def ask_save_as(self) -> bool:
        name, _ = QFileDialog.getSaveFileName(self, "Save Configuration", "rqt_multiplot.xml", "Multiplot configurations (*.xml)")
        return self.save_as(name) if name else False

    def get_history(self) -> list[str]:
        return [self.history.itemText(index) for index in range(self.history.count())]

    def set_history(self, urls: list[str]) -> None:
        text = self.history.currentText()
        self.history.clear()
        self.history.addItems(list(dict.fromkeys(urls))[:MOST_HISTORY])
        self.history.setEditText(text)

    # Files of data

    def _ask_name(self, title: str, suggestion: str, pattern: str, existing: bool = False) -> str | None:
        ask = QFileDialog.getOpenFileName if existing else QFileDialog.getSaveFileName
        return ask(self, title, suggestion, pattern)[0] or None

    def ask_bag(self) -> None:
        name = self._ask_name("Import from bag file", "", "Bags (*.bag);;All files (*)", existing=True)
        if name:
            self.load_bag(name)

    def load_bag(self, name: str) -> None:
        """Show the messages of a bag in place of all points."""
        self.progress.setValue(0)
        self.progress.show()
        self.view.load_bag(name)

    def _bag_done(self, text: str) -> None:
        self.progress.hide()
        self.tell(text)

    def ask_image(self) -> None:
        name = self._ask_name("Export to image file", "rqt_multiplot.png", "Portable Network Graphics (*.png)")
        if name:
            self.export_image(name)

    def ask_text(self) -> None:
        name = self._ask_name("Export to text file", "rqt_multiplot.txt", "Text (*.txt)")
        if name:
            self.export_text(name)

    def export_image(self, name: str) -> None:
        self._export(lambda: write_image(name, self.view.panels))

    def export_text(self, name: str) -> None:
        self._export(lambda: write_text(name, self.view.all_panels))

    def _export(self, write_file) -> None:
        try:
            write_file()
        except OSError as error:
            self.tell(str(error))

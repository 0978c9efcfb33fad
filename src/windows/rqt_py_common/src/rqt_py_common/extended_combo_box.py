"""A combo box that is searched by typing any part of an entry."""

from python_qt_binding.QtCore import QSortFilterProxyModel, Qt, Signal
from python_qt_binding.QtWidgets import QComboBox, QCompleter


class ExtendedComboBox(QComboBox):
    """``setItems.emit(list)`` fills it from any thread and keeps what is chosen, if that is still in the list."""

    setItems = Signal(list)

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setEditable(True)
        self.filter_model = QSortFilterProxyModel(self)
        self.filter_model.setFilterCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.filter_model.setSourceModel(self.model())
        self.completer = QCompleter(self.filter_model, self)
        self.completer.setCompletionMode(QCompleter.CompletionMode.UnfilteredPopupCompletion)  # the model has filtered
        self.setCompleter(self.completer)
        self.lineEdit().textEdited.connect(self.filter_model.setFilterFixedString)
        self.completer.activated[str].connect(self.on_completer_activated)
        self.setItems.connect(self.onSetItems)

    def on_completer_activated(self, text):
        if text:
            self.setCurrentIndex(self.findText(text))

    def setModel(self, model):
        super().setModel(model)
        self.filter_model.setSourceModel(model)
        self.completer.setModel(self.filter_model)

    def setModelColumn(self, column):
        self.completer.setCompletionColumn(column)
        self.filter_model.setFilterKeyColumn(column)
        super().setModelColumn(column)

    def onSetItems(self, items):
        chosen = self.currentText()
        self.clear()
        self.addItems(items)
        index = self.findText(chosen)
        if chosen and index >= 0:
            self.setCurrentIndex(index)

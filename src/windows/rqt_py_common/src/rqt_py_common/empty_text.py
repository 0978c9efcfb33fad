"""What a list says while there is nothing in it."""

import contextlib

from python_qt_binding.QtCore import QObject, Qt
from python_qt_binding.QtWidgets import QLabel, QVBoxLayout


class EmptyText(QObject):
    """A text over an item view as long as its model has no rows. Kept by the view.

    :param view: a ``QAbstractItemView`` that has its model
    """

    def __init__(self, view, text):
        super().__init__(view)
        self._view = view
        self.label = QLabel(text)
        self.label.setObjectName("empty_text")
        self.label.setWordWrap(True)
        self.label.setMargin(12)
        self.label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        layout = QVBoxLayout(view.viewport())
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.label)
        model = view.model()
        for signal in (model.rowsInserted, model.rowsRemoved, model.modelReset, model.layoutChanged):
            signal.connect(self.look)
        self.look()

    def set_text(self, text):
        self.label.setText(text)

    def look(self, *_):
        with contextlib.suppress(RuntimeError):  # the view goes, and its model with its rows
            self.label.setVisible(self._view.model().rowCount() == 0)

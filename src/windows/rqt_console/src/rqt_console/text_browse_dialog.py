"""A window with a text to read and copy."""

from python_qt_binding.QtWidgets import QDialog, QDialogButtonBox, QTextEdit, QVBoxLayout


class TextBrowseDialog(QDialog):
    """:param text: what it shows. :param rospack: not needed here; other packages give it."""

    def __init__(self, text, rospack=None, parent=None):
        super().__init__(parent)
        self.resize(700, 400)
        self.text_browser = QTextEdit()
        self.text_browser.setObjectName("message_text")
        self.text_browser.setReadOnly(True)
        self.text_browser.setPlainText(text)
        close = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close.rejected.connect(self.close)
        layout = QVBoxLayout(self)
        layout.addWidget(self.text_browser)
        layout.addWidget(close)

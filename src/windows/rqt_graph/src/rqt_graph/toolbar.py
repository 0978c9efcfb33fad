"""Rows of small controls, each found by its object name."""

from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton


class Row(QHBoxLayout):
    """One row of controls above a graph."""

    def button(self, name, icon, text, tip, slot):
        """A button with the theme's ``icon``, or with ``text`` where the theme has none; ``slot()`` is called when it is clicked.

        :param name: object name
        :param tip: tool tip
        """
        button = QPushButton()
        button.setObjectName(name)
        button.setToolTip(tip)
        themed = QIcon.fromTheme(icon)
        button.setIcon(themed) if not themed.isNull() else button.setText(text)
        button.clicked.connect(lambda checked=False: slot())
        self.addWidget(button)
        return button

    def check(self, name, text, tip, on, slot):
        """A check box with ``text`` beside it, checked if ``on``; ``slot()`` is called when that changes.

        :param name: object name
        :param tip: tool tip
        """
        box = QCheckBox(text)
        box.setObjectName(name)
        box.setToolTip(tip)
        box.setChecked(on)
        box.toggled.connect(lambda checked: slot())
        self.addWidget(box)
        return box

    def label(self, text):
        self.addWidget(QLabel(text))

    def file_buttons(self, pane, stem, load=None):
        """Load DOT, save DOT, SVG, picture: under upstream's names.

        :param pane: the GraphPane that is saved
        :param stem: of the file names that are proposed
        :param load: called for the first button; None: ``pane`` asks for a file
        """
        self.button("load_dot_push_button", "document-open", "Load", "Load DOT graph from file", load or pane.ask_load_dot)
        self.button("save_dot_push_button", "document-save-as", "DOT", "Save as DOT graph", lambda: pane.ask_save_dot(stem + ".dot"))
        self.button("save_as_svg_push_button", "document-save-as", "SVG", "Save as SVG", lambda: pane.ask_save_svg(stem + ".svg"))
        self.button("save_as_image_push_button", "image-x-generic", "Image", "Save as image", lambda: pane.ask_save_image(stem + ".png"))

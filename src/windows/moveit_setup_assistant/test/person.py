"""Somebody who uses the assistant's window by clicks and keys, in this process."""

import time

import numpy as np
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtTest import QTest
from python_qt_binding.QtWidgets import QWidget


class User:
    """Somebody who clicks and types."""

    def __init__(self, window):
        self.window = window

    def widget(self, name):
        found = self.window.findChild(QWidget, name)
        assert found is not None, name
        return found

    def screen(self, title):
        self.window.list.setCurrentItem(self.window.list.findItems(title, Qt.MatchExactly)[0])
        assert self.window.list.currentItem().text() == title

    def click(self, *names):
        for name in names:
            assert self.widget(name).isEnabled(), f"{name}: {self.widget(name).toolTip()}"
            QTest.mouseClick(self.widget(name), Qt.LeftButton)

    def can(self, name):
        return self.widget(name).isEnabled()

    def load(self, urdf):
        self.click("start_new")
        self.fill(start_path=str(urdf))
        self.click("start_load")

    def open(self, package):
        self.window.edit(str(package))
        self.wait(lambda: self.window.session.config is not None, "package")

    def rows(self, name):
        """The texts of a table."""
        table = self.widget(name)
        return [[table.item(row, column).text() for column in range(table.columnCount())] for row in range(table.rowCount())]

    def fill(self, **texts):
        for name, text in texts.items():
            widget = self.widget(name)
            if hasattr(widget, "setCurrentText"):
                assert widget.isEditable() or widget.findText(text) >= 0, f"{name} offers no '{text}'"
                widget.setCurrentText(text)
                widget.activated.emit(widget.currentIndex())
            elif hasattr(widget, "setValue"):
                widget.setValue(text)
            else:
                widget.setText("")
                QTest.keyClicks(widget, text)
                QTest.keyClick(widget, Qt.Key_Return)

    def mark(self, name, *texts):
        view = self.widget(name)
        view.clearSelection()
        for text in texts:
            view.findItems(text, Qt.MatchExactly)[0].setSelected(True)

    def said(self):
        return self.widget("said").text()

    def wait(self, condition, what):
        end = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < end, what
            QTest.qWait(10)

    def red_pixels(self):
        """How many pixels of the picture are in the colour of a link that lights up."""
        QTest.qWait(30)
        self.wait(lambda: not self.window.view._timer.isActive(), "picture")
        image = self.window.view.picture()
        pointer = image.bits()
        pointer.setsize(image.sizeInBytes())
        pixels = np.frombuffer(bytes(pointer), np.uint8).reshape(image.height(), image.bytesPerLine())
        rgb = pixels[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)
        return int(((rgb[..., 0] > 90) & (rgb[..., 1] < rgb[..., 0] / 3) & (rgb[..., 2] < rgb[..., 0] / 3)).sum())

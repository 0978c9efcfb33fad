"""Items of trees that users cannot edit."""

from python_qt_binding.QtGui import QStandardItem


class ReadonlyItem(QStandardItem):
    """An item whose text stays."""

    def __init__(self, *args):
        super().__init__(*args)
        self.setEditable(False)


class CheckableItem(ReadonlyItem):
    """A read-only item with a check box."""

    def __init__(self, *args):
        super().__init__(*args)
        self.setCheckable(True)

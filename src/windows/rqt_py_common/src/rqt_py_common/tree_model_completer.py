"""Completion of paths along a tree."""

from python_qt_binding.QtWidgets import QCompleter


class TreeModelCompleter(QCompleter):
    """Completes ``/a/b`` in a model whose items have ``_path``."""

    separator = "/"

    def __init__(self, parent=None):
        super().__init__(parent)

    def splitPath(self, path):
        return path.lstrip(self.separator).split(self.separator)

    def pathFromIndex(self, index):
        return getattr(self.model().itemFromIndex(index), "_path", "")

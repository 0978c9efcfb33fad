"""Editors of cells."""

from python_qt_binding.QtWidgets import QDoubleSpinBox, QItemDelegate


class SpinBoxDelegate(QItemDelegate):
    """Edits a cell with a spin box."""

    def __init__(self, min_value=0, max_value=100, decimals=2, *args):
        super().__init__(*args)
        self._min, self._max, self._decimals = min_value, max_value, decimals

    def createEditor(self, parent, option, index):
        """A spin box in ``parent``, with the limits that were given; it is the same for every ``option`` and ``index``."""
        editor = QDoubleSpinBox(parent)
        editor.setDecimals(self._decimals)
        editor.setRange(self._min, self._max)
        return editor


class DelegateUtil:
    """What delegates ask of a tree."""

    @staticmethod
    def _get_hierarchy_level(model_index):
        """1 for the top level of a tree, 2 for what is below, and so on."""
        level = 1
        while model_index.parent().isValid():
            model_index = model_index.parent()
            level += 1
        return level

"""A box of radio buttons."""

from python_qt_binding.QtWidgets import QButtonGroup, QGroupBox, QRadioButton

from qt_gui_py_common.checkbox_group import fill


class ExclusiveOptionGroup(QGroupBox):
    """One of the options is on.

    :param options: list of dicts with any of ``title``, ``description``, ``tooltip``, ``enabled``, ``selected``
    :param selected_index: which is on at first, beside one that says ``selected``
    """

    def __init__(self, options, title="Exclusive Options", selected_index=None, parent=None):
        super().__init__()
        self._options = list(options)
        self._button_group = QButtonGroup(self)
        selected = [index for index, option in enumerate(self._options) if option.get("selected") or index == selected_index]
        fill(self, self._button_group, QRadioButton, title, self._options, selected, parent)

    def get_settings(self):
        """``{"selected_index": int, "selected_option": dict}``, both None when none is on."""
        index = self._button_group.checkedId()
        return {"selected_index": index if index >= 0 else None, "selected_option": self._options[index] if index >= 0 else None}

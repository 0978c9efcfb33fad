"""A box of check boxes."""

from python_qt_binding.QtWidgets import QButtonGroup, QCheckBox, QGroupBox, QLabel, QVBoxLayout


class CheckBoxGroup(QGroupBox):
    """Any number of the options may be on.

    :param options: list of dicts with any of ``title``, ``description``, ``tooltip``, ``enabled``
    :param selected_indexes: which are on at first
    :param parent: widget whose layout takes the boxes in place of this group's own
    """

    def __init__(self, options, title="Checkboxes", selected_indexes=(), parent=None):
        super().__init__()
        self._options = list(options)
        self._button_group = QButtonGroup(self)
        self._button_group.setExclusive(False)
        fill(self, self._button_group, QCheckBox, title, self._options, selected_indexes, parent)

    def get_settings(self):
        """``{"selected_indexes": [int], "selected_options": [dict]}``."""
        indexes = [index for index in range(len(self._options)) if self._button_group.button(index).isChecked()]
        return {"selected_indexes": indexes, "selected_options": [self._options[index] for index in indexes]}


def fill(group, buttons, kind, title, options, selected, parent):
    """Make one button of a ``kind`` (a class of buttons) for each of ``options`` in ``group``, a QGroupBox.

    :param buttons: the QButtonGroup that they join, numbered from 0
    :param title: of the group
    :param options: dicts with ``title``, ``enabled``, ``tooltip`` and ``description``, all of which may be missing
    :param selected: numbers of those that are checked
    :param parent: the widget whose layout they go into; None: ``group``
    """
    group.setTitle(title)
    group.setLayout(QVBoxLayout())
    layout = (parent or group).layout()
    for index, option in enumerate(options):
        button = kind(option.get("title", f"option {index}"))
        button.setEnabled(bool(option.get("enabled", True)))
        button.setChecked(index in selected)
        button.setToolTip(option.get("tooltip", ""))
        buttons.addButton(button, index)
        layout.addWidget(button)
        if "description" in option:
            layout.addWidget(QLabel(option["description"]))

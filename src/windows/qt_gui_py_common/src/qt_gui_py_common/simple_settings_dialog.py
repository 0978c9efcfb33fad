"""A dialog made of groups of options."""

from python_qt_binding.QtWidgets import QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from qt_gui_py_common.checkbox_group import CheckBoxGroup
from qt_gui_py_common.exclusive_options_group import ExclusiveOptionGroup


class SimpleSettingsDialog(QDialog):
    """Add groups, then ask: ``first, second = dialog.get_settings()``."""

    def __init__(self, title="Options", description=None):
        super().__init__()
        self.setObjectName("SimpleSettingsDialog")
        self.setWindowTitle(title)
        self._settings_groups = []
        self.group_area = QWidget(self)
        self.group_area.setLayout(QVBoxLayout())
        kinds = QDialogButtonBox.StandardButton
        self.button_box = QDialogButtonBox(kinds.Ok | kinds.Cancel, self)
        self.button_box.accepted.connect(self.accept)
        self.button_box.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(self.group_area)
        layout.addWidget(self.button_box)
        if description is not None:
            self.add_label(description)

    def add_label(self, text):
        self.group_area.layout().addWidget(QLabel(text))

    def add_exclusive_option_group(self, *args, **kwargs):
        """Arguments are those of :class:`ExclusiveOptionGroup`."""
        self.add_settings_group(ExclusiveOptionGroup(*args, **kwargs))

    def add_checkbox_group(self, *args, **kwargs):
        """Arguments are those of :class:`CheckBoxGroup`."""
        self.add_settings_group(CheckBoxGroup(*args, **kwargs))

    def add_settings_group(self, settings_group):
        """Any widget; what its ``get_settings()`` returns is its part of the result."""
        self._settings_groups.append(settings_group)
        self.group_area.layout().addWidget(settings_group)

    def get_settings(self):
        """Show the dialog; a list with what each group returns, or None for each when the user cancels."""
        accepted = self.exec() if hasattr(self, "exec") else self.exec_()
        return [group.get_settings() if accepted and hasattr(group, "get_settings") else None for group in self._settings_groups]

"""The dialog that asks for the name of a new perspective."""

from python_qt_binding.QtWidgets import QCheckBox, QDialog, QDialogButtonBox, QFormLayout, QLabel, QLineEdit


def ask_new_name(parent, taken, cloning=True):
    """(name, whether to copy the perspective in use), the name being None when the user wants none.

    :param parent: widget that the dialog belongs to
    :param taken: names that are in use
    :param cloning: ask whether to copy
    """
    dialog = PerspectiveDialog(parent, taken, cloning)
    accepted = dialog.exec() if hasattr(dialog, "exec") else dialog.exec_()
    return (dialog.name_edit.text() if accepted else None), dialog.clone_box.isChecked()


class PerspectiveDialog(QDialog):
    """Its button Ok can be pressed while the name can be used; a line says why it cannot."""

    def __init__(self, parent, taken, cloning=True):
        super().__init__(parent)
        self.setWindowTitle("New perspective")
        self._taken = set(taken)
        layout = QFormLayout(self)
        self.name_edit = QLineEdit(self)
        self.name_edit.setObjectName("perspective_name_edit")
        self.clone_box = QCheckBox("Clone the current perspective", self)
        self.clone_box.setObjectName("clone_checkbox")
        self.clone_box.setChecked(cloning)
        self.clone_box.setVisible(cloning)
        self.problem_label = QLabel(self)
        kinds = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(kinds.Ok | kinds.Cancel, self)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout.addRow("Name", self.name_edit)
        for widget in (self.clone_box, self.problem_label, self.buttons):
            layout.addRow(widget)
        self.name_edit.textChanged.connect(self._judge)
        self._judge("")

    def _judge(self, name):
        problem = ""
        if "/" in name:
            problem = "A name has no slash in it."
        elif name.startswith("@"):
            problem = "Names that begin with @ are hidden ones."
        elif name in self._taken:
            problem = "A perspective of this name exists already."
        self.problem_label.setText(problem)
        self.buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(bool(name.strip()) and not problem)

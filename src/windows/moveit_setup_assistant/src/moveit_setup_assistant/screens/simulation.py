"""Simulation: a URDF that a simulator can use."""

from python_qt_binding.QtWidgets import QApplication, QHBoxLayout, QPlainTextEdit, QPushButton

from moveit_setup_assistant.screens.base import Screen, allow
from moveit_setup_assistant.simulation import simulated_urdf


class SimulationScreen(Screen):
    """Adds inertia, transmissions and the plugin that runs controllers."""

    title = "Simulation"
    about = (
        "A simulator needs inertia, transmissions and the plugin gazebo_ros_control. What the robot's description lacks is added "
        "here; the result is kept in the package as config/gazebo_<robot>.urdf. Choose controllers first: they decide "
        "which interface each joint gets."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        row = QHBoxLayout()
        self._buttons = {}
        for text, name, action in (
            ("&Generate URDF", "generate", self._generate),
            ("&Copy to Clipboard", "copy", self._copy),
            ("&Remove", "remove", self._remove),
        ):
            button = self._buttons[name] = QPushButton(text)
            button.setObjectName(f"simulation_{name}")
            button.clicked.connect(action)
            row.addWidget(button)
        self.layout_.addLayout(row)
        self._text = QPlainTextEdit()
        self._text.setObjectName("simulation_urdf")
        self._text.textChanged.connect(self._take)
        self.layout_.addWidget(self._text)

    def enter(self) -> None:
        self._text.setPlainText(self.config.gazebo_urdf)
        self._allow()

    def _take(self) -> None:
        self.config.gazebo_urdf = self._text.toPlainText()
        self._allow()

    def _allow(self) -> None:
        for name in ("copy", "remove"):
            allow(self._buttons[name], "" if self.config.gazebo_urdf else "There is no URDF yet: generate it first.")

    def _generate(self) -> None:
        made = simulated_urdf(self.config.robot.urdf, self.config.controllers)
        self._text.setPlainText(made)
        self.session.say("" if made else "The robot's description has all that a simulator needs; nothing was added.")

    def _copy(self) -> None:
        QApplication.clipboard().setText(self._text.toPlainText())

    def _remove(self) -> None:
        self._text.setPlainText("")

"""Controllers: what moves the joints."""

from python_qt_binding.QtWidgets import QPushButton

from moveit_setup_assistant.configuration import ACTION_TYPES, TRAJECTORY_TYPES, Controller
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.screens.base import Entries, Screen, choice, line
from moveit_setup_assistant.words import counted


class ControllersScreen(Screen):
    """Controllers of ros_control, and actions that somebody else serves."""

    title = "Controllers"
    about = (
        "Controllers move the joints along what was planned: those of ros_control, which launch/ros_controllers.launch starts, or "
        "actions (FollowJointTrajectory, GripperCommand) that your robot's driver serves."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        automatic = QPushButton("Auto Add JointTrajectoryController for each Planning Group")
        automatic.setObjectName("controllers_auto")
        automatic.clicked.connect(self._automatic)
        self.layout_.addWidget(automatic)
        self._entries = Entries(
            "controllers",
            {
                "name": ("Controller name", line()),
                "type": ("Controller type", choice((*TRAJECTORY_TYPES, *ACTION_TYPES), editable=True)),
                "joints": ("Joints, blanks between them", line()),
                "group": ("or the joints of the group", choice()),
            },
            lambda: self.config.controllers,
            lambda c: f"{c.name}: {c.type} ({counted(len(c.joints), 'joint')})",
            lambda c: {"name": c.name, "type": c.type, "joints": " ".join(c.joints), "group": ""},
            self._write,
            lambda c: self.config.controllers.remove(c),
        )
        self._entries.refused.connect(lambda text: session.say(text, bad=True))
        self._entries.looked_at.connect(lambda c: session.highlight([session.child_of(joint) for joint in c.joints]))
        self.layout_.addWidget(self._entries)

    def enter(self) -> None:
        self._entries.offer("group", ["", *(group.name for group in self.config.semantics.groups)])
        self._entries.fill()

    def _automatic(self) -> None:
        before = len(self.config.controllers)
        self.config.add_default_controllers()
        self._entries.fill()
        self.session.say(f"{counted(len(self.config.controllers) - before, 'controller')} added")

    def _write(self, thing, values) -> None:
        joints = self.session.joints_of(values["group"]) if values["group"] else values["joints"].split()
        known = set(self.config.robot.model.joints)
        if not values["name"] or any(c.isspace() for c in values["name"]):
            raise AssistantError("A controller needs a name without blanks.")
        if any(c.name == values["name"] and c is not thing for c in self.config.controllers):
            raise AssistantError(f"There is a controller '{values['name']}' already; choose another name.")
        if not joints:
            raise AssistantError("A controller needs joints: name them, or choose a group.")
        for joint in joints:
            if joint not in known:
                raise AssistantError(f"The robot has no joint '{joint}'.")
        if thing is None:
            self.config.controllers.append(Controller(values["name"], values["type"], joints))
        else:
            thing.name, thing.type, thing.joints = values["name"], values["type"], joints

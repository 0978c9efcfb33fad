"""Controllers: what moves the joints."""

from python_qt_binding.QtWidgets import QPushButton

from moveit_setup_assistant.configuration import ACTION_TYPES, TRAJECTORY_TYPES, Controller
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.screens.base import Entries, Screen, allow, choice, line
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
        self._automatic = QPushButton("A&uto Add JointTrajectoryController\nfor each Planning Group")
        self._automatic.setObjectName("controllers_auto")
        self._automatic.clicked.connect(self._add_all)
        self.layout_.addWidget(self._automatic)
        self._entries = Entries(
            "controllers",
            "Controller",
            ("Controller", "Controller Type", "Joints"),
            {
                "name": ("Controller name", line()),
                "type": ("Controller type", choice((*TRAJECTORY_TYPES, *ACTION_TYPES), editable=True)),
                "joints": ("Joints, blanks between them", line()),
                "group": ("or the joints of the group", choice()),
            },
            lambda: self.config.controllers,
            lambda c: (c.name, c.type, counted(len(c.joints), "joint")),
            lambda c: {"name": c.name, "type": c.type, "joints": " ".join(c.joints), "group": ""},
            self._check,
            self._write,
            lambda c: self.config.controllers.remove(c),
        )
        self._entries.looked_at.connect(lambda c: session.highlight([session.child_of(joint) for joint in c.joints]))
        self._entries.changed.connect(self._allow)
        self.layout_.addWidget(self._entries)

    def enter(self) -> None:
        self._entries.offer("group", ["", *(group.name for group in self.config.semantics.groups)])
        self._entries.fill()

    def _missing(self) -> tuple[list[Controller], str]:
        """The controllers that can be added at once; why there are none."""
        if not self.config.semantics.groups:
            return [], "Make a group first, on the screen Planning Groups."
        try:
            return self.config.default_controllers(), "Every group's joints have a controller."
        except AssistantError as error:
            return [], str(error)

    def _allow(self) -> None:
        missing, why = self._missing()
        allow(self._automatic, "" if missing else why)

    def _add_all(self) -> None:
        made, _ = self._missing()
        self.config.controllers += made
        self._entries.fill()
        self.session.say(f"{counted(len(made), 'controller')} added")

    def _joints(self, values) -> list[str]:
        return self.session.joints_of(values["group"]) if values["group"] else values["joints"].split()

    def _check(self, thing, values) -> None:
        joints, known = self._joints(values), set(self.config.robot.model.joints)
        if not values["name"] or any(c.isspace() for c in values["name"]):
            raise AssistantError("A controller needs a name without blanks.")
        if any(c.name == values["name"] and c is not thing for c in self.config.controllers):
            raise AssistantError(f"There is a controller '{values['name']}' already; choose another name.")
        if not joints:
            raise AssistantError("A controller needs joints: name them, or choose a group.")
        for joint in joints:
            if joint not in known:
                raise AssistantError(f"The robot has no joint '{joint}'.")

    def _write(self, thing, values) -> None:
        if thing is None:
            thing = Controller("", "")
            self.config.controllers.append(thing)
        thing.name, thing.type, thing.joints = values["name"], values["type"], self._joints(values)

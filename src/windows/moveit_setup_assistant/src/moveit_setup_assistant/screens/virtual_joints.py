"""Virtual joints: how the robot stands in the world."""

from srdfdom import srdf

from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.screens.base import Entries, Screen, choice, line


class VirtualJointsScreen(Screen):
    """A joint between the robot's root link and a frame of the world."""

    title = "Virtual Joints"
    about = (
        "A virtual joint ties the robot's root link to a frame of the world: fixed for an arm on a table, planar for one on "
        "wheels, floating for one that flies."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._entries = Entries(
            "virtual_joints",
            "Virtual Joint",
            ("Name", "Child Link", "Parent Frame", "Type"),
            {
                "name": ("Virtual joint name", line()),
                "child_link": ("Child link", choice()),
                "parent_frame": ("Parent frame name", line("world")),
                "type": ("Joint type", choice(("fixed", "floating", "planar"))),
            },
            lambda: self.config.semantics.virtual_joints,
            lambda v: (v.name, v.child_link, v.parent_frame, v.type),
            lambda v: {"name": v.name, "child_link": v.child_link, "parent_frame": v.parent_frame, "type": v.type},
            self._check,
            self._write,
            lambda v: self.config.semantics.virtual_joints.remove(v),
        )
        self._entries.looked_at.connect(lambda v: session.highlight([v.child_link]))
        self.layout_.addWidget(self._entries)

    def enter(self) -> None:
        self._entries.offer("child_link", self.config.robot.model.links)
        self._entries.fill()

    def _check(self, thing, values) -> None:
        if not values["name"] or not values["parent_frame"]:
            raise AssistantError("A virtual joint needs a name and a parent frame.")
        if any(v.name == values["name"] and v is not thing for v in self.config.semantics.virtual_joints):
            raise AssistantError(f"There is a virtual joint '{values['name']}' already; choose another name.")

    def _write(self, thing, values) -> None:
        if thing is None:
            thing = srdf.VirtualJoint()
            self.config.semantics.virtual_joints.append(thing)
        thing.name, thing.child_link = values["name"], values["child_link"]
        thing.parent_frame, thing.type = values["parent_frame"], values["type"]

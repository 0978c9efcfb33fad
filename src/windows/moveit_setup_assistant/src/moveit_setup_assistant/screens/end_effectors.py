"""End effectors: groups that hang on a link of another."""

from srdfdom import srdf

from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.screens.base import Entries, Screen, choice, line


class EndEffectorsScreen(Screen):
    """A gripper's group and the link that carries it."""

    title = "End Effectors"
    about = (
        "An end effector is a group, a gripper for one, that hangs on a link of another group. Pick and place needs it, and "
        "RViz puts the marker there."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._entries = Entries(
            "end_effectors",
            "End Effector",
            ("Name", "Group", "Parent Link", "Parent Group"),
            {
                "name": ("End effector name", line()),
                "group": ("End effector group", choice()),
                "parent_link": ("Parent link", choice()),
                "parent_group": ("Parent group (optional)", choice()),
            },
            lambda: self.config.semantics.end_effectors,
            lambda e: (e.name, e.group, e.parent_link, e.parent_group or ""),
            lambda e: {"name": e.name, "group": e.group, "parent_link": e.parent_link, "parent_group": e.parent_group or ""},
            self._check,
            self._write,
            lambda e: self.config.semantics.end_effectors.remove(e),
        )
        self._entries.looked_at.connect(lambda e: session.highlight(session.links_of(e.group)))
        self.layout_.addWidget(self._entries)

    def enter(self) -> None:
        groups = [group.name for group in self.config.semantics.groups]
        self._entries.offer("group", groups)
        self._entries.offer("parent_group", ["", *groups])
        self._entries.offer("parent_link", self.config.robot.model.links)
        self._entries.fill()

    def _check(self, thing, values) -> None:
        if not values["group"]:
            raise AssistantError("An end effector is a group: make the group first, on the screen Planning Groups.")
        if not values["name"]:
            raise AssistantError("An end effector needs a name.")
        if any(e.name == values["name"] and e is not thing for e in self.config.semantics.end_effectors):
            raise AssistantError(f"There is an end effector '{values['name']}' already; choose another name.")
        if values["parent_link"] in self.session.links_of(values["group"]):
            raise AssistantError(
                f"Link '{values['parent_link']}' belongs to group '{values['group']}' itself; choose the link that carries it."
            )

    def _write(self, thing, values) -> None:
        if thing is None:
            thing = srdf.EndEffector()
            self.config.semantics.end_effectors.append(thing)
        thing.name, thing.group, thing.parent_link = values["name"], values["group"], values["parent_link"]
        thing.parent_group = values["parent_group"] or None

"""Passive joints: those that nothing drives."""

from srdfdom import srdf

from moveit_setup_assistant.screens.base import Screen, TwoLists


class PassiveJointsScreen(Screen):
    """Joints without an actuator, for which nobody plans."""

    title = "Passive Joints"
    about = "Joints that no motor drives, casters for one. Nobody plans for them, and nobody waits for their state."

    def __init__(self, session) -> None:
        super().__init__(session)
        self._lists = TwoLists("Active joints", "Passive joints", "passive_joints")
        self._lists.changed.connect(self._take)
        self._lists.looked_at.connect(lambda names: session.highlight([session.child_of(name) for name in names]))
        self.layout_.addWidget(self._lists)

    def enter(self) -> None:
        self._lists.set(self.config.robot.movable_joints, [p.name for p in self.config.semantics.passive_joints])

    def _take(self) -> None:
        self.config.semantics.passive_joints = [srdf.PassiveJoint(name) for name in self._lists.chosen()]

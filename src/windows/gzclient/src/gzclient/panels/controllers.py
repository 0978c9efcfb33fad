"""What the controller managers list; start and stop; sliders of the commands."""

from __future__ import annotations

from typing import Any, NamedTuple

import rosgraph
import rospy
from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerRequest
from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.simulation import Frame, Refused

from gzclient.controller_commands import Command, command_of, joints_of

_LIST = "/controller_manager/list_controllers"
_PATIENCE = 3.0  # wall s that a service may take to be there


class _Listed(NamedTuple):
    """A controller; ``joints`` in the order in which it takes their numbers."""

    manager: str
    name: str
    kind: str
    state: str
    joints: tuple[str, ...]


class _Sent(NamedTuple):
    """What the sliders of a running controller send."""

    listed: _Listed
    command: Command
    publisher: rospy.Publisher
    sliders: tuple[Any, ...]


def managers() -> list[str]:
    """Namespaces that have a controller manager, from the master."""
    services = rosgraph.Master(rospy.get_name()).getSystemState()[2]
    return sorted(name[: -len(_LIST)] for name, _ in services if name.endswith(_LIST))


class ControllersPanel(Panel):
    title = "Controllers"

    def __init__(self, page: Any):
        super().__init__(page)
        self._made: list[Any] = []
        self._sent: list[_Sent] = []
        self.gui.add_button("Look for controllers").on_click(lambda event: page.attempt(event, self._read))
        self._folder = self.gui.add_folder("Controllers")
        with self._folder:
            self._note = self.gui.add_html(note("not asked yet"))

    def _read(self) -> None:
        """Ask, in the thread of the click; draw in the drawing thread."""
        try:
            asked = managers()
        except (OSError, rosgraph.MasterException) as error:
            raise Refused(f"the ROS master does not answer: {error}") from error
        found = [_listed(manager, controller) for manager in asked for controller in _call(manager + _LIST, ListControllers).controller]
        self.page.later(lambda: self._show(found, bool(asked)))

    def _show(self, found: list[_Listed], asked: bool) -> None:
        for thing in self._made:
            thing.remove()
        for sent in self._sent:
            sent.publisher.unregister()
        self._made, self._sent = [], []
        self._note.visible = not found
        self._note.content = note("no controller is loaded" if asked else "no controller manager is there")
        with self._folder:
            for listed in found:
                self._add(listed)

    def _add(self, listed: _Listed) -> None:
        running = listed.state == "running"
        box = self.gui.add_checkbox(f"{listed.manager}/{listed.name}", running, hint=f"{listed.kind}: {listed.state}")
        self.on_update(box, lambda _: self._switch(listed, box))
        self._made.append(box)
        command = command_of(listed.kind, listed.joints, self._joints(listed)) if running else None
        if command is None:
            return
        publisher = rospy.Publisher(f"{listed.manager}/{listed.name}/{command.topic}", command.cls, queue_size=1)
        sliders = [
            self.gui.add_slider(f"{listed.name} {slider.label}", slider.low, slider.high, (slider.high - slider.low) / 1000, slider.now)
            for slider in command.sliders
        ]
        sent = _Sent(listed, command, publisher, tuple(sliders))
        for made in sliders:
            self.on_update(made, lambda _: self._send(sent))
        self._sent.append(sent)
        self._made += sliders

    def _joints(self, listed: _Listed) -> dict:
        return joints_of(self.page.world, self.page.frame, listed.joints, listed.manager)

    def _send(self, sent: _Sent) -> None:
        values, known = [float(slider.value) for slider in sent.sliders], self._joints(sent.listed)
        now = [known[name][1] for name in sent.listed.joints if name in known]
        sent.publisher.publish(sent.command.make(values, now if len(now) == len(values) else values))

    def on_frame(self, frame: Frame) -> None:
        for sent in self._sent:
            if not sent.command.lasting and any(slider.value for slider in sent.sliders):
                self._send(sent)

    def _switch(self, listed: _Listed, box: Any) -> None:
        start, stop = ([listed.name], []) if box.value else ([], [listed.name])
        answer = _call(
            f"{listed.manager}/controller_manager/switch_controller",
            SwitchController,
            start,
            stop,
            SwitchControllerRequest.STRICT,
            False,
            0.0,
        )
        self._read()
        if not answer.ok:
            verb = "start" if start else "stop"
            raise Refused(f"{listed.manager}: the controller manager did not {verb} {listed.name}; its terminal says why")


def _listed(manager: str, controller: Any) -> _Listed:
    claimed = [name for part in controller.claimed_resources for name in part.resources]
    ordered = rospy.get_param(f"{manager}/{controller.name}/joints", claimed)  # claimed ones are in the order of the alphabet
    known = ordered if isinstance(ordered, list) and sorted(map(str, ordered)) == sorted(claimed) else claimed
    return _Listed(manager, controller.name, controller.type, controller.state, tuple(known))


def _call(name: str, service: type, *arguments: Any) -> Any:
    try:
        rospy.wait_for_service(name, _PATIENCE)
        return rospy.ServiceProxy(name, service)(*arguments)
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise Refused(f"{name}: {error}") from error

"""What the controller managers list; start and stop; sliders of the commands."""
from __future__ import annotations

from typing import Any, List, Tuple

import rosgraph
import rospy
from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerRequest
from ode_sim.viewer.panels.base import Panel, note
from ode_sim.viewer.simulation import Refused
from std_msgs.msg import Float64

_LIST = "/controller_manager/list_controllers"
_SINGLE = ("position_controllers", "velocity_controllers", "effort_controllers")  # whose Joint... take one number
_PATIENCE = 3.0  # wall s that a service may take to be there


def managers() -> List[str]:
    """Namespaces that have a controller manager, from the master."""
    services = rosgraph.Master(rospy.get_name()).getSystemState()[2]
    return sorted(name[:-len(_LIST)] for name, _ in services if name.endswith(_LIST))


class ControllersPanel(Panel):
    title = "Controllers"

    def __init__(self, page: Any):
        super().__init__(page)
        self._made: List[Any] = []
        self._publishers: List[rospy.Publisher] = []
        self.gui.add_button("Look for controllers").on_click(lambda event: page.attempt(event, self._read))
        self._folder = self.gui.add_folder("Controllers")
        with self._folder:
            self._note = self.gui.add_html(note("not asked yet"))

    def _read(self) -> None:
        """Ask, in the thread of the click; draw in the drawing thread."""
        try:
            found = [(manager, _call(manager + _LIST, ListControllers).controller) for manager in managers()]
        except (OSError, rosgraph.MasterException) as error:
            raise Refused(f"the ROS master does not answer: {error}") from error
        self.page.later(lambda: self._show(found))

    def _show(self, found: List[Tuple[str, Any]]) -> None:
        for thing in self._made:
            thing.remove()
        for publisher in self._publishers:
            publisher.unregister()
        self._made, self._publishers = [], []
        self._note.visible = not any(controllers for _, controllers in found)
        self._note.content = note("no controller manager is there" if not found else "no controller is loaded")
        with self._folder:
            for manager, controllers in found:
                for controller in controllers:
                    self._add(manager, controller)

    def _add(self, manager: str, controller: Any) -> None:
        running = controller.state == "running"
        box = self.gui.add_checkbox(f"{manager}/{controller.name}", running,
                                    hint=f"{controller.type}: {controller.state}")
        self.on_update(box, lambda _: self._switch(manager, controller.name, box))
        self._made.append(box)
        kind, _, name = controller.type.partition("/")
        if running and kind in _SINGLE and name.startswith("Joint") and name.endswith("Controller"):
            publisher = rospy.Publisher(f"{manager}/{controller.name}/command", Float64, queue_size=1)
            slider = self.gui.add_slider(f"{controller.name} command", -3.14, 3.14, 0.01, 0.0)
            self.on_update(slider, lambda value: publisher.publish(float(value)))
            self._publishers.append(publisher)
            self._made.append(slider)

    def _switch(self, manager: str, name: str, box: Any) -> None:
        start, stop = ([name], []) if box.value else ([], [name])
        answer = _call(f"{manager}/controller_manager/switch_controller", SwitchController, start, stop,
                       SwitchControllerRequest.STRICT, False, 0.0)
        self._read()
        if not answer.ok:
            verb = "start" if start else "stop"
            raise Refused(f"{manager}: the controller manager did not {verb} {name}; its terminal says why")


def _call(name: str, service: type, *arguments: Any) -> Any:
    try:
        rospy.wait_for_service(name, _PATIENCE)
        return rospy.ServiceProxy(name, service)(*arguments)
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise Refused(f"{name}: {error}") from error

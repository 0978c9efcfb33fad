"""Which trajectory controllers can be moved by sliders, and why the others cannot."""

from typing import NamedTuple

import rospy
from controller_manager_msgs.srv import ListControllers
from controller_manager_msgs.utils import ControllerManagerLister

from .joint_limits_urdf import DescriptionError, JointLimits, joint_limits


class Found(NamedTuple):
    """``usable``: name to joints with limits; ``reasons``: lines about the running ones that cannot be used."""

    usable: dict[str, dict[str, JointLimits]]
    reasons: tuple[str, ...]


class ControllerFinder:
    """Asks managers; any call may hang."""

    def __init__(self):
        self._list_managers = ControllerManagerLister()

    def managers(self) -> list[str]:
        return list(self._list_managers())

    def controllers(self, manager: str) -> Found:
        """:raises rospy.ServiceException: the manager is gone"""
        running = [
            c
            for c in rospy.ServiceProxy(f"{manager}/list_controllers", ListControllers)().controller
            if c.state == "running" and "JointTrajectoryController" in c.type
        ]
        if not running:
            return Found({}, (f"{manager} runs no controller whose type contains JointTrajectoryController",))
        limits, reasons = self._limits(manager.rsplit("/", 1)[0])
        if limits is None:
            return Found({}, reasons)
        usable = {}
        for controller in running:
            joints = self._in_order(manager, controller)
            missing = [joint for joint in joints if joint not in limits]
            if joints and not missing:
                usable[controller.name] = {joint: limits[joint] for joint in joints}
            else:
                reasons += (
                    f"{controller.name}: robot_description has no limits of position and velocity for {', '.join(missing)}"
                    if missing
                    else f"{controller.name} claims no joints",
                )
        return Found(usable, reasons)

    @staticmethod
    def _in_order(manager: str, controller) -> list[str]:
        """The claimed joints, as the controller's own parameter orders them: claims are sorted by name."""
        claimed = list(dict.fromkeys(joint for entry in controller.claimed_resources for joint in entry.resources))
        listed = rospy.get_param(f"{manager.rsplit('/', 1)[0]}/{controller.name}/joints", None)
        return list(listed) if isinstance(listed, list) and sorted(map(str, listed)) == sorted(claimed) else claimed

    @staticmethod
    def _limits(namespace: str):
        """From robot_description beside the manager, else from the global one."""
        for name in dict.fromkeys((f"{namespace}/robot_description", rospy.resolve_name("robot_description"), "/robot_description")):
            if rospy.has_param(name):
                try:
                    return joint_limits(rospy.get_param(name)), ()
                except DescriptionError as error:
                    return None, (f"{name}: {error}",)
        return None, (f"there is no parameter {namespace}/robot_description, nor /robot_description",)

#!/usr/bin/env python3
"""Controllers of managers that are only services: which are known, and which start and stop for a motion."""

import unittest

import rospy
import rostest
from control_msgs.msg import FollowJointTrajectoryActionResult
from controller_manager_msgs.msg import ControllerState, HardwareInterfaceResources
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllersResponse,
    SwitchController,
    SwitchControllerRequest,
    SwitchControllerResponse,
)
from moveit_ros_control_interface.manager import ControlManager, MultiControlManager

TRAJECTORY, GROUP = "position_controllers/JointTrajectoryController", "velocity_controllers/JointGroupVelocityController"
POSITION, VELOCITY = "hardware_interface/PositionJointInterface", "hardware_interface/VelocityJointInterface"


def controller(name, kind, running, *joints, interface=POSITION):
    claimed = [HardwareInterfaceResources(interface, [joint]) for joint in joints]
    return ControllerState(name, "running" if running else "stopped", kind, claimed)


class Services:
    """A controller_manager's, which refuses as ros_control does: what is not as asked for, and a joint for two."""

    def __init__(self, namespace, *controllers):
        self.controllers, self.requests = {c.name: c for c in controllers}, []
        where = namespace + "controller_manager/"
        self._services = [
            rospy.Service(where + "list_controllers", ListControllers, lambda _: ListControllersResponse([*self.controllers.values()])),
            rospy.Service(where + "switch_controller", SwitchController, self._switch),
        ]

    def running(self):
        return sorted(name for name, c in self.controllers.items() if c.state == "running")

    def _switch(self, request):
        assert request.strictness == SwitchControllerRequest.STRICT
        self.requests.append((sorted(request.start_controllers), sorted(request.stop_controllers)))
        before = set(self.running())
        after = before - set(request.stop_controllers) | set(request.start_controllers)
        held = [joint for name in after for claimed in self.controllers[name].claimed_resources for joint in claimed.resources]
        if before & set(request.start_controllers) or set(request.stop_controllers) - before or len(held) != len(set(held)):
            return SwitchControllerResponse(False)
        for name, c in self.controllers.items():
            c.state = "running" if name in after else "stopped"
        return SwitchControllerResponse(True)

    def end(self):
        for service in self._services:
            service.shutdown("the test is over")


class Switch(unittest.TestCase):
    def serve(self, namespace, *controllers):
        services = Services(namespace, *controllers)
        self.addCleanup(services.end)
        return services

    def test_what_holds_a_joint_stops_whatever_its_kind(self):
        served = self.serve(
            "/",
            controller("states", "joint_state_controller/JointStateController", True),
            controller("wheels", GROUP, True, "w", interface=VELOCITY),
            controller("arm", TRAJECTORY, False, "a", "b", "c"),
            controller("jog", GROUP, True, "z", "b", interface=VELOCITY),  # holds the second of the joints, and another one
            controller("single", "effort_controllers/JointPositionController", True, "c"),
        )
        manager = ControlManager(None)
        self.assertEqual((manager.controllers(), manager.active_controllers()), (["/arm"], []))
        self.assertIsNone(manager.handle("/arm"))
        self.assertTrue(manager.switch(["/arm"], []))
        self.assertEqual(served.requests, [(["arm"], ["jog", "single"])])
        self.assertEqual(served.running(), ["arm", "states", "wheels"])
        self.assertIsNotNone(manager.handle("/arm"))
        self.assertTrue(manager.switch(["/arm"], []))
        self.assertEqual(len(served.requests), 1, "it runs already")

    def test_what_has_changed_a_moment_ago_counts(self):
        served = self.serve("/", controller("arm", TRAJECTORY, True, "a"), controller("jog", GROUP, False, "a"))
        manager = ControlManager(None)
        self.assertEqual(manager.active_controllers(), ["/arm"])
        served.controllers["arm"].state, served.controllers["jog"].state = "stopped", "running"
        self.assertTrue(manager.switch(["/arm"], []))
        self.assertEqual(served.requests, [(["arm"], ["jog"])])

    def test_a_holder_that_is_named_stops_once_and_one_that_stands_not_at_all(self):
        served = self.serve(
            "/",
            controller("arm", TRAJECTORY, False, "a"),
            controller("other", TRAJECTORY, True, "a"),
            controller("third", TRAJECTORY, False, "a"),
        )
        self.assertTrue(ControlManager(None).switch(["/arm"], ["/other", "/third", "/nobody"]))
        self.assertEqual(served.requests, [(["arm"], ["other"])])

    def test_what_is_refused_is_refused(self):
        served = self.serve("/", controller("arm", TRAJECTORY, False, "a"), controller("twin", TRAJECTORY, False, "a"))
        self.assertFalse(ControlManager(None).switch(["/arm", "/twin"], []))
        self.assertEqual(served.running(), [])

    def test_each_of_several_managers_stops_its_own(self):
        left = self.serve("/left/", controller("arm", TRAJECTORY, False, "a"), controller("jog", GROUP, True, "a"))
        right = self.serve("/right/", controller("arm", TRAJECTORY, False, "a"), controller("jog", GROUP, True, "a"))
        manager = MultiControlManager(None)
        self.assertTrue(manager.switch(["/left/arm"], []))
        self.assertEqual((left.running(), right.running()), (["arm"], ["jog"]))
        self.assertEqual((left.requests, right.requests), ([(["arm"], ["jog"])], []))
        self.assertEqual(manager.active_controllers(), ["/left/arm"])

    def test_a_controller_of_any_type_with_the_action_takes_trajectories(self):
        self.serve("/", controller("own", "my_package/Follower", True, "a"), controller("jog", GROUP, True, "b"))
        topic = rospy.Publisher("/own/follow_joint_trajectory/result", FollowJointTrajectoryActionResult, queue_size=1)
        self.addCleanup(topic.unregister)
        self.assertEqual(ControlManager(None).controllers(), ["/own"])


if __name__ == "__main__":
    rospy.init_node("switch_rostest")
    rostest.rosrun("moveit_ros_control_interface", "switch", Switch)

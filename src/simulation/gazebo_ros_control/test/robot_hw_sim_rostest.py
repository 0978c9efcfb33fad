#!/usr/bin/env python3
"""Hardware of a robot in C++, derived from the default one, in the simulator."""

import importlib.util
import sys
import threading
import time
import unittest

import rospy
import rosservice
import rostest
from controller_manager_msgs.srv import LoadController, SwitchController, SwitchControllerRequest
from gazebo_msgs.srv import DeleteModel, GetJointProperties, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Pose
from rosgraph_msgs.msg import Log
from std_msgs.msg import Float64
from test_support.hearing import heard

KINDS = {"velocity": "Velocity", "position": "Position", "effort": "Effort"}
PARTS = "".join(
    f"""<joint name="{name}" type="revolute"><parent link="world"/><child link="{name}_link"/>
<origin xyz="0 {2 * i} 1"/><axis xyz="1 0 0"/><limit lower="-3" upper="3" effort="50" velocity="2"/></joint>
<link name="{name}_link"><inertial><mass value="1"/><inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link>
<transmission name="{name}_t"><type>transmission_interface/SimpleTransmission</type><joint name="{name}">
<hardwareInterface>hardware_interface/{kind}JointInterface</hardwareInterface></joint><actuator name="{name}_m"/></transmission>"""
    for i, (name, kind) in enumerate(KINDS.items())
)
ROBOT = """<robot name="robot"><link name="world"/>{parts}<gazebo><plugin name="control" filename="{library}">
<robotNamespace>/robot</robotNamespace><robotSimType>{sim}</robotSimType></plugin></gazebo></robot>"""


def service(name, kind):
    rospy.wait_for_service(name, 30)
    return rospy.ServiceProxy(name, kind)


class Robot(unittest.TestCase):
    def setUp(self):
        self.log = []
        self.subscriber = rospy.Subscriber("/rosout", Log, lambda m: self.log.append(m.msg))
        self.wait(lambda: heard([self.subscriber]))
        self.step = service("/gazebo/step", StepWorld)

    def tearDown(self):
        service("/gazebo/delete_model", DeleteModel)("robot")
        self.subscriber.unregister()

    def wait(self, condition):
        end = time.monotonic() + 30
        while not condition():
            self.assertLess(time.monotonic(), end, "\n".join(self.log))
            time.sleep(0.02)

    def spawn(self, sim, library="libgazebo_ros_control.so", described=True, **parameters):
        text = ROBOT.format(parts=PARTS, sim=sim, library=library)
        if rospy.has_param("/robot"):
            rospy.delete_param("/robot")
        rospy.set_param(
            "/robot",
            {**parameters, **{name: {"type": f"{name}_controllers/Joint{kind}Controller", "joint": name} for name, kind in KINDS.items()}},
        )
        if described:
            rospy.set_param("/robot_description", text)
        answer = service("/gazebo/spawn_urdf_model", SpawnModel)("robot", text, "", Pose(), "")
        self.assertTrue(answer.success, answer.status_message)
        return text

    def start_controllers(self):
        for name in KINDS:
            self.assertTrue(service("/robot/controller_manager/load_controller", LoadController)(name).ok)
        switch = service("/robot/controller_manager/switch_controller", SwitchController)
        done = []
        thread = threading.Thread(target=lambda: done.append(switch(list(KINDS), [], SwitchControllerRequest.STRICT, False, 0.0).ok))
        thread.start()
        self.wait(lambda: self.step(1) and done)
        self.assertEqual(done, [True])

    def logged(self, *words):
        self.wait(lambda: any(all(word in line for word in words) for line in self.log))

    def joint(self, name):
        return service("/gazebo/get_joint_properties", GetJointProperties)(name)

    def command(self, name, value, condition):
        """Until the controller has heard it."""
        publisher = rospy.Publisher(f"/robot/{name}/command", Float64, queue_size=1, latch=True)
        publisher.publish(value)

        def one_more():
            self.step(1)
            return condition()

        self.wait(one_more)
        publisher.unregister()


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class RobotHWSimTest(Robot):
    def test_it_drives_joints_and_its_failure_is_one_line(self):
        self.spawn("test/Halved")
        self.start_controllers()
        self.command("position", 0.1, lambda: abs(self.joint("position").position[0] - 0.1) < 1e-6)
        self.command("velocity", 1.0, lambda: abs(self.joint("velocity").rate[0] - 0.5) < 1e-3)
        self.command("effort", 0.5, lambda: self.joint("effort").rate[0] > 0.1)
        rate = self.joint("effort").rate[0]
        self.step(100)
        self.assertAlmostEqual(self.joint("effort").rate[0], rate + 0.5 / 0.5 * 0.1, delta=1e-3)
        self.assertAlmostEqual(self.joint("position").position[0], 0.1, delta=1e-6)
        self.command("effort", 45.0, lambda: any("told to fail" in line for line in self.log))
        self.logged("HalvedHWSim", "failed: its writeSim() threw told to fail in writeSim. Its controllers are stopped")
        self.assertTrue(self.step(10))

    def test_what_cannot_start_is_one_line(self):
        for sim, parameters, words in (
            ("test/Halved", {"fail_in": "initSim"}, ("cannot start", "its initSim() threw told to fail in initSim")),
            ("test/Absent", {}, ("NoSuchClass", "its constructor threw")),
            ("test/Controller", {}, ("is no simulated hardware", "plugins.xml")),
            ("test/NoLibrary", {}, ("no_such_library.so is not found in",)),
        ):
            self.spawn(sim, **parameters)
            self.logged(*words)
            service("/gazebo/delete_model", DeleteModel)("robot")


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class DerivedPluginTest(Robot):
    """In a simulator of its own: a library of hardware is loaded by pluginlib here, by path there."""

    def test_a_plugin_derived_from_the_control_plugin(self):
        """In C++, on hardware of either origin, with controllers of Python; it goes with its model, and the next one begins anew."""
        for sim, rate in (("gazebo_ros_control/DefaultRobotHWSim", 1.0), ("test/Halved", 0.5)):
            self.spawn(sim, library="libgazebo_ros_control_test_plugin.so")
            self.logged(f"chatty: {sim} of /robot has 3 transmissions, 0.001 s")
            self.start_controllers()
            self.command("position", 0.1, lambda: abs(self.joint("position").position[0] - 0.1) < 1e-6)
            self.command("velocity", 1.0, lambda: abs(self.joint("velocity").rate[0] - rate) < 1e-3)
            service("/gazebo/delete_model", DeleteModel)("robot")
            self.wait(lambda: not any("/robot/controller_manager" in name for name in rosservice.get_service_list()))
            self.assertTrue(self.step(10))

    def test_a_derived_plugin_waits_for_the_description(self):
        """What it says is said once, by a node that begins with the first such plugin: that one is to be heard by then."""
        self.spawn("test/None", library="libgazebo_ros_control_test_plugin.so")
        self.wait(lambda: heard([self.subscriber]))
        service("/gazebo/delete_model", DeleteModel)("robot")
        if rospy.has_param("/robot_description"):
            rospy.delete_param("/robot_description")
        text = self.spawn("test/Halved", library="libgazebo_ros_control_test_plugin.so", described=False)
        self.logged("waiting for model URDF in parameter [robot_description]")
        rospy.set_param("/robot_description", text)
        self.wait(lambda: self.step(1) and "/robot/controller_manager/load_controller" in rosservice.get_service_list())
        self.start_controllers()

    def test_a_derived_plugin_with_hardware_that_is_not_there(self):
        self.spawn("test/None", library="libgazebo_ros_control_test_plugin.so")
        self.logged("model 'robot': <robotSimType>test/None</robotSimType> cannot be made")
        self.assertTrue(self.step(10))


if __name__ == "__main__":
    rospy.init_node("robot_hw_sim_rostest")
    derived = "derived" in sys.argv
    rostest.rosrun("gazebo_ros_control", "derived_plugin" if derived else "robot_hw_sim", DerivedPluginTest if derived else RobotHWSimTest)

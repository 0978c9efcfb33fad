#!/usr/bin/env python3
"""gazebo_ros_control as a plugin of a model: its namespaces, periods, emergency stop, and the end of it."""

import os
import sys
import tempfile
import threading

import rosgraph
import rospy
import rostest
import test_support
from controller_manager_msgs.srv import ListControllerTypes
from gazebo_ros.plugin import PluginError
from hardware_interface import PositionJointInterface
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from test_support import wait_until

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulated_robot import EFFORT, FORWARD, NO_LIMIT, POSITION, Log, SimulatedRobot, joint, one_joint, transmission, urdf  # noqa: E402


class PluginTest(test_support.TestCase):
    def service_there(self, namespace):
        services = [name for name, _ in rosgraph.Master("/t").getSystemState()[2]]
        return f"{namespace}/controller_manager/list_controllers" in services

    def test_namespaces(self):
        for plugin, namespace in (
            ("<robotNamespace>/a/b</robotNamespace>", "/a/b"),
            ("", "/model"),
            ("<robotNamespace>/</robotNamespace>", ""),
            ("<robotNamespace/>", ""),
            ("<robotNamespace>arm</robotNamespace>", "/arm"),
        ):
            with self.subTest(plugin=plugin):
                with SimulatedRobot(one_joint(POSITION), plugin):
                    self.assertTrue(self.service_there(namespace))
                self.assertFalse(self.service_there(namespace), "gone with the model")

    def test_the_list_of_types_has_no_doubles_of_tests(self):
        with SimulatedRobot(one_joint(POSITION), "<robotNamespace>/r</robotNamespace>"):
            types = rospy.ServiceProxy("/r/controller_manager/list_controller_types", ListControllerTypes)().types
        self.assertIn("joint_state_controller/JointStateController", types)
        self.assertEqual([name for name in types if "_tests/" in name], [])

    def test_description_in_a_parameter_of_another_name(self):
        robot = SimulatedRobot(
            one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><robotParam>my_description</robotParam>", describe=False
        )
        rospy.set_param("/robot/my_description", one_joint(POSITION))
        with robot:
            self.assertEqual(robot.hw.get(PositionJointInterface).names(), ["j"])

    def test_waiting_for_the_description_does_not_stop_the_world(self):
        with Log.recorded() as log, SimulatedRobot(one_joint(POSITION), describe=False) as robot:
            wait_until(
                lambda: log.having(
                    "waiting for model URDF in parameter [robot_description] on the ROS param server", "/robot and above", level="WARNING"
                ),
                "the plugin's word",
            )
            robot.run(0.1)
            self.assertIsNone(robot.manager)
            rospy.set_param("/robot_description", one_joint(POSITION))
            wait_until(lambda: robot.manager is not None, "the controller manager")
            robot.step()
            self.assertTrue(self.service_there("/robot"))

    def test_a_model_deleted_while_it_waits(self):
        robot = SimulatedRobot(one_joint(POSITION), describe=False)
        with robot:
            robot.step()
        rospy.set_param("/robot_description", one_joint(POSITION))
        wait_until(lambda: "gazebo_ros_control" not in [thread.name for thread in threading.enumerate()], "its thread to end")
        self.assertFalse(self.service_there("/robot"))

    def test_a_description_that_is_no_xml(self):
        robot = SimulatedRobot(one_joint(POSITION))
        rospy.set_param("/robot_description", "<robot>")
        with self.assertRaisesRegex(PluginError, "robot_description.*no valid XML"):
            robot.load()

    def test_control_period(self):
        with (
            Log.recorded() as log,
            SimulatedRobot(
                one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>0.01</controlPeriod>", FORWARD
            ) as robot,
        ):
            self.assertEqual(len(log.having("<controlPeriod>0.01 is longer", level="WARNING")), 1)
            robot.start("pos")
            periods = []
            robot.manager.controllers[0].update = lambda time, period: periods.append(period)
            robot.run(0.1)
            self.assertEqual(len(periods), 10)
            self.assertAlmostEqual(min(periods), 0.01, delta=1e-9)
            self.assertAlmostEqual(max(periods), 0.01, delta=1e-9)

    def test_control_period_shorter_than_the_step(self):
        with (
            Log.recorded() as log,
            SimulatedRobot(one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>0.0001</controlPeriod>"),
        ):
            self.assertEqual(len(log.having("shorter than the time step", level="ERROR")), 1)

    def test_control_periods_that_are_no_time(self):
        robot = SimulatedRobot(one_joint(POSITION), "<controlPeriod>inf</controlPeriod>")
        with self.assertRaisesRegex(PluginError, "<controlPeriod> must be a number of seconds, it is infinite"):
            robot.load()
        with SimulatedRobot(
            one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>nan</controlPeriod>", FORWARD
        ) as robot:
            robot.start("pos")  # as without it: every step

    def test_unknown_robot_sim(self):
        with self.assertRaisesRegex(PluginError, "nobody/Sim.*gazebo_ros_control/DefaultRobotHWSim"):
            SimulatedRobot(one_joint(POSITION), "<robotSimType>nobody/Sim</robotSimType>").load()

    def test_robot_sim_of_a_third_party(self):
        with tempfile.TemporaryDirectory() as folder:
            files = {
                "package.xml": '<package format="2"><name>third_sim</name><version>1.0.0</version><description>x'
                '</description><maintainer email="a@b.c">a</maintainer><license>BSD</license>'
                "<exec_depend>gazebo_ros_control</exec_depend><export><gazebo_ros_control "
                'plugin="${prefix}/sims.xml"/></export></package>',
                "sims.xml": '<library path="src"><class name="third_sim/Sim" type="third_sim_module.Sim"/></library>',
                "src/third_sim_module.py": "from gazebo_ros_control import RobotHWSim\n\n\nclass Sim(RobotHWSim):\n"
                "    written = 0\n\n    def init_sim(self, *arguments):\n        return True\n\n"
                "    def write_sim(self, time, period):\n        self.written += 1\n",
            }
            os.mkdir(os.path.join(folder, "src"))
            for name, text in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            before = os.environ["ROS_PACKAGE_PATH"]
            os.environ["ROS_PACKAGE_PATH"] = f"{folder}:{before}"
            self.addCleanup(os.environ.__setitem__, "ROS_PACKAGE_PATH", before)
            with SimulatedRobot(one_joint(POSITION), "<robotSimType>third_sim/Sim</robotSimType>") as robot:
                robot.step(5)
                self.assertEqual((type(robot.hw).__name__, robot.hw.written), ("Sim", 5))

    def test_emergency_stop(self):
        description = urdf(joint("j"), joint("k", NO_LIMIT, y=1.0), transmission("t", "j", POSITION), transmission("u", "k", EFFORT))
        parameters = {**FORWARD, "eff": {"type": "effort_controllers/JointEffortController", "joint": "k"}}
        with SimulatedRobot(description, "<robotNamespace>/robot</robotNamespace><eStopTopic>e_stop</eStopTopic>", parameters) as robot:
            robot.start("pos", "eff")
            robot.command("pos", 1.0)
            robot.command("eff", 0.5)
            robot.run(0.2)
            publisher = rospy.Publisher("/robot/e_stop", Bool, queue_size=2)
            wait_until(publisher.get_num_connections, "the plugin to listen")
            publisher.publish(True)
            wait_until(lambda: robot.plugin._e_stop, "the emergency stop")
            robot.step()
            position, velocity = robot.joint().position(), robot.joint("k").velocity()
            robot.run(0.3)
            self.assertAlmostEqual(robot.joint().position(), position, delta=1e-3)
            self.assertAlmostEqual(robot.joint("k").velocity(), velocity, delta=1e-3)
            publisher.publish(False)
            wait_until(lambda: not robot.plugin._e_stop, "the release")
            robot.run(0.3)
            self.assertAlmostEqual(robot.joint().position(), position, delta=2e-3, msg="controllers were restarted")
            robot.command("pos", 1.0)
            robot.run(0.3)
            self.assertGreater(robot.joint().position(), position + 0.1)

    def test_joint_states_survive_a_reset_of_time(self):
        with SimulatedRobot(one_joint(POSITION), parameters=FORWARD) as robot:
            stamps = []
            rospy.Subscriber("/robot/joint_states", JointState, lambda message: stamps.append(message.header.stamp))
            robot.start("states", "pos")
            gate = robot.controller("states")
            wait_until(lambda: gate._publisher.has_subscribers, "the subscriber")
            robot.run(5.0)
            wait_until(lambda: stamps, "joint states")
            robot.world.reset()
            robot.plugin.reset()
            del stamps[:]
            for _ in range(10):
                robot.run(0.05)
            wait_until(lambda: stamps and stamps[-1].to_sec() < 1.0, "joint states after the reset")

    def test_joint_states_at_regular_stamps(self):
        with SimulatedRobot(one_joint(POSITION), parameters=FORWARD) as robot:
            messages = []
            rospy.Subscriber("/robot/joint_states", JointState, messages.append, queue_size=100)
            robot.start("states", "pos")
            gate = robot.controller("states")
            wait_until(lambda: gate._publisher.has_subscribers, "the subscriber")
            robot.command("pos", 1.0)
            for _ in range(500):
                robot.step()
            wait_until(lambda: len(messages) >= 49, "joint states")
            messages = messages[1:]
            gaps = {(later.header.stamp - earlier.header.stamp).to_nsec() for earlier, later in zip(messages, messages[1:])}
            self.assertEqual(gaps, {10_000_000})
            advances = [later.position[0] - earlier.position[0] for earlier, later in zip(messages, messages[1:])]
            self.assertAlmostEqual(max(advances), 0.005, delta=1e-9)
            self.assertAlmostEqual(min(advances), 0.005, delta=1e-9)

    def test_same_commands_same_bits(self):
        def history():
            description = urdf(joint("j"), joint("k", NO_LIMIT, y=1.0), transmission("t", "j", POSITION), transmission("u", "k", EFFORT))
            parameters = {
                **FORWARD,
                "eff": {"type": "effort_controllers/JointVelocityController", "joint": "k", "pid": {"p": 0.8, "i": 0.1, "i_clamp": 1.0}},
            }
            with SimulatedRobot(description, parameters=parameters) as robot:
                for name in ("pos", "eff"):
                    assert robot.manager.load_controller(name)
                robot.run(0.1)
                robot.switch(["pos", "eff"])
                base = robot.world.iterations
                found = []
                for step in range(300):
                    if step == 50:
                        robot.command("pos", 0.7)
                        robot.command("eff", 1.5)
                    robot.step()
                    found.append((robot.joint().position(), robot.joint("k").position(), robot.joint("k").velocity()))
                return base, found

        self.assertEqual(history(), history())


if __name__ == "__main__":
    rospy.init_node("plugin_rostest")
    rostest.rosrun("gazebo_ros_control", "plugin", PluginTest)

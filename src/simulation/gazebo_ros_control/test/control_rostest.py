#!/usr/bin/env python3
"""gazebo_ros_control on a simulated robot: what commands do to joints, step by step."""
import math
import os
import sys
import tempfile
import threading
import time
import unittest

import rosgraph
import rospy
import rostest
from controller_manager_msgs.srv import ListControllerTypes
from gazebo_ros.plugin import PluginError
from hardware_interface import EffortJointInterface, PositionJointInterface, VelocityJointInterface
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulated_robot import (DT, INERTIA, LIMIT, NO_LIMIT, Log, SimulatedRobot, joint, transmission,  # noqa: E402
                             urdf)

POSITION, VELOCITY, EFFORT = (f"hardware_interface/{kind}JointInterface" for kind in ("Position", "Velocity", "Effort"))
FORWARD = {
    "pos": {"type": "position_controllers/JointPositionController", "joint": "j"},
    "vel": {"type": "velocity_controllers/JointVelocityController", "joint": "j"},
    "eff": {"type": "effort_controllers/JointEffortController", "joint": "j"},
    "states": {"type": "joint_state_controller/JointStateController", "publish_rate": 100},
}


def one_joint(*interfaces, limit=LIMIT, kind="revolute"):
    return urdf(joint("j", limit, kind), transmission("t", "j", *interfaces))


def gains(**values):
    return {**FORWARD, "gazebo_ros_control": {"pid_gains": {"j": values}}}


def wait_until(condition, what, timeout=60.0):
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain for {what}")
        time.sleep(0.005)


class PositionTest(unittest.TestCase):
    def test_follows_exactly_at_the_velocity_limit(self):
        with SimulatedRobot(one_joint(POSITION), parameters=FORWARD) as robot:
            robot.start("pos")
            robot.command("pos", 1.0)
            robot.step()
            start = robot.joint().position()
            for step in range(1, 1500):
                robot.step()
                self.assertAlmostEqual(robot.joint().position(), start + 0.5 * DT * step, delta=1e-9)
            robot.run(1.0)
            self.assertEqual(robot.joint().position(), 1.0)

    def test_position_limits(self):
        with SimulatedRobot(one_joint(POSITION, limit='<limit lower="-1" upper="0.2" effort="9" velocity="5"/>'),
                            parameters=FORWARD) as robot:
            robot.start("pos")
            for command, reached in ((7.0, 0.2), (-7.0, -1.0)):
                robot.command("pos", command)
                robot.run(1.0)
                self.assertAlmostEqual(robot.joint().position(), reached, delta=1e-9)

    def test_without_a_controller_it_holds_where_the_first_command_of_zero_took_it(self):
        robot = SimulatedRobot(one_joint(POSITION))
        robot.joint().set_position(0.3)
        with robot:
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().position(), 0.3 - 0.5 * DT, delta=1e-9, msg="one rate-limited step")
        robot = SimulatedRobot(one_joint(POSITION, limit="", kind="continuous"))
        robot.joint().set_position(0.3)
        with robot:
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().position(), 0.0, delta=1e-9, msg="no limit slows it down")

    def test_starting_a_controller_keeps_the_position(self):
        robot = SimulatedRobot(one_joint(POSITION), parameters=FORWARD)
        robot.joint().set_position(0.3)
        with robot:
            robot.start("pos")
            before = robot.joint().position()
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().position(), before, delta=2e-3)

    def test_a_held_joint_tells_the_weight_beyond(self):
        with SimulatedRobot(one_joint(POSITION), parameters=FORWARD) as robot:
            robot.joint().feedback()
            robot.start("pos")
            robot.command("pos", 0.0)
            robot.run(0.2)
            felt = robot.joint().feedback()
            weight = 0.5 * 9.8
            for got, wanted in zip((*felt.child_force, *felt.child_torque), (0, 0, weight, 0, -0.5 * weight, 0)):
                self.assertAlmostEqual(got, wanted, delta=1e-3)

    def test_no_p_gain_is_harmless_and_says_so(self):
        with Log.recorded() as log, SimulatedRobot(one_joint(POSITION)):
            line, = log.having("No p gain specified for pid.  Namespace: /robot/gazebo_ros_control/pid_gains/j")
            self.assertTrue(line.endswith("pid_gains/j"), line)
            self.assertEqual(len(log.having("nothing is wrong", "set p", level="INFO")), 1)
            self.assertEqual(log.having("No p gain", level="ERROR") + log.having("No p gain", level="WARNING"), [])

    def test_with_gains_a_pid_drives_it(self):
        with SimulatedRobot(one_joint(POSITION), parameters=gains(p=50.0, d=5.0)) as robot:
            robot.start("pos")
            robot.command("pos", 0.4)
            robot.step(2)
            self.assertGreater(robot.handle(PositionJointInterface).effort, 0.01)
            robot.run(0.3)
            self.assertLess(robot.joint().position(), 0.2, "rate-limited")
            robot.run(3.0)
            self.assertAlmostEqual(robot.joint().position(), 0.4, delta=0.005)
            services = [name for name, _ in rosgraph.Master("/t").getSystemState()[2]]
            self.assertIn("/robot/gazebo_ros_control/pid_gains/j/set_parameters", services)

    def test_a_pid_never_exceeds_the_effort_limit(self):
        limit = '<limit lower="-3" upper="3" effort="0.1" velocity="100"/>'
        with SimulatedRobot(one_joint(POSITION, limit=limit), parameters=gains(p=1e4)) as robot:
            robot.start("pos")
            robot.command("pos", 3.0)
            robot.step(10)
            self.assertAlmostEqual(robot.handle(PositionJointInterface).effort, 0.1, delta=1e-12)
            self.assertAlmostEqual(robot.joint().velocity(), 10 * DT * 0.1 / INERTIA, delta=1e-5)

    def test_a_pid_takes_the_short_way_of_a_continuous_joint(self):
        robot = SimulatedRobot(one_joint(POSITION, limit='<limit effort="10" velocity="100"/>', kind="continuous"),
                               parameters=gains(p=50.0, d=5.0))
        robot.joint().set_position(3.0)
        with robot:
            robot.start("pos")
            robot.command("pos", -3.0)
            robot.run(3.0)
            self.assertAlmostEqual(robot.joint().position(), 2.0 * math.pi - 3.0, delta=0.01)


class VelocityTest(unittest.TestCase):
    def test_motor(self):
        with SimulatedRobot(one_joint(VELOCITY, limit=NO_LIMIT), parameters=FORWARD) as robot:
            robot.start("vel")
            robot.command("vel", 2.0)
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().velocity(), 2.0, delta=1e-3)
            robot.command("vel", 0.0)
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().velocity(), 0.0, delta=1e-3)

    def test_limit(self):
        with SimulatedRobot(one_joint(VELOCITY), parameters=FORWARD) as robot:
            robot.start("vel")
            robot.command("vel", 9.0)
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().velocity(), 0.5, delta=1e-3)

    def test_many_turns_are_counted(self):
        with SimulatedRobot(one_joint(VELOCITY, limit=NO_LIMIT), parameters=FORWARD) as robot:
            robot.start("vel")
            robot.command("vel", 2.0 * math.pi)
            robot.run(3.0)
            self.assertAlmostEqual(robot.handle(VelocityJointInterface).position, 6.0 * math.pi, delta=0.05)

    def test_with_gains_a_pid_drives_it(self):
        with SimulatedRobot(one_joint(VELOCITY, limit=NO_LIMIT), parameters=gains(p=1.0)) as robot:
            robot.start("vel")
            robot.command("vel", 2.0)
            robot.step(3)
            self.assertLess(robot.joint().velocity(), 0.2)
            self.assertAlmostEqual(robot.handle(VelocityJointInterface).effort, 2.0, delta=0.2)
            robot.run(2.0)
            self.assertAlmostEqual(robot.joint().velocity(), 2.0, delta=0.01)


class EffortTest(unittest.TestCase):
    def test_torque_accelerates(self):
        with SimulatedRobot(one_joint(EFFORT, limit=NO_LIMIT), parameters=FORWARD) as robot:
            robot.start("eff")
            robot.command("eff", 0.27)
            robot.step()
            before = robot.joint().velocity()
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().velocity() - before, 0.5 * 0.27 / INERTIA, delta=0.01)
            self.assertAlmostEqual(robot.handle(EffortJointInterface).effort, 0.27, delta=1e-12)

    def test_limit(self):
        limit = '<limit lower="-1e9" upper="1e9" effort="0.1" velocity="100"/>'
        with SimulatedRobot(one_joint(EFFORT, limit=limit), parameters=FORWARD) as robot:
            robot.start("eff")
            robot.command("eff", 50.0)
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().velocity(), 0.5 * 0.1 / INERTIA, delta=0.01)

    def test_without_a_controller_it_is_free(self):
        robot = SimulatedRobot(one_joint(EFFORT, limit=NO_LIMIT))
        with robot:
            robot.step()
            robot.model.links["j_link"].add_torque((0.0, 0.0, 10.0))
            robot.step()
            velocity = robot.joint().velocity()
            self.assertGreater(velocity, 0.01)
            robot.run(0.2)
            self.assertAlmostEqual(robot.joint().velocity(), velocity, delta=1e-3)

    def test_position_below_minus_two_is_reported_as_it_is(self):
        robot = SimulatedRobot(one_joint(EFFORT))
        robot.joint().set_position(-2.9)
        with robot:
            robot.step(3)
            self.assertAlmostEqual(robot.handle(EffortJointInterface).position, -2.9, delta=1e-6)


class LimitsTest(unittest.TestCase):
    def test_parameters_override_the_description(self):
        with SimulatedRobot(one_joint(POSITION), parameters={**FORWARD, "joint_limits": {"j": {
                "has_velocity_limits": True, "max_velocity": 0.1, "has_position_limits": True, "min_position": 0.0,
                "max_position": 0.05}}}) as robot:
            robot.start("pos")
            robot.command("pos", 1.0)
            robot.run(0.3)
            self.assertAlmostEqual(robot.joint().position(), 0.03, delta=1e-3)
            robot.run(0.7)
            self.assertAlmostEqual(robot.joint().position(), 0.05, delta=1e-9)

    def test_soft_limits(self):
        limit = LIMIT + '<safety_controller soft_lower_limit="-0.1" soft_upper_limit="0.1" k_position="10"/>'
        with SimulatedRobot(one_joint(POSITION, limit=limit), parameters=FORWARD) as robot:
            robot.start("pos")
            robot.command("pos", 1.0)
            robot.run(2.0)
            self.assertAlmostEqual(robot.joint().position(), 0.1, delta=1e-4)

    def test_zero_velocity_limit_is_pointed_out(self):
        with Log.recorded() as log, SimulatedRobot(
                one_joint(POSITION, limit='<limit lower="-1" upper="1" effort="9" velocity="0"/>')) as robot:
            self.assertEqual(len(log.having("'j' has a velocity limit of 0", level="WARNING")), 1)
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().position(), 0.0, delta=1e-9)

    def test_numbers_that_are_none(self):
        for interface, controller in ((POSITION, "pos"), (VELOCITY, "vel"), (EFFORT, "eff")):
            for limit, kind in ((LIMIT, "revolute"), ("", "continuous")):
                for bad in (math.nan, math.inf, -math.inf):
                    with self.subTest(interface=interface, limit=limit, bad=bad), Log.recorded() as log, \
                            SimulatedRobot(one_joint(interface, limit=limit, kind=kind), parameters=FORWARD) as robot:
                        robot.start(controller)
                        robot.command(controller, 0.1)
                        robot.step(3)
                        robot.command(controller, bad)
                        robot.step(100)
                        self.assertTrue(math.isfinite(robot.joint().position()))
                        self.assertLess(abs(robot.joint().velocity()), 1.0)
                        self.assertEqual(robot.state(controller), "running")
                        if math.isnan(bad):
                            self.assertEqual(len(log.having("'j' was commanded nan", level="WARNING")), 1)


class TransmissionsTest(unittest.TestCase):
    def test_one_bad_transmission_does_not_take_the_others_along(self):
        description = urdf(
            joint("j"), joint("k", y=1.0), joint("m", y=2.0),
            transmission("good", "j", POSITION),
            transmission("unknown", "k", "hardware_interface/ForceJointInterface"),
            transmission("absent", "nowhere", POSITION),
            transmission("two", "m", POSITION, joints=f'<joint name="k"><hardwareInterface>{POSITION}'
                                                      "</hardwareInterface></joint>"),
            '<transmission name="old"><type>T</type><joint name="m"/><actuator name="a"><hardwareInterface>'
            f"{POSITION}</hardwareInterface></actuator></transmission>")
        with Log.recorded() as log, SimulatedRobot(description, parameters=FORWARD) as robot:
            self.assertEqual(robot.hw.get(PositionJointInterface).names(), ["j"])
            self.assertEqual(len(log.having("'unknown'", "ForceJointInterface", "possible are", level="ERROR")), 1)
            self.assertEqual(len(log.having("'absent'", "'nowhere'", "it has: j, k, m", level="ERROR")), 1)
            self.assertEqual(len(log.having("'two'", "has 2 joints", "SimpleTransmission of its own", level="WARNING")), 1)
            self.assertEqual(len(log.having("'old'", "belongs into <joint>", level="ERROR")), 1)
            robot.start("pos")
            robot.command("pos", 0.1)
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().position(), 0.1, delta=1e-9)

    def test_interface_without_prefix(self):
        with Log.recorded() as log, SimulatedRobot(one_joint("EffortJointInterface"), parameters=FORWARD) as robot:
            self.assertEqual(len(log.having("Deprecated syntax", "hardware_interface/", level="WARNING")), 1)
            robot.start("eff")

    def test_doubled_transmission(self):
        description = urdf(joint("j"), transmission("t", "j", POSITION), transmission("t", "j", POSITION))
        with Log.recorded() as log, SimulatedRobot(description, parameters=FORWARD) as robot:
            self.assertEqual(len(log.having("is there already", level="WARNING")), 1)
            robot.start("pos")
            robot.command("pos", 0.1)
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().position(), 0.1, delta=1e-9)

    def test_switching_between_the_interfaces_of_a_joint(self):
        with SimulatedRobot(one_joint(POSITION, VELOCITY, EFFORT, limit=NO_LIMIT), parameters=FORWARD) as robot:
            robot.start("pos")
            robot.command("pos", 0.2)
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().position(), 0.2, delta=1e-9)
            self.assertTrue(robot.manager.load_controller("vel"))
            self.assertTrue(robot.manager.load_controller("eff"))
            robot.switch(["vel"], ["pos"])
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().position(), 0.2, delta=1e-3)
            robot.command("vel", 1.0)
            robot.run(0.5)
            self.assertAlmostEqual(robot.joint().velocity(), 1.0, delta=1e-3)
            robot.switch(["eff"], ["vel"])
            velocity = robot.joint().velocity()
            robot.run(0.2)
            self.assertAlmostEqual(robot.joint().velocity(), velocity, delta=0.01, msg="the motor has let go")
            robot.switch(["pos"], ["eff"])
            position = robot.joint().position()
            robot.run(0.2)
            self.assertAlmostEqual(robot.joint().position(), position, delta=0.01, msg="held where it was")


class PluginTest(unittest.TestCase):
    def service_there(self, namespace):
        services = [name for name, _ in rosgraph.Master("/t").getSystemState()[2]]
        return f"{namespace}/controller_manager/list_controllers" in services

    def test_namespaces(self):
        for plugin, namespace in (("<robotNamespace>/a/b</robotNamespace>", "/a/b"), ("", "/model"),
                                  ("<robotNamespace>/</robotNamespace>", ""), ("<robotNamespace/>", ""),
                                  ("<robotNamespace>arm</robotNamespace>", "/arm")):
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
        robot = SimulatedRobot(one_joint(POSITION), "<robotNamespace>/robot</robotNamespace>"
                               "<robotParam>my_description</robotParam>", describe=False)
        rospy.set_param("/robot/my_description", one_joint(POSITION))
        with robot:
            self.assertEqual(robot.hw.get(PositionJointInterface).names(), ["j"])

    def test_waiting_for_the_description_does_not_stop_the_world(self):
        with Log.recorded() as log, SimulatedRobot(one_joint(POSITION), describe=False) as robot:
            wait_until(lambda: log.having("waiting for model URDF in parameter [robot_description] on the ROS param server",
                                          "/robot and above", level="WARNING"), "the plugin's word")
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
        with Log.recorded() as log, SimulatedRobot(
                one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>0.01</controlPeriod>",
                FORWARD) as robot:
            self.assertEqual(len(log.having("<controlPeriod>0.01 is longer", level="WARNING")), 1)
            robot.start("pos")
            periods = []
            robot.manager.controllers[0].update = lambda time, period: periods.append(period)
            robot.run(0.1)
            self.assertEqual(len(periods), 10)
            self.assertAlmostEqual(min(periods), 0.01, delta=1e-9)
            self.assertAlmostEqual(max(periods), 0.01, delta=1e-9)

    def test_control_period_shorter_than_the_step(self):
        with Log.recorded() as log, SimulatedRobot(
                one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>0.0001</controlPeriod>"):
            self.assertEqual(len(log.having("shorter than the time step", level="ERROR")), 1)

    def test_control_periods_that_are_no_time(self):
        robot = SimulatedRobot(one_joint(POSITION), "<controlPeriod>inf</controlPeriod>")
        with self.assertRaisesRegex(PluginError, "<controlPeriod> must be a number of seconds, it is infinite"):
            robot.load()
        with SimulatedRobot(one_joint(POSITION), "<robotNamespace>/robot</robotNamespace><controlPeriod>nan</controlPeriod>",
                            FORWARD) as robot:
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
        description = urdf(joint("j"), joint("k", NO_LIMIT, y=1.0), transmission("t", "j", POSITION),
                           transmission("u", "k", EFFORT))
        parameters = {**FORWARD, "eff": {"type": "effort_controllers/JointEffortController", "joint": "k"}}
        with SimulatedRobot(description, "<robotNamespace>/robot</robotNamespace><eStopTopic>e_stop</eStopTopic>",
                            parameters) as robot:
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
            gaps = {(later.header.stamp - earlier.header.stamp).to_nsec()
                    for earlier, later in zip(messages, messages[1:])}
            self.assertEqual(gaps, {10_000_000})
            advances = [later.position[0] - earlier.position[0] for earlier, later in zip(messages, messages[1:])]
            self.assertAlmostEqual(max(advances), 0.005, delta=1e-9)
            self.assertAlmostEqual(min(advances), 0.005, delta=1e-9)

    def test_same_commands_same_bits(self):
        def history():
            description = urdf(joint("j"), joint("k", NO_LIMIT, y=1.0), transmission("t", "j", POSITION),
                               transmission("u", "k", EFFORT))
            parameters = {**FORWARD, "eff": {"type": "effort_controllers/JointVelocityController", "joint": "k",
                                             "pid": {"p": 0.8, "i": 0.1, "i_clamp": 1.0}}}
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


def suite():
    loader = unittest.TestLoader()
    return unittest.TestSuite(loader.loadTestsFromTestCase(case) for case in (
        PositionTest, VelocityTest, EffortTest, LimitsTest, TransmissionsTest, PluginTest))


if __name__ == "__main__":
    rospy.init_node("control_rostest")
    rostest.rosrun("gazebo_ros_control", "control", "control_rostest.suite")

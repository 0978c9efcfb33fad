#!/usr/bin/env python3
"""gazebo_ros_control on a simulated robot: what commands do to joints, step by step."""

import math
import os
import sys
import unittest

import rosgraph
import rospy
import rostest
import test_support
from hardware_interface import EffortJointInterface, PositionJointInterface, VelocityJointInterface

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulated_robot import (  # noqa: E402
    DT,
    EFFORT,
    FORWARD,
    INERTIA,
    LIMIT,
    NO_LIMIT,
    POSITION,
    VELOCITY,
    Log,
    SimulatedRobot,
    gains,
    joint,
    one_joint,
    transmission,
    urdf,
)


class PositionTest(test_support.TestCase):
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
        with SimulatedRobot(
            one_joint(POSITION, limit='<limit lower="-1" upper="0.2" effort="9" velocity="5"/>'), parameters=FORWARD
        ) as robot:
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

    def test_it_tells_the_simulator_which_joints_it_drives(self):
        """At once those that hold without a controller; one on efforts is free until its controller starts."""
        with SimulatedRobot(one_joint(POSITION)) as robot:
            self.assertEqual(robot.server.driven, [["j"]])
        with SimulatedRobot(one_joint(VELOCITY)) as robot:
            self.assertEqual(robot.server.driven, [["j"]])
        with SimulatedRobot(
            one_joint(EFFORT), parameters={"eff": {"type": "effort_controllers/JointEffortController", "joint": "j"}}
        ) as robot:
            self.assertEqual(robot.server.driven, [])
            robot.start("eff")
            self.assertEqual(robot.server.driven, [["j"]])

    def test_no_p_gain_is_harmless_and_says_so(self):
        with Log.recorded() as log, SimulatedRobot(one_joint(POSITION)):
            (line,) = log.having("No p gain specified for pid.  Namespace: /robot/gazebo_ros_control/pid_gains/j")
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
        robot = SimulatedRobot(
            one_joint(POSITION, limit='<limit effort="10" velocity="100"/>', kind="continuous"), parameters=gains(p=50.0, d=5.0)
        )
        robot.joint().set_position(3.0)
        with robot:
            robot.start("pos")
            robot.command("pos", -3.0)
            robot.run(3.0)
            self.assertAlmostEqual(robot.joint().position(), 2.0 * math.pi - 3.0, delta=0.01)


class VelocityTest(test_support.TestCase):
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


class EffortTest(test_support.TestCase):
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


class LimitsTest(test_support.TestCase):
    def test_parameters_override_the_description(self):
        with SimulatedRobot(
            one_joint(POSITION),
            parameters={
                **FORWARD,
                "joint_limits": {
                    "j": {
                        "has_velocity_limits": True,
                        "max_velocity": 0.1,
                        "has_position_limits": True,
                        "min_position": 0.0,
                        "max_position": 0.05,
                    }
                },
            },
        ) as robot:
            robot.start("pos")
            robot.command("pos", 1.0)
            robot.run(0.3)
            self.assertAlmostEqual(robot.joint().position(), 0.03, delta=1e-3)
            robot.run(0.7)
            self.assertAlmostEqual(robot.joint().position(), 0.05, delta=1e-9)

    def test_soft_limits(self):
        limit = LIMIT + '<safety_controller soft_lower_limit="-0.1" soft_upper_limit="0.1" k_position="10" k_velocity="1"/>'
        with SimulatedRobot(one_joint(POSITION, limit=limit), parameters=FORWARD) as robot:
            robot.start("pos")
            robot.command("pos", 1.0)
            robot.run(2.0)
            self.assertAlmostEqual(robot.joint().position(), 0.1, delta=1e-4)

    def test_zero_velocity_limit_is_pointed_out(self):
        with (
            Log.recorded() as log,
            SimulatedRobot(one_joint(POSITION, limit='<limit lower="-1" upper="1" effort="9" velocity="0"/>')) as robot,
        ):
            self.assertEqual(len(log.having("'j' has a velocity limit of 0", level="WARNING")), 1)
            robot.run(0.1)
            self.assertAlmostEqual(robot.joint().position(), 0.0, delta=1e-9)

    def test_gains_of_zero_of_a_safety_controller_are_pointed_out(self):
        for interface, soft, said in (
            (EFFORT, 'k_position="5" k_velocity="0"', "k_velocity 0: no force can move it"),
            (EFFORT, 'k_position="0" k_velocity="5"', "k_position 0: it cannot move"),
            (POSITION, 'k_velocity="5"', "k_position 0: it cannot move"),
            (VELOCITY, 'k_position="5" k_velocity="0"', ""),
            (EFFORT, 'k_position="5" k_velocity="5"', ""),
        ):
            limit = LIMIT + f'<safety_controller soft_lower_limit="-1" soft_upper_limit="1" {soft}/>'
            with (
                self.subTest(interface=interface, soft=soft),
                Log.recorded() as log,
                SimulatedRobot(one_joint(interface, limit=limit), parameters=FORWARD),
            ):
                told = log.having("<safety_controller>", level="WARNING")
                self.assertEqual(len(told), bool(said), told)
                self.assertTrue(all(said in line and "'j'" in line for line in map(str, told)), told)

    def test_numbers_that_are_none(self):
        for interface, controller in ((POSITION, "pos"), (VELOCITY, "vel"), (EFFORT, "eff")):
            for limit, kind in ((LIMIT, "revolute"), ("", "continuous")):
                for bad in (math.nan, math.inf, -math.inf):
                    with (
                        self.subTest(interface=interface, limit=limit, bad=bad),
                        Log.recorded() as log,
                        SimulatedRobot(one_joint(interface, limit=limit, kind=kind), parameters=FORWARD) as robot,
                    ):
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


class TransmissionsTest(test_support.TestCase):
    def test_one_bad_transmission_does_not_take_the_others_along(self):
        description = urdf(
            joint("j"),
            joint("k", y=1.0),
            joint("m", y=2.0),
            transmission("good", "j", POSITION),
            transmission("unknown", "k", "hardware_interface/ForceJointInterface"),
            transmission("absent", "nowhere", POSITION),
            transmission("two", "m", POSITION, joints=f'<joint name="k"><hardwareInterface>{POSITION}</hardwareInterface></joint>'),
            '<transmission name="old"><type>T</type><joint name="m"/><actuator name="a"><hardwareInterface>'
            f"{POSITION}</hardwareInterface></actuator></transmission>",
        )
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


def suite():
    loader = unittest.TestLoader()
    return unittest.TestSuite(
        loader.loadTestsFromTestCase(case) for case in (PositionTest, VelocityTest, EffortTest, LimitsTest, TransmissionsTest)
    )


if __name__ == "__main__":
    rospy.init_node("control_rostest")
    rostest.rosrun("gazebo_ros_control", "control", "control_rostest.suite")

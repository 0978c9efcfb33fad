#!/usr/bin/env python3
"""The tutorial's session: load, start, hold level with a PD's sag, turn round and round."""

import time
import unittest

import rospy
import rostest
from controller_manager_msgs.srv import ListControllers, SwitchController
from lab_tools.simulation import PATIENCE, Topic, run_free
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import Empty

NAMES = ["joint_state_controller", "joint1_position_controller", "joint1_velocity_controller"]
WEIGHT = 0.5 * 9.8 * 0.2  # N m, of the level bar about the axis
STIFFNESS = 30.0  # N m/rad, gain p of the position controller


class Simulation(unittest.TestCase):
    def switch(self, start, stop):
        request = {
            "start_controllers": ["controllers/" + name for name in start],
            "stop_controllers": ["controllers/" + name if name else "" for name in stop],
        }
        switch = rospy.ServiceProxy("/controller_manager/switch_controller", SwitchController)
        self.assertTrue(switch(strictness=1, start_asap=True, timeout=0.0, **request).ok)

    def command(self, controller, value):
        publisher = rospy.Publisher("/controllers/%s/command" % controller, Float64, queue_size=1, latch=True)
        publisher.publish(value)
        return publisher

    def test_session(self):
        rospy.wait_for_service("/controller_manager/list_controllers", PATIENCE)
        controllers = rospy.ServiceProxy("/controller_manager/list_controllers", ListControllers)
        while len(controllers().controller) < 3:
            time.sleep(0.1)  # simulated time stands still
        self.assertEqual({c.name: c.state for c in controllers().controller}, {"controllers/" + name: "initialized" for name in NAMES})
        states = Topic("/joint_states", JointState)
        rospy.ServiceProxy("/gazebo/unpause_physics", Empty)()
        self.switch(["joint_state_controller"], [""])
        swinging = states.wait_for(lambda m: abs(m.velocity[0]) > 0.1, "a bar that swings")
        self.assertEqual(swinging.name, ["joint1"])
        run_free()

        self.switch(["joint1_position_controller"], ["joint1_velocity_controller"])
        self.command("joint1_position_controller", 0.0)
        sag = WEIGHT / STIFFNESS  # positive is down
        level = states.wait_for(lambda m: abs(m.velocity[0]) < 1e-4 and abs(m.position[0] - sag) < 2e-3, "rest, level")
        held = states.wait_for(lambda m: (m.header.stamp - level.header.stamp).to_sec() > 2, "two seconds later")
        self.assertAlmostEqual(held.position[0], sag, delta=2e-3)
        self.assertAlmostEqual(held.velocity[0], 0.0, delta=1e-3)

        self.switch(["joint1_velocity_controller"], ["joint1_position_controller"])
        self.command("joint1_velocity_controller", 3.1415)
        first = states.wait_for(lambda m: m.position[0] - held.position[0] > 4 * 3.14159, "a steady turn, after two")
        last = states.wait_for(lambda m: m.position[0] - first.position[0] > 20 * 3.14159, "ten turns on")
        mean = (last.position[0] - first.position[0]) / (last.header.stamp - first.header.stamp).to_sec()
        self.assertAlmostEqual(mean, 2.85, delta=0.1)
        speeds = [m.velocity[0] for m in states.messages if first.header.stamp <= m.header.stamp <= last.header.stamp]
        self.assertAlmostEqual(min(speeds), 1.9, delta=0.1)
        self.assertAlmostEqual(max(speeds), 4.3, delta=0.1)


if __name__ == "__main__":
    rospy.init_node("simulation_rostest")
    rostest.rosrun("rm_controls_tutorials", "simulation", Simulation)

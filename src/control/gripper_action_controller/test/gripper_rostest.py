#!/usr/bin/env python3
"""Behaviour of the gripper action controllers."""

import math

import actionlib
import rospy
import test_support
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import GripperCommand, GripperCommandAction, GripperCommandGoal
from control_test_robots import client
from sensor_msgs.msg import JointState


class Gripper(test_support.TestCase):
    def setUp(self):
        client.set_faults()

    def connect(self, controller):
        action = actionlib.ActionClient(f"/{controller}/gripper_cmd", GripperCommandAction)
        self.addCleanup(action.stop)  # else its connection to this controller is counted as one to the next
        action.wait_for_server()
        return action

    def send(self, action, position, max_effort=0.0):
        return action.send_goal(GripperCommandGoal(GripperCommand(position, max_effort)))

    def finish(self, goal):
        client.wait_until(lambda: goal.get_comm_state() == actionlib.CommState.DONE, "the goal to end")
        return goal.get_terminal_state(), goal.get_result()

    def test_reaches_its_goal_and_reports_the_effort_asked_for(self):
        with client.running("position"):
            action = self.connect("position")
            self.finish(self.send(action, 0.0, 3.0))
            status, result = self.finish(self.send(action, 0.05, 7.0))
        self.assertEqual((status, result.reached_goal, result.stalled), (GoalStatus.SUCCEEDED, True, False))
        self.assertAlmostEqual(result.position, 0.05, delta=0.002)
        self.assertEqual(result.effort, 7.0)

    def test_something_held_is_a_stall(self):
        with client.running("position"):
            action = self.connect("position")
            self.finish(self.send(action, 0.0))
            client.set_faults(finger={"upper_bound": 0.03})
            before = rospy.get_time()
            status, result = self.finish(self.send(action, 0.05))
            self.assertGreater(rospy.get_time() - before, 0.5)
        self.assertEqual((status, result.reached_goal, result.stalled), (GoalStatus.ABORTED, False, True))
        self.assertAlmostEqual(result.position, 0.03, delta=1e-6)

    def test_new_goal_replaces_the_old_one(self):
        client.set_faults(finger={"smoothing": 0.99})
        with client.running("position"):
            action = self.connect("position")
            first = self.send(action, 5.0)
            client.wait_until(lambda: first.get_comm_state() == actionlib.CommState.ACTIVE, "the goal to become active")
            second = self.send(action, 0.05)
            self.assertEqual(self.finish(first)[0], GoalStatus.PREEMPTED)
            client.set_faults()
            self.assertEqual(self.finish(second)[0], GoalStatus.SUCCEEDED)

    def test_cancel_holds_where_it_is(self):
        client.set_faults(finger={"smoothing": 0.99})
        with client.running("joint_states", "position"):
            action = self.connect("position")
            goal = self.send(action, 5.0)
            client.wait_until(lambda: goal.get_comm_state() == actionlib.CommState.ACTIVE, "the goal to become active")
            client.sim_sleep(0.3)
            goal.cancel()
            status, _ = self.finish(goal)
            self.assertEqual(status, GoalStatus.PREEMPTED)
            client.set_faults()
            state = client.Topic("/joint_states", JointState)
            client.sim_sleep(0.5)
            last = state.next()
            held = last.position[last.name.index("finger")]
            self.assertTrue(0.1 < held < 4.5, held)
            state.close()

    def test_stop_preempts_and_a_stopped_controller_rejects(self):
        client.set_faults(finger={"smoothing": 0.99})
        with client.running("position"):
            action = self.connect("position")
            goal = self.send(action, 5.0)
            client.wait_until(lambda: goal.get_comm_state() == actionlib.CommState.ACTIVE, "the goal to become active")
            client.switch(stop=["position"])
            self.assertEqual(self.finish(goal)[0], GoalStatus.PREEMPTED)
            rejected = self.send(action, 0.0)
            self.assertEqual(self.finish(rejected)[0], GoalStatus.REJECTED)
            self.assertIn("not running", rejected.get_goal_status_text())

    def test_goals_that_are_not_numbers_are_rejected(self):
        with client.running("position"):
            self.assertEqual(self.finish(self.send(self.connect("position"), math.nan))[0], GoalStatus.REJECTED)

    def test_effort_is_bounded_by_the_goal(self):
        with client.running("effort"):
            action = self.connect("effort")
            status, result = self.finish(self.send(action, 0.5, 0.0))  # no force: no motion
            self.assertEqual((status, result.stalled, result.effort), (GoalStatus.ABORTED, True, 0.0))
            self.assertAlmostEqual(result.position, 0.0, delta=1e-9)
            status, result = self.finish(self.send(action, 0.5, 4.0))
            self.assertEqual((status, result.reached_goal), (GoalStatus.SUCCEEDED, True))
            self.assertLessEqual(abs(result.effort), 4.0)

    def test_wrong_parameters_are_refused(self):
        for name in ("no_joint", "unknown_joint", "no_gains"):
            with self.subTest(name):
                self.assertFalse(client.loads(name))


if __name__ == "__main__":
    import rostest

    rospy.init_node("gripper")
    rostest.rosrun("gripper_action_controller", "gripper", "__main__")

#!/usr/bin/env python3
"""Configurations that name CHOMP and STOMP: what move_group says of them as it starts, and what its pipelines answer."""

import signal
import subprocess
import tempfile
import unittest

import rospy
import rostest
from client import HOME, PATIENCE, move, plan, wait_until
from motions_rostest import path, place, state_of, vector
from moveit_msgs.msg import MoveItErrorCodes

Codes = MoveItErrorCodes
CHOMP = """collision_clearance, collision_threshold, enable_failure_recovery, joint_update_limit, learning_rate, max_iterations,
max_iterations_after_collision_free, max_recovery_attempts, obstacle_cost_weight, planning_time_limit, pseudo_inverse_ridge_factor,
ridge_factor, smoothness_cost_acceleration, smoothness_cost_jerk, smoothness_cost_velocity, smoothness_cost_weight,
trajectory_initialization_method, use_pseudo_inverse, use_stochastic_descent""".replace("\n", " ")


class Pipelines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = tempfile.TemporaryFile("w+")
        cls.node = subprocess.Popen(["rosrun", "moveit_ros_move_group", "move_group"], stdout=cls.log, stderr=subprocess.STDOUT)
        rospy.wait_for_service("plan_kinematic_path", timeout=PATIENCE)

    @classmethod
    def tearDownClass(cls):
        cls.node.send_signal(signal.SIGINT)
        cls.node.wait(PATIENCE)

    @classmethod
    def lines(cls):
        """What the node has written so far."""
        cls.log.seek(0)
        return cls.log.read().splitlines()

    def said(self, *words):
        found = [line for line in self.lines() if all(word in line for word in words)]
        return len(found)

    def test_what_is_not_here_is_told_once(self):
        wait_until(lambda: self.said("You can start planning now"), "move_group")
        self.assertEqual(self.said("WARN", "request adapter 'chomp/OptimizerAdapter' is not known and left out"), 1)
        self.assertEqual(self.said("WARN", "/move_group/planning_pipelines/ompl-chomp", "not used here: " + CHOMP), 1)
        self.assertEqual(self.said("WARN", "request adapter 'stomp_moveit/StompSmoothingAdapter' is not known and left out"), 1)
        self.assertEqual(self.said("WARN", "/move_group/planning_pipelines/ompl-stomp", "not used here: stomp"), 1)
        for plugin in ("chomp_interface/CHOMPPlanner", "stomp_moveit/StompPlannerManager"):
            self.assertEqual(self.said("WARN", f"Exception while loading planner '{plugin}'", "use pipeline:=ompl"), 1)
        self.assertEqual(self.said("Traceback"), 0)

    def test_ompl_plans_where_an_optimizer_would_smooth(self):
        for pipeline in ("ompl-chomp", "ompl-stomp", ""):
            for planner in ("", "RRTConnect", "CHOMP"):
                fields = dict(pipeline_id=pipeline, planner_id=planner, start_state=state_of(HOME))
                found = plan([0.5] + HOME[1:], **fields)
                self.assertEqual(found.error_code.val, Codes.SUCCESS, (pipeline, planner))
                self.assertGreater(found.trajectory.joint_trajectory.points[-1].time_from_start.to_sec(), 0.0)
                self.assertLess(abs(path(found.trajectory)[-1] - vector(place([0.5] + HOME[1:]))).max(), 1e-3)

    def test_a_pipeline_without_its_planner_refuses_requests_and_says_what_plans(self):
        for pipeline in ("chomp", "stomp"):
            for planner in ("", "CHOMP", "STOMP"):
                fields = dict(pipeline_id=pipeline, planner_id=planner, start_state=state_of(HOME))
                self.assertEqual(plan([0.5] + HOME[1:], **fields).error_code.val, Codes.FAILURE)
            _status, result, text = move([0.5] + HOME[1:], plan_only=True, **fields).result()
            self.assertEqual(result.error_code.val, Codes.FAILURE)
            self.assertIn("use pipeline:=ompl", text)


if __name__ == "__main__":
    rospy.init_node("pipelines_rostest")
    rostest.rosrun("moveit_ros_move_group", "pipelines", Pipelines)

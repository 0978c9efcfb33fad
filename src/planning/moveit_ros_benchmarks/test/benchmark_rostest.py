#!/usr/bin/env python3
"""Stored queries are solved by every planner, and the logs say how."""

import os
import sqlite3
import subprocess
import tempfile
import unittest

import rospy
import rostest
import yaml
from moveit_msgs.msg import CollisionObject, Constraints, JointConstraint, MotionPlanRequest, PlanningScene, RobotState
from moveit_ros_benchmarks import log
from moveit_ros_benchmarks.executor import Executor
from moveit_ros_benchmarks.options import OptionsError, load, read
from moveit_ros_warehouse.storage import Warehouse
from shape_msgs.msg import SolidPrimitive

JOINTS = [f"joint_{number}" for number in range(1, 7)]
HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]
PIPELINES = [{"name": "ompl", "planners": ["Connect", "Tree"]}]
PATIENCE = 300.0


def goal(values):
    return Constraints(
        name="goal", joint_constraints=[JointConstraint(name, value, 1e-3, 1e-3, 1.0) for name, value in zip(JOINTS, values)]
    )


def fill(base):
    box = CollisionObject(id="box", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.1, 0.1])])
    box.pose.position.x, box.pose.position.z, box.pose.orientation.w = 2.0, 1.0, 1.0
    scene = PlanningScene(name="kitchen", robot_model_name="arm", is_diff=True)
    scene.robot_state.is_diff = True
    scene.world.collision_objects = [box]
    base.scenes.save("kitchen", scene)
    state = RobotState(is_diff=True)
    state.joint_state.name, state.joint_state.position = JOINTS, HOME
    base.states.save("home", state)
    base.add_request("kitchen", MotionPlanRequest(goal_constraints=[goal([0.8, *HOME[1:]])]), "pick")


class Benchmark(unittest.TestCase):
    def test_stored_queries(self):
        with tempfile.TemporaryDirectory() as folder:
            fill(Warehouse(os.path.join(folder, "warehouse.sqlite")))
            rospy.set_param("~database_path", folder)
            file = os.path.join(folder, "bench.yaml")
            config = {
                "warehouse": {"scene_name": "kitchen"},
                "planning_pipelines": PIPELINES,
                "parameters": {
                    "name": "test",
                    "runs": 2,
                    "group": "manipulator",
                    "timeout": 5.0,
                    "start_states": "home",
                    "output_directory": os.path.join(folder, "out"),
                },
            }
            with open(file, "w", encoding="utf-8") as out:
                yaml.safe_dump({"benchmark_config": config}, out)
            # under this node's name, so that it finds this test's parameters
            done = subprocess.run(
                [
                    "rosrun",
                    "moveit_ros_benchmarks",
                    "moveit_run_benchmark",
                    file,
                    "--benchmark-planners",
                    f"__name:={rospy.get_name().lstrip('/')}_copy",
                ],
                capture_output=True,
                text=True,
                timeout=PATIENCE,
            )
            self.assertEqual((done.returncode, "Traceback" in done.stderr), (1, False))
            self.assertIn("Planning pipeline 'ompl' does NOT exist", done.stdout + done.stderr)
            from moveit_ros_benchmarks.executor import open_warehouse

            options = load(file)
            executor = Executor(options)
            problems = executor.load(open_warehouse(options))
            self.assertEqual([problem.name for problem in problems], ["home_pick"])
            logs = executor.run(problems)
            with open(logs[0], encoding="utf-8") as text:
                entry = log.read(text.read())
            self.assertEqual(list(entry.planners), ["Connect (ompl)", "Tree (ompl)"])
            for run in entry.planners["Connect (ompl)"]:
                self.assertEqual((run["solved BOOLEAN"], run["final_path_correct BOOLEAN"]), ("1", "1"))
                self.assertGreater(float(run["final_path_length REAL"]), 0.79)
                self.assertGreater(float(run["final_path_clearance REAL"]), 0.0)
                self.assertIn("average_waypoint_distance REAL", run)
            self.statistics(folder, logs)

    def statistics(self, folder, logs):
        base = os.path.join(folder, "b.db")
        done = subprocess.run(
            ["rosrun", "moveit_ros_benchmarks", "moveit_benchmark_statistics.py", "-d", base, *logs],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = (
            sqlite3.connect(base)
            .execute("SELECT name, solved, final_path_length FROM runs JOIN plannerConfigs ON plannerid = plannerConfigs.id")
            .fetchall()
        )
        self.assertEqual(sorted({row[0] for row in rows}), ["Connect (ompl)", "Tree (ompl)"])
        self.assertEqual(len(rows), 4)

    def test_poses_of_the_robot(self):
        options = read(
            {
                "parameters": {"group": "manipulator", "runs": 1, "predefined_poses": ["home", "left", "ghost"]},
                "planning_pipelines": PIPELINES[:1],
            },
            "here",
        )
        self.assertEqual([problem.name for problem in Executor(options).combine_poses()], ["home_left", "left_home"])

    def test_what_is_wrong_is_said(self):
        good = {"parameters": {"group": "manipulator"}, "planning_pipelines": PIPELINES}
        for change, message in (
            ({"parameters": {}}, "here/parameters/group is missing"),
            ({"parameters": {"group": "manipulator", "runs": "many"}}, "runs is 'many'"),
            ({"planning_pipelines": []}, "names no planner"),
            ({"planning_pipelines": [{"name": "ompl", "planners": ["STAR"]}]}, "there are: Connect, Tree"),
            ({"parameters": {"group": "tail"}}, "it has: manipulator, hand"),
            ({}, "there is nothing to solve"),
        ):
            with self.assertRaisesRegex(OptionsError, message):
                Executor(read({**good, **change}, "here")).load(None)

    def test_files_of_old_configurations(self):
        with tempfile.NamedTemporaryFile("w", suffix=".cfg") as file:
            file.write(
                "[scene]\nname=kitchen\ngroup=manipulator\nruns=3\ntimeout=2.5\nquery=.*pick\n[plugin]\n"
                "name=ompl_interface_ros/OMPLPlanner\nplanners=Connect Tree\n"
            )
            file.flush()
            options = load(file.name)
        self.assertEqual((options.scene, options.runs, options.timeout, options.queries), ("kitchen", 3, 2.5, ".*pick"))
        self.assertEqual(options.pipelines, {"ompl": ["Connect", "Tree"]})


if __name__ == "__main__":
    rospy.init_node("benchmark_rostest")
    rostest.rosrun("moveit_ros_benchmarks", "benchmark", Benchmark)

"""An arm in a scene, a request to it, and what is measured of the path of its tool."""

import motion
import numpy as np
import pytest
import robots

HOME = [0.3, -1.2, 1.4, -0.9, 1.1, 0.5]


@pytest.fixture(scope="module")
def model():
    return motion.load_model(*robots.arm("ur5"))


@pytest.fixture
def scene(model):
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("arm", HOME)
    scene.set_state(state)
    return scene


def places(trajectory, link="tool"):
    return np.array([trajectory.state(i).pose(link).position for i in range(len(trajectory))])


def off_line(points, a, b):
    way = (b - a) / np.linalg.norm(b - a)
    rest = points - a
    return np.linalg.norm(rest - np.outer(rest @ way, way), axis=1).max()


def request(scene, goal=(-0.5, -1.6, 1.1, -0.5, 0.9, -1.0), **more):
    return motion.MotionRequest("arm", goals=[motion.joint_goal(scene.model, "arm", list(goal))], seed=1, planning_time=60.0, **more)


def moved(scene, offset, planner, **more):
    start = scene.state.pose("tool")
    goal = motion.pose_goal("tool", (start.position + offset, start.quaternion))
    fields = {"goals": [goal], "velocity_scaling": 0.2, "acceleration_scaling": 0.2, **more}
    return motion.MotionRequest("arm", planner=planner, **fields)

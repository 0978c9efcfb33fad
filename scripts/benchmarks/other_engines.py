#!/usr/bin/env python3
"""Robots from their URDF in other engines, each joint held by a PD in Python at every 1 ms step. One line of JSON.

usage: other_engines.py pybullet|mujoco ROBOT STEPS
"""
import json
import os
import re
import sys
import tempfile
import time

from robots import ROBOTS

P, D = 100.0, 5.0  # N m per rad, and per rad/s


def without_meshes(text):
    """A URDF without visuals, and with spheres in the place of collision meshes, which both engines would hull."""
    text = re.sub(r"<visual\b.*?</visual>", "", text, flags=re.S)
    return re.sub(r"<mesh\b[^>]*?(/>|>.*?</mesh>)", '<sphere radius="0.01"/>', text, flags=re.S)


def pybullet(file, joints, steps):
    """Array calls: one to read all joints, one to command them."""
    import pybullet as bullet
    bullet.connect(bullet.DIRECT)
    bullet.setGravity(0, 0, -9.8)
    bullet.setTimeStep(0.001)
    robot = bullet.loadURDF(file, useFixedBase=True)
    names = {bullet.getJointInfo(robot, i)[1].decode(): i for i in range(bullet.getNumJoints(robot))}
    indices = [names[joint] for joint in joints]
    bullet.setJointMotorControlArray(robot, indices, bullet.VELOCITY_CONTROL, forces=[0.0] * len(indices))

    def step(target):
        efforts = [P * (target - state[0]) - D * state[1] for state in bullet.getJointStates(robot, indices)]
        bullet.setJointMotorControlArray(robot, indices, bullet.TORQUE_CONTROL, forces=efforts)
        bullet.stepSimulation()

    return timed(step, steps)


def mujoco(file, joints, steps):
    import mujoco as engine
    model = engine.MjModel.from_xml_path(file)
    model.opt.timestep = 0.001
    data = engine.MjData(model)
    places = [model.joint(joint).dofadr[0] for joint in joints]

    def step(target):
        position, velocity, effort = data.qpos, data.qvel, data.qfrc_applied
        for i in places:
            effort[i] = P * (target - position[i]) - D * velocity[i]
        engine.mj_step(model, data)

    return timed(step, steps)


def timed(step, steps):
    for i in range(500):
        step(0.0)
    start = time.process_time()
    for i in range(steps):
        step(0.0001 * i if i < 5000 else 0.5)
    return (time.process_time() - start) / steps * 1e6


def main():
    engine, robot = sys.argv[1], ROBOTS[sys.argv[2]]
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "robot.urdf")
        with open(file, "w", encoding="utf-8") as out:
            out.write(without_meshes(robot.urdf()))
        cost = {"pybullet": pybullet, "mujoco": mujoco}[engine](file, robot.joints, int(sys.argv[3]))
    print(json.dumps({"us per step": cost}))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Robots from their URDF in other engines, each joint held by a PD in Python at every 1 ms step. One line of JSON.

usage: other_engines.py pybullet|mujoco ROBOT STEPS
       other_engines.py mujoco pile STEPS        the 100 boxes of physics.py
"""

import json
import os
import sys
import tempfile
import time
from xml.etree import ElementTree

import numpy
from robots import ROBOTS

BANDWIDTH = 10.0  # rad/s, of the PD: critically damped for the inertia of each joint, or it would shake light links
NEARLY_NOTHING = '<inertial><mass value="1e-6"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/></inertial>'
ALLOWED = 0.2  # rad, of error at the end: more is no control, and no comparison


def bare_mechanism(text):
    """A URDF of links and joints alone: no shapes, and next to nothing for links without inertial, which PyBullet would
    give a kilogram."""
    robot = ElementTree.fromstring(text)
    for link in robot.findall("link"):
        for shape in link.findall("visual") + link.findall("collision"):
            link.remove(shape)
        if link.find("inertial") is None:
            link.append(ElementTree.fromstring(NEARLY_NOTHING))
    return ElementTree.tostring(robot, encoding="unicode")


def pybullet(file, joints, steps):
    """Array calls: one to read all joints, one to command them."""
    import pybullet as bullet

    bullet.connect(bullet.DIRECT)
    bullet.setGravity(0, 0, 0)  # costs the same, and a PD need not sag
    bullet.setTimeStep(0.001)
    robot = bullet.loadURDF(file, useFixedBase=True)
    names = {bullet.getJointInfo(robot, i)[1].decode(): i for i in range(bullet.getNumJoints(robot))}
    indices = [names[joint] for joint in joints]
    bullet.setJointMotorControlArray(robot, indices, bullet.VELOCITY_CONTROL, forces=[0.0] * len(indices))

    movable = [i for i in range(bullet.getNumJoints(robot)) if bullet.getJointInfo(robot, i)[2] != bullet.JOINT_FIXED]
    inertia = bullet.calculateMassMatrix(robot, [0.0] * len(movable))
    gains = [gain(inertia[movable.index(i)][movable.index(i)]) for i in indices]

    def step(target):
        efforts = [p * (target - state[0]) - d * state[1] for (p, d), state in zip(gains, bullet.getJointStates(robot, indices))]
        bullet.setJointMotorControlArray(robot, indices, bullet.TORQUE_CONTROL, forces=efforts)
        bullet.stepSimulation()

    return timed(step, steps, lambda: [state[0] for state in bullet.getJointStates(robot, indices)])


def mujoco(file, joints, steps):
    import mujoco as engine

    model = engine.MjModel.from_xml_path(file)
    model.opt.timestep = 0.001
    model.opt.gravity = (0, 0, 0)
    data = engine.MjData(model)
    engine.mj_forward(model, data)
    inertia = numpy.zeros((model.nv, model.nv))
    engine.mj_fullM(model, inertia, data.qM)
    places = [(i, *gain(inertia[i, i])) for i in (model.joint(joint).dofadr[0] for joint in joints)]

    def step(target):
        position, velocity, effort = data.qpos, data.qvel, data.qfrc_applied
        for i, p, d in places:
            effort[i] = p * (target - position[i]) - d * velocity[i]
        engine.mj_step(model, data)

    return timed(step, steps, lambda: [data.qpos[i] for i, _, _ in places])


def mujoco_pile(steps):
    import mujoco as engine
    from physics import PILE

    bodies = "".join(f'<body pos="{x} {y} {z}"><freejoint/><geom type="box" size="0.05 0.05 0.05" mass="1"/></body>' for x, y, z in PILE)
    model = engine.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.001" gravity="0 0 -9.8"/><worldbody><geom type="plane" size="10 10 1"/>{bodies}</worldbody></mujoco>'
    )
    data, contacts, start = engine.MjData(model), 0, time.process_time()
    for _ in range(steps):
        engine.mj_step(model, data)
        contacts += data.ncon
    return {"us per step": (time.process_time() - start) / steps * 1e6, "contacts": contacts / steps}


def gain(inertia):
    """(N m per rad, N m per rad/s). :param inertia: kg m2"""
    return inertia * BANDWIDTH**2, 2.0 * inertia * BANDWIDTH


def timed(step, steps, positions):
    for _ in range(500):
        step(0.0)
    start = time.process_time()
    for i in range(steps):
        step(min(0.0001 * i, 0.5))
    cost = (time.process_time() - start) / steps * 1e6
    target = min(0.0001 * steps, 0.5)
    error = max(abs(position - target) for position in positions())
    if not error < ALLOWED:
        raise SystemExit(f"the PD lost the robot: {error:g} rad off")
    return cost


def main():
    if sys.argv[1:3] == ["mujoco", "pile"]:
        print(json.dumps(mujoco_pile(int(sys.argv[3]))))
        return
    engine, robot = sys.argv[1], ROBOTS[sys.argv[2]]
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "robot.urdf")
        with open(file, "w", encoding="utf-8") as out:
            out.write(bare_mechanism(robot.urdf()))
        os.chdir(folder)  # MuJoCo leaves a log where it runs
        cost = {"pybullet": pybullet, "mujoco": mujoco}[engine](file, robot.joints, int(sys.argv[3]))
    print(json.dumps({"us per step": cost}))


if __name__ == "__main__":
    main()

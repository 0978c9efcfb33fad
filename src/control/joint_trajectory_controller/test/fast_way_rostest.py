#!/usr/bin/env python3
"""Every trajectory controller twice, with the fast way and without, through the same twelve seconds: the same commands, to the last bit,
and the same answers. Joints lag, are disturbed and go missing; trajectories replace each other; goals are cancelled."""

import math
import random
import struct

import rospy
from control_msgs.msg import FollowJointTrajectoryGoal, JointTolerance
from controller_interface import NodeHandle
from hardware_interface import JointHandle, JointStateHandle, PosVelAccJointHandle, PosVelJointHandle
from joint_trajectory_controller import variants
from test_support.cases import TestCase
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

START, DT = 100.0, 0.01  # s
CYCLES = 1200
#: joints of each kind, and the controller's other parameters by their namespace in trajectory_robot.yaml
VARIANTS = [
    (variants.PositionTrajectoryController, JointHandle, "position"),
    (variants.PositionTrajectoryController, JointHandle, "ramp"),
    (variants.PosVelTrajectoryController, PosVelJointHandle, "pos_vel"),
    (variants.PosVelAccTrajectoryController, PosVelAccJointHandle, "pos_vel_acc"),
    (variants.VelocityTrajectoryController, JointHandle, "velocity"),
    (variants.VelocityTrajectoryController, JointHandle, "wrapping"),
    (variants.EffortTrajectoryController, JointHandle, "effort"),
]


class Goal:
    """As an action server's, that notes what becomes of it."""

    def __init__(self, goal, number, journal):
        self.goal, self.id = goal, str(number)
        self._journal = journal

    def __getattr__(self, what):
        return lambda message=None, text="": self._journal.append((what, self.id, str(message), text))


class Robot:
    def __init__(self, variant, handle, namespace, fast):
        self.namespace = namespace
        names = rospy.get_param(f"{namespace}/joints")
        self.states = [JointStateHandle(name) for name in names]
        self.handles = [handle(state) for state in self.states]
        self.journal = []
        self.controller = type(variant.__name__, (variant,), {"fast_way": fast})()
        nh = NodeHandle(namespace)
        interface = variant.interface(*self.handles)
        self.controller.init(interface, NodeHandle(""), nh)
        self.nh = nh
        self.controller.starting(START)

    def commands(self):
        names = (
            ("command_position", "command_velocity", "command_acceleration")
            if hasattr(self.handles[0], "command_position")
            else ("command", "slope")
        )
        return [struct.pack("d", getattr(handle, name)) for handle in self.handles for name in names if hasattr(handle, name)]

    def moved(self, disturbance):
        """The joints lag behind what they are told."""
        for handle, state in zip(self.handles, self.states):
            state.position, state.velocity = state.position + disturbance, state.velocity
            if hasattr(handle, "command_position") or self.namespace in ("position", "ramp"):
                target = getattr(handle, "command_position", None)
                target = handle.command if target is None else target
                before = state.position
                state.position += 0.7 * (target - before)
                state.velocity = (state.position - before) / DT
            elif self.namespace == "effort":
                state.velocity = 0.9 * state.velocity + handle.command * DT
                state.position += state.velocity * DT
            else:
                state.velocity = 0.3 * state.velocity + 0.7 * handle.command
                state.position += state.velocity * DT
                if self.namespace == "wrapping":
                    state.position = math.remainder(state.position, 2 * math.pi)


def some_trajectory(dice, names, time):
    message = JointTrajectory(joint_names=list(names))
    dice.shuffle(message.joint_names)
    if dice.random() < 0.3:
        message.header.stamp = rospy.Time.from_sec(time + dice.uniform(-0.3, 0.4))
    order, at = dice.choice((1, 2, 3)), 0.0
    for _ in range(dice.choice((0, 1, 1, 2, 4))):
        at += dice.choice((0.0 if not message.points else 0.01, 0.1, 0.5))
        rows = [[dice.uniform(-4.0, 4.0) for _ in names] for _ in range(order)] + [[], []]
        message.points.append(
            JointTrajectoryPoint(positions=rows[0], velocities=rows[1], accelerations=rows[2], time_from_start=rospy.Duration.from_sec(at))
        )
    return message


def some_goal(dice, names, time):
    goal = FollowJointTrajectoryGoal(trajectory=some_trajectory(dice, names, time))
    if dice.random() < 0.5:
        goal.path_tolerance = [JointTolerance(name=names[0], position=dice.choice((0.3, 3.0, -1.0)))]
    goal.goal_tolerance = [JointTolerance(name=name, position=0.1, velocity=-1.0) for name in names]
    goal.goal_time_tolerance = rospy.Duration.from_sec(dice.choice((0.0, 0.2, 1.0)))
    return goal


def life(variant, handle, namespace, fast):
    """The bits of the commands of each cycle, and the journal of the goals."""
    dice = random.Random(namespace)
    robot = Robot(variant, handle, namespace, fast)
    names, commands = [state.name for state in robot.states], []
    try:
        for cycle in range(1, CYCLES):
            time, what = START + cycle * DT, dice.random()
            if what < 0.01:
                robot.controller._on_command(some_trajectory(dice, names, time))
            elif what < 0.03:
                robot.controller._on_goal(Goal(some_goal(dice, names, time), cycle, robot.journal))
            elif what < 0.033:
                robot.controller._on_cancel(robot.controller._goal.id if robot.controller._goal else "none")
            before = [(state.position, state.velocity) for state in robot.states]
            disturbance = dice.choice((0.05, 1.0, math.nan)) if dice.random() < 0.01 else 0.0
            robot.moved(disturbance)
            robot.controller.update(time, DT)
            if math.isnan(disturbance):
                for state, (position, velocity) in zip(robot.states, before):
                    state.position, state.velocity = position, velocity
            commands.append(robot.commands())
    finally:
        robot.nh.shutdown()
    return commands, robot.journal


class FastWay(TestCase):
    def test_the_same_bits_and_answers(self):
        seen = set()
        for variant, handle, namespace in VARIANTS:
            with self.subTest(namespace):
                fast, slow = (life(variant, handle, namespace, way) for way in (True, False))
                for cycle, commands in enumerate(zip(fast[0], slow[0])):
                    self.assertEqual(*commands, (namespace, cycle))
                self.assertEqual(fast[1], slow[1])
                seen |= {what for what, *_ in fast[1]}
        self.assertLessEqual({"accept", "succeed", "abort", "cancel", "feedback", "reject"}, seen)


if __name__ == "__main__":
    import rostest

    rospy.init_node("fast_way")
    rostest.rosrun("joint_trajectory_controller", "fast_way", "__main__")

"""The robots that are measured: their descriptions, worlds, controllers and commands."""

from __future__ import annotations

import os
import subprocess

import rospkg
import rospy
import yaml

_PACKS = rospkg.RosPack()
_PHYSICS = (
    "<sdf version='1.6'><world name='default'><include><uri>model://ground_plane</uri></include>"
    "<physics type='ode'><max_step_size>{step}</max_step_size><real_time_update_rate>{rate}"
    "</real_time_update_rate></physics></world></sdf>"
)


def write_world(file: str, step: float = 0.001, rate: float = 0.0) -> str:
    """A world of ground and gravity. :param step: s :param rate: steps per wall second, 0 = uncapped."""
    with open(file, "w", encoding="utf-8") as out:
        out.write(_PHYSICS.format(step=step, rate=rate))
    return file


def find(package: str, *path: str) -> str:
    return os.path.join(_PACKS.get_path(package), *path)


def xacro(file: str) -> str:
    return subprocess.run(["xacro", file], check=True, capture_output=True, text=True).stdout


class Arm:
    """Four position controllers, joint states at 100 Hz."""

    namespace = "/arm"
    joints = ["j0", "j1", "j2", "j3"]
    started = ["joint_state_controller"] + [f"joint{i}_position_controller" for i in range(4)]

    def urdf(self) -> str:
        return xacro(find("arm_description", "urdf", "arm.urdf.xacro"))

    def controllers(self) -> dict:
        with open(find("arm_control", "config", "arm_control.yaml"), encoding="utf-8") as file:
            config = yaml.safe_load(file)
        config["joint_state_controller"]["publish_rate"] = 100
        return config

    def command(self, namespace: str) -> None:
        from std_msgs.msg import Float64

        for i in range(4):
            rospy.Publisher(f"{namespace}/joint{i}_position_controller/command", Float64, queue_size=1, latch=True).publish(1.0)


class UR5:
    """A joint trajectory controller on six joints, joint states at 50 Hz."""

    namespace = "/"
    joints = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
    started = ["joint_state_controller", "arm_controller"]

    def urdf(self) -> str:
        return xacro(find("myur5_description", "urdf", "myur5.urdf.xacro"))

    def controllers(self) -> dict:
        config = {}
        for name in ("joint_state_controller", "arm_controller_ur5"):
            with open(find("ur_gazebo", "controller", f"{name}.yaml"), encoding="utf-8") as file:
                config.update(yaml.safe_load(file))
        return config

    def command(self, namespace: str) -> None:
        from trajectory_msgs.msg import JointTrajectory

        rospy.Publisher(f"{namespace.rstrip('/')}/arm_controller/command", JointTrajectory, queue_size=1, latch=True).publish(
            self.trajectory()
        )

    def trajectory(self, swings: int = 300, duration: float = 2.0):
        """To and fro, ``swings`` times, each in ``duration`` s."""
        from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

        message = JointTrajectory(joint_names=self.joints)
        for i in range(1, swings + 1):
            sign = 1.0 if i % 2 else -1.0
            message.points.append(
                JointTrajectoryPoint(
                    positions=[0.5 * sign, -1.0 - 0.3 * sign, 0.6 * sign, 0.2 * sign, 0.3 * sign, 0.4 * sign],
                    velocities=[0.0] * 6,
                    time_from_start=rospy.Duration(i * duration),
                )
            )
        return message


ROBOTS = {"arm": Arm(), "ur5": UR5()}

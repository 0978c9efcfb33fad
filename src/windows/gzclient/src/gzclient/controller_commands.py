"""What a controller is commanded by: sliders, and the message that they make."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import rospy
from control_msgs.msg import GripperCommandActionGoal
from four_wheel_steering_msgs.msg import FourWheelSteering
from geometry_msgs.msg import Twist, Vector3
from ode_sim.description import model as d
from ode_sim_viewer.panels.joints import range_of
from ode_sim_viewer.simulation import Frame, ModelRecord, WorldRecord
from std_msgs.msg import Float64, Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

_FORWARD = re.compile(r"(?:position|velocity|effort)_controllers/Joint(Group)?(Position|Velocity|Effort)Controller")
_TRAJECTORY = re.compile(r"\w+_controllers/JointTrajectoryController")
_DRIVES = ("diff_drive_controller/DiffDriveController", "ackermann_steering_controller/AckermannSteeringController")
_FOUR_WHEELS = "four_wheel_steering_controller/FourWheelSteeringController"
_GRIPPER = re.compile(r"(?:position|effort)_controllers/GripperActionController")
_FASTEST = ((1.0, "forward (m/s)"), (2.0, "left (rad/s)"))  # of a drive
_STEERED = ((1.0, "forward (m/s)"), (0.6, "front wheels (rad)"), (0.6, "rear wheels (rad)"))
_MODES = {"Position": "position", "Velocity": "velocity", "Effort": "force"}
_LARGEST_FORCE = 100.0  # N m, N
_CALM = 0.5  # of the fastest that a joint may move
_USUAL_SPEED = 1.0  # rad/s, m/s of a joint that has no limit
_SHORTEST = 0.1  # s of a motion


@dataclass(frozen=True)
class Slider:
    """``now``: where it begins."""

    label: str
    low: float
    high: float
    now: float


@dataclass(frozen=True)
class Command:
    """``topic`` below the controller's name. ``make(values, now)``: the message of these values, one of each slider, while the joints are
    at ``now``. ``lasting``: one message is enough; else it is sent again and again, as the controller stops without."""

    topic: str
    cls: type
    sliders: tuple[Slider, ...]
    make: Callable[[Sequence[float], Sequence[float]], Any]
    lasting: bool = True


#: What the page knows of a joint, and where it is (rad, m).
Known = dict[str, tuple[d.Joint, float]]


def joints_of(world: WorldRecord, frame: Frame | None, names: Sequence[str], manager: str) -> Known:
    """Of the model that has all of these joints; of several the one whose name or ``robotNamespace`` is the manager's namespace.

    :param frame: where the joints are now
    :param names: of the joints
    :param manager: namespace of the controller manager
    :return: nothing without such a model, or when ``frame`` is not of this revision of ``world``
    """
    able = [model for model in world.models if all(name in model.joints for name in names)]
    model = next((model for model in able if _belongs(model, manager)), able[0] if able else None)
    if model is None or frame is None or frame.revision != world.revision:
        return {}
    described = {joint.name: joint for joint in model.description.joints}
    return {name: (described[name], float(frame.joints[model.joints[name]])) for name in names if described[name].axes}


def _belongs(model: ModelRecord, manager: str) -> bool:
    wanted = manager.strip("/")
    return wanted == model.name or any(
        (plugin.element.findtext("robotNamespace") or "").strip().strip("/") == wanted
        for plugin in model.description.plugins
        if "ros_control" in plugin.filename
    )


def command_of(kind: str, names: Sequence[str], known: Known) -> Command | None:
    """None for a controller that takes no numbers.

    :param kind: its type, as the controller manager lists it
    :param names: of its joints, in its own order
    :param known: of :func:`joints_of`
    """
    if kind in _DRIVES:
        return Command(
            "cmd_vel",
            Twist,
            _about_zero(_FASTEST),
            lambda values, _: Twist(Vector3(values[0], 0.0, 0.0), Vector3(0.0, 0.0, values[1])),
            lasting=False,
        )
    if kind == _FOUR_WHEELS:
        return Command(
            "cmd_four_wheel_steering",
            FourWheelSteering,
            _about_zero(_STEERED),
            lambda values, _: FourWheelSteering(speed=values[0], front_steering_angle=values[1], rear_steering_angle=values[2]),
            lasting=False,
        )
    if not names or any(name not in known for name in names):
        return None
    if _GRIPPER.fullmatch(kind):
        joint = known[names[0]][0]
        return Command(
            "gripper_cmd/goal",
            GripperCommandActionGoal,
            (_slider(names[0], *known[names[0]], "position"),),
            partial(_grip, range_of(joint, "force", _LARGEST_FORCE)[1]),
        )
    forward = _FORWARD.fullmatch(kind)
    if not forward and not _TRAJECTORY.fullmatch(kind):
        return None
    mode = _MODES[forward.group(2)] if forward else "position"
    sliders = tuple(_slider(name, *known[name], mode) for name in names)
    if forward and forward.group(1):
        return Command("command", Float64MultiArray, sliders, lambda values, _: Float64MultiArray(data=list(values)))
    if forward:
        return Command("command", Float64, sliders[:1], lambda values, _: Float64(values[0]))
    return Command("command", JointTrajectory, sliders, partial(_motion, tuple(names), [_speed(known[name][0]) for name in names]))


def _slider(name: str, joint: d.Joint, position: float, mode: str) -> Slider:
    low, high = range_of(joint, mode, _LARGEST_FORCE)
    return Slider(name, low, high, min(high, max(low, position)) if mode == "position" else 0.0)


def _about_zero(controls: Sequence[tuple[float, str]]) -> tuple[Slider, ...]:
    return tuple(Slider(label, -most, most, 0.0) for most, label in controls)


def _grip(force: float, values: Sequence[float], _: Sequence[float]) -> GripperCommandActionGoal:
    """A goal, which takes the place of the one before. With all the ``force`` (N, N m) that the joint may use: 0 is none."""
    goal = GripperCommandActionGoal()
    goal.goal.command.position, goal.goal.command.max_effort = values[0], force
    return goal


def _motion(names: Sequence[str], speeds: Sequence[float], values: Sequence[float], now: Sequence[float]) -> JointTrajectory:
    """One point, reached as soon as its farthest joint can be there calmly."""
    lasts = max(abs(to - begin) / speed for to, begin, speed in zip(values, now, speeds))
    point = JointTrajectoryPoint(positions=list(values), time_from_start=rospy.Duration.from_sec(max(_SHORTEST, lasts)))
    return JointTrajectory(joint_names=list(names), points=[point])


def _speed(joint: d.Joint) -> float:
    fastest = joint.axes[0].velocity
    return _CALM * (fastest if 0.0 < fastest < 100.0 else _USUAL_SPEED)

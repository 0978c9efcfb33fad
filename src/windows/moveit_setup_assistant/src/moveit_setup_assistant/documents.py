"""The YAML files of a configuration package, each a function from the configuration to the file's text."""

from __future__ import annotations

from typing import Any

import yaml

from moveit_setup_assistant import planners
from moveit_setup_assistant.configuration import ACTION_TYPES, MARKER, Configuration

GAINS = {"p": 100, "d": 1, "i": 1, "i_clamp": 1}


class _Dumper(yaml.SafeDumper):
    """Lists below their key are indented, and nothing is abbreviated by anchors."""

    def increase_indent(self, flow=False, indentless=False):
        return super().increase_indent(flow, False)

    def ignore_aliases(self, data) -> bool:
        return True


# Not PyYAML's 1e-05, which roslaunch's and rosparam's reader takes for text.
_Dumper.add_representer(
    float,
    lambda dumper, value: dumper.represent_scalar(
        "tag:yaml.org,2002:float", f"{value:.1e}" if value and not 1e-3 < abs(value) < 1e9 else repr(value)
    ),
)


def text(values: Any, comment: str = "") -> str:
    """``values`` as YAML text, with ``comment``, of one line or several, above it."""
    head = "".join(f"# {line}\n" for line in comment.splitlines())
    return head + yaml.dump(values, Dumper=_Dumper, sort_keys=False, default_flow_style=False, width=120)


def marker(config: Configuration, timestamp: int) -> str:
    """The hidden file by which an assistant knows its packages, for the package of ``config``.

    :param timestamp: seconds since 1970, when the files were written
    """
    source = config.source
    return text(
        {
            "moveit_setup_assistant_config": {
                "URDF": {"package": source.package, "relative_path": source.relative_path, "xacro_args": source.xacro_args},
                "SRDF": {"relative_path": config.srdf_file},
                "CONFIG": {"author_name": config.author_name, "author_email": config.author_email, "generated_timestamp": timestamp},
            }
        }
    )


def joint_limits(config: Configuration) -> str:
    """Speeds from the URDF; accelerations, which a URDF does not have, are left for you."""
    model, limits = config.model(), {}
    moved = {joint for group in config.semantics.groups if model.has_group(group.name) for joint in model.group(group.name).active_joints}
    for name in sorted(moved):
        for variable, bound in zip(model.joint(name).variables, model.joint(name).limits):
            limits[variable] = {
                "has_velocity_limits": bool(bound.has_velocity),
                "max_velocity": float(bound.max_velocity) if bound.has_velocity else 0,
                "has_acceleration_limits": bool(bound.has_acceleration),
                "max_acceleration": float(bound.max_acceleration) if bound.has_acceleration else 0,
            }
    return text(
        {"default_velocity_scaling_factor": 0.1, "default_acceleration_scaling_factor": 0.1, "joint_limits": limits},
        "Limits for planning; they win over those of the URDF. Keys of a joint: has_position_limits, min_position, "
        "max_position,\nhas_velocity_limits, max_velocity, has_acceleration_limits, max_acceleration.\n"
        "Requests that say nothing move at the factors below, a tenth of full speed; 1.0 is full speed.",
    )


def cartesian_limits(_config: Configuration) -> str:
    """Of straight and circular motions."""
    return text({"cartesian_limits": {"max_trans_vel": 1, "max_trans_acc": 2.25, "max_trans_dec": -5, "max_rot_vel": 1.57}})


def kinematics(config: Configuration) -> str:
    """The solver of each group that has one."""
    chosen = {name: entry.to_mapping() for name, entry in config.kinematics.items() if entry.solver and name in config.semantics.group_map}
    return text(chosen) if chosen else "# No group has a kinematics solver.\n"


def ompl_planning(config: Configuration) -> str:
    """All planners for all groups."""
    model = config.model()
    values: dict[str, Any] = {"planner_configs": planners.configurations()}
    for group in config.semantics.groups:
        entry: dict[str, Any] = {}
        if config.default_planners.get(group.name):
            entry["default_planner_config"] = config.default_planners[group.name]
        entry["planner_configs"] = planners.names()
        joints = list(model.group(group.name).active_joints) if model.has_group(group.name) else []
        if len(joints) >= 2:
            entry["projection_evaluator"] = f"joints({joints[0]},{joints[1]})"
            entry["longest_valid_segment_fraction"] = 0.005
        values[group.name] = entry
    return text(values)


def chomp_planning(_config: Configuration) -> str:
    """CHOMP's parameters, for a computer that has it."""
    return text(
        {
            "planning_time_limit": 10.0,
            "max_iterations": 200,
            "max_iterations_after_collision_free": 5,
            "smoothness_cost_weight": 0.1,
            "obstacle_cost_weight": 1.0,
            "learning_rate": 0.01,
            "smoothness_cost_velocity": 0.0,
            "smoothness_cost_acceleration": 1.0,
            "smoothness_cost_jerk": 0.0,
            "ridge_factor": 0.0,
            "use_pseudo_inverse": False,
            "pseudo_inverse_ridge_factor": 1e-4,
            "joint_update_limit": 0.1,
            "collision_clearance": 0.2,
            "collision_threshold": 0.07,
            "use_stochastic_descent": True,
            "enable_failure_recovery": False,
            "max_recovery_attempts": 5,
        }
    )


def stomp_planning(config: Configuration) -> str:
    """STOMP's parameters, for a computer that has it."""
    model = config.model()
    return text(
        {
            f"stomp/{group.name}": _stomp(group.name, len(model.group(group.name).active_joints))
            for group in config.semantics.groups
            if model.has_group(group.name)
        }
        or None
    )


def _stomp(group: str, joints: int) -> dict[str, Any]:
    return {
        "group_name": group,
        "optimization": {
            "num_timesteps": 60,
            "num_iterations": 40,
            "num_iterations_after_valid": 0,
            "num_rollouts": 30,
            "max_rollouts": 30,
            "initialization_method": 1,
            "control_cost_weight": 0.0,
        },
        "task": {
            "noise_generator": [{"class": "stomp_moveit/NormalDistributionSampling", "stddev": [0.05] * joints}],
            "cost_functions": [
                {
                    "class": "stomp_moveit/CollisionCheck",
                    "collision_penalty": 1.0,
                    "cost_weight": 1.0,
                    "kernel_window_percentage": 0.2,
                    "longest_valid_joint_move": 0.05,
                }
            ],
            "noisy_filters": [
                {"class": "stomp_moveit/JointLimits", "lock_start": True, "lock_goal": True},
                {
                    "class": "stomp_moveit/MultiTrajectoryVisualization",
                    "line_width": 0.02,
                    "rgb": [255, 255, 0],
                    "marker_array_topic": "stomp_trajectories",
                    "marker_namespace": "noisy",
                },
            ],
            "update_filters": [
                {"class": "stomp_moveit/PolynomialSmoother", "poly_order": 6},
                {
                    "class": "stomp_moveit/TrajectoryVisualization",
                    "line_width": 0.05,
                    "rgb": [0, 191, 255],
                    "error_rgb": [255, 0, 0],
                    "publish_intermediate": True,
                    "marker_topic": "stomp_trajectory",
                    "marker_namespace": "optimized",
                },
            ],
        },
    }


def fake_controllers(config: Configuration) -> str:
    """A pretended controller for every group, and the pose in which each group begins."""
    model, seen, initial = config.model(), set(), []
    listed = [
        {
            "name": f"fake_{group.name}_controller",
            "type": "$(arg fake_execution_type)",
            "joints": list(model.group(group.name).active_joints) if model.has_group(group.name) else [],
        }
        for group in config.semantics.groups
    ]
    for state in config.semantics.group_states:
        if state.group not in seen:
            seen.add(state.group)
            initial.append({"group": state.group, "pose": state.name})
    values: dict[str, Any] = {"controller_list": listed}
    if initial:
        values["initial"] = initial
    return text(values)


def simple_controllers(config: Configuration) -> str:
    """The actions that move_group calls: of ros_control's trajectory controllers, and those that nobody here serves."""
    return text(
        {
            "controller_list": [
                {"name": c.name, "action_ns": ACTION_TYPES[c.action], "type": c.action, "default": True, "joints": list(c.joints)}
                for c in config.controllers
                if c.action
            ]
        }
    )


def ros_controllers(config: Configuration) -> str:
    """The controllers of ros_control; their gains are a start, to be tuned."""
    values = {c.name: {"type": c.type, "joints": list(c.joints), **_gains(c)} for c in config.controllers if not c.is_action}
    return text(values) if values else "# No controllers of ros_control were chosen.\n"


def _gains(controller) -> dict[str, Any]:
    if controller.type.startswith("position_controllers"):
        return {}  # positions go straight to the joints
    return {"gains": {joint: dict(GAINS) for joint in controller.joints}}


def gazebo_controllers(_config: Configuration) -> str:
    """What publishes /joint_states in simulation."""
    return text({"joint_state_controller": {"type": "joint_state_controller/JointStateController", "publish_rate": 50}})


def sensors_3d(config: Configuration) -> str:
    """Where the octomap of the surroundings comes from."""
    sensors: list[dict[str, Any]] = config.sensors
    return text({"sensors": [dict(sensor) for sensor in sensors]}, f"Read by the assistant, which knows this name ({MARKER}).")

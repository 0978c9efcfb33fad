"""A move_group of its own, with the arm of its tests: what it offers, and whether it still plans."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

from fuzzing import seeds
from fuzzing.findings import Found
from fuzzing.simulation import Server, print_targets
from fuzzing.worker import end_with_parent

ROBOT = Path("src/planning/moveit_ros_planning/test/robot")
GROUPS = ("manipulator", "hand")
JOINTS = [f"joint_{number}" for number in range(1, 7)]
_HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]


def industrial_requests() -> list[dict[str, Any]]:
    """MotionPlanRequests as fields: each industrial motion to a pose, and to joint values; circles by both of their points."""
    point = {"header": {"frame_id": "world"}, "link_name": "hand", "weight": 1.0}
    turn = {**point, "orientation": {"x": 0.0, "y": 0.8415, "z": 0.0, "w": 0.5403}}
    turn.update({f"absolute_{axis}_axis_tolerance": 0.01 for axis in "xyz"})

    def region(*at: float) -> dict[str, Any]:
        pose = {"position": dict(zip("xyz", at)), "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}
        return {"primitives": [{"type": 2, "dimensions": [0.001]}], "primitive_poses": [pose]}

    x, z = 0.2626, 0.8138  # of the hand at home
    goals = [
        {"position_constraints": [{**point, "constraint_region": region(x, 0.1, z)}], "orientation_constraints": [turn]},
        {
            "joint_constraints": [
                {"joint_name": name, "position": value + 0.1, "tolerance_above": 1e-4, "tolerance_below": 1e-4, "weight": 1.0}
                for name, value in zip(JOINTS, _HOME)
            ]
        },
    ]
    start = {"is_diff": True, "joint_state": {"name": JOINTS, "position": _HOME, "velocity": [0.0] * len(JOINTS)}}
    ways = [("PTP", {}), ("LIN", {})]
    for name, at in (("interim", (x, 0.05, z + 0.05)), ("center", (x, 0.05, z + 0.02))):
        ways.append(("CIRC", {"name": name, "position_constraints": [{**point, "constraint_region": region(*at)}]}))
    return [
        {
            "pipeline_id": "pilz_industrial_motion_planner",
            "planner_id": planner,
            "group_name": GROUPS[0],
            "start_state": start,
            "goal_constraints": [goal],
            "path_constraints": way,
            "max_velocity_scaling_factor": 0.1,
            "max_acceleration_scaling_factor": 0.1,
        }
        for planner, way in ways
        for goal in goals
    ]


class MoveGroup(Server):
    """Start it in a worker process. move_group ends with the worker's process group."""

    program, node = "move_group", "/move_group"
    patience = 60.0  # a request may ask for several plans

    def __init__(self, folder: Path, number: int):
        super().__init__(folder, number)
        import yaml

        robot, rospy = seeds.ROOT / ROBOT, self._rospy
        rospy.set_param("/robot_description", (robot / "arm.urdf").read_text())
        rospy.set_param("/robot_description_semantic", (robot / "arm.srdf").read_text())
        for name in ("parameters", "noetic", "controllers"):
            for key, value in yaml.safe_load((robot / f"{name}.yaml").read_text()).items():
                known = rospy.get_param(f"/{key}", {})
                rospy.set_param(f"/{key}", {**known, **value} if isinstance(known, dict) and isinstance(value, dict) else value)
        rospy.set_param("/move_group/capabilities", "move_group/TfPublisher move_group/MoveGroupExecuteService")
        rospy.set_param("/joint_state_publisher/source_list", ["move_group/fake_controller_joint_states"])
        rospy.init_node("fuzz", disable_signals=True, anonymous=True)
        self._states: subprocess.Popen | None = None
        self.restart()

    def restart(self) -> None:
        """A new one, with an empty scene."""
        self.start("rosrun", "moveit_ros_move_group", "move_group")
        if self._states is None:
            self._states = subprocess.Popen(
                ["rosrun", "joint_state_publisher", "joint_state_publisher"],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                stdin=subprocess.DEVNULL,
                preexec_fn=end_with_parent,
            )
        self.wait("/get_planning_scene")
        self.wait("/move_group/trajectory_execution/set_parameters")

    def recover(self) -> None:
        """After something was found: go on with this one if it still plans, else with a new one."""
        try:
            self._check_plans()
        except Exception:  # whatever it is, a new one knows nothing of it
            self.restart()
        self._read = self._log_path.stat().st_size

    def stop(self) -> None:
        super().stop()
        states = getattr(self, "_states", None)
        if states is not None and self._process is None:
            states.terminate()

    def check(self) -> None:
        """:raises Found: it is gone, does not answer, does not plan any more, or a log line is no message."""
        self.check_alive("a message")
        self.check_log()
        self._check_plans()

    def _check_plans(self) -> None:
        from moveit_msgs.msg import CollisionObject, PlanningScene, RobotState
        from sensor_msgs.msg import JointState

        empty = PlanningScene(is_diff=True)
        empty.robot_state.is_diff = True
        empty.world.collision_objects = [CollisionObject(operation=CollisionObject.REMOVE)]
        self.call("/apply_planning_scene", scene=empty)
        home = RobotState(is_diff=True, joint_state=JointState(name=JOINTS, position=_HOME))
        self.call("/check_state_validity", robot_state=home, group_name=GROUPS[0])
        scene = self.call("/get_planning_scene").scene
        if scene.world.collision_objects:
            raise Found("left behind", "objects after all were removed", str([thing.id for thing in scene.world.collision_objects])[:300])


if __name__ == "__main__":
    print_targets(MoveGroup)

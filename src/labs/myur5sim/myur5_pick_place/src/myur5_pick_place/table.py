"""The things on the table of ``worlds/table.world``, for pick and place."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rospy
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import Grasp, GripperTranslation, PlaceLocation
from tf.transformations import quaternion_about_axis, quaternion_from_euler, quaternion_matrix, quaternion_multiply
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

#: sizes (m) of what the world file has; "table" is the table's top
SIZES: dict[str, tuple[float, float, float]] = {"table": (0.5, 1.2, 0.04), "post": (0.08, 0.08, 0.4), "block": (0.05, 0.05, 0.12)}
#: from tool0 to the middle between the finger tips, m
REACH = 0.095
OPEN, SQUEEZE = 0.04, 0.005  # m: a finger that is open from the middle; how far it is sent into what it holds
WIDEST = 2 * (OPEN - 0.005)  # m, of what fits between the fingers
FINGERS = ("left_finger_joint", "right_finger_joint")


def model_pose(name: str) -> Pose:
    """Where the simulator has a model, in the world frame.

    :raises rospy.ServiceException: the simulator does not answer.
    """
    return rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)(name, "world").pose


def position(pose: Pose) -> np.ndarray:
    """(3,) position of a pose, m."""
    return np.array((pose.position.x, pose.position.y, pose.position.z))


def fill_scene(scene) -> list[str]:
    """Put table, post and block where the simulator has them into a moveit_commander.PlanningSceneInterface.

    :return: the names of what was put; what the robot holds is left with it.
    """
    names = sorted(set(SIZES) - set(scene.get_attached_objects()))
    for name in names:
        stamped = PoseStamped(pose=model_pose(name))
        stamped.header.frame_id = "world"
        scene.add_box(name, stamped, SIZES[name])
    return names


def _stamped(x: float, y: float, z: float, quaternion) -> PoseStamped:
    pose = PoseStamped()
    pose.header.frame_id = "world"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    turn = pose.pose.orientation
    turn.x, turn.y, turn.z, turn.w = quaternion
    return pose


def _vertical(sign: float, desired: float = 0.12, least: float = 0.08) -> GripperTranslation:
    move = GripperTranslation(desired_distance=desired, min_distance=least)
    move.direction.header.frame_id = "world"
    move.direction.vector.z = sign
    return move


def fingers(opening: float) -> JointTrajectory:
    """Both fingers ``opening`` m away from the middle, after a second."""
    return JointTrajectory(
        joint_names=list(FINGERS), points=[JointTrajectoryPoint(positions=[opening] * 2, time_from_start=rospy.Duration(1.0))]
    )


def grasps(box: Pose, size: Sequence[float] = SIZES["block"]) -> list[Grasp]:
    """Ways to grip an upright box from above, a quarter of a turn apart; none where it is too wide, or lies on its side."""
    found: list[Grasp] = []
    at, o = position(box), box.orientation
    turn = (o.x, o.y, o.z, o.w)
    if quaternion_matrix(turn)[2, 2] < 0.999:
        return found
    for number in range(4):
        width = size[1 - number % 2]  # the fingers close along the hand's y axis
        if width > WIDEST:
            continue
        turned = quaternion_multiply(
            quaternion_multiply(turn, quaternion_about_axis(number * np.pi / 2, (0, 0, 1))), quaternion_from_euler(np.pi, 0, 0)
        )
        found.append(
            Grasp(
                id=f"from above, turned by {90 * number} degrees",
                grasp_quality=1.0 - 0.1 * number,
                grasp_pose=_stamped(at[0], at[1], at[2] + size[2] / 2 - 0.04 + REACH, turned),
                pre_grasp_posture=fingers(OPEN),
                grasp_posture=fingers(max(0.0, width / 2 - SQUEEZE)),
                pre_grasp_approach=_vertical(-1.0),
                post_grasp_retreat=_vertical(1.0),
            )
        )
    return found


def places(x: float, y: float, z: float) -> list[PlaceLocation]:
    """Ways to put the block down with its middle at x, y, z, turned by any quarter."""
    return [
        PlaceLocation(
            id=f"turned by {90 * number} degrees",
            quality=1.0 - 0.1 * number,
            place_pose=_stamped(x, y, z, quaternion_about_axis(number * np.pi / 2, (0, 0, 1))),
            post_place_posture=fingers(OPEN),
            pre_place_approach=_vertical(-1.0),
            post_place_retreat=_vertical(1.0),
        )
        for number in range(4)
    ]

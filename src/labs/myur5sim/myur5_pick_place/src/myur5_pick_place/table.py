"""The things on the table of ``worlds/table.world``, for pick and place."""
from __future__ import annotations

from typing import Dict, List, Tuple

import numpy as np
import rospy
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import Grasp, GripperTranslation, PlaceLocation
from tf.transformations import quaternion_about_axis, quaternion_from_euler, quaternion_multiply
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

#: sizes (m) of what the world file has; "table" is the table's top
SIZES: Dict[str, Tuple[float, float, float]] = {
    "table": (0.5, 1.2, 0.04), "post": (0.08, 0.08, 0.4), "block": (0.05, 0.05, 0.12)}
#: from tool0 to the middle between the finger tips, m
REACH = 0.095
OPEN, CLOSED = 0.04, 0.02  # m that each finger is away from the middle
FINGERS = ("left_finger_joint", "right_finger_joint")


def model_pose(name: str) -> Pose:
    """Where the simulator has a model, in the world frame.

    :raises rospy.ServiceException: the simulator does not answer.
    """
    return rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)(name, "world").pose


def position(pose: Pose) -> np.ndarray:
    """(3,) position of a pose, m."""
    return np.array((pose.position.x, pose.position.y, pose.position.z))


def fill_scene(scene) -> None:
    """Put table, post and block where the simulator has them into a moveit_commander.PlanningSceneInterface."""
    for name, size in SIZES.items():
        stamped = PoseStamped(pose=model_pose(name))
        stamped.header.frame_id = "world"
        scene.add_box(name, stamped, size)


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
    return JointTrajectory(joint_names=list(FINGERS), points=[JointTrajectoryPoint(
        positions=[opening] * 2, time_from_start=rospy.Duration(1.0))])


def grasps(block: Pose) -> List[Grasp]:
    """Ways to grip a block from above, a quarter of a turn apart."""
    found, at = [], position(block)
    for number in range(4):
        turned = quaternion_multiply(quaternion_about_axis(number * np.pi / 2, (0, 0, 1)),
                                     quaternion_from_euler(np.pi, 0, 0))
        found.append(Grasp(id=f"from above, turned by {90 * number} degrees", grasp_quality=1.0 - 0.1 * number,
                           grasp_pose=_stamped(at[0], at[1], at[2] + 0.02 + REACH, turned),
                           pre_grasp_posture=fingers(OPEN), grasp_posture=fingers(CLOSED),
                           pre_grasp_approach=_vertical(-1.0), post_grasp_retreat=_vertical(1.0)))
    return found


def places(x: float, y: float, z: float) -> List[PlaceLocation]:
    """Ways to put the block down with its middle at x, y, z, turned by any quarter."""
    return [PlaceLocation(id=f"turned by {90 * number} degrees", quality=1.0 - 0.1 * number,
                          place_pose=_stamped(x, y, z, quaternion_about_axis(number * np.pi / 2, (0, 0, 1))),
                          post_place_posture=fingers(OPEN), pre_place_approach=_vertical(-1.0),
                          post_place_retreat=_vertical(1.0)) for number in range(4)]

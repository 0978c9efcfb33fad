"""Pictures of the simulated scene, by a camera that is spawned for them and deleted afterwards, as any Gazebo can."""
from __future__ import annotations

import math
from typing import Callable, List, Tuple

import numpy as np
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from rosservice import get_service_class_by_name
from rostopic import get_topic_class
from sensor_msgs.msg import Image

_NAME = "gallery_camera"
_CAMERA = """<sdf version="1.6"><model name="gallery_camera"><static>true</static><link name="link">
    <sensor name="camera" type="camera">
    <update_rate>10</update_rate><always_on>true</always_on>
    <camera><horizontal_fov>1.05</horizontal_fov>
        <image><width>1280</width><height>800</height><format>R8G8B8</format></image>
        <clip><near>0.02</near><far>200</far></clip></camera>
    <plugin name="gallery_camera" filename="libgazebo_ros_camera.so"><cameraName>gallery_camera</cameraName>
        <imageTopicName>image_raw</imageTopicName><cameraInfoTopicName>camera_info</cameraInfoTopicName>
        <frameName>gallery_camera</frameName></plugin></sensor></link></model></sdf>"""
_AZIMUTH, _ELEVATION = math.radians(35), math.radians(28)  # of the camera, seen from what it looks at
_WIDE = 14.0  # m from which the surroundings are seen


def _service(name: str) -> rospy.ServiceProxy:
    """A service of the simulator, whoever that is: the kind is asked of the running one."""
    return rospy.ServiceProxy(name, get_service_class_by_name(name))


def _message(topic: str, seconds: float):
    kind = get_topic_class(topic)[0]
    if kind is None:
        raise rospy.ROSException(f"nobody publishes {topic}")
    return rospy.wait_for_message(topic, kind, seconds)


def look_at(eye: np.ndarray, target: np.ndarray) -> Pose:
    """X_WC of a camera at ``eye`` whose x axis points to ``target``, z up; (3,) each, world frame, m."""
    way = target - eye
    yaw, pitch = math.atan2(way[1], way[0]), math.atan2(-way[2], math.hypot(way[0], way[1]))
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return Pose(Point(*eye), Quaternion(-sy * sp, cy * sp, sy * cp, cy * cp))


def subject(seconds: float) -> Tuple[str, np.ndarray, float]:
    """What to look at: the movable model with most joints, or the origin of an empty world.

    :returns: its name, the middle of its links (3,) in the world, m, and how far its outermost link is from there, m.
    :raises rospy.ROSException: the simulator did not answer within ``seconds``.
    """
    properties = _service("/gazebo/get_model_properties")
    names = [name for name in _message("/gazebo/model_states", seconds).name if name != _NAME]
    known = {name: properties(name) for name in names}
    movable = [name for name in names if not known[name].is_static]
    if not movable:
        return "", np.zeros(3), 1.0
    name = max(movable, key=lambda each: len(known[each].joint_names))
    links = _message("/gazebo/link_states", seconds)
    points = np.array([[pose.position.x, pose.position.y, pose.position.z] for link, pose in zip(links.name, links.pose)
                       if link.startswith(name + "::")])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return name, middle, max(0.25, float(np.linalg.norm(points - middle, axis=1).max()))


def pictures(save: Callable[[Image, str], None], folder: str, stem: str, seconds: float) -> List[Tuple[str, str]]:
    """The robot from near, and its surroundings.

    :returns: (file name, caption) of each.
    :raises rospy.ROSException, rospy.ServiceException: the simulator did not answer, or is paused.
    """
    name, middle, radius = subject(seconds)
    level = math.cos(_ELEVATION)
    direction = np.array([level * math.cos(_AZIMUTH), level * math.sin(_AZIMUTH), math.sin(_ELEVATION)])
    taken = []
    for kind, distance, caption in (("robot", 3.7 * radius, f"The simulator: {name or 'origin'}"),
                                    ("world", max(_WIDE, 6 * radius), "The simulator from above")):
        eye = middle + direction * distance
        if kind == "world":
            eye = middle + distance * np.array([0.14, 0.1, 0.985])  # nearly from above: into rooms
        answer = _service("/gazebo/spawn_sdf_model")(_NAME, _CAMERA, "", look_at(eye, middle), "world")
        if not answer.success:
            raise rospy.ServiceException(f"no camera for pictures of the scene: {answer.status_message}")
        try:
            picture = f"{stem}-{kind}.png"
            save(rospy.wait_for_message(f"/{_NAME}/image_raw", Image, seconds), f"{folder}/{picture}")
            taken.append((picture, caption))
        finally:
            _service("/gazebo/delete_model")(_NAME)
    return taken

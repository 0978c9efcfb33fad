"""An RViz set-up for a system whose launch file brings none: all that is published, as seen from the root frame."""

from __future__ import annotations

import math

import rospy
import tf2_ros
import yaml

#: Message type to RViz display and the name of its topic property.
DISPLAYS = {
    "sensor_msgs/LaserScan": ("LaserScan", "Topic"),
    "sensor_msgs/PointCloud2": ("PointCloud2", "Topic"),
    "sensor_msgs/PointCloud": ("PointCloud", "Topic"),
    "sensor_msgs/Range": ("Range", "Topic"),
    "nav_msgs/Odometry": ("Odometry", "Topic"),
    "nav_msgs/Path": ("Path", "Topic"),
    "nav_msgs/OccupancyGrid": ("Map", "Topic"),
    "geometry_msgs/PoseArray": ("PoseArray", "Topic"),
    "geometry_msgs/PolygonStamped": ("Polygon", "Topic"),
    "geometry_msgs/WrenchStamped": ("WrenchStamped", "Topic"),
    "sensor_msgs/Image": ("Image", "Image Topic"),
    "visualization_msgs/Marker": ("Marker", "Marker Topic"),
    "visualization_msgs/MarkerArray": ("MarkerArray", "Marker Topic"),
}
_IMAGES = 2  # panels that fit in the dock


def frames(seconds: float) -> dict[str, str]:
    """Transforms heard within ``seconds`` of wall time: child frame to parent frame."""
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    # not rospy.sleep: the system may be paused
    rospy.rostime.wallsleep(seconds)
    heard = yaml.safe_load(buffer.all_frames_as_yaml()) or {}
    listener.unregister()
    return {str(child): str(known["parent"]) for child, known in dict(heard).items()}


def root_of(parents: dict[str, str]) -> str:
    """The root below which most frames are; 'map' without any."""
    counts: dict[str, int] = {}
    for frame in parents:
        seen = set()
        while frame in parents and frame not in seen:
            seen.add(frame)
            frame = parents[frame]
        counts[frame] = counts.get(frame, 0) + 1
    return max(counts, key=lambda frame: counts[frame]) if counts else "map"


def config(topics: list[tuple[str, str]], description: bool, root: str, reach: float) -> dict:
    """The set-up as RViz's YAML has it.

    :param topics: (name, message type) of what is published.
    :param description: there is a parameter robot_description.
    :param root: fixed frame.
    :param reach: how far from the root's origin there is something to see, m.
    """
    shown: list[dict] = [{"Class": "rviz/Grid", "Name": "Grid"}]
    if description:
        shown.append({"Class": "rviz/RobotModel", "Name": "RobotModel"})
    shown.append({"Class": "rviz/TF", "Name": "TF", "Marker Scale": max(0.1, round(reach / 3, 2))})
    images = 0
    for name, kind in sorted(topics):
        if kind not in DISPLAYS or (kind == "sensor_msgs/Image" and images == _IMAGES):
            continue
        images += kind == "sensor_msgs/Image"
        display, topic_property = DISPLAYS[kind]
        shown.append({"Class": f"rviz/{display}", "Name": name.strip("/"), topic_property: name})
        if display == "Odometry":
            shown[-1]["Covariance"] = {"Value": False}  # RViz draws it by default, larger than the world
    return {
        "Panels": [{"Class": "rviz/Displays", "Name": "Displays"}],
        "Visualization Manager": {
            "Displays": [{**display, "Enabled": True} for display in shown],
            "Global Options": {"Fixed Frame": root, "Background Color": "48; 48; 48"},
            "Tools": [],
            "Views": {
                "Current": {
                    "Class": "rviz/Orbit",
                    "Distance": 4 * max(reach, 0.3),
                    "Pitch": 0.5,
                    "Yaw": math.pi / 4,
                    "Focal Point": {"X": 0, "Y": 0, "Z": reach / 3},
                }
            },
        },
    }

"""A layout for Lichtblick from what runs: the robot in 3D, joints and speeds as plots, pictures, diagnostics, and buttons to command it."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from math import hypot
from typing import Any

#: What a 3D view shows at once. Pictures and clouds of every camera would fill it, and the line.
IN_3D = ("sensor_msgs/LaserScan", "nav_msgs/OccupancyGrid", "nav_msgs/Path", "visualization_msgs/Marker", "visualization_msgs/MarkerArray")
MOST_JOINTS, MOST_IMAGES = 12, 2
_ROOM = 8.0  # m from where a scan or a map is seen
_NUMBERS = ("std_msgs/Float64", "std_msgs/Float32", "std_msgs/Int32")


@dataclass(frozen=True)
class Running:
    """What a layout is made of.

    :ivar name: of the robot
    :ivar frame: that does not move, in which the robot stands; '' where nothing says one
    :ivar reach: of the robot from its root, m
    :ivar joints: names as /joint_states tells them, in its order, with their positions (rad or m)
    :ivar one_order: each message of /joint_states has the same joints in the same order: a plot knows a joint by its place alone
    :ivar velocities: /joint_states tells them, too
    :ivar published: topic -> package/Type; ``subscribed`` likewise
    :ivar described: there is a /robot_description
    :ivar moved: topic of a controller's commands -> names of its joints
    """

    name: str = "robot"
    frame: str = ""
    reach: float = 1.0
    joints: dict[str, float] = field(default_factory=dict)
    published: dict[str, str] = field(default_factory=dict)
    subscribed: dict[str, str] = field(default_factory=dict)
    one_order: bool = True
    velocities: bool = False
    described: bool = False
    moved: dict[str, list[str]] = field(default_factory=dict)

    def of(self, *types: str) -> list[str]:
        """Topics that somebody publishes of ``types``, in the order of their names."""
        return sorted(name for name, kind in self.published.items() if kind in types)

    def taking(self, *types: str) -> list[str]:
        """Topics that somebody reads of ``types``, in the order of their names."""
        return sorted(name for name, kind in self.subscribed.items() if kind in types)


def described(urdf: str) -> tuple[str, str, float]:
    """Name, root link and reach (m) of the robot of ``urdf``; ('robot', '', 1.0) where it cannot be read."""
    try:
        robot = ElementTree.fromstring(urdf.encode())
    except ElementTree.ParseError:
        return "robot", "", 1.0
    above: dict[str, tuple[str, float]] = {}
    for joint in robot.findall("joint"):
        parent, child, origin = joint.find("parent"), joint.find("child"), joint.find("origin")
        if parent is not None and child is not None:
            above[child.get("link", "")] = parent.get("link", ""), _length(origin.get("xyz", "") if origin is not None else "")
    roots = [link.get("name", "") for link in robot.findall("link") if link.get("name") not in above]
    return robot.get("name") or "robot", roots[0] if roots else "", max([_far(link, above) for link in above], default=0.0) or 1.0


def _length(xyz: str) -> float:
    try:
        return hypot(*(float(word) for word in xyz.split()))
    except ValueError:
        return 0.0


def _far(link: str, above: dict[str, tuple[str, float]]) -> float:
    """From the root to ``link`` along the joints, m."""
    length = 0.0
    for _ in above:
        link, step = above.get(link, ("", 0.0))
        length += step
    return length


def layout(running: Running) -> dict[str, Any]:
    """What Lichtblick reads as a layout: the panels' settings by identifier, and the tree of the panels."""
    panels: dict[str, dict[str, Any]] = {"3D!scene": _scene(running)}
    column = [
        _add(panels, f"Image!{number}", {"imageMode": {"imageTopic": topic}})
        for number, topic in enumerate(_pictures(running)[:MOST_IMAGES])
    ]
    column += [_add(panels, f"Plot!{name}", _plot(name, paths)) for name, paths in _plots(running).items() if paths]
    tabs = [("Log", _add(panels, "RosOut!log", {}))]
    if running.of("diagnostic_msgs/DiagnosticArray"):
        settings = {"topicToRender": running.of("diagnostic_msgs/DiagnosticArray")[0], "minLevel": 0, "pinnedIds": []}
        tabs.insert(0, ("Diagnostics", _add(panels, "DiagnosticSummary!states", settings)))
    tabs += [(title, _add(panels, name, settings)) for title, name, settings in _commands(running)]
    tabs.append(("Topics", _add(panels, "RawMessages!any", {"topicPath": ""})))
    panels["Tab!more"] = {"activeTabIdx": 0, "tabs": [{"title": title, "layout": name} for title, name in tabs]}
    column.append("Tab!more")
    return {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": {"direction": "row", "first": "3D!scene", "second": _stacked(column), "splitPercentage": 55},
    }


def _add(panels: dict[str, dict[str, Any]], name: str, settings: dict[str, Any]) -> str:
    panels[name] = settings
    return name


def _pictures(running: Running) -> list[str]:
    """One topic for each camera, colours before depth."""
    raw = running.of("sensor_msgs/Image")
    packed = [topic for topic in running.of("sensor_msgs/CompressedImage") if topic.rpartition("/")[0] not in raw]
    return sorted(raw + packed, key=lambda topic: ("depth" in topic, topic))


def _stacked(names: list[str]) -> Any:
    """One over the other, of equal height."""
    if len(names) == 1:
        return names[0]
    return {"direction": "column", "first": names[0], "second": _stacked(names[1:]), "splitPercentage": 100 / len(names)}


def _scene(running: Running) -> dict[str, Any]:
    topics: dict[str, Any] = {name: {"visible": True} for name in running.of(*IN_3D)}
    robot = {"param:/robot_description": {"visible": True}} if running.described else {}
    grid = {
        "layerId": "foxglove.Grid",
        "instanceId": "grid",
        "label": "Grid",
        "visible": True,
        "frameLocked": True,
        "size": 10,
        "divisions": 10,
    }
    return {
        "followTf": running.frame or None,
        "followMode": "follow-pose",
        "cameraState": {
            "perspective": True,
            "distance": max(0.5, 3.0 * running.reach, _ROOM if topics else 0.0),
            "phi": 60,
            "thetaOffset": 45,
            "fovy": 45,
            "near": 0.01,
            "far": 5000,
            "target": [0, 0, 0],
            "targetOffset": [0, 0, running.reach / 3.0],
            "targetOrientation": [0, 0, 0, 1],
        },
        "scene": {"transforms": {"axisScale": min(1.0, running.reach / 4.0), "showLabel": False}},
        "transforms": {},
        "topics": {**topics, **robot},
        "layers": {"grid": grid},
    }


def _plots(running: Running) -> dict[str, list[tuple[str, str]]]:
    """Title -> (message path, label) of each line."""
    states = running.of("sensor_msgs/JointState")
    joints = list(running.joints)[:MOST_JOINTS] if states and running.one_order else []
    source = "/joint_states" if "/joint_states" in states else states[0] if states else ""
    odometry = [(f"{topic}.twist.twist", "odometry") for topic in running.of("nav_msgs/Odometry")[:1]]
    commands = [(topic, "command") for topic in running.taking("geometry_msgs/Twist")[:1] if topic in running.published]
    speeds = [(twist + part, f"{label}, {part[1:]}") for twist, label in odometry + commands for part in (".linear.x", ".angular.z")]
    return {
        "Joint positions": [(f"{source}.position[{number}]", name) for number, name in enumerate(joints)],
        "Joint velocities": []
        if speeds or not running.velocities
        else [(f"{source}.velocity[{number}]", name) for number, name in enumerate(joints)],
        "Speeds": speeds,
    }


def _plot(title: str, paths: list[tuple[str, str]]) -> dict[str, Any]:
    return {
        "lichtblickPanelTitle": title,
        "paths": [{"value": path, "label": label, "enabled": True, "timestampMethod": "receiveTime"} for path, label in paths],
        "xAxisVal": "timestamp",
        "legendDisplay": "floating",
        "showPlotValuesInLegend": True,
        "isSynced": True,
        "followingViewWidth": 30,
    }


def _commands(running: Running) -> list[tuple[str, str, dict[str, Any]]]:
    """Panels that tell the robot something: title, identifier, settings."""
    found = []
    for topic in running.taking("geometry_msgs/Twist")[:1]:
        buttons = {"up": ("linear-x", 0.3), "down": ("linear-x", -0.3), "left": ("angular-z", 0.5), "right": ("angular-z", -0.5)}
        settings: dict[str, Any] = {f"{button}Button": {"field": name, "value": value} for button, (name, value) in buttons.items()}
        found.append(("Drive", "Teleop!drive", {"topic": topic, "publishRate": 10, **settings}))
    for topic in running.taking("trajectory_msgs/JointTrajectory")[:1]:
        names = running.moved.get(topic) or list(running.joints)
        there = [running.joints.get(name, 0.0) for name in names]
        point = {"positions": there, "velocities": [], "accelerations": [], "effort": [], "time_from_start": {"sec": 2, "nsec": 0}}
        header = {"seq": 0, "stamp": {"sec": 0, "nsec": 0}, "frame_id": ""}  # Lichtblick sends only what has all its fields
        message = {"header": header, "joint_names": names, "points": [point]}
        found.append(("Command", "Publish!command", _publish(topic, running.subscribed[topic], message)))
    for topic in [] if found else running.taking(*_NUMBERS)[:1]:
        found.append(("Command", "Publish!command", _publish(topic, running.subscribed[topic], {"data": 0})))
    return found


def _publish(topic: str, kind: str, message: dict[str, Any]) -> dict[str, Any]:
    return {"topicName": topic, "datatype": kind, "advancedView": True, "buttonText": "Publish", "value": json.dumps(message, indent=2)}

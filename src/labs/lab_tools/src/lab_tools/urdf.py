"""Looking into a robot description, for tests and scripts."""

import pathlib
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
from trimesh.transformations import euler_matrix, rotation_matrix, translation_matrix


def expand(path, *arguments):
    """The URDF text that xacro makes of the file at `path`, run in its folder with `arguments` (name:=value)."""
    path = pathlib.Path(path)
    return subprocess.run(["xacro", path.name, *arguments], cwd=path.parent, check=True, stdout=subprocess.PIPE, text=True).stdout


def check(text, folder):
    """Raises CalledProcessError unless urdfdom's check_urdf accepts the URDF `text`; `folder` takes a copy of it."""
    path = pathlib.Path(folder) / "checked.urdf"
    path.write_text(text)
    subprocess.run(["check_urdf", path], check=True, stdout=subprocess.PIPE)


def numbers(text):
    return [float(word) for word in text.split()]


def pose_of(text, link, root, positions=None):
    """Forward kinematics.

    :param text: URDF text.
    :param positions: dict of joint name to angle (rad); joints that are not named stand at 0.
    :returns: (4, 4) X_RL, the pose of `link` in `root`.
    """

    def part(joint, tag):
        found = joint.find(tag)
        if found is None:
            raise ValueError(f"joint {joint.get('name')} has no <{tag}>")
        return found

    by_child = {part(joint, "child").get("link"): joint for joint in ET.fromstring(text).findall("joint")}
    pose = np.eye(4)
    while link != root:
        joint = by_child[link]
        origin = joint.find("origin")
        step = np.eye(4)
        if origin is not None:
            roll, pitch, yaw = numbers(origin.get("rpy", "0 0 0"))
            step = translation_matrix(numbers(origin.get("xyz", "0 0 0"))) @ euler_matrix(roll, pitch, yaw, "sxyz")
        angle = (positions or {}).get(joint.get("name"), 0.0)
        if angle:
            step = step @ rotation_matrix(angle, numbers(part(joint, "axis").get("xyz")))
        pose = step @ pose
        link = part(joint, "parent").get("link")
    return pose

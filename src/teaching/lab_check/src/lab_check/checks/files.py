"""Facts of files and of the robot's description."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from typing import Any

import lenient_xml

from ..isolation.untrusted_files import matching, read_regular
from .base import Check, Context, names, search
from .inertia import insane, number

_LARGEST = 1_000_000  # bytes of a file in which a pattern is looked for


class FileCheck(Check):
    """A file of the submission: ``path`` below the packages, ``*`` allowed."""

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        path = self.wanted["path"]
        found = self._find(path)
        if self.wanted.get("absent"):
            package = path.partition("/")[0]
            if package in self.context.required and package not in self.context.packages:
                return False, f"there is no package {package} in your submission", {}
            return not found, f"{path} is {'still there' if found else 'not there, as it should be'}", {}
        if not found:
            return False, f"there is no file {path} in your submission", {}
        contains = self.wanted.get("contains")
        if contains:
            if not any(self._holds(contains, name) for name in found):
                return False, f"{path} is there, but holds nothing like '{contains}'", {}
        return True, f"{path} is there" + (f" and holds '{contains}'" if contains else ""), {}

    def _holds(self, pattern: str, name: str) -> bool:
        try:
            return bool(search(pattern, read_regular(self.context.home, name, _LARGEST).decode("utf-8", "replace")))
        except OSError:  # something else stands there by now
            return False

    def _find(self, path: str) -> list[str]:
        """Below the submission's home."""
        package, _, rest = path.partition("/")
        mine = package in self.context.packages and rest
        folder = (self.context.packages[package] if mine else self.context.source).relative_to(self.context.home)
        found = matching(self.context.home, rest if mine else path, anywhere=not mine, below=folder)
        return [str(folder / name) for name in found]


class UrdfCheck(Check):
    """The robot description on the parameter server, URDF or SDF."""

    patience = 5.0  # s after the commands

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self._param = wanted.get("param", "/robot_description")

    def there(self) -> bool:
        import rosgraph

        return rosgraph.Master("/lab_check").hasParam(self._param)

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        import rosgraph

        name = self._param
        try:
            text = rosgraph.Master("/lab_check").getParam(name)
        except rosgraph.MasterException:
            return False, f"the parameter {name} is not set: no robot description was loaded", {}
        try:
            robot = lenient_xml.fromstring(text)
        except (ET.ParseError, TypeError, ValueError) as error:
            return False, f"the parameter {name} is no XML: {error}", {}
        complaints = complain(robot, self.wanted)
        return not complaints, "; ".join(complaints) or f"the robot description has {_in_words(self.wanted)}", {}


def _in_words(wanted: dict[str, Any]) -> str:
    words = [f"{wanted['moving']} moving joints"] if "moving" in wanted else []
    for key in ("joints", "links", "plugins", "sensors"):
        words += [f"the {key} {names(wanted[key])}"] if wanted.get(key) else []
    words += [f"{wanted['transmissions']} transmissions"] if "transmissions" in wanted else []
    sentences = {"limits": "limits for each joint", "collisions": "a collision shape for each visible link", "inertias": "sane inertias"}
    words += [text for key, text in sentences.items() if wanted.get(key)]
    return " and ".join(words) or "the parameter that is asked for"


def complain(root: ET.Element, wanted: dict[str, Any]) -> list[str]:
    """What of the description with the root element ``root`` is not as ``wanted``, a sentence each."""
    robot = next(root.iter("model"), root) if root.tag == "sdf" else root
    if robot.find("link") is None:
        return [f"the description, a <{root.tag}>, has no link"]
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    moving = [joint for joint in joints.values() if joint.get("type") != "fixed"]
    links = {link.get("name") for link in robot.findall("link")}
    plugins = {plugin.get("filename") for plugin in robot.iter("plugin")}
    sensors = {sensor.get("type") for sensor in robot.iter("sensor")}
    found = []
    for kind, wished, there in (
        ("joint", wanted.get("joints", []), joints),
        ("link", wanted.get("links", []), links),
        ("plugin", wanted.get("plugins", []), plugins),
        ("sensor of type", wanted.get("sensors", []), sensors),
    ):
        for name in wished:
            if name not in there:
                found.append(f"there is no {kind} '{name}' (there are: {names(sorted(filter(None, there)))})")
    if "moving" in wanted and len(moving) != wanted["moving"]:
        found.append(f"{len(moving)} joints can move, {wanted['moving']} should: {names(j.get('name', '?') for j in moving)}")
    transmissions = len(robot.findall("transmission"))
    if "transmissions" in wanted and transmissions < wanted["transmissions"]:
        found.append(f"{transmissions} transmissions are there, {wanted['transmissions']} are needed")
    if wanted.get("limits"):
        found += [] if moving else ["no joint can move, so that none has limits"]
        found += [
            f"joint '{joint.get('name')}' has no limit with effort and velocity"
            for joint in moving
            if joint.get("type") in ("revolute", "prismatic") and not _limited(joint)
        ]
    if wanted.get("collisions"):
        found += [] if robot.find("link/collision") is not None else ["no link has a collision"]
        found += [
            f"link '{link.get('name')}' has a visual, but no collision"
            for link in robot.findall("link")
            if link.find("visual") is not None and link.find("collision") is None
        ]
    if wanted.get("inertias") == "sane":
        found += [] if robot.find("link/inertial") is not None else ["no link has an inertia"]
        found += [text for link in robot.findall("link") if (text := insane(link))]
    return found


def _limited(joint: ET.Element) -> bool:
    limit = joint.find("limit") if joint.find("limit") is not None else joint.find("axis/limit")
    try:
        return number(limit, "effort") > 0 and number(limit, "velocity") > 0
    except ValueError:
        return False

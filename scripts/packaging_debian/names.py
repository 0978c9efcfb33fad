"""Upstream's package names: which this platform covers, which Debian has under its own names."""

from __future__ import annotations

import functools
import re
import subprocess
from pathlib import Path

import yaml

from .tree import platform_packages

#: Rules that Debian ships for rosdep: ROS package -> Debian packages.
DEBIAN_RULES = Path("/usr/share/python3-rosdep2/debian.yaml")
#: Keys there that belong to ROS 2, or are no ROS packages.
FOREIGN = re.compile(
    r"ament_|rosidl_|fast|osrf_|python3-|.*_vendor$|.*(cyclone|iceoryx|test_fixture)|rcutils|rcpputils"
    r"|shared_queues|domain_coordinator|mk$|test_interface_files|pybind11|ompl$|spdlog|google"
)
#: Metapackages: the sections of scripts/debian-packages.txt that they bring beside Debian's metapackage of that name.
META: dict[str, tuple[str, ...]] = {
    "desktop_full": ("build", "headers", "desktop", "planning", "windows"),
    "desktop": ("build", "headers", "windows"),
    "viz": ("windows",),
    "perception": (),
    "simulators": ("build", "headers"),
    "robot": ("build", "headers"),
    "ros_base": ("build",),
    "ros_core": ("build",),
}
#: Names that courses type and Debian spells otherwise.
TOOLS = {"python3-catkin-tools": "catkin-tools", "python3-rosdep": "python3-rosdep2", "python3-osrf-pycommon": "catkin-tools"}


def debian_name(name: str) -> str:
    """``gazebo_ros`` -> ``ros-noetic-gazebo-ros``"""
    return "ros-noetic-" + name.lower().replace("_", "-")


def sections(root: Path, *wanted: str) -> list[str]:
    """Debian packages of these sections of scripts/debian-packages.txt, in its order; those with ? if this release has them."""
    packages, section, known = [], "", known_to_apt()
    for line in (root / "scripts/debian-packages.txt").read_text().splitlines():
        if line.startswith("# section: "):
            section = line.split()[2]
        elif line.strip() and not line.startswith("#") and section in wanted:
            name = line.strip()
            if not name.endswith("?") or name[:-1] in known:
                packages.append(name.rstrip("?"))
    return packages


@functools.cache
def known_to_apt() -> frozenset:
    """All package names in this machine's package lists."""
    return frozenset(subprocess.run(["apt-cache", "pkgnames"], capture_output=True, text=True, check=True).stdout.split())


def covered(root: Path) -> dict[str, tuple[list[str], str]]:
    """Debian package to make -> (what it depends on beside noetic-labs, what it stands for)."""
    known = known_to_apt()
    made: dict[str, tuple[list[str], str]] = {}
    rules = yaml.safe_load(DEBIAN_RULES.read_text())
    windows = sections(root, "windows")
    for name, rule in rules.items():
        packages = [package for package in rule.get("debian") or [] if package in known]
        if packages and not FOREIGN.match(name) and name not in META:
            made[debian_name(name)] = (packages, f"Debian's packages of the ROS package {name}")
    for package in platform_packages(root):
        made[debian_name(package.name)] = (
            windows if package.parent.name == "windows" else [],
            f"the ROS package {package.name}, which noetic-labs supplies",
        )
    for name, wanted in META.items():
        own = [package for package in (rules.get(name) or {}).get("debian", []) if package in known]
        made[debian_name(name)] = (
            own + [package for package in sections(root, *wanted) if package in known],
            f"the ROS metapackage {name}, as far as Debian and noetic-labs have it",
        )
    for name, stands_for in TOOLS.items():
        if name not in known and stands_for in known:
            made[name] = ([stands_for], f"{stands_for}, which courses call {name}")
    return made

"""Displays, tools and panels that RViz offers though nobody has built their library: one line each says what to build.

RViz lists what packages declare, and finds the library only when one is added. ``rviz_start`` starts this beside RViz, which does not
wait: from a shell, rosrun, roslaunch and rosmon.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree


def start(words: list[str]) -> None:
    """Look in a process of its own, which nobody has to wait for. :param words: rviz's; those that open no window want no look"""
    if {"--help", "-h"} & set(words):
        return
    subprocess.run(["sh", "-c", '"$0" -m node_signals.rviz_displays &', sys.executable], check=False)


def unbuilt() -> list[str]:
    """A line for each library that is declared and is nowhere."""
    found = subprocess.run(["rospack", "plugins", "--attrib=plugin", "rviz"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    lines = []
    for package, _, path in (line.partition(" ") for line in found.stdout.splitlines()):
        for library, names in _declared(Path(path)):
            if names and not any(place.exists() for place in _places(library, Path(path).parent)):
                lines.append(
                    f"rviz: {', '.join(names)} of the package {package} cannot be added, its library "
                    f"{os.path.basename(library)} is not built: catkin build {package}"
                )
    return lines


def _declared(path: Path) -> Iterator[tuple]:
    """(library, names of the classes in it) of a plugin description; nothing of one that cannot be read."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError):
        return
    for library in root.iter("library"):
        yield (
            library.get("path", ""),
            [
                element.get("name") or element.get("type", "")
                for element in library.iter("class")
                if element.get("base_class_type", "").startswith("rviz::")
            ],
        )


def _places(library: str, package: Path) -> Iterator[Path]:
    """Where pluginlib looks."""
    file = library if library.endswith(".so") else library + ".so"
    name = os.path.basename(file)
    multiarch = sysconfig.get_config_var("MULTIARCH") or ""
    for prefix in [*filter(None, os.environ.get("CMAKE_PREFIX_PATH", "").split(":")), "/usr"]:
        yield Path(prefix, file)
        yield from (Path(prefix, folder, name) for folder in ("lib", f"lib/{multiarch}", "bin"))
    yield from (Path(folder, name) for folder in filter(None, os.environ.get("LD_LIBRARY_PATH", "").split(":")))
    yield package / file


if __name__ == "__main__":
    for told in unbuilt():
        print(told, file=sys.stderr, flush=True)

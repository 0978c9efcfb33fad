"""What is known of a package that a launch file names and that is not there: one line, not all folders searched."""
from __future__ import annotations

import re
from pathlib import Path

import rospkg

_DEBIAN_RULES = Path("/usr/share/python3-rosdep2/debian.yaml")
_UNKNOWN = "Is it built in your workspace, and that sourced? `rosdep resolve {name}` says whether Debian has it."


def explanation(name: str) -> str:
    """Who has the package, or what to look at."""
    found = _debian_packages(name)
    if found:
        return f"Debian has it: sudo apt install {found}"
    return _known_sentence(name) or _UNKNOWN.format(name=name)


def _debian_packages(name: str) -> str:
    """Names for apt, by the rules that Debian ships for rosdep."""
    if not _DEBIAN_RULES.is_file():
        return ""
    found = re.search(rf"^{re.escape(name)}:\n  debian:\n((?:  - .+\n)+)", _DEBIAN_RULES.read_text(), re.MULTILINE)
    return " ".join(found[1].split()).replace("- ", "") if found else ""


def _known_sentence(name: str) -> str:
    """What find_package says of it, from the list of noetic_compatibility."""
    try:
        listed = Path(rospkg.RosPack().get_path("noetic_compatibility"), "cmake", "absent_packages.cmake").read_text()
    except (rospkg.ResourceNotFound, OSError):
        return ""
    for sentence, names in re.findall(r'^_noetic_absent\("([^"]*)"([^)]*)\)', listed, re.MULTILINE):
        if name in names.split():
            return sentence.replace("\\\n", "")
    return ""


def in_one_line(error: rospkg.ResourceNotFound) -> str:
    """For rospkg.ResourceNotFound.__str__."""
    what = str(error.args[0]) if error.args else ""
    return f"the package '{what}' is not here. {explanation(what)}" if re.fullmatch(r"[A-Za-z][\w-]*", what) else what

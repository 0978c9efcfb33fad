"""The figures of one robot as an entry of docs/tried.yaml."""

from __future__ import annotations

import math
import os
import re
import subprocess

import yaml

_PLAIN = ("sensor_msgs/JointState", "nav_msgs/Odometry")


def source(path: str) -> str:
    """``owner/name@commit`` of the repository that a file is from; the name of its folder where it is from none."""

    def git(*words: str) -> str:
        return subprocess.run(["git", "-C", os.path.dirname(path), *words], capture_output=True, text=True).stdout.strip()

    commit = git("rev-parse", "--short=7", "HEAD")
    if not commit:
        return os.path.basename(os.path.dirname(path))
    url = git("remote", "get-url", "origin") or git("rev-parse", "--show-toplevel")
    return f"{re.sub(r'[.]git$', '', '/'.join(re.split('[/:]', url)[-2:]))}@{commit}"


def _number(value: float, unit: str) -> str:
    """What is too small to matter is shown by its order only."""
    return f"{value:.3f} {unit}" if abs(value) >= 0.0005 else f"{value:.0e} {unit}" if abs(value) > 1e-9 else f"0 {unit}"


def straight(found: dict) -> str | list[str]:
    parts = []
    for name, along, across in (("straight", "ahead", "left"), ("aside", "left", "ahead")):
        if name in found:
            motion = found[name]
            wanted = motion["speed" if name == "straight" else "aside"] * motion["seconds"]
            parts.append(
                f"{'' if name == 'straight' else 'left '}{motion[along]:.3f} of {wanted:.3f} m"
                f" (aside {_number(motion[across], 'm')}, {_number(motion['turned'], 'rad')})"
            )
    return parts if len(parts) > 1 else "".join(parts) or "-"


def turn(found: dict, wheelbase: float) -> str:
    """How far it turned, of how far it should have, by the figures ``found``.

    :param wheelbase: m, of a car that is told its steering angle; 0: it is told its turn rate.
    """
    if "turn" not in found:
        return "-"
    motion = found["turn"]
    steers = found["command"]["kind"].startswith("ackermann_msgs")
    rate = motion["rate"]
    if steers and not wheelbase:
        return f"{motion['turned']:.3f} rad in {motion['seconds']:.1f} s at {rate:g} rad, {motion['speed']:g} m/s"
    if wheelbase:
        rate = motion["speed"] * math.tan(rate) / wheelbase
    way = f" (centre moved {_number(_way(motion), 'm')})" if not motion["speed"] else ""
    return f"{motion['turned']:.3f} of {rate * motion['seconds']:.3f} rad{way}"


def _way(motion: dict) -> float:
    return math.hypot(motion["ahead"], motion["left"])


def drift(found: dict) -> str:
    if "drift" not in found:
        return "-"
    motion = found["drift"]
    fallen = f", tilted {motion['tilt']:.2f} rad" if motion["tilt"] > 0.05 else ""
    span = f" in {motion['seconds']:.0f} s" if round(motion["seconds"]) != 60 else ""
    return f"{_number(_way(motion), 'm')}, {_number(abs(motion['turned']), 'rad')}{span}{fallen}"


def sensors(found: dict) -> list[str]:
    """Each topic with its rate and what it says; joints and odometry last."""
    lines: list[str] = []
    for sensor in sorted(found.get("sensors", ()), key=lambda sensor: sensor["kind"] in _PLAIN):
        rate = "silent" if sensor["rate"] is None else f"{sensor['rate']:.1f} Hz"
        says = f" ({sensor['says']})" if sensor["says"] and sensor["says"] != rate else ""
        lines.append(f"{sensor['topic']} {rate}{says}")
    return lines


def reach(found: dict) -> list[str]:
    return [f"{name} ends {_number(error, 'rad')} from its goal" for name, error in found.get("reach", {}).items()]


def row(robot: str, repository: str, launch: str, found: dict, wheelbase: float) -> str:
    """The entry of ``robot`` from ``repository``, brought up by ``launch``, with the figures ``found``.

    :param wheelbase: as for :func:`turn`.
    """
    said = {
        "robot": robot,
        "source": repository,
        "launch": f"`{launch}`",
        "straight": straight(found),
        "turn": turn(found, wheelbase),
        "drift in 60 s": drift(found),
        "sensors": sensors(found),
        "notes": "; ".join(reach(found) + found["notes"]) or "-",
    }
    entry = {key: value for key, value in said.items() if value not in ("-", [])}
    return yaml.safe_dump([entry], sort_keys=False, width=130, allow_unicode=True).strip()

"""Copies of a good submission, each with one known fault: what a spec must notice. A seed chooses the same copies every time."""

from __future__ import annotations

import argparse
import json
import pathlib
import random
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """``apply`` changes the copy and returns False where it does not fit; ``what`` is what a teacher would say."""

    name: str
    what: str
    apply: Callable[[pathlib.Path, random.Random], bool]


def _in(pattern: str, what: str, to: str, count: int = 1) -> Callable[[pathlib.Path, random.Random], bool]:
    """Replaces in the first file that matches, by path, and holds ``what``."""

    def apply(copy: pathlib.Path, dice: random.Random) -> bool:
        del dice
        for file in sorted(copy.rglob(pattern)):
            text = file.read_text(encoding="utf-8", errors="surrogateescape")
            changed = re.sub(what, to, text, count=count, flags=re.MULTILINE)
            if changed != text:
                file.write_text(changed, encoding="utf-8", errors="surrogateescape")
                return True
        return False

    return apply


def _without(pattern: str) -> Callable[[pathlib.Path, random.Random], bool]:
    def apply(copy: pathlib.Path, dice: random.Random) -> bool:
        del dice
        for path in sorted(copy.rglob(pattern)):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
            return True
        return False

    return apply


def _one_joint_wrong(copy: pathlib.Path, dice: random.Random) -> bool:
    joint = dice.randrange(4)
    return _in("*.yaml", rf"joint: j{joint}$", f"joint: j{joint}{joint}")(copy, dice)


FAULTS: list[Fault] = [
    Fault("none", "nothing is wrong", lambda copy, dice: True),
    Fault("compile_error", "the node does not compile", _in("*.cpp", r";\s*$", "")),
    Fault("no_package_xml", "a package has no manifest", _without("arm_controller/package.xml")),
    Fault("launch_missing", "the launch file is not there", _without("arm_gazebo.launch")),
    Fault("launch_not_xml", "the launch file is no XML", _in("arm_gazebo.launch", r"</launch>", "</lunch>")),
    Fault(
        "wrong_include",
        "the launch file includes a file that is not there",
        _in("arm_gazebo.launch", r"arm_world\.launch", "arm_word.launch"),
    ),
    Fault("urdf_broken", "the robot's description is no XML", _in("*.urdf.xacro", r"</robot>", "</robto>")),
    Fault("joint_unknown", "a controller names a joint that is not there", _one_joint_wrong),
    Fault("wrong_type", "a controller's type is misspelt", _in("*control*.yaml", r"JointPositionController$", "JointPosController")),
    Fault("no_states", "joint states are not published", _in("*control*.launch", r'default="joint_state_controller ', 'default="')),
    Fault("controller_missing", "one of four controllers is not spawned", _in("*control*.launch", r"joint2_position_controller", "")),
    Fault("wrong_namespace", "the controllers are spawned in another namespace", _in("arm_gazebo.launch", r'ns="arm"', 'ns="arms"')),
    Fault("node_sleeps", "the node does nothing", _in("*_node.cpp", r"^(\s*)publishers\[i\]\.publish\(.*\);", r"\1;")),
    Fault(
        "node_wrong_joint",
        "the node sends the last angle to the first joint",
        _in("*_node.cpp", r"publishers\[i\]\.publish", "publishers[0].publish"),
    ),
    Fault(
        "node_crashes",
        "the node crashes",
        _in("*_node.cpp", r"ros::Rate rate\(10\);", "volatile int* nowhere = nullptr; *nowhere = 1; ros::Rate rate(10);"),
    ),
]


def make(good: pathlib.Path, folder: pathlib.Path, count: int, seed: int = 0, faults: list[Fault] | None = None) -> list[dict]:
    """``count`` copies of ``good`` in ``folder``, named ``NN_fault``; what was done to each, also as ``faults.json`` there.

    :param seed: chooses the same places every time. :param faults: those that are made, in turn; None: all
    :raises ValueError: a fault fits no file of the submission
    """
    dice, made = random.Random(seed), []
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(count):
        chosen = (faults or FAULTS)[number % len(faults or FAULTS)]
        copy = folder / f"{number:02}_{chosen.name}"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(good, copy, ignore=shutil.ignore_patterns(".git", "build", "devel"))
        if not chosen.apply(copy, dice):
            raise ValueError(f"the fault '{chosen.name}' fits no file of {good}")
        made.append({"submission": copy.name, "fault": chosen.name, "what": chosen.what})
    (folder / "faults.json").write_text(json.dumps(made, indent=1), encoding="utf-8")
    return made


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="rosrun lab_check faults", description="Copies of a good arm homework, each with one known fault."
    )
    parser.add_argument("good", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=len(FAULTS))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    try:
        made = make(options.good, options.folder, options.count, options.seed)
    except (OSError, ValueError) as error:
        parser.exit(1, f"lab_check: {error}\n")
    for entry in made:
        print(f"{entry['submission']:28} {entry['what']}")
    return 0

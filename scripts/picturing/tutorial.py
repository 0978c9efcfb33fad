"""Pictures of the MoveIt tutorial: those of its tests, which click through it, and one of a block that is put down by clicks."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from rqt_testing.desktop import Desktop

from .common import PICK, ROOT, Options, Trouble, launched, master, of_ros, save

PANEL = ROOT / "src" / "planning" / "moveit_ros_visualization" / "test"
ASSISTANT = ROOT / "src" / "windows" / "moveit_setup_assistant" / "test"
sys.path.insert(0, str(PANEL))
from rviz_desktop import run_rviz  # noqa: E402  # beside the panel's tests

SIZE = "1280x940x24"
PICK_CONFIG = ROOT / "src" / "labs" / "myur5sim" / "myur5_moveit_config" / "launch" / "moveit.rviz"
WIDTH = 800  # pixels of a picture


def _shown(seen: Path, file: Path) -> None:
    """A picture of a screen, as pages have it."""
    from PIL import Image

    save(Image.open(seen), file, WIDTH)


def _kept(folder: Path, out: Path, names: Sequence[str]) -> None:
    """What a test kept in ``folder`` as N_NAME.png, as NAME.jpg in ``out``."""
    for name in names:
        found = sorted(folder.glob(f"*_{name}.png"))
        if not found:
            raise Trouble(f"the test kept no picture {name}")
        _shown(found[0], out / f"{name}.jpg")


def _tested(out: Path, names: Sequence[str], *command: str) -> None:
    """The pictures ``names`` that the test ``command`` keeps when it is asked to."""
    with tempfile.TemporaryDirectory() as folder, master() as environment:
        done = subprocess.run(command, env={**environment, "TUTORIAL_PICTURES": folder}, capture_output=True, text=True)
        if done.returncode:
            raise Trouble(f"the test has failed: {' '.join(command)}: {done.stdout.strip().splitlines()[-1:]}")
        _kept(Path(folder), out, names)


def assistant(out: Path) -> None:
    """The Setup Assistant's screens, filled in for the UR5 on its pedestal."""
    names = ("start", "collisions", "virtual_joints", "groups", "poses", "controllers", "author", "files")
    test = f"{ASSISTANT / 'test_tutorial.py'}::test_clicks_and_the_command_make_the_same_package"
    _tested(out, names, sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", test)


def panel(out: Path) -> None:
    """RViz's panel is added, plans and executes."""
    _tested(out, ("empty", "add", "added", "planned", "executed"), "rostest", str(PANEL / "simulated.test"))


def manipulation(out: Path) -> None:
    """A block is picked and put down by clicks in the tab Manipulation."""
    with launched(PICK) as environment, Desktop(SIZE) as desktop:
        config = Path(desktop.home) / "moveit.rviz"
        shutil.copy(PICK_CONFIG, config)
        desktop.environment.update(of_ros(environment))
        rviz = run_rviz(desktop, str(config), "1270x900")

        def status() -> str:
            return json.loads(rviz.ask("text", "statuses") or "{}").get("MotionPlanning", ["", ""])[1]

        rviz.wait(lambda: status() == "Status: Ok", "display without a complaint")
        rviz.click_text("Manipulation")

        def result(begin: str) -> bool:
            return rviz.text("manipulation_result").startswith(begin)

        while not result("Recognized"):  # what finds things on the table may come after RViz
            rviz.click("detect_objects_button")
            rviz.wait(lambda: result("Recognized") or result("Listed"), "answer to Detect")
        rviz.click_text("block")
        rviz.click("pick_button")
        rviz.wait(lambda: result("Picked up"), "block picked up", 120.0)
        x, y, *_ = rviz.rect("support_surfaces_list")
        desktop.click_at(x + 20, y + 12)  # its first row: the table
        rviz.click("place_button")
        rviz.wait(lambda: result("Putting"), "place")
        time.sleep(2.0)  # the block is on its way, the places that are tried are seen
        file = Path(desktop.home) / "seen.png"
        desktop.screenshot(str(file))
        _shown(file, out / "manipulation.jpg")


#: name -> who makes it
CHAPTERS: dict[str, Callable[[Path], None]] = {"moveit_assistant": assistant, "moveit_panel": panel, "moveit_manipulation": manipulation}


def make(name: str, options: Options) -> Path:
    """:raises Trouble: its test failed. :raises AssertionError: something did not appear."""
    out = options.out / "moveit"
    os.makedirs(out, exist_ok=True)
    CHAPTERS[name](out)
    return out

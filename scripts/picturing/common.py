"""What all makers of pictures need: a ROS master with something launched, and a line when a picture cannot be made."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "scripts" / "benchmarks"), str(ROOT / "src" / "windows" / "gzclient" / "test")]
from run import master  # noqa: E402

QUALITY = 88  # of JPEG
PICK = ("roslaunch", "myur5_pick_place", "pick_place.launch", "gui:=false", "rviz:=false")


class Trouble(Exception):
    """One line for who called."""


@dataclass(frozen=True)
class Options:
    """Where pictures go, and what some need from outside.

    :param out: folder
    :param house: a copy of aws-robotics/aws-robomaker-small-house-world
    """

    out: Path
    house: Path | None = None


@contextlib.contextmanager
def running(environment: dict[str, str], *words: str, **options: Any) -> Iterator[subprocess.Popen]:
    """A command that is ended by Ctrl-C, in ``environment``; ``options`` are Popen's."""
    process = subprocess.Popen(words, env=environment, text=True, start_new_session=True, stderr=subprocess.DEVNULL, **options)
    try:
        yield process
    finally:
        os.killpg(process.pid, signal.SIGINT)
        process.wait(60)


@contextlib.contextmanager
def launched(*commands: tuple[str, ...]) -> Iterator[dict[str, str]]:
    """A master of its own with ``commands`` running; the environment in which others find them."""
    with master() as environment, contextlib.ExitStack() as stack:
        for command in commands:
            stack.enter_context(running(environment, *command, stdout=subprocess.DEVNULL))
        yield environment


def of_ros(environment: dict[str, str]) -> dict[str, str]:
    """What of an environment leads programs on another screen to the same master."""
    return {name: value for name, value in environment.items() if name.startswith("ROS_")}


def save(picture: Any, file: Path, width: int) -> None:
    """Write ``picture``, an image of PIL, as JPEG of ``width`` pixels."""
    from PIL import Image

    height = round(width * picture.height / picture.width)
    picture.convert("RGB").resize((width, height), Image.Resampling.LANCZOS).save(file, quality=QUALITY)

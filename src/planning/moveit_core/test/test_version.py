"""`moveit_version` on the command line says what programs in C++ are compiled for."""

import re
import subprocess
from pathlib import Path

HEADER = Path(__file__).parents[1] / "include/moveit/version.h"


def test_it_is_the_version_of_the_header():
    said = subprocess.run(["rosrun", "moveit_core", "moveit_version"], capture_output=True, text=True, timeout=60)
    assert said.stdout.strip() == re.search(r'MOVEIT_VERSION_STR "([^"]+)"', HEADER.read_text())[1]


def test_it_is_on_the_path():
    assert subprocess.run("moveit_version", capture_output=True, text=True, timeout=60).returncode == 0

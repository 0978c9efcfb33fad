"""A package in Noetic's style that calls roslint is configured, and `make roslint` judges its files."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent.parent

CMAKE = """cmake_minimum_required(VERSION 3.10)
project(linted)
find_package(catkin REQUIRED COMPONENTS roslint)
catkin_package()
{checks}
"""


def make(folder, files, checks="roslint_python({files})\nroslint_add_test()"):
    (folder / "package.xml").write_text(
        '<package format="2"><name>linted</name><version>0.0.1</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend></package>'
    )
    (folder / "CMakeLists.txt").write_text(CMAKE.format(checks=checks.format(files=files)))
    build = folder.with_name(folder.name + "_build")
    configured = subprocess.run(
        ["cmake", "-S", folder, "-B", build, "-DPYTHON_EXECUTABLE=/usr/bin/python3"], capture_output=True, text=True
    )
    assert configured.returncode == 0, configured.stderr
    return subprocess.run(["cmake", "--build", build, "--target", "roslint"], capture_output=True, text=True, env=os.environ)


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("pycodestyle"), reason="pycodestyle is not installed")
@pytest.mark.parametrize("files", ["", "good.py bad.py"])
def test_python_files_are_judged(tmp_path, files):
    (tmp_path / "good.py").write_text("value = 1\n")
    (tmp_path / "bad.py").write_text("value=1\n")
    made = make(tmp_path, files)
    assert made.returncode != 0 and "bad.py:1:6: E225" in made.stdout and "good.py" not in made.stdout
    (tmp_path / "bad.py").write_text("value = 1\n")
    assert make(tmp_path, files).returncode == 0


@pytest.mark.slow
def test_checkers_of_others_hang_on_its_targets(tmp_path):
    """As ruvu_lint does: the targets exist without a call of roslint's own checkers."""
    own = "_roslint_create_targets()\nadd_custom_target(own COMMAND echo judged by {files})\nadd_dependencies(roslint_linted own)"
    made = make(tmp_path, "another", own)
    assert made.returncode == 0 and "judged by another" in made.stdout

"""Programs for Noetic's bindings ``moveit.core`` read in one line what takes their place."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    "line",
    [
        "import moveit.core",
        "from moveit.core import load_robot_model",
        "from moveit.core.robot_model import RobotModel",
        "from moveit.core import planning_scene",
        "import moveit.core.kinematic_constraints",
    ],
)
def test_the_bindings_name_what_to_use(line):
    said = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, timeout=60)
    assert said.returncode == 1
    last = said.stderr.strip().splitlines()[-1]
    assert last.startswith("ModuleNotFoundError: moveit.core ")
    assert "import motion" in last and "import moveit_commander" in last


def test_other_packages_beside_it_are_found(tmp_path):
    (tmp_path / "moveit" / "mine").mkdir(parents=True)
    (tmp_path / "moveit" / "__init__.py").write_text("")
    (tmp_path / "moveit" / "mine" / "__init__.py").write_text("here = True")
    line = f"import sys; sys.path.append({str(tmp_path)!r}); from moveit.mine import here; print(here)"
    assert subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, timeout=60).stdout == "True\n"

"""scripts/setup on a copy that needs no packages: bad folders are refused, a second run waits for the first."""
import shutil
import subprocess
import time
from pathlib import Path

import pytest

SETUP = Path(__file__).resolve().parents[4] / "scripts/setup"


def copy_of_setup(folder: Path) -> Path:
    (folder / "scripts").mkdir(parents=True)
    for name in ("debian-packages.txt", "requirements.txt"):
        (folder / "scripts" / name).write_text("# none\n")
    return Path(shutil.copy(SETUP, folder / "scripts"))


@pytest.mark.parametrize("name", ["with blank", "a;b", "a:b", "it's", "a$b", "tab\there", "a[1]"])
def test_a_folder_that_catkin_cannot_take_is_refused_in_one_line_before_anything_is_done(tmp_path, name):
    setup = copy_of_setup(tmp_path / name)
    before = sorted(tmp_path.rglob("*"))
    ended = subprocess.run([setup, "--no-build"], capture_output=True, text=True, timeout=60)
    assert ended.returncode == 1 and ended.stdout == ""
    assert ended.stderr.startswith("[setup] ERROR: the folder '") and ended.stderr.count("\n") == 1 and "move it" in ended.stderr
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ["plain", "größe", "a+b-c_d.e~1"])
def test_other_folders_are_taken(tmp_path, name):
    ended = subprocess.run([copy_of_setup(tmp_path / name), "--no-build"], capture_output=True, text=True, timeout=120)
    assert ended.returncode == 0 and "ready" in ended.stdout, ended.stderr


def test_a_second_setup_says_that_it_waits_and_goes_on_when_the_first_has_ended(tmp_path):
    setup = copy_of_setup(tmp_path)
    with subprocess.Popen(["flock", str(tmp_path / "scripts"), "cat"], stdin=subprocess.PIPE) as first:
        time.sleep(0.2)  # the lock is taken as soon as the process runs; the assertion below finds out if it was not
        with subprocess.Popen([setup, "--no-build"], stdout=subprocess.PIPE, text=True) as second:
            line = second.stdout.readline()
            assert "another scripts/setup is at work" in line and "waiting" in line
            assert second.poll() is None
            first.stdin.close()
            rest = second.communicate(timeout=120)[0]
    assert second.returncode == 0 and "ready" in rest


def needed(*arguments):
    return subprocess.run(["/usr/bin/python3", SETUP.parent / "needed_packages.py", *arguments], capture_output=True, text=True, timeout=60)


def test_what_the_demo_builds_is_what_it_needs_to_run():
    found = needed("--without", "theora_image_transport", "--", "arm_gazebo").stdout.split()
    assert {"arm_gazebo", "arm_description", "gazebo_ros", "gazebo_ros_control", "gazebo_msgs", "ode_sim", "xacro"} <= set(found)
    for for_tests_only in ("controller_manager_tests", "control_test_robots"):
        assert for_tests_only not in found
    assert "theora_image_transport" not in found and "theora_image_transport" in needed("gazebo_plugins").stdout.split()
    assert found == sorted(set(found))


def test_an_unknown_package_is_one_line():
    ended = needed("no_such_package")
    assert ended.returncode == 2 and ended.stdout == "" and "this workspace has no package no_such_package" in ended.stderr

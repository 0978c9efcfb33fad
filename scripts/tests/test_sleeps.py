"""No test waits for a time in which it hopes that something happens: it waits for the thing (``test_support.wait_until``, or for a bound in
which it must not come, ``never``). A sleep within a loop is taken for the interval of such a wait."""

import ast
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST_INTERVAL = 0.05  # s, of a loop in C++
#: How many sleeps of a fixed time a file has, and why.
KNOWN = {
    "src/common/node_signals/test/test_bounded_calls.py": (2, "plays a node that answers slowly"),
    "src/common/node_signals/test/test_half_dead_master.py": (1, "plays a master that does not answer"),
    "src/planning/moveit_ros_visualization/test/simulated_rostest.py": (1, "pictures for the documentation"),
    "src/planning/moveit_simple_controller_manager/test/pretend_controller.py": (1, "plays a controller that is late"),
    "src/shelf/robot_localization/test/localization_rostest.py": (1, "the pace of a clock that the test makes"),
    "src/shelf/robot_localization/test/order_rostest.py": (1, "the pace of a clock that the test makes"),
    "src/shelf/robot_localization/test/navsat_rostest.py": (1, "the pace of a clock that the test makes"),
    "src/simulation/gazebo_plugins/test/counting.py": (1, "plays a subscriber that is slow"),
    "src/simulation/gazebo_ros/test/compiled_plugins/twin.cpp": (1, "plays a plugin that blocks the step"),
    "src/simulation/gazebo_ros/test/hostile_rostest.py": (1, "how long the server is stopped"),
    "src/simulation/gazebo_ros/test/processes_rostest.py": (1, "how long the master is stopped"),
    "src/teaching/lab_check/test/every_lab/scripts/helper.py": (1, "plays a student's action"),
    "src/windows/gzclient/test/browser.py": (1, "the time between two looks that are compared"),
    "src/windows/gzclient/test/hardships.py": (1, "plays a slow line"),
    "src/windows/gzclient/test/sensors_rostest.py": (1, "the time between two looks that are compared"),
    "src/windows/moveit_setup_assistant/test/test_tutorial.py": (2, "pictures for the documentation; a list that unfolds"),
    "src/windows/rqt_graph/test/test_window.py": (1, "plays a node that is slow"),
}


def fixed_sleeps(node, within_loop=False):
    """Lines of calls of sleep that are no part of a loop."""
    for child in ast.iter_child_nodes(node):
        inner = within_loop or isinstance(child, (ast.While, ast.For))
        if isinstance(child, (ast.FunctionDef, ast.Lambda)):
            inner = False
        if isinstance(child, ast.Call) and not inner:
            name = child.func.attr if isinstance(child.func, ast.Attribute) else getattr(child.func, "id", "")
            if name in ("sleep", "wallsleep"):
                yield child.lineno
        yield from fixed_sleeps(child, inner)


def long_sleeps(text):
    """Lines of C++ that sleep longer than a loop looks."""
    for number, line in enumerate(text.splitlines(), 1):
        for seconds in re.findall(r"Duration\(([\d.]+)\)\.sleep\(\)", line):
            if float(seconds) > LONGEST_INTERVAL:
                yield number
        if "sleep_for(" in line or "sleep_until(" in line or "usleep(" in line:
            yield number


def files_of_tests(ending):
    out = subprocess.run(["git", "ls-files", "-z", "--", f"src/*{ending}"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [name for name in out.split("\0") if "/test/" in name and (ROOT / name).is_file()]


def test_a_sleep_of_a_fixed_time_is_found():
    assert list(fixed_sleeps(ast.parse("def f():\n    time.sleep(1)\n    while not x():\n        rospy.sleep(0.1)\n"))) == [2]
    assert list(fixed_sleeps(ast.parse("for i in range(3):\n    def g():\n        wallsleep(1)\n"))) == [3]
    assert list(long_sleeps("  ros::WallDuration(0.01).sleep();\n  ros::Duration(0.5).sleep();\n  std::this_thread::sleep_for(t);")) == [
        2,
        3,
    ]


def test_no_test_sleeps_for_a_fixed_time():
    lines = {}
    for name in files_of_tests(".py"):
        lines[name] = list(fixed_sleeps(ast.parse((ROOT / name).read_text(), name)))
    for name in files_of_tests(".cpp"):
        lines[name] = list(long_sleeps((ROOT / name).read_text()))
    found = {name: len(numbers) for name, numbers in lines.items() if numbers}
    known = {name: count for name, (count, _) in KNOWN.items()}
    wrong = [
        f"{name}: lines {lines.get(name)}, known are {known.get(name, 0)}"
        for name in {*found, *known}
        if found.get(name) != known.get(name)
    ]
    assert not wrong, "\n".join(sorted(wrong))

"""What entries of controller_list say of tolerances, numbers and flags."""

from pathlib import Path

import pytest
import rospkg
import yaml
from moveit_simple_controller_manager import entries

CASES = yaml.safe_load((Path(rospkg.RosPack().get_path("moveit_ros_planning")) / "test" / "tolerances.yaml").read_text())


@pytest.fixture
def lines(monkeypatch):
    said = []
    monkeypatch.setattr(entries.rospy, "logerr", lambda text, *values: said.append(text % values))
    return said


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["case"].replace(" ", "_"))
def test_tolerances(case, lines):
    made = entries.tolerances({"name": "arm", "joints": case["joints"], "goal_tolerance": case["given"]}, "goal_tolerance")
    assert [[row.name, row.position, row.velocity, row.acceleration] for row in made] == case["rows"]
    assert bool(lines) == case.get("refused", False)
    assert all("'arm'" in line and "goal_tolerance" in line and "\n" not in line for line in lines)


def test_a_list_of_the_wrong_length_says_both_lengths(lines):
    entries.tolerances({"name": "arm", "joints": ["a", "b"], "path_tolerance": {"velocity": [1.0, 2.0, 3.0]}}, "path_tolerance")
    assert len(lines) == 1 and "path_tolerance: velocity" in lines[0] and "3 numbers" in lines[0] and "2 joints" in lines[0]


def test_nothing_given_is_nothing(lines):
    assert entries.tolerances({"name": "arm", "joints": ["a"]}, "goal_tolerance") == [] and not lines


@pytest.mark.parametrize(
    "value, expected, told",
    [(1, 1.0, False), (-0.5, -0.5, False), ("soon", 0.0, True), (float("nan"), 0.0, True), (True, 0.0, True), ([1], 0.0, True)],
)
def test_numbers(value, expected, told, lines):
    assert entries.number({"name": "arm", "goal_time_tolerance": value}, "goal_time_tolerance") == expected
    assert bool(lines) == told


@pytest.mark.parametrize("value, expected", [(True, True), (1, True), ("true", True), (False, False), (0, False)])
def test_flags(value, expected):
    assert entries.flag({"parallel": value}, "parallel") is expected
    assert not entries.flag({}, "parallel")

"""The arm's homework from one end to the other, in the sandbox: full marks for the lab, fewer for a node that does nothing."""

import json
import pathlib
import xml.etree.ElementTree as ET

import pytest
from lab_check import faults, report
from lab_check.check import check
from lab_check.isolation import sandbox
from lab_check.specs import spec

ROOT = pathlib.Path(__file__).parent.parent
ARM = ROOT.parents[1] / "labs" / "arm"


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """The arm's spec, with only the first and the last task of those that run."""
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))
    place = tmp_path_factory.mktemp("spec") / "arm.yaml"
    text = (ROOT / "specs" / "arm_homework.yaml").read_text()
    start, end = text.index("  - name: The simulated arm comes up"), text.index("  - name: The node moves the arm")
    place.write_text((text[:start] + text[end:]).replace("film: true", "film: false"))
    return spec.load(place)


@pytest.mark.slow
def test_the_same_marks_to_the_last_digit(short, tmp_path):
    first, second = (check(short, ARM, tmp_path / name, films=False) for name in "ab")
    assert not first.fault and first.points == first.of == 55, [v.reason for t in first.tasks for v in t.verdicts if not v.passed]
    assert report.marks(first).split("], [") == report.marks(second).split("], [")  # in parts, so that a failure shows the figure
    assert (tmp_path / "a" / "pictures").is_dir()


@pytest.mark.slow
def test_a_node_that_does_nothing_loses_its_own_points_only(short, tmp_path):
    fault = [f for f in faults.FAULTS if f.name == "node_sleeps"]
    faults.make(ARM, tmp_path / "class", 1, faults=fault)
    result = check(short, tmp_path / "class" / "00_node_sleeps", tmp_path / "out", films=False)
    assert {task.name: task.points for task in result.tasks} == {"Build": 20, "The robot's description": 15, "The node moves the arm": 0}
    assert "joint j0 should reach 1 rad" in (tmp_path / "out" / "report.html").read_text()
    assert ET.parse(tmp_path / "out" / "junit.xml").getroot().get("failures") == "1"
    assert json.loads((tmp_path / "out" / "results.json").read_text())["score"] == 35

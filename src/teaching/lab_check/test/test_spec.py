"""Every kind of mistake in a spec gets a line with its place and what to do."""
import pathlib

import pytest
from lab_check import spec

GOOD = """\
title: T
launch: p a.launch
tasks:
  - name: A
    points: 3
    do:
      - run: {command: p node}
    expect:
      - joint: {name: j0, value: 1, tolerance: 0.1}
"""


def problems(tmp_path, text):
    path = tmp_path / "spec.yaml"
    path.write_text(text)
    with pytest.raises(spec.SpecError) as caught:
        spec.load(path)
    return "\n".join(caught.value.problems)


def test_a_good_one_gets_its_defaults(tmp_path):
    (tmp_path / "spec.yaml").write_text(GOOD)
    found = spec.load(tmp_path / "spec.yaml")
    assert found.points == 3 and found.limit("disk") == 1e9 and found.data["tasks"][0]["launch"] == "p a.launch"


@pytest.mark.parametrize("old, new, line, words", [
    ("points: 3", "pionts: 3", 5, "did you mean 'points'"),
    ("points: 3", "points: -3", 5, "-3 is less than 0"),
    ("points: 3", "points: many", 5, '"many" is no number'),
    ("tolerance: 0.1", "tolerance: [1]", 9, "is no number"),
    (", tolerance: 0.1", "", 9, "'tolerance' is missing"),
    ("name: A", "name: ''", 4, "too short"),
    ("title: T", "titel: T", 1, "did you mean 'title'"),
    ("- joint:", "- joints:", 9, "did you mean 'joint'"),
    ("{command: p node}", "{}", 7, "'command' is missing"),
    ("launch: p a.launch\n", "", 8, "'joint' needs something that runs"),
    ("launch: p a.launch\n", "launch: p a.launch\nlimits: {disk: big}\n", 3, "a size such as 500 MB"),
    ("launch: p a.launch\n", "launch: p a.launch\nlaunch: q\n", 3, "second time"),
    ("      - joint: {name: j0, value: 1, tolerance: 0.1}\n", "      - exit: {run: other}\n", 9, "no 'run' of this task is named 'other'"),
    ("      - joint: {name: j0, value: 1, tolerance: 0.1}\n", "      - {node: a, topic: {name: b}}\n", 9, "several kinds"),
    ("      - joint: {name: j0, value: 1, tolerance: 0.1}\n", "      - python: {file: no.py, function: f}\n", 9, "there is no file"),
    ("title: T", "title: [T", 2, "no YAML"),
])
def test_mistakes_are_named_with_their_line(tmp_path, old, new, line, words):
    assert old in GOOD
    found = problems(tmp_path, GOOD.replace(old, new, 1))
    assert f"spec.yaml:{line}:" in found and words in found, found


def test_no_file_empty_file_and_bytes(tmp_path):
    with pytest.raises(spec.SpecError, match="cannot be read"):
        spec.load(tmp_path / "none.yaml")
    (tmp_path / "bytes.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(spec.SpecError, match="cannot be read"):
        spec.load(tmp_path / "bytes.yaml")
    assert "table" in problems(tmp_path, "")
    assert "table" in problems(tmp_path, "- a\n")
    assert "40 deep" in problems(tmp_path, "[" * 60 + "]" * 60)


@pytest.mark.parametrize("path", sorted((pathlib.Path(__file__).parent.parent / "specs").glob("*.yaml")), ids=lambda path: path.stem)
def test_the_examples_are_good_and_give_100_points(path):
    assert spec.load(path).points == 100

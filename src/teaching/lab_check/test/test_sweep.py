"""A sweep's cases, its mistakes by line, where values go, the table and the page: without ROS."""

import csv
import math
import pathlib
import types

import pytest
import yaml
from lab_check import outcome, sweep
from lab_check.classroom import store
from lab_check.specs import sweep_spec
from lab_check.specs.spec import SpecError

SPEC = """\
title: T
launch: p a.launch + p b.launch
tasks:
  - name: A
    points: 4
    expect:
      - joint: {name: j0, value: 1, tolerance: 0.1}
      - python: {file: own.py, function: f}
"""
SWEEP = """\
title: S
spec: spec.yaml
submission: lab
seed: 3
draws: 2
parameters:
  gain: {values: [1, 2.5]}
  start: {from: 0, to: 1, steps: 3}
  friction: {log: [0.1, 10]}
set:
  - {parameter: gain, yaml: p/gains.yaml, key: arm/pid/p}
  - {parameter: start, launch: x}
  - {parameter: friction, file: p/arm.urdf, find: 'friction="([^"]*)"'}
  - {parameter: gain, spec: tasks.1.expect.1.joint.value}
  - {parameter: gain, spec: seed}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "lab" / "p").mkdir(parents=True)
    (tmp_path / "lab" / "p" / "gains.yaml").write_text("# own\narm: {pid: {p: 100.0, i: 1}}\n")
    (tmp_path / "lab" / "p" / "arm.urdf").write_text('<a friction="0"/><b friction="7" other="1"/>')
    (tmp_path / "spec.yaml").write_text(SPEC)
    (tmp_path / "own.py").write_text("def f(context): return True\n")
    (tmp_path / "sweep.yaml").write_text(SWEEP)
    return tmp_path


def test_the_grid_with_its_draws_is_the_same_every_time(folder):
    found = sweep_spec.load_sweep(folder / "sweep.yaml").cases
    assert len(found) == 2 * 3 * 2 and found == sweep_spec.load_sweep(folder / "sweep.yaml").cases
    assert [case["start"] for case in found[:6]] == [0.0, 0.0, 0.5, 0.5, 1.0, 1.0]
    frictions = [case["friction"] for case in found]
    assert len(set(frictions)) == 12 and all(0.1 <= f <= 10 for f in frictions)
    # one more parameter changes the draws of none
    more = SWEEP.replace("  start:", "  more: {uniform: [0, 1]}\n  start:")
    (folder / "sweep.yaml").write_text(more + "  - {parameter: more, launch: y}\n")
    assert [case["friction"] for case in sweep_spec.load_sweep(folder / "sweep.yaml").cases] == frictions


def test_values_go_to_their_places(folder):
    found = sweep_spec.load_sweep(folder / "sweep.yaml")
    submission = found.write_case({"gain": 2.5, "start": 0.5, "friction": 3.25}, folder / "case")
    assert yaml.safe_load((submission / "p" / "gains.yaml").read_text()) == {"arm": {"pid": {"p": 2.5, "i": 1}}}
    assert (submission / "p" / "arm.urdf").read_text() == '<a friction="3.25"/><b friction="3.25" other="1"/>'
    data = yaml.safe_load((folder / "case" / "spec.yaml").read_text())
    assert data["launch"] == "p a.launch x:=0.5 + p b.launch" and data["seed"] == 2.5
    assert data["tasks"][0]["expect"][0]["joint"]["value"] == 2.5
    assert data["tasks"][0]["expect"][1]["python"]["file"] == str(folder / "own.py")
    assert "100.0" in (folder / "lab" / "p" / "gains.yaml").read_text()  # the original


@pytest.mark.parametrize(
    "old, new, line, words",
    [
        ("seed: 3", "sede: 3", 4, "did you mean 'seed'"),
        ("draws: 2", "draws: 0", 5, "0 is less than 1"),
        ("{values: [1, 2.5]}", "{values: [1], log: [1, 2]}", 7, "holds log and values; give one"),
        ("{from: 0, to: 1, steps: 3}", "{from: 0, to: 1}", 8, "from, to and steps belong together"),
        ("{from: 0, to: 1, steps: 3}", "{from: 0, to: 1, steps: 90000}", 6, "360000 cases; 100000 are the most"),
        ("{log: [0.1, 10]}", "{log: [0, 10]}", 9, "both numbers must be above 0"),
        ("{log: [0.1, 10]}", "{uniform: [1, 1]}", 9, "the lesser one"),
        ("{log: [0.1, 10]}", "{values: [1]}", 5, "no parameter is random"),
        ("{parameter: start, launch: x}", "{parameter: strat, launch: x}", 12, "there is no parameter 'strat'"),
        ("{parameter: start, launch: x}", "{parameter: gain, launch: x}", 8, "parameters.start: goes nowhere"),
        ("launch: x}", "launch: x, spec: seed}", 12, "holds spec and launch"),
        (", key: arm/pid/p", "", 11, "'yaml' and 'key' belong together"),
        ("key: arm/pid/p", "key: arm/dip/p", 11, "p/gains.yaml has no arm.dip"),
        ("p/gains.yaml", "p/gain.yaml", 11, "the submission has no file p/gain.yaml"),
        ("p/gains.yaml", "../sweep.yaml", 11, "the submission has no file"),
        ('friction="([^"]*)"', "damping=(.)", 13, "holds nothing like"),
        ('([^"]*)', '[^"]*', 13, "find needs one group"),
        ("tasks.1.expect.1", "tasks.2.expect.1", 14, "the spec has no tasks.2"),
        ("submission: lab", "submission: bal", 3, "there is no folder"),
    ],
)
def test_mistakes_are_named_with_their_line(folder, old, new, line, words):
    assert old in SWEEP
    (folder / "sweep.yaml").write_text(SWEEP.replace(old, new, 1))
    with pytest.raises(SpecError) as caught:
        sweep_spec.load_sweep(folder / "sweep.yaml")
    found = "\n".join(caught.value.problems)
    assert f"sweep.yaml:{line}:" in found and words in found, found


def test_faults_of_the_spec_itself_are_shown(folder):
    (folder / "spec.yaml").write_text(SPEC.replace("points: 4", "points: x"))
    with pytest.raises(SpecError, match="spec.yaml:5"):
        sweep_spec.load_sweep(folder / "sweep.yaml")


def some_results(folder):
    book = store.Store(folder / "sweep.sqlite")
    inputs = {"case_1": {"gain": 1, "word": "a"}, "case_2": {"gain": 2.5, "word": "b"}, "case_3": {"gain": 3, "word": "c"}}
    for number, name in enumerate(inputs):
        book.enlist(name, folder, "1")
        verdict = outcome.Verdict("joint", True, "", figures={"last": 0.1 * number, "names": ["x"]})
        result = outcome.Result("t", "s")
        result.add(outcome.TaskResult("A", float(number), 4.0, [verdict]))
        book.done(name, result) if number < 2 else book.failed(name, "its worker died")
    return inputs, book


def test_the_table_has_parameters_points_and_figures(folder):
    inputs, book = some_results(folder)
    columns, rows = sweep.table(inputs, book)
    assert columns == ["case", "gain", "word", "points", "of", "seconds", "A", "A / 1 joint / last", "why"]
    assert rows[1]["points"] == 1.0 and rows[1]["A / 1 joint / last"] == 0.1 and rows[2]["why"] == "its worker died"
    read = list(csv.DictReader(sweep.write_table(columns, rows, folder, True).open()))
    assert [row["gain"] for row in read] == ["1", "2.5", "3"] and read[2]["points"] == ""


def test_the_same_table_as_parquet(folder):
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed: scripts/setup --teaching")
    inputs, book = some_results(folder)
    path = sweep.write_table(*sweep.table(inputs, book), folder, False)
    read = parquet.read_table(path).to_pydict()
    assert path.suffix == ".parquet" and read["gain"] == [1.0, 2.5, 3.0] and read["points"] == [0.0, 1.0, None]


def test_plots_and_page(folder):
    inputs, book = some_results(folder)
    columns, rows = sweep.table(inputs, book)
    found = types.SimpleNamespace(data={"title": "A & B", "parameters": {"gain": {"log": [1, 3]}, "word": {}}}, cases=[1, 2, 3])
    pictures = sweep.plots(found, columns, rows, folder)
    assert [name for name, _ in pictures] == ["points", "A", "A / 1 joint / last"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for _, path in pictures)
    sweep.write_page(found, columns, rows, pictures, folder)
    page = (folder / "sweep.html").read_text()
    assert "A &amp; B" in page and "case_2/report.html" in page and "its worker died" in page


def test_cases_of_an_earlier_sweep_no_longer_wait(folder):
    _, book = some_results(folder)
    book.begin_again(["case_1", "case_3"])
    assert [row["name"] for row in book.rows()] == ["case_1", "case_3"] and book.waiting() == ["case_3"]
    assert math.isclose(book.rows()[0]["points"], 0.0)


def test_the_example_is_good():
    example = pathlib.Path(__file__).parent.parent / "sweeps" / "mbot.yaml"
    assert len(sweep_spec.load_sweep(example).cases) == 4


def test_last_digits_are_no_difference():
    assert not sweep._differs([1.4e-17, -4.6e-18, 0.0, None]) and sweep._differs([0.6, 1.2]) and not sweep._differs([None])

"""Every kind of mistake in a spec gets a line with its place and what to do."""

import pathlib

import pytest
from lab_check.specs import spec

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


@pytest.mark.parametrize(
    "old, new, line, words",
    [
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
        (
            "      - joint: {name: j0, value: 1, tolerance: 0.1}\n",
            "      - exit: {run: other}\n",
            9,
            "no 'run' of this task is named 'other'",
        ),
        ("      - joint: {name: j0, value: 1, tolerance: 0.1}\n", "      - {node: a, topic: {name: b}}\n", 9, "several kinds"),
        ("      - joint: {name: j0, value: 1, tolerance: 0.1}\n", "      - python: {file: no.py, function: f}\n", 9, "there is no file"),
        ("title: T", "title: [T", 2, "no YAML"),
    ],
)
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


GUIDE = pathlib.Path(__file__).resolve().parents[4] / "docs" / "grading.md"


def blocks():
    return [part.partition("```")[0] for part in GUIDE.read_text().split("```yaml\n")[1:]]


def test_the_guide_has_a_line_for_everything_that_a_spec_can_say(tmp_path):
    """Its two specs are good as they stand, and hold each key of the schema but those of a sweep."""
    (tmp_path / "my_functions.py").write_text("def arm_moved(context, by): return True\n")
    texts = [text for text in blocks() if text.startswith("title: ") and "tasks:" in text]
    assert len(texts) == 2
    said = ""
    for text in texts:
        (tmp_path / "spec.yaml").write_text(text)
        spec.load(tmp_path / "spec.yaml")
        said += text
    missing = [key for key in keys_of(spec.SCHEMA) if f"{key}:" not in said]
    assert not missing


def keys_of(schema):
    if isinstance(schema, dict):
        for name, part in schema.items():
            if name == "properties":
                yield from part
            yield from keys_of(part)


JOINT = "joint: {name: j0, value: 1, tolerance: 0.1}"


@pytest.mark.parametrize(
    "wrong, words",
    [
        (JOINT.replace("0.1", "-0.1"), "-0.1 is less than 0"),
        ("still: {joints: [j0], tolerance: -1}", "-1 is less than 0"),
        ("tf: {from: a, to: b, xyz: [0, 0, 0], tolerance: -0.1}", "-0.1 is less than 0"),
        ("path: {points: [[1, 0]], tolerance: -0.1}", "-0.1 is less than 0"),
        ("image: {topic: /a, colour: [0, 0, 0], tolerance: -1}", "-1 is less than 0"),
        (JOINT.replace("value: 1", "value: .nan"), "value: is no number (.nan)"),
        (JOINT.replace("0.1", ".nan"), "tolerance: is no number (.nan)"),
        (JOINT.replace("value: 1", "value: -.inf"), "value: has to be finite"),
        (JOINT.replace("0.1}", "0.1, within: .inf}"), "within: has to be finite"),
        ("moved: {by: [.nan, 1]}", "by.1: is no number"),
        ("moved: {to: [0, .inf]}", "to.2: has to be finite"),
        ("path: {points: [[1, .nan]], tolerance: 0.1}", "points.1.2: is no number"),
        ("param: {name: /x, value: .nan}", "value: is no number"),
        ("topic: {name: /x, rate: [11, 9]}", "[11, 9]: the least comes first"),
        ("distance: {from: a, to: b, least: 2, most: 1}", "least: 2 is more than most, 1"),
    ],
)
def test_numbers_by_which_nothing_could_be_judged(tmp_path, wrong, words):
    found = problems(tmp_path, GOOD.replace(JOINT, wrong))
    assert "spec.yaml:9:" in found and words in found, found


RUN = "run: {command: p node}"


@pytest.mark.parametrize(
    "old, new, line, words",
    [
        (RUN, "publish: {topic: /a, type: std_msgs/Bool, message: {dta: true}}", 7, "does not fit std_msgs/Bool: No field name [dta]"),
        (RUN, "publish: {topic: /a, type: geometry_msgs/Twist, message: {linear: {x: [1]}}}", 7, "does not fit geometry_msgs/Twist"),
        (
            RUN,
            "action: {topic: /a, type: actionlib/TestAction, goal: {gaol: 1}}",
            7,
            "does not fit actionlib/TestGoal: No field name [gaol]",
        ),
        (RUN, "stop: nobody", 7, "no 'run' of this task is named 'nobody'"),
        (JOINT, "file: {path: p/a, contains: '('}", 9, "'(' is no regular expression"),
        (JOINT, "no_errors: {ignore: [fine, '[']}", 9, "'[' is no regular expression"),
        (JOINT, "exit: {run: it, says: '*'}", 9, "'*' is no regular expression"),
    ],
)
def test_what_no_submission_could_meet(tmp_path, old, new, line, words):
    """The spec's own mistakes are told before anybody loses points by them."""
    found = problems(tmp_path, GOOD.replace(old, new, 1))
    assert f"spec.yaml:{line}:" in found and words in found, found


@pytest.mark.parametrize(
    "new",
    [
        "publish: {topic: /a, type: their_msgs/Own, message: {any: 1}}",  # of the submission, which is not built yet
        "publish: {topic: /a, type: std_msgs/Float64}",
        "action: {topic: /a, type: actionlib/TestAction, goal: {goal: 21}}",
    ],
)
def test_messages_that_fit_or_may_fit(tmp_path, new):
    (tmp_path / "spec.yaml").write_text(GOOD.replace(RUN, new))
    assert spec.load(tmp_path / "spec.yaml").points == 3


def test_bounds_may_have_no_end_and_messages_may_hold_anything(tmp_path):
    """A robot that is told to go to nowhere is an exercise, too."""
    text = GOOD.replace(JOINT, "moved: {by: [0.5, .inf]}").replace(
        "- run: {command: p node}", "- publish: {topic: /x, type: std_msgs/Float64, message: {data: .nan}}"
    )
    (tmp_path / "spec.yaml").write_text(text)
    assert spec.load(tmp_path / "spec.yaml").points == 3


@pytest.mark.parametrize(
    "wrong, right",
    [
        ("topic: {name: /a, rate: 10}", "rate: [9, 11]"),
        ("moved: {distance: 2}", "by: [0.9, 1.1]"),
        ("node: {nam: /x}", "node: /my_node"),
        ("node: [/x]", "node: /my_node"),
        ("still: {joints: j0}", "joints: [j0, j1]"),
        ("path: {points: [1, 2], tolerance: 0.1}", "points: [[1, 0], [1, 1]]"),
        ("no_errors: true", 'ignore: ["No p gain"]'),
        ("image: {topic: /a, colour: red}", "topic: /camera/image_raw"),
        ("controllers: {running: all}", "running: [j0_controller"),
    ],
)
def test_a_mistake_is_told_with_the_right_form(tmp_path, wrong, right):
    found = problems(tmp_path, GOOD.replace("joint: {name: j0, value: 1, tolerance: 0.1}", wrong))
    assert "spec.yaml:9:" in found and "; the right form: " in found and right in found


def test_every_example_of_the_schema_is_good(tmp_path):
    (tmp_path / "my_functions.py").write_text("")
    definitions = spec.SCHEMA["definitions"]
    commands = [kind["examples"][0] for kind in definitions["command"]["properties"].values()]
    expectations = [kind["examples"][0] for name, kind in definitions["expectation"]["properties"].items() if name not in spec.EXTRAS]
    lines = [
        "title: T",
        "launch: p a.launch",
        "tasks:",
        "  - name: A",
        "    do:",
        *(f"      - {line}" for line in commands),
        "    expect:",
        *(f"      - {line}" for line in expectations),
    ]
    (tmp_path / "spec.yaml").write_text("\n".join(lines))
    assert len(spec.load(tmp_path / "spec.yaml").data["tasks"][0]["expect"]) == len(expectations) > 20


@pytest.mark.parametrize(
    "launch, holds",
    [
        (
            "arm_gazebo arm_gazebo.launch",
            ["moving: 4, joints: [j0, j1, j2, j3]", "model: arm", "command of j3", "arm_description", "count: 5"],
        ),
        (
            "mbot_gazebo view_mbot_gazebo_room.launch",
            ["topic: /cmd_vel, type: geometry_msgs/Twist", "moved: {by: [0.8, 1.2]", "models: [mbot]"],
        ),
        ("myur5_description myur5.launch", ["/arm_controller/follow_joint_trajectory", "moving: 6", "joint: {name: wrist_3_joint"]),
    ],
)
def test_a_first_spec_for_a_launch_file_is_good_as_it_stands(tmp_path, launch, holds):
    """What it must hold is what the labs' URDF and launch files say. Windows are no nodes of an examination."""
    from lab_check.specs import new_spec

    written = new_spec.text(new_spec.look(*launch.split(), []))
    (tmp_path / "spec.yaml").write_text(written)
    assert spec.load(tmp_path / "spec.yaml").data["launch"] == launch
    assert not [words for words in holds if words not in written] and "rviz" not in written and written.count("#") > 5


def test_a_launch_file_that_cannot_be_read_is_one_line(capsys, tmp_path):
    from lab_check.specs import new_spec

    assert new_spec.main(["nobodys_package", "a.launch"]) == 2
    assert new_spec.main(["arm_gazebo", "no_such.launch"]) == 2
    (tmp_path / "spec.yaml").write_text("mine")
    assert new_spec.main(["arm_gazebo", "arm_gazebo.launch", "--out", str(tmp_path / "spec.yaml")]) == 2
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 3 and all(line.startswith("lab_check: ") for line in said) and (tmp_path / "spec.yaml").read_text() == "mine"

"""Each kind of command and expectation in one examination for real: what is met is told as met, what is not as not, with its reason."""

import pathlib

import pytest
from lab_check.check import check
from lab_check.isolation import sandbox
from lab_check.specs import spec
from lab_check.specs.spec import SCHEMA

HERE = pathlib.Path(__file__).parent


@pytest.fixture(scope="module")
def examined(tmp_path_factory):
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))
    out = tmp_path_factory.mktemp("every") / "out"
    return check(spec.load(HERE / "every_lab.yaml"), HERE / "every_lab", out), out


def test_everything_that_a_spec_can_say_is_in_this_one():
    tasks = spec.load(HERE / "every_lab.yaml").data["tasks"]
    definitions = SCHEMA["definitions"]
    told = {kind for task in tasks for expectation in task["expect"] for kind in expectation}
    assert set(definitions["expectation"]["properties"]) - told == {"points", "say"}
    assert set(definitions["command"]["properties"]) == {kind for task in tasks for command in task["do"] for kind in command}


@pytest.mark.slow
def test_what_is_met_is_told_as_met(examined):
    result, _ = examined
    assert not result.fault
    wrong = [f"{task.name}: {v.kind}: {v.reason}" for task in result.tasks for v in task.verdicts if v.passed != (task.name[0] != "-")]
    assert not wrong, "\n".join(wrong)


REASONS = """\
no file every_lab/launch/other.launch|holds nothing like 'no such thing'|1 joints can move, 2 should|no joint 'boom'|did you mean /helper
/tick comes at 10 Hz|/tick is not latched|/tick carries std_msgs/Float64|no topic that anybody publishes: /tack|std_srvs/SetBool, not
no service /forbid|/gain is 2.5, not 2.6|no parameter /loss|no transform from odom to moon|pole is 0.5 m from|controller boom is not loaded
160x120 pixels, not 640x480|0.00% of the picture|robot::pole fills 0.00%|no 'trophy' in the simulator|less than 100000 times
3 models are there|no model in the simulator has a joint 'boom'|joint mast should reach 0.5|joint mast moved by|J of work
had to be refused|success is False|ended with code 0; it should end with 2|argument instead of refusing it: RuntimeError: as it was told
on a wrong argument instead of refusing it: nothing|did not say what is wrong with it, nor how it is used (it last printed: root 0.000)
(it last printed: Usage: picky.py NUMBER)|ended with code 0; it should end with 2 (it last printed: Usage|could not be started
robot moved by|prize is|0 of 1 points were passed|came within|touched robot|1 error lines, the first: [ERROR]|ended with code 0; it should
nobody listens to /cmd_well; your nodes subscribe to /cmd_vel"""


@pytest.mark.slow
def test_reasons_say_what_is_wrong(examined):
    said = "\n".join(v.reason for task in examined[0].tasks for v in task.verdicts if not v.passed)
    missing = [words for words in REASONS.replace("\n", "|").split("|") if words not in said]
    assert not missing, f"{missing} is not in\n{said}"


@pytest.mark.slow
def test_the_report_has_pictures_films_plots_and_what_to_type(examined):
    result, out = examined
    page = (out / "report.html").read_text()
    running = [task for task in result.tasks if task.pictures]
    assert len(running) == len(result.tasks) - 3  # without the build, and those that only look at files
    for task in running:
        assert all(pathlib.Path(picture).read_bytes().startswith(b"\x89PNG") for picture in task.pictures)
        if any(v.kind in ("joint", "moved", "image") and v.passed for v in task.verdicts):
            assert pathlib.Path(task.film).read_bytes()[4:8] == b"ftyp", task.name
    assert page.count("<video") >= 6 and page.count("svg+xml") >= 4
    for line in (
        "roslaunch every_lab every.launch",
        "rosservice call /allow '{&quot;data&quot;: true}'",
        "rosrun every_lab picky.py crash",
        "rosrun every_lab keys.py   # then type &quot;wwwwwq&quot;",
        "rostopic pub -1 /mast/command std_msgs/Float64",
    ):
        assert line.replace("'", "&#x27;") in page, line
    assert "[ERROR]" in next(task for task in result.tasks if "keys" in task.name and task.name[0] == "-").log[0]

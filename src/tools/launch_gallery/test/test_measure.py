"""What the measuring tool makes of samples, topics and logs, without ROS running."""

import math
from types import SimpleNamespace

import pytest
import rosgraph
import yaml
from launch_gallery import commands, hearing, measure, motion, row, simulator, system


def circle(speed, rate, seconds, step=0.1):
    """Samples of a robot on a circle from the origin along x."""
    times = [i * step for i in range(round(seconds / step) + 1)]
    radius = speed / rate
    return [
        motion.Sample(t, radius * math.sin(rate * t), radius * (1 - math.cos(rate * t)), 0.0, math.remainder(rate * t, 2 * math.pi), 0.0)
        for t in times
    ]


def test_turns_are_counted_beyond_half_a_turn():
    assert motion.turned(circle(0.5, 1.0, 10.0)) == pytest.approx(10.0)
    assert motion.turned(circle(0.5, -1.0, 10.0)) == pytest.approx(-10.0)


def test_ahead_and_left_go_by_the_robots_own_heading():
    start, end = motion.Sample(0, 1, 1, 0, math.pi / 2, 0), motion.Sample(1, 0.9, 4, 0.2, math.pi / 2, 0.1)
    found = motion.Motion.of([start, end])
    assert (found.ahead, found.left, found.rise, found.tilt) == pytest.approx((3.0, 0.1, 0.2, 0.1))


def test_tilt_is_the_angle_to_the_upward_axis():
    assert motion.sample(0, (0, 0, 0), (math.sin(0.2), 0, 0, math.cos(0.2))).tilt == pytest.approx(0.4)


@pytest.mark.parametrize(
    "angle, lower, upper, target", [(0.0, -1, 1, 0.5), (0.9, -1, 1, 0.4), (0.0, -0.1, 0.3, 0.1), (0.0, None, None, 0.5)]
)
def test_joints_go_where_their_limits_let_them(angle, lower, upper, target):
    assert motion.reachable(angle, 0.5, lower, upper) == pytest.approx(target)


def test_the_command_goes_to_an_input_of_a_multiplexer():
    twist = "geometry_msgs/Twist"
    heard = [("/base/cmd_vel", twist), ("/cmd_vel", twist), ("/joy", "sensor_msgs/Joy"), ("/a", twist)]
    assert commands.choose(heard, ["/cmd_vel"]) == ("/base/cmd_vel", twist)
    assert commands.choose(heard, []) == ("/cmd_vel", twist)
    assert commands.choose(heard, [], "a") == ("/a", twist)


@pytest.mark.parametrize(
    "wanted, words", [("joy", "is of type sensor_msgs/Joy"), ("b", "has no subscriber"), ("", "nobody listens to speeds")]
)
def test_a_topic_that_cannot_be_commanded_is_said(wanted, words):
    with pytest.raises(commands.MeasuringError, match=words):
        commands.choose([("/joy", "sensor_msgs/Joy")], [], wanted)


def test_rates_come_from_stamps():
    assert hearing.rate([0.0, 0.1, 0.1, 0.2], 5.0) == pytest.approx(10.0)
    assert hearing.rate([0.1], 5.0) is None
    assert hearing.rate([0.1, 0.1], 5.0) is None  # the same picture twice


def test_messages_that_nobody_stamped_are_counted_as_they_come():
    assert hearing.rate([0.0] * 100, 5.0) == pytest.approx(20.0)
    assert hearing.rate([], 5.0) is None and hearing.rate([0.0], 5.0) is None


def test_descriptions_tell_limits_and_rates():
    text = """<robot name="r"><joint name="a" type="revolute"><limit lower="-1" upper="2"/></joint><joint name="b"
      type="continuous"><limit effort="1"/></joint><gazebo reference="l"><sensor name="eye"><update_rate>30</update_rate>
      </sensor><sensor name="ear"/></gazebo><gazebo reference="none"><sensor name="gone"><update_rate>9</update_rate>
      </sensor></gazebo><link name="l"/></robot>"""
    assert commands.joint_limits(text) == {"a": (-1, 2)}
    assert commands.nominal_rates(text) == [("eye", 30.0)]


def test_a_blank_picture_is_said():
    blank, half = bytes(12), bytes(6) + b"\xff" * 6
    assert hearing.contents("sensor_msgs/Image", SimpleNamespace(width=2, height=2, data=blank)) == "2x2, one colour"
    assert hearing.contents("sensor_msgs/Image", SimpleNamespace(width=2, height=2, data=half)) == "2x2"


def test_a_row_sets_what_was_done_against_what_was_told():
    still = {"seconds": 60.0, "ahead": 0.0, "left": 2e-5, "turned": 0.0, "rise": 0.0, "tilt": 0.0}
    found = {
        "notes": ["a | b"],
        "drift": still,
        "command": {"kind": "geometry_msgs/Twist"},
        "reach": {"arm": 0.25},
        "straight": {**still, "seconds": 10.0, "ahead": 2.9, "speed": 0.3},
        "turn": {**still, "seconds": 10.0, "turned": 4.8, "rate": 0.5, "speed": 0.0},
    }
    (entry,) = yaml.safe_load(row.row("it", "me/it@1", "roslaunch x", found, 0.0))
    assert entry["straight"].startswith("2.900 of 3.000 m")
    assert entry["turn"].startswith("4.800 of 5.000 rad")
    assert entry["drift in 60 s"] == "2e-05 m, 0 rad"
    assert entry["notes"] == "arm ends 0.250 rad from its goal; a | b"
    assert (entry["robot"], entry["source"], entry["launch"]) == ("it", "me/it@1", "`roslaunch x`")
    assert "sensors" not in entry


def test_cars_are_set_against_their_geometry():
    turn = {"seconds": 10.0, "turned": 3.0, "rate": math.atan(0.325), "speed": 1.0, "ahead": 0.0, "left": 0.0}
    found = {"turn": turn, "command": {"kind": "ackermann_msgs/AckermannDriveStamped"}}
    assert row.turn(found, 1.0).startswith("3.000 of 3.250 rad")
    assert row.turn(found, 0.0).startswith("3.000 rad in 10.0 s at")


def test_errors_of_a_log_are_told_once(tmp_path):
    log = tmp_path / "log"
    log.write_text(
        "[INFO] [1.0]: fine\n\x1b[31m[ERROR] [123.4, 5.0]: no p gain\x1b[0m\n[ERROR] [124.4, 6.0]: no p gain\n"
        "[gazebo-2] process has died [pid 1]\n"
    )
    assert measure.errors(str(log)) == ["no p gain", "[gazebo-2] process has died [pid 1]"]


def test_the_longest_silence_between_commands():
    assert motion.longest_silence([0.0, 0.05, 0.35, 0.4]) == pytest.approx(0.3)
    assert motion.longest_silence([1.0]) == 0.0


def test_a_simulator_may_run_within_a_group():
    services = ["/rosout/get_loggers", "/car/gazebo/get_model_state", "/car/gazebo/spawn_urdf_model"]
    found = simulator.find(services)
    assert found.name("take_picture") == "/car/gazebo/take_picture"
    assert simulator.find([*services, "/gazebo/get_model_state"]).name("pause") == "/gazebo/pause"
    assert simulator.find(["/gazebo/spawn_urdf_model"]) is None


def test_descriptions_are_read_as_tinyxml_reads_them():
    text = "<robot><gazebo>a & b</gazebo><joint name='a' type='revolute'><limit lower='-1' upper='2'/></joint></robot>"
    assert commands.joint_limits(text) == {"a": (-1.0, 2.0)} and commands.nominal_rates(text) == []


def test_a_node_with_an_anonymous_name_is_found_though_the_name_is_made_anew():
    read, running = (rosgraph.names.anonymous_name("rviz") for _ in range(2))
    assert read != running
    assert system.lasting_name("/" + read) == system.lasting_name("/" + running) == "/rviz"
    assert system.lasting_name("/move_group_2_3") == "/move_group_2_3"

"""What both faces of execution hold of trajectories, controllers and plans: cases from what MoveIt 1 does, and from paper."""

import io
import math
import time

import motion
import pytest
import rospy
from geometry_msgs.msg import Quaternion, Transform, Vector3
from moveit_msgs.msg import MoveItErrorCodes, RobotTrajectory
from moveit_ros_planning import _execution
from moveit_ros_planning._execution import Controller, StartTolerance
from trajectory_msgs.msg import JointTrajectoryPoint, MultiDOFJointTrajectoryPoint

_FLAG, _COUNT, _NUMBER = _execution.Kind.FLAG, _execution.Kind.COUNT, _execution.Kind.NUMBER
#: Of MoveIt's TrajectoryExecution-, PlanExecution- and PlanningSceneMonitorDynamicReconfigure.cfg: name, kind, default, bounds, level.
_PARAMETERS = [
    ("execution_duration_monitoring", _FLAG, 1, 0, 1, 1),
    ("allowed_execution_duration_scaling", _NUMBER, 1.1, 1, 10, 2),
    ("allowed_goal_duration_margin", _NUMBER, 0.5, 0.1, 30, 3),
    ("execution_velocity_scaling", _NUMBER, 1, 0.1, 10, 4),
    ("allowed_start_tolerance", _NUMBER, 0.01, 0, math.inf, 5),
    ("wait_for_trajectory_completion", _FLAG, 1, 0, 1, 6),
]
_PLAN = [("max_replan_attempts", _COUNT, 5, 0, 1000, 1), ("record_trajectory_state_frequency", _NUMBER, 0, 0, 1000, 6)]
_SCENE = [
    ("publish_planning_scene", _FLAG, 0, 0, 1, 1),
    ("publish_planning_scene_hz", _NUMBER, 4, 0.1, 100, 2),
    ("publish_geometry_updates", _FLAG, 1, 0, 1, 3),
    ("publish_state_updates", _FLAG, 0, 0, 1, 4),
    ("publish_transforms_updates", _FLAG, 0, 0, 1, 5),
]


@pytest.mark.parametrize(
    "rows, wanted", [(_execution.parameters(), _PARAMETERS), (_execution.plan_parameters(), _PLAN), (_execution.scene_parameters(), _SCENE)]
)
def test_parameters_are_those_of_upstream_in_its_order(rows, wanted):
    assert [(each.name, each.kind, each.value, each.low, each.high, each.level) for each in rows] == wanted
    assert all(each.description for each in rows)


@pytest.mark.parametrize("name, _kind, own, low, high, _level", [row for row in _PARAMETERS if row[1] == _NUMBER])
def test_a_parameter_outside_its_bounds_is_the_bound_beside_it(name, _kind, own, low, high, _level):
    (parameter,) = (each for each in _execution.parameters() if each.name == name)
    assert parameter.within(low - 5) == low == parameter.within(-math.inf)
    assert parameter.within(math.inf) == high and parameter.within(low + 1) == low + 1
    assert parameter.within(math.nan) == own


@pytest.mark.parametrize(
    "known, stamp, now, wanted",
    [
        (10.0, 10.0, 10.0, "NEWS"),  # two messages of one moment, each with a part of the joints
        (10.0, 10.1, 10.1, "NEWS"),
        (10.0, 9.9, 10.0, "REPEATED"),
        (10.0, 2.0, 10.1, "REPEATED"),  # somebody's old state beside a robot that is heard of
        (10.0, 0.01, 0.02, "JUMPED_BACK"),  # the simulation was reset
        (0.4, 0.01, 0.02, "REPEATED"),  # so short ago that it comes by itself
        (1000.0, 900.0, 1.7e9, "JUMPED_BACK"),  # a bag without a clock that begins again
        (1000.0, 999.7, 1.7e9, "REPEATED"),  # two nodes in one bag
    ],
)
def test_a_stamp_of_before_is_a_repetition_or_time_that_jumped_back(known, stamp, now, wanted):
    assert _execution.stamp_order(known, stamp, now) == getattr(_execution.StampOrder, wanted)


_JOINTS = (
    ("lift", "prismatic", '<limit lower="0" upper="0.4" velocity="1" effort="9"/>'),
    ("elbow", "revolute", '<limit lower="-1" upper="1" velocity="1" effort="9"/>'),
    ("wheel", "continuous", ""),
    ("finger", "revolute", '<limit lower="0" upper="1" velocity="1" effort="9"/><mimic joint="elbow"/>'),
    ("bolt", "fixed", ""),
)
_SRDF = """<robot name="crane">
<virtual_joint name="base" type="floating" parent_frame="odom" child_link="base_link"/>
<group name="arm"><joint name="lift"/><joint name="elbow"/><joint name="wheel"/></group></robot>"""


def _urdf() -> str:
    parts, parent = ['<link name="base_link"/>'], "base_link"
    for name, kind, more in _JOINTS:
        link = name + "_link"
        parts.append(
            f'<link name="{link}"/><joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{link}"/>'
            f'<axis xyz="0 0 1"/>{more}</joint>'
        )
        parent = link
    return f'<robot name="crane">{"".join(parts)}</robot>'


@pytest.fixture(scope="module")
def robot():
    return motion.load_model(_urdf(), _SRDF)


def trajectory(names=("elbow",), points=((0.0, [0.0]),), **fields) -> RobotTrajectory:
    """A message of points (s, positions[, velocities]); ``fields`` of each point besides."""
    message = RobotTrajectory()
    message.joint_trajectory.joint_names = list(names)
    for seconds, positions, *velocities in points:
        point = JointTrajectoryPoint(positions=positions, time_from_start=rospy.Duration.from_sec(seconds), **fields)
        point.velocities = velocities[0] if velocities else []
        message.joint_trajectory.points.append(point)
    return message


def base_at(xyz=(0.0, 0.0, 0.0), yaw=0.0, count=1) -> RobotTrajectory:
    message = RobotTrajectory()
    message.multi_dof_joint_trajectory.joint_names = ["base"]
    place = Transform(Vector3(*xyz), Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2)))
    message.multi_dof_joint_trajectory.points = [
        MultiDOFJointTrajectoryPoint(transforms=[place] * count, time_from_start=rospy.Duration(1))
    ]
    return message


def read(message: RobotTrajectory) -> _execution.Trajectory:
    buffer = io.BytesIO()
    message.serialize(buffer)
    return _execution.Trajectory(buffer.getvalue())


def written(part: _execution.Trajectory) -> RobotTrajectory:
    return RobotTrajectory().deserialize(part.bytes())


# ------------------------------------------------------------------ trajectories

_NAN, _INF = math.nan, math.inf


@pytest.mark.parametrize(
    "message, words",
    [
        (trajectory(points=[(0.0, [0.1]), (1.0, [0.2])]), ""),
        (trajectory(), ""),
        (RobotTrajectory(), ""),
        (base_at(), ""),
        (trajectory(names=["nose"]), "moves joint 'nose', which the robot 'crane' does not have"),
        (trajectory(points=[(0.0, [])]), "point 0 has 0 positions for 1 joints"),
        (trajectory(points=[(0.0, [0.1]), (1.0, [0.2, 0.3])]), "point 1 has 2 positions for 1 joints"),
        (trajectory(points=[(0.0, [0.1], [0.1, 0.1])]), "point 0 has 2 velocities for 1 joints"),
        (trajectory(accelerations=[1.0, 2.0]), "point 0 has 2 accelerations for 1 joints"),
        (trajectory(effort=[1.0, 2.0]), "point 0 has 2 effort for 1 joints"),
        (trajectory(points=[(0.0, [_NAN])]), "point 0 holds a number that is not finite"),
        (trajectory(points=[(0.0, [0.1]), (1.0, [0.2], [_INF])]), "point 1 holds a number that is not finite"),
        (trajectory(points=[(0.0, [0.1]), (0.0, [0.2])]), "point 1 comes at 0 s, not after the one before"),
        (trajectory(points=[(2.0, [0.1]), (1.5, [0.2])]), "point 1 comes at 1.5 s, not after the one before"),
        (trajectory(points=[(-1.0, [0.1])]), "point 0 comes at -1 s"),
        (base_at(count=2), "point 0 has 2 transforms for 1 joints"),
        (base_at(xyz=(0.0, _NAN, 0.0)), "point 0 holds a number that is not finite"),
    ],
)
def test_the_first_fault_of_a_trajectory_is_one_line(robot, message, words):
    fault = read(message).fault(robot)
    assert words in fault and bool(words) == bool(fault) and "\n" not in fault


def test_a_trajectory_takes_no_time_when_it_ends_at_once():
    later = trajectory()
    later.joint_trajectory.header.stamp = rospy.Time(7)  # it is to begin then
    assert [read(message).takes_no_time for message in (RobotTrajectory(), trajectory(), later)] == [True, True, False]
    assert not read(trajectory(points=[(0.5, [0.0])])).takes_no_time
    assert not read(base_at()).takes_no_time and read(base_at()).duration == 1.0


@pytest.mark.parametrize(
    "stamp, now, scaling, margin, seconds",
    [(0, 100, 1.0, 0.0, 4.0), (0, 100, 1.1, 0.5, 4.9), (103, 100, 1.0, 0.0, 7.0), (103, 100, 2.0, 1.0, 15.0), (90, 100, 1.0, 0.0, 4.0)],
)
def test_a_controller_may_take_the_delay_and_the_duration_scaled_and_the_margin(stamp, now, scaling, margin, seconds):
    message = trajectory(points=[(0.0, [0.0]), (4.0, [0.1])])
    message.joint_trajectory.header.stamp = rospy.Time(stamp)
    assert read(message).allowed_duration(now=now, scaling=scaling, margin=margin) == pytest.approx(seconds, abs=1e-9)


# ------------------------------------------------------------------ controllers


def test_fixed_mimic_and_unknown_joints_need_no_controller(robot):
    names = ["lift", "elbow", "wheel", "finger", "bolt", "base", "nose"]
    assert _execution.actuated(names, robot) == {"lift", "elbow", "wheel", "base"}


def _controllers(**joints) -> list[Controller]:
    """name="a b": idle; "*a": preferred; "!a": active."""
    return [Controller(name, set(text.strip("*!").split()), active="!" in text, preferred="*" in text) for name, text in joints.items()]


@pytest.mark.parametrize(
    "wanted, controllers, managed, unmanaged",
    [
        ("a", {}, [], []),
        ("a", {"x": "b"}, [], []),
        ("a b", {"x": "a"}, [], []),
        ("a b", {"x": "a", "y": "b"}, ["x", "y"], ["x", "y"]),
        ("a b", {"x": "a", "y": "b", "z": "a b"}, ["z"], ["z"]),  # as few as possible
        ("a b", {"x": "a b", "y": "b c"}, ["x"], ["x"]),
        ("a b c", {"x": "a b", "y": "b c"}, [], []),  # no joint twice
        ("a", {"x": "a", "y": "*a b c"}, ["y"], ["y"]),  # default ones first
        ("a", {"x": "a b", "y": "a"}, ["y"], ["y"]),  # then those with few joints
        ("a", {"x": "a", "y": "!a"}, ["y"], ["y"]),  # then those that are active
        ("a", {"y": "a", "x": "a"}, ["x"], ["x"]),
        # Who may not switch takes what is active, though there is a default one, though they are more.
        ("a", {"x": "*a", "y": "!a b"}, ["x"], ["y"]),
        ("a b", {"x": "a b", "y": "!a", "z": "!b"}, ["x"], ["y", "z"]),
        ("a b", {"x": "a b", "y": "!a", "z": "b"}, ["x"], ["x"]),  # half of it is of no use
        # Two arms, each with two ways.
        ("a b", {"p": "a", "q": "!*a", "r": "b", "s": "*b"}, ["q", "s"], ["q", "s"]),
        # A joint that is not wanted is still nobody's twice.
        ("a b", {"x": "a c", "y": "b c"}, [], []),
        ("a b", {"x": "a c", "y": "b c", "z": "b"}, ["x", "z"], ["x", "z"]),
    ],
)
def test_controllers_are_chosen_as_upstream_chooses_them(wanted, controllers, managed, unmanaged):
    known = _controllers(**controllers)
    assert _execution.choose(set(wanted.split()), known, manage=True) == managed
    assert _execution.choose(set(wanted.split()), known, manage=False) == unmanaged


def test_a_robot_of_many_controllers_does_not_wait_for_all_their_combinations():
    """40 joints with two controllers each have 2^40 combinations."""
    joints = [f"j{number}" for number in range(40)]
    known = [Controller(kind + joint, {joint}, preferred=kind == "p") for joint in joints for kind in "pv"]
    start = time.process_time()
    assert _execution.choose(set(joints), known, manage=True) == sorted("p" + joint for joint in joints)
    assert time.process_time() - start < 1.0


def test_a_share_has_its_joints_in_alphabetical_order_and_scaled_velocities():
    whole = trajectory(["wheel", "elbow", "lift"], [(1.0, [1.0, 2.0, 3.0], [10.0, 20.0, 30.0])], effort=[7.0, 8.0, 9.0])
    part = written(read(whole).share({"wheel", "elbow", "nose"}, 0.5)).joint_trajectory
    point = part.points[0]
    assert part.joint_names == ["elbow", "wheel"]
    assert (list(point.positions), list(point.velocities)) == ([2.0, 1.0], [10.0, 5.0])
    assert (list(point.accelerations), list(point.effort)) == ([], [8.0, 7.0])
    assert point.time_from_start == rospy.Duration(1)
    assert written(read(whole).share({"nose"})) == RobotTrajectory()
    base = written(read(base_at(yaw=0.5)).share({"base"})).multi_dof_joint_trajectory
    assert base.joint_names == ["base"] and base.points[0].transforms[0].rotation.z == pytest.approx(math.sin(0.25))


# ------------------------------------------------------------------ where the robot is


@pytest.mark.parametrize(
    "joint, starts, is_at, off",
    [
        ("elbow", 0.5, 0.5, None),
        ("elbow", 0.5, 0.509, None),
        ("elbow", 0.5, 0.52, 0.02),
        ("elbow", 1.0, 1.05, None),  # pressed beyond its stop: compared on it, as upstream does
        ("elbow", 1.0, 0.95, 0.05),
        ("lift", 0.0, -0.03, None),
        ("wheel", math.pi - 0.001, -math.pi + 0.001, None),  # a turn further is the same place
        ("wheel", 0.0, 4 * math.pi + 0.3, 0.3),
    ],
)
def test_a_trajectory_starts_where_the_robot_is(robot, joint, starts, is_at, off):
    state = motion.RobotState(robot)
    state.set(joint, is_at)
    line = read(trajectory([joint], [(0.0, [starts])])).start_deviation(state, StartTolerance(0.01))
    assert bool(line) == (off is not None)
    if off is not None:
        assert f"joint '{joint}' is {off:.4f} off" in line and "more than 0.01" in line
    own = StartTolerance(0.01, {joint: 1.0})
    assert not read(trajectory([joint], [(0.0, [starts])])).start_deviation(state, own)
    assert not read(trajectory([joint], [(0.0, [starts])])).start_deviation(state, StartTolerance(0.0))


@pytest.mark.parametrize(
    "place, words",
    [
        ({}, ""),
        ({"xyz": (0.005, 0.0, -0.005), "yaw": 0.005}, ""),
        ({"xyz": (0.0, 0.02, 0.0)}, "joint 'base' is 0.0200 m off"),
        ({"xyz": (0.0, -0.02, 0.0)}, "joint 'base' is 0.0200 m off"),  # upstream lets the robot stand behind
        ({"yaw": 0.1}, "joint 'base' is 0.1000 rad off"),
        ({"yaw": -0.1}, "joint 'base' is 0.1000 rad off"),
        ({"yaw": 2 * math.pi}, ""),
    ],
)
def test_a_base_starts_where_it_is_by_each_coordinate_and_by_the_angle(robot, place, words):
    line = read(base_at(**place)).start_deviation(motion.RobotState(robot), StartTolerance(0.01))
    assert words in line and bool(words) == bool(line)


def test_a_robot_rests_when_no_joint_moves_by_more_than_its_tolerance(robot):
    before, now = motion.RobotState(robot), motion.RobotState(robot)
    now.set("elbow", 0.008)
    joints = ["lift", "elbow"]
    assert not _execution.moved(joints, before, now, StartTolerance(0.01))
    assert _execution.moved(joints, before, now, StartTolerance(0.01), part=0.1)
    assert _execution.moved(joints, before, now, StartTolerance(0.01, {"elbow": 0.001}))
    assert not _execution.moved(joints, before, now, StartTolerance(0.001, {"elbow": 0.0}))  # 0: is not looked at
    assert not _execution.moved(["lift"], before, now, StartTolerance(0.001))


# ------------------------------------------------------------------ plans


def test_another_plan_is_tried_after_what_it_may_mend():
    codes = MoveItErrorCodes
    again = {
        name: (_execution.may_plan_again(getattr(codes, name)), _execution.waits_before_planning(getattr(codes, name)))
        for name in dir(codes)
        if name.isupper()
    }
    assert {name for name, (may, _waits) in again.items() if may} == {
        "PLANNING_FAILED",
        "INVALID_MOTION_PLAN",
        "UNABLE_TO_AQUIRE_SENSOR_DATA",
        "MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE",
    }
    assert {name for name, (_may, waits) in again.items() if waits} == {
        "UNABLE_TO_AQUIRE_SENSOR_DATA",
        "MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE",
    }


@pytest.mark.parametrize(
    "groups, befores",
    [
        (["arm"], [-1]),
        (["arm", "arm", "arm"], [-1, 0, 1]),
        (["arm", "hand", "arm"], [-1, 0, 0]),  # the hand's plan knows nothing of where the arm has gone
        (["arm", None, "arm"], [-1, 0, 0]),
        ([None, "arm"], [-1, -1]),
        (["arm", "hand", "both"], [-1, 0, 1]),
    ],
)
def test_continuous_joints_go_on_from_the_trajectory_of_their_group(groups, befores):
    assert [_execution.goes_on_from(groups, index) for index in range(len(groups))] == befores


def _turned(robot, elbow: float, *bodies: str):
    state = motion.RobotState(robot)
    state.set("elbow", elbow)
    for name in bodies:
        state.attach(motion.AttachedBody(name, "elbow_link", [motion.Box(0.1, 0.1, 0.1)]))
    return state


@pytest.mark.parametrize(
    "expected, seen",
    [(0, [0, 1, 2, 3]), (1, [0, 1, 2, 3]), (3, [2, 3]), (4, [3]), (-1, [0, 1, 2, 3]), (9, [])],
    ids=["start", "leaving_the_first", "on_its_way", "reached", "not_begun", "gone"],
)
def test_a_path_is_looked_at_from_the_way_point_that_is_being_left(robot, expected, seen):
    looked = []

    def valid(state) -> bool:
        looked.append(round(state.get("elbow") * 10))
        return True

    def way_point(index: int):
        return _turned(robot, index / 10)

    assert _execution.first_invalid(4, expected, way_point, _turned(robot, 0), valid) == -1
    assert looked == seen


def test_the_first_way_point_that_is_not_valid_is_told_and_none_after_it_looked_at(robot):
    looked = []

    def valid(state) -> bool:
        looked.append(state.get("elbow"))
        return state.get("elbow") < 0.15

    assert _execution.first_invalid(4, 0, lambda index: _turned(robot, index / 10), _turned(robot, 0), valid) == 2
    assert looked == pytest.approx([0, 0.1, 0.2])


def test_a_path_is_looked_at_with_what_is_attached_now(robot):
    """What was put down since the plan was made does not count any more, what was grasped since does."""
    carried = []

    def valid(state) -> bool:
        carried.append({body.id for body in state.attached})
        return True

    assert (
        _execution.first_invalid(2, 0, lambda index: _turned(robot, 0, "put_down", "kept"), _turned(robot, 0, "kept", "grasped"), valid)
        == -1
    )
    assert carried == [{"kept", "grasped"}] * 2


def test_a_test_of_states_that_fails_is_not_swallowed(robot):
    def valid(_state) -> bool:
        raise KeyError("scene")

    with pytest.raises(KeyError, match="scene"):
        _execution.first_invalid(1, 0, lambda index: _turned(robot, 0), _turned(robot, 0), valid)

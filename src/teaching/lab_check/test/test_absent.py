"""Marks for what is not there: from the start, not any more, another thing of the same name in its place, and nodes that have ended."""

import pytest
from lab_check.check import check
from lab_check.isolation import sandbox
from lab_check.specs import spec
from teachers import CMAKE, MANIFEST

pytestmark = pytest.mark.slow

INERTIAL = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
SHAPE = "<collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>"
ARM = (
    f"<robot name='arm'><link name='base'>{INERTIAL}{SHAPE}</link><link name='l0'>{INERTIAL}</link><joint name='j0' type='revolute'>"
    "<parent link='base'/><child link='l0'/><axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='10' velocity='5'/></joint>"
    "<gazebo><plugin name='s' filename='libgazebo_ros_joint_state_publisher.so'><jointName>j0</jointName>"
    "<updateRate>20</updateRate></plugin></gazebo></robot>"
)
BLOCK = f"<robot name='block'><link name='base'>{INERTIAL}{SHAPE}</link></robot>"
LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <param name="robot_description" textfile="$(find my_robot)/arm.urdf"/>
  <param name="block" textfile="$(find my_robot)/block.urdf"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model arm -z 0.5"/>
  <node name="other" pkg="gazebo_ros" type="spawn_model" args="-urdf -param block -model block -x 2 -z 0.05"/>
</launch>
"""
NODE = """#!/usr/bin/env python3
import os, signal, sys
import rospy
from gazebo_msgs.srv import DeleteModel, SpawnModel
from geometry_msgs.msg import Pose, Quaternion, Point
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool
rospy.init_node("evil")
what = sys.argv[1]
if what in ("takes_away", "replaces"):
    rospy.sleep(0.3)
    rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("arm")
if what == "replaces":
    put = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)
    put("arm", rospy.get_param("robot_description"), "", Pose(Point(0, 0, 0.5), Quaternion(0, 0, 0, 1)), "world")
if what == "dies":
    rospy.Publisher("dead_topic", String, queue_size=1)
    rospy.Subscriber("dead_ears", String, lambda message: None)
    rospy.Service("dead_service", SetBool, lambda request: None)
    rospy.sleep(0.2)
    os.kill(os.getpid(), signal.SIGKILL)
if what == "dies_of_a_question":
    rospy.Service("mortal", SetBool, lambda request: os.kill(os.getpid(), signal.SIGKILL))
if what == "tells_states":
    bare, silent, frozen = (rospy.Publisher(name, JointState, queue_size=10) for name in ("bare", "silent", "frozen"))
    rate = rospy.Rate(20)
    rate.sleep()  # until the clock has come
    end = rospy.get_time() + 1.0
    while not rospy.is_shutdown():
        now = rospy.Time.now()
        message = JointState(name=["j0"], position=[0.0], velocity=[0.0])
        message.header.stamp = now
        bare.publish(message)
        message.effort = [0.0]
        if now.to_sec() < end:
            silent.publish(message)
        message.header.stamp = rospy.Time(1)
        frozen.publish(message)
        rate.sleep()
rospy.spin()
"""
HEAD = """\
title: What is not there
packages: [my_robot]
launch: my_robot a.launch
quantum: 0.05
ready: {models: [arm, block], topics: [/joint_states], at: 2, timeout: 100}
"""


@pytest.fixture(scope="module", autouse=True)
def namespaces():
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))


def verdicts(tmp_path, tasks, more=()):
    """Of each task, by its name, [passed, reason] of each expectation."""
    package = tmp_path / "mallory" / "my_robot"
    package.mkdir(parents=True)
    texts = {
        "package.xml": MANIFEST.format("my_robot", ""),
        "CMakeLists.txt": CMAKE.format("my_robot"),
        "arm.urdf": ARM,
        "block.urdf": BLOCK,
        "a.launch": LAUNCH,
        "evil.py": NODE,
        **dict(more),
    }
    for name, text in texts.items():
        (package / name).write_text(text)
        (package / name).chmod(0o755)
    lines = [HEAD + "tasks:"]
    for name, (commands, expected) in tasks.items():
        lines += [f"  - name: {name}", "    points: 1", "    model: arm", "    film: false"]
        lines += ["    do:", *(f"      - {line}" for line in commands)] if commands else []
        lines += ["    expect:", *(f"      - {line}" for line in expected)]
    (tmp_path / "spec.yaml").write_text("\n".join(lines))
    result = check(spec.load(tmp_path / "spec.yaml"), tmp_path / "mallory", tmp_path / "out", films=False)
    assert not result.fault, result.fault
    return {task.name: [(v.passed, v.reason) for v in task.verdicts] for task in result.tasks if task.name in tasks}, result


WATCHED = {
    "still: {joints: [j0], for: 1}": "the joint 'j0' was %s",
    "no_collision: {model: arm, allow: [ground_plane], for: 1}": "'arm' was %s",
    "no_collision: {model: 'arm::base', for: 1}": "'arm::base' was %s",
    "distance: {from: arm, to: block, least: 0.1, for: 1}": "'arm' was %s",
    "distance: {from: 'arm::base', to: block, most: 10, for: 1}": "'arm::base' was %s",
    "moved: {by: [0, 10], within: 1}": "'arm' was %s",
    "moved: {turned: [-1, 1], within: 1}": "'arm' was %s",
    "path: {points: [[9, 9]], tolerance: 0.1, within: 1}": "'arm' was %s",
    "joint: {name: j0, value: 0, tolerance: 3, within: 1, hold: 0.8}": "",
}


def run(what, more=""):
    return f"run: {{command: my_robot evil.py {what}, name: evil{more}}}"


def test_nothing_is_told_of_what_was_taken_away_or_replaced(tmp_path):
    found, result = verdicts(
        tmp_path,
        {
            "untouched": ([], [line for line in WATCHED if "path" not in line]),
            "replaced": ([run("replaces")], list(WATCHED)),
            "taken away": ([run("takes_away")], [*WATCHED, "moved: {to: [0, 0], tolerance: 10, within: 1}"]),
            "gone": (
                [],
                [
                    "no_collision: {model: arm}",
                    "still: {joints: [j0]}",
                    "distance: {from: arm, to: block}",
                    "distance: {from: block, to: arm}",
                ],
            ),
        },
    )
    assert all(passed for passed, _ in found["untouched"]), found["untouched"]
    for task, word in (("replaced", "replaced by another of its name by"), ("taken away", "gone at")):
        for (passed, reason), (line, words) in zip(found[task], WATCHED.items()):
            if line.startswith("joint"):  # the new one holds still, too, and is another: noted
                continue
            assert not passed and words % word in reason, (task, line, reason)
    assert "'arm' was gone at" in found["taken away"][-1][1] and not found["taken away"][-1][0]
    assert not found["taken away"][-2][0] and "it was gone at" in found["taken away"][-2][1], found["taken away"][-2]
    assert any("the model with the joint j0 was replaced by" in note for note in result.notes), result.notes
    assert not any(passed for passed, _ in found["gone"]), found["gone"]


GHOSTS = {
    "no_collision: {model: robot, for: 0.5}": "there is no model 'robot' in the simulator (there are: ",
    "no_collision: {model: 'arm::hand', for: 0.5}": "there is no model 'arm::hand'",
    "no_collision: {model: robot}": "there is no model 'robot'",
    "still: {joints: [j0, j9]}": "has a joint 'j9'",
    "distance: {from: robot, to: arm, least: 0}": "there is no 'robot'",
    "distance: {from: arm, to: 'arm::hand', most: 9}": "there is no 'arm::hand'",
    "moved: {model: robot, by: [0, 9]}": "there is no 'robot'",
    "moved: {model: robot, to: [0, 0], tolerance: 9}": "there is no 'robot'",
    "path: {model: robot, points: [[0, 0]], tolerance: 9, within: 0.2}": "there is no 'robot'",
    "odometry: {topic: /odom, tolerance: 9}": "nobody publishes /odom",
    "energy: {topic: /no_states, most: 9, for: 0.2}": "nobody publishes /no_states",
    "joint: {name: j9, value: 0, tolerance: 9, within: 0.2}": "has a joint 'j9'",
    "topic: {name: /nothing, latched: false, within: 0.2}": "no topic that anybody publishes: /nothing",
    "topic: {name: /nothing, rate: [0, 9], within: 0.2}": "no topic that anybody publishes: /nothing",
    "topic: {name: '/noth*', rate: [0, 9], within: 0.2}": "no topic fits",
    "controllers: {types: {'*': effort_controllers/JointPositionController}, within: 0.2}": "there is no controller manager",
    "image: {topic: /eye, within: 0.2}": "nobody publishes /eye",
    "service: {name: /nothing, within: 0.2}": "no service /nothing",
    "node: {name: /nothing, within: 0.2}": "no node /nothing",
}
ENDED = {
    "node: {name: /evil, within: 0.5}": "the node /evil has ended",
    "topic: {name: /dead_topic, within: 0.5}": "the node /evil, which publishes /dead_topic, has ended",
    "topic: {name: /dead_ears, subscribed: true, within: 0.5}": "the node /evil, which listens to /dead_ears, has ended",
    "service: {name: /dead_service, within: 0.5}": "service /dead_service does not answer",
}
STATES = {
    "energy: {topic: /bare, most: 9, for: 3}": "tell no efforts with velocities",
    "energy: {topic: /joint_states, most: 9, for: 1}": "tell no efforts with velocities",  # Gazebo's joint state publisher tells none
    "energy: {topic: /silent, most: 9, for: 3}": "no joint states came on /silent from",
    "energy: {topic: /frozen, most: 9, for: 3}": "do not go on with the time",
}


def test_what_never_was_or_has_ended_earns_nothing(tmp_path):
    tasks = {
        "ghosts": ([], list(GHOSTS)),
        "ended": ([run("dies", ", wait: 2")], list(ENDED)),
        "no answer": (
            [run("dies_of_a_question"), "call: {service: /mortal, request: {data: true}, name: q}"],
            ["answer: {call: q, refused: true}", "answer: {call: q}"],
        ),
        "states": ([run("tells_states")], list(STATES)),
    }
    found, _ = verdicts(tmp_path, tasks)
    for task, expected in (("ghosts", GHOSTS), ("ended", ENDED), ("states", STATES)):
        for (passed, reason), words in zip(found[task], expected.values()):
            assert not passed and words in reason, (task, words, reason)
    assert [passed for passed, _ in found["no answer"]] == [False, False] and "no answer came" in found["no answer"][0][1], found[
        "no answer"
    ]

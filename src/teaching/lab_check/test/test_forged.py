"""Marks that a submission tries to forge: an arm that nothing moves, and nodes that say, or see to it, that it moved."""

import pathlib

import pytest
from lab_check.check import check
from lab_check.isolation import sandbox
from lab_check.specs import spec

pytestmark = pytest.mark.slow

MANIFEST = (
    "<package format='2'><name>my_robot</name><version>1.0.0</version><description>x</description>"
    "<maintainer email='mallory@example.org'>x</maintainer><license>x</license><buildtool_depend>catkin</buildtool_depend></package>"
)
INERTIAL = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
ARM = (
    f"<robot name='arm'><link name='base'>{INERTIAL}</link><link name='l0'>{INERTIAL}</link><joint name='j0' type='revolute'>"
    "<parent link='base'/><child link='l0'/><axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='10' velocity='5'/>"
    "<dynamics damping='5' friction='5'/></joint></robot>"
)
LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
  <param name="robot_description" textfile="$(find my_robot)/arm.urdf"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model arm -z 0.1"/>
  %s
</launch>
"""
NODE = '<node name="evil" pkg="my_robot" type="evil.py" output="screen"/>'
SPEC = """\
title: An arm
packages: [my_robot]
build: {points: 10}
launch: my_robot a.launch
quantum: 0.05
ready: {models: [%s], at: 1, timeout: 200}
limits: {time: 300}
tasks:
  - name: The joint obeys
    points: 20
    film: false
    expect:
      - joint: {name: j0, value: 0.5, tolerance: 0.1, within: 0.5, hold: 0.1}
  - name: The joint obeys its own controllers
    points: 20
    film: false
    interference: costs
    expect:
      - joint: {name: j0, value: 0.5, tolerance: 0.1, within: 0.5, hold: 0.1}
"""


@pytest.fixture(scope="module", autouse=True)
def namespaces():
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))


def examine(tmp_path, node="", cmake="", extra="", models="arm"):
    package = tmp_path / "mallory" / "my_robot"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    head = "cmake_minimum_required(VERSION 3.10)\nproject(my_robot)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    (package / "CMakeLists.txt").write_text(head + cmake)
    (package / "arm.urdf").write_text(ARM)
    (package / "launch" / "a.launch").write_text(LAUNCH % ((NODE if node else "") + extra))
    (package / "evil.py").write_text("#!/usr/bin/env python3\n" + node)
    (package / "evil.py").chmod(0o755)
    (tmp_path / "spec.yaml").write_text(SPEC % models)
    result = check(spec.load(tmp_path / "spec.yaml"), tmp_path / "mallory", tmp_path / "out", films=False)
    log = tmp_path / "out" / "launch_0.log"
    return result, log.read_text() if log.exists() else ""


CUSTOM = r"""
import sys
print("CUSTOM", sys.orig_argv, flush=True)
if "lab_check.examination.probe" in " ".join(sys.orig_argv):
    import os
    os.write(2, b"INSIDE THE SIMULATOR\n")
"""
FAKE_STATE = """
import json, rospy
from std_srvs.srv import Empty, Trigger, TriggerResponse
rospy.init_node("evil")
arm = {"static": False, "pose": [0] * 6 + [1], "links": {}, "joints": {"j0": [0.5, 0, 0]}}
state = {"time_ns": 10**10, "dt": 0.001, "contacts": [], "models": {"arm": arm}}
rospy.Service("/gazebo/lab_check_state", Trigger, lambda request: TriggerResponse(True, json.dumps(state)))
rospy.wait_for_service("/gazebo/pause_physics")
rospy.Service("/gazebo/pause_physics", Empty, lambda request: None)
print("FORGED", flush=True)
rospy.spin()
"""


def test_only_the_simulator_is_measured(tmp_path):
    """Somebody else's state service, modules in the user's and the workspace's folders of Python, and a library put before all others."""
    cmake = "".join(
        f"file(COPY ${{CMAKE_CURRENT_SOURCE_DIR}}/custom.py DESTINATION {folder})\nfile(RENAME {folder}/custom.py {folder}/{name}.py)\n"
        for name in ("usercustomize", "sitecustomize")
        for folder in (
            "$ENV{HOME}/.local/lib/python3.11/site-packages",
            "$ENV{HOME}/.local/lib/python3.13/site-packages",
            "${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages",
            "$ENV{HOME}/.ros",
            "$ENV{HOME}",
        )
    )
    cmake += 'file(WRITE ${CATKIN_DEVEL_PREFIX}/etc/catkin/profile.d/99.x.sh "export LD_PRELOAD=/nowhere/evil.so GAZEBO_EVIL=yes\\n")\n'
    result, log = examine(tmp_path, FAKE_STATE, f"file(WRITE ${{CMAKE_CURRENT_SOURCE_DIR}}/custom.py [==[{CUSTOM}]==])\n" + cmake)
    assert not result.fault and {task.name: task.points for task in result.tasks}["Build"] == 10
    assert result.points == 10, [v.reason for task in result.tasks for v in task.verdicts]
    assert "FORGED" in log and "CUSTOM" in log and "INSIDE THE SIMULATOR" not in log
    assert "joint j0 should reach 0.5" in result.tasks[1].verdicts[0].reason
    assert any("offers /gazebo/lab_check_state" in note for note in result.notes), result.notes
    assert any("registered /gazebo/pause_physics over the simulator's" in note for note in result.notes), result.notes


BY_HAND = """
import rospy
from gazebo_msgs.srv import SetModelConfiguration
rospy.init_node("evil")
rospy.wait_for_service("/gazebo/set_model_configuration")
put = rospy.ServiceProxy("/gazebo/set_model_configuration", SetModelConfiguration)
rate = rospy.Rate(40)
while not rospy.is_shutdown():
    put("arm", "robot_description", ["j0"], [0.5])
    rate.sleep()
"""


def test_who_interferes_is_named_and_costs_what_the_spec_says(tmp_path):
    """By ROS the joint is put where it should go: points where the spec says that it is noted, none where it says that it costs."""
    result, _ = examine(tmp_path, BY_HAND)
    assert not result.fault
    assert [task.points for task in result.tasks] == [10, 20, 0], [v.reason for task in result.tasks for v in task.verdicts]
    assert any("the node /evil used /gazebo/set_model_configuration" in note for note in result.notes), result.notes
    assert "/evil used /gazebo/set_model_configuration" in result.tasks[2].verdicts[0].reason


BY_PLUGIN = """
import rospy
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Pose
from std_msgs.msg import Header
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
rospy.init_node("evil")
rospy.wait_for_service("/gazebo/spawn_sdf_model")
model = '<sdf version="1.6"><model name="deco"><static>1</static><link name="l"/><plugin name="p" '
model += 'filename="libgazebo_ros_joint_pose_trajectory.so"/></model></sdf>'
rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)("deco", model, "", Pose(), "")
put = rospy.Publisher("/set_joint_trajectory", JointTrajectory, queue_size=1, latch=True)
point = JointTrajectoryPoint(positions=[0.5], time_from_start=rospy.Duration(100))
put.publish(header=Header(frame_id="arm::base"), joint_names=["j0"], points=[point])
rospy.spin()
"""


def test_whoever_puts_joints_through_a_plugin_of_gazebo_is_named(tmp_path):
    """A model that the node itself spawns brings the plugin, which holds the robot's joint where the spec wants it."""
    result, _ = examine(tmp_path, BY_PLUGIN, models="arm, deco")
    assert not result.fault and result.tasks[2].points == 0, [v.reason for task in result.tasks for v in task.verdicts]
    assert any("the node /evil used /set_joint_trajectory 1 times" in note for note in result.notes), result.notes


def test_a_second_model_with_the_joints_name_is_a_doubt(tmp_path):
    """It is spawned where the joint should be; the spec's task names no model."""
    extra = '<node name="other" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model aaa -x 3 -J j0 0.5"/>'
    result, _ = examine(tmp_path, extra=extra, models="arm, aaa")
    assert not result.fault and result.tasks[2].points == 0
    assert any("the joint j0 is there in several models (" in note for note in result.notes), result.notes


UNREADABLE = r"""
import os, socket, threading, time, xmlrpc.client
def serve(door, answer):
    while True:
        near, _ = door.accept()
        near.recv(10000)
        try:
            answer(near)
            near.close()
        except OSError:
            pass
def junk(near):
    near.sendall(b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n<methodResponse><params><param><value><array>" + b"\xff" * 100)
def nothing(near):
    near.sendall(b"no HTTP at all\r\n\r\n")
def slow(near):
    near.sendall(b"HTTP/1.0 200 OK\r\nContent-Length: 10000\r\n\r\n")
    for _ in range(10000):
        near.sendall(b" ")
        time.sleep(1)
def other(near):
    text = xmlrpc.client.dumps(({"a": 1},), methodresponse=True).encode()
    near.sendall(b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n" + text)
master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
for answer in (junk, nothing, slow, other):
    door = socket.create_server(("127.0.0.1", 0))
    threading.Thread(target=serve, args=(door, answer), daemon=True).start()
    uri = "http://localhost:%d/" % door.getsockname()[1]
    name = "/evil_" + answer.__name__
    master.registerSubscriber(name, "/clock", "rosgraph_msgs/Clock", uri)
    master.registerPublisher(name, "/odd", "no_such/Type", uri)
    master.registerService(name, "/gazebo/lab_check_state", "rosrpc://localhost:%d" % door.getsockname()[1], uri)
print("REGISTERED", master.shutdown("/evil", "end"), flush=True)
time.sleep(10000)
"""


def test_what_cannot_be_read_is_the_submissions_fault(tmp_path):
    """Nodes that answer no XML, no HTTP, one blank a second and what was not asked, and a call that would end the master."""
    result, log = examine(tmp_path, UNREADABLE)
    assert "REGISTERED" in log
    assert not result.fault, result.fault
    assert [task.points for task in result.tasks] == [10, 0, 0]
    assert "joint j0 should reach 0.5" in result.tasks[1].verdicts[0].reason, result.tasks[1].verdicts[0].reason
    assert any("asked the ROS master to end" in note for note in result.notes), result.notes


def test_files_that_are_named_here_stand_in_the_guide():
    """docs/grading.md names the test behind each promise."""
    text = (pathlib.Path(__file__).resolve().parents[4] / "docs" / "grading.md").read_text()
    folder = pathlib.Path(__file__).parent
    for line in text.splitlines():
        if line.startswith("|") and "test_" in line:
            file = ""
            for named in line.split("`")[1::2]:
                if named.startswith(("test_", "::")):
                    file, _, name = (named if named.startswith("test_") else file + named).partition("::")
                    assert not name or f"def {name}(" in (folder / file).read_text(), named

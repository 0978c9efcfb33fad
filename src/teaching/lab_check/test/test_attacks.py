"""What a submission's nodes, launch files and plugins may try while they run, by whoever examines: with and without the kernel's control
groups, as root and as a user. The arm of this submission has nothing that moves it: its joint earns no point, whatever is tried."""

import contextlib
import os
import pathlib
import re
import socket
import sys
import threading

import pytest
from lab_check.examination import submission_code
from teachers import CMAKE, MANIFEST, reasons

pytestmark = pytest.mark.slow

WIRE = pathlib.Path(__file__).resolve().parents[3] / "simulation" / "gazebo_ros" / "test" / "gazebo_wire.py"
INERTIAL = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
ARM = (
    f"<robot name='arm'><link name='base'>{INERTIAL}</link><link name='l0'>{INERTIAL}</link><joint name='j0' type='revolute'>"
    "<parent link='base'/><child link='l0'/><axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='10' velocity='5'/>"
    "<dynamics damping='5' friction='5'/></joint>%s</robot>"
)
LAUNCH = """<launch>
  <arg name="attack" default=""/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
  <param name="robot_description" textfile="$(find my_robot)/%s.urdf"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model arm -z 0.1"/>
  <node if="$(eval attack != '')" name="evil" pkg="my_robot" type="attack.py" args="$(arg attack)" output="screen"/>
</launch>
"""
BOMBS = {
    "yaml.launch": '<launch><rosparam file="$(find my_robot)/bomb.yaml"/></launch>',
    "xacro.launch": '<launch><param name="robot_description" command="xacro $(find my_robot)/bomb.xacro"/></launch>',
    "include.launch": '<launch><include file="$(find my_robot)/include.launch"/></launch>',
    "eval.launch": "<launch><param name=\"x\" value=\"$(eval __import__('os').system('id'))\"/></launch>",
    "power.launch": '<launch><param name="x" value="$(eval 9**9**9**9)"/></launch>',
    "bomb.yaml": "a: &a [x, x, x, x, x, x, x, x, x]\n"
    + "".join(f"{chr(98 + i)}: &{chr(98 + i)} [{', '.join([f'*{chr(97 + i)}'] * 9)}]\n" for i in range(9)),
    "bomb.xacro": "<robot xmlns:xacro='http://www.ros.org/wiki/xacro' name='x'><xacro:macro name='m'><xacro:m/><xacro:m/></xacro:macro>"
    "<xacro:m/></robot>",
}
HEAD = """\
title: An arm
packages: [my_robot]
build: {points: 10}
limits: {memory: 1 GB, disk: 200 MB, time: 60}
ready: {models: [arm], at: 1, timeout: 40}
tasks:
"""
JOINT = "joint: {name: j0, value: 0.5, tolerance: 0.1, within: 0.5, hold: 0.1}"


def task(name, launch, more=(), costs=False):
    expected = "".join(f"      - {line}\n" for line in (JOINT, *more))
    word = "    interference: costs\n" if costs else ""
    return f"  - name: {name}\n    points: 20\n    film: false\n    launch: my_robot {launch}\n{word}    expect:\n{expected}"


def submission(script, **more):
    return {
        "package.xml": MANIFEST.format("my_robot", ""),
        "CMakeLists.txt": CMAKE.format("my_robot"),
        "arm.urdf": ARM % "",
        "a.launch": LAUNCH % "arm",
        "attack.py": "#!/usr/bin/env python3\n" + script,
        **more,
    }


def noted(result, words):
    return any(re.search(words, note) for note in result["notes"])


# Of Gazebo 11's gazebo_ros_api_plugin: its services that change the world, and its topics.
CHANGING = (
    "apply_body_wrench",
    "apply_joint_effort",
    "delete_light",
    "delete_model",
    "reset_simulation",
    "reset_world",
    "set_joint_properties",
    "set_light_properties",
    "set_link_properties",
    "set_link_state",
    "set_model_configuration",
    "set_model_state",
    "set_physics_properties",
)
WORLD = r"""
import os, socket, sys, threading, time, rospy
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from gazebo_wire import Wire, field, fields
from gazebo_msgs.msg import LinkState, ModelState
from rosservice import get_service_class_by_name
rospy.init_node("evil")
rospy.wait_for_service("/gazebo/get_world_properties")
for name in CHANGING:
    try:
        rospy.ServiceProxy("/gazebo/" + name, get_service_class_by_name("/gazebo/" + name))()
    except rospy.ServiceException as error:
        print(name, error)
if sys.argv[1] == "topics":
    states = rospy.Publisher("/gazebo/set_model_state", ModelState, queue_size=10, latch=True)
    links = rospy.Publisher("/gazebo/set_link_state", LinkState, queue_size=10, latch=True)
    states.publish(ModelState(model_name="arm"))
    links.publish(LinkState(link_name="arm::l0"))
if sys.argv[1] == "transport":
    rospy.sleep(0.2)  # of simulation: the world goes
    while True:  # it comes up after the services
        try:
            wire = Wire(11345)
            break
        except ConnectionRefusedError:
            time.sleep(0.1)
    world = fields(wire.packet("topic_namepaces_init")[1])[1][0].decode()
    def read_on(wire):  # who does not read keeps everybody waiting
        wire.socket.settimeout(None)
        threading.Thread(target=lambda: all(iter(lambda: wire.socket.recv(4096), b"")), daemon=True).start()
    def publish(topic, kind, message):
        with socket.create_server(("127.0.0.1", 0)) as place:
            place.settimeout(20)
            wire.tell("advertise", field(1, topic) + field(2, kind) + field(3, "127.0.0.1") + field(4, place.getsockname()[1]))
            other = Wire.__new__(Wire)
            other.socket, _ = place.accept()
            other.packet()
            other.send(message)
            read_on(other)
            return other
    read_on(wire)
    kept = [publish("/gazebo/%s/world_control" % world, "gazebo.msgs.WorldControl", field(4, field(1, 1))),
            publish("/gazebo/%s/request" % world, "gazebo.msgs.Request", field(1, 7) + field(2, "entity_delete") + field(3, "nobody"))]
    print("TOLD", flush=True)
rospy.spin()
"""


def test_whatever_changes_the_world_is_noted_with_its_name(teacher):
    """Every service that does, both topics, and Gazebo's own transport, which has no names."""
    script = WORLD.replace("CHANGING", f"({CHANGING!r} if sys.argv[1] == 'services' else ())")
    spec = HEAD + "".join(task(name, f"a.launch attack:={name}", costs=True) for name in ("services", "topics", "transport"))
    result, out, _ = teacher.examine(spec, "my_robot", submission(script, **{"gazebo_wire.py": WIRE.read_text()}))
    assert result["points"] == 10, reasons(result)
    log = "".join((out / f"launch_{number}.log").read_text() for number in range(3))
    missing = [name for name in CHANGING if not noted(result, f"the node /evil used /gazebo/{name} 1 times")]
    assert not missing, (missing, result["notes"], log)
    assert "TOLD" in log, log
    for words in (
        "/evil used /gazebo/set_model_state 1",
        "/evil used /gazebo/set_link_state 1",
        "transport.* used /gazebo/reset_simulation 1",
        "transport.* used /gazebo/delete_model 1",
    ):
        assert noted(result, words), (words, result["notes"], log)


IMPOSTER = r"""
import ctypes, os, pathlib, signal, socket, subprocess, sys, threading, time, xmlrpc.client
import rosgraph, rospy
from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import ListControllers, ListControllersResponse
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage
rospy.init_node("evil", disable_rostime=True)
rospy.wait_for_service("/gazebo/get_world_properties")
master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
for call, more in ((master.release, ()), (master.told, ()), (master.simulatorIs, ("/evil", rospy.get_node_uri(), 1))):
    print("MASTER", call("/evil", "", *more)[0], flush=True)
others = [pid for pid in os.listdir("/proc") if pid.isdigit()]
words = [b"lab_check.examination." + word for word in (b"probe", b"session", b"examiner", b"guarded_master")]
seen = [pid for pid in others if any(word in pathlib.Path("/proc", pid, "cmdline").read_bytes() for word in words)]
print("SEEN", seen, flush=True)
def reached(address, family):
    try:
        with socket.socket(family) as near:
            near.settimeout(2)
            near.connect(address)
            return True
    except OSError:
        return False
doors = (("127.0.0.1", HOST_PORT), socket.AF_INET), ("\0HOST_NAME", socket.AF_UNIX), ("HOST_PATH", socket.AF_UNIX)
print("HOST", *(reached(*door) for door in doors), flush=True)
try:
    time.clock_settime(time.CLOCK_REALTIME, time.time() + 1e6)
    print("CLOCK SET")
except OSError as error:
    print("CLOCK", error)
second = subprocess.run(["rosrun", "gazebo_ros", "gzserver"], capture_output=True, text=True, timeout=50)
print("SECOND", second.returncode, flush=True)
best = ControllerState(name="best", state="running", type="effort_controllers/JointPositionController")
rospy.Service("/controller_manager/list_controllers", ListControllers, lambda request: ListControllersResponse([best]))
topics = ("/joint_states", JointState), ("/clock", Clock), ("/tf", TFMessage)
joints, clock, tf = (rospy.Publisher(*words, queue_size=10) for words in topics)
moved = TransformStamped(child_frame_id="l0")
moved.header.frame_id, moved.transform.rotation.z = "base", 1.0
print("FORGES", flush=True)
while not rospy.is_shutdown():
    joints.publish(JointState(name=["j0"], position=[0.5], velocity=[0.0], effort=[0.0]))
    clock.publish(Clock(rospy.Time(1e6)))
    tf.publish(TFMessage([moved]))
    time.sleep(0.01)
"""


@contextlib.contextmanager
def services_of_the_host(place):
    """A port, an abstract socket and one with a path, in which somebody listens, as a notebook or a container engine does."""
    name, path = f"lab_check_test.{os.getpid()}", str(place / "door")
    with contextlib.ExitStack() as doors:
        near = doors.enter_context(socket.create_server(("127.0.0.1", 0)))
        for address in (f"\0{name}", path):
            door = doors.enter_context(socket.socket(socket.AF_UNIX))
            door.bind(address)
            door.listen(8)
        os.chmod(path, 0o777)
        os.chmod(place, 0o755)
        yield near.getsockname()[1], name, path


def test_nobody_passes_for_the_simulator_its_master_or_its_clock(teacher):
    """Nor sees a process of the checker, or a service of the machine; what says it is a controller manager is doubted."""
    with services_of_the_host(teacher.place) as (port, name, path):
        script = IMPOSTER.replace("HOST_PORT", str(port)).replace("HOST_NAME", name).replace("HOST_PATH", path)
        managed = ["controllers: {running: [best]}"]
        result, out, _ = teacher.examine(
            HEAD + task("noted", "a.launch attack:=x", managed) + task("costs", "a.launch attack:=x", managed, costs=True),
            "my_robot",
            submission(script),
        )
    log = (out / "launch_0.log").read_text()
    assert "FORGES" in log, log
    assert [task["points"] for task in result["tasks"]] == [10, 10, 0], reasons(result)
    assert log.count("MASTER -1") == 3 and "SEEN []" in log and "HOST False False False" in log and "CLOCK SET" not in log, log
    assert "SECOND 255" in log, log
    assert noted(result, "controller manager that was asked is the node /evil's"), result["notes"]


FLOOD = r"""
import os, socket, sys, threading, time, xmlrpc.client
import rosgraph
uri, what = os.environ["ROS_MASTER_URI"], sys.argv[1]
master = xmlrpc.client.ServerProxy(uri)
def port_of(uri):
    return int(uri.rpartition(":")[2].strip("/"))
if what == "parameters":
    text = xmlrpc.client.dumps(("/evil", "/KEY", "x" * 60000000), "setParam").encode()
    for number in range(60):
        with socket.create_connection(("localhost", port_of(uri))) as near:
            body = text.replace(b"/KEY", b"/k%d" % number)
            near.sendall(b"POST /RPC2 HTTP/1.0\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n" % len(body) + body)
            near.recv(1000)
        print("PUT", number, flush=True)
if what == "names":
    for number in range(300):
        try:
            master.registerService("/evil", "/" + "n" * 100000 + str(number), "rosrpc://localhost:1", "http://localhost:1/")
            master.registerPublisher("/evil" + "m" * 1000000, "/" + "t" * 100000 + str(number), "std_msgs/String", "http://localhost:1/")
        except (OSError, xmlrpc.client.Error) as error:
            print(error)
    print("NAMED", flush=True)
if what == "doors":
    while not rosgraph.is_master_online():
        time.sleep(0.1)
    doors = [("localhost", port_of(uri)), "\0" + os.environ["LAB_CHECK_SIMULATOR"]]
    time.sleep(8)
    system = rosgraph.Master("/evil")
    doors += [("localhost", port_of(system.lookupNode(node))) for part in system.getSystemState() for _, nodes in part for node in nodes
              if node.startswith("/lab_check") or node == "/gazebo"]
    print("DOORS", len(doors), flush=True)
    held, junk = [], (b"", b"{", b"\xff" * 1000, b'{"arguments": 3}', b"[]", b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n")
    for number in range(3900):
        door = doors[number % len(doors)]
        near = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) if isinstance(door, str) else socket.socket()
        near.settimeout(1)
        try:
            near.connect(door)
            near.send(junk[number % len(junk)])
        except OSError:
            continue
        if isinstance(door, str) and number % 2:
            near.close()
        else:
            held.append(near)
    print("HELD", len(held), flush=True)
time.sleep(10000)
"""


def test_floods_of_parameters_names_and_connections_are_the_submissions_fault(teacher):
    """The master and the examiner's node answer to everybody: neither takes memory, files or room in the report without bound."""
    taken = []
    over = threading.Event()
    watch = threading.Thread(target=lambda: [taken.append(_memory_of_masters()) for _ in iter(lambda: over.wait(0.2), True)])
    watch.start()
    try:
        asked = ["node: /nobody", "controllers: {count: 1}"]
        tasks = [task(name, f"a.launch attack:={name}", asked) for name in ("parameters", "names", "doors")]
        spec = HEAD.replace("time: 60", "time: 12").replace("timeout: 40", "timeout: 15") + "".join(tasks)
        result, out, _ = teacher.examine(spec, "my_robot", submission(FLOOD))
    finally:
        over.set()
        watch.join()
    assert result["points"] == 10, reasons(result)
    logs = [(out / f"launch_{number}.log").read_text() for number in range(3)]
    assert "PUT 1" in logs[0] and ("DOORS" in logs[2] or "not done after" in reasons(result)), logs
    assert 2e7 < max(taken) < 1.3e9, "the limit is 1 GB; without a bound the parameters alone are 3.6 GB, and their text as much again"
    assert (out / "report.json").stat().st_size < 300_000 and (out / "report.html").stat().st_size < 300_000


def _memory_of_masters():
    """Bytes of RAM of the largest ROS master of an examination."""
    most = 0.0
    for pid in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError):
            if b"lab_check.examination.guarded_master" in pathlib.Path("/proc", pid, "cmdline").read_bytes().split(b"\0"):
                most = max(most, float(pathlib.Path("/proc", pid, "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE"))
    return most


HIDING = """
import gc, os, sys
from gazebo_ros.plugin import ModelPlugin
class Hide(ModelPlugin):
    def load(self, server, model, sdf):
        server.before_step(lambda: model.joints["j0"].set_position(0.5))
        print("INSIDE", flush=True)
for name in [name for name in sys.modules if name.startswith("my_robot")]:
    sys.modules[name].__file__ = "/usr/lib/python3/nothing.py"
for one in gc.get_objects():
    if isinstance(one, set) and any("my_robot" in str(each) for each in list(one)[:1000]):
        one.clear()
"""
PLUGIN = {
    "plugins.xml": '<library path="src"><class name="libhide.so" type="my_robot.hide.Hide" base_class_type="gazebo_ros.ModelPlugin"/>'
    "</library>",
    "src/my_robot/__init__.py": "",
    "src/my_robot/hide.py": HIDING,
    "arm.urdf": ARM % "<gazebo><plugin name='hide' filename='libhide.so'/></gazebo>",
    "package.xml": MANIFEST.format("my_robot", "<depend>gazebo_ros</depend><export><gazebo_ros plugin='${prefix}/plugins.xml'/></export>"),
}


def test_a_plugin_that_hides_itself_is_named(teacher):
    """It is told before its first instruction, and what has been told stays told."""
    result, out, _ = teacher.examine(HEAD + task("plugin", "a.launch"), "my_robot", submission("", **PLUGIN))
    assert "INSIDE" in (out / "launch_0.log").read_text(), (out / "launch_0.log").read_text()
    assert noted(result, r"my_robot/hide\.py, code of the submission, ran inside the simulator"), result["notes"]


def test_what_is_code_of_the_submission(tmp_path):
    """Libraries under every name, modules, and those that Python compiled; no data."""
    (tmp_path / "home" / "lib").mkdir(parents=True)
    for name in ("a.py", "b.so", "c.so.1", "d.dae"):
        (tmp_path / "home" / name).write_text("")
    there, here = os.pipe2(os.O_NONBLOCK)
    child = os.fork()
    if child == 0:
        submission_code.tell(here, str(tmp_path / "home"))
        os.chdir(tmp_path / "home")
        for name in ("a.py", str(tmp_path / "home" / "b.so"), os.fsencode("c.so.1"), "d.dae", sys.executable):
            with open(name, "rb"):
                pass
        os._exit(0)
    os.waitpid(child, 0)
    os.close(here)
    assert submission_code.told(there) == [str(tmp_path / "home" / name) for name in ("a.py", "b.so", "c.so.1")]
    os.close(there)


def test_bombs_in_launch_files_end_as_the_submissions_fault(teacher):
    """Of YAML, of xacro, of includes and of $(eval)."""
    names = [name for name in BOMBS if name.endswith(".launch")]
    spec = HEAD.replace("timeout: 40", "timeout: 4").replace("time: 60", "time: 10") + "".join(task(name, name) for name in names)
    result, out, _ = teacher.examine(spec, "my_robot", submission("", **BOMBS))
    assert result["points"] == 10, reasons(result)
    assert "uid=" not in "".join((out / f"launch_{number}.log").read_text() for number in range(len(names)))
    assert all("roslaunch" in verdict["reason"] for task in result["tasks"][1:] for verdict in task["verdicts"]), reasons(result)

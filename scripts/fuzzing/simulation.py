"""A simulator of its own with the labs' robots and controllers in it: what it offers, and whether it still does."""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from fuzzing import ros, seeds
from fuzzing.findings import Found
from fuzzing.worker import end_with_parent

Target = tuple[str, str, str]  # "service" or "topic", name, type
_CONTROLLERS = {
    "/arm": ["joint_state_controller", *(f"joint{i}_position_controller" for i in range(4))],
    "": ["joint_state_controller", "arm_controller"],
}
_ROBOTS = {
    "arm": ("arm/arm_description/urdf/arm.urdf.xacro", "/arm", 0.0),
    "mbot": ("mbot/mbot_description/urdf/xacro/gazebo/mbot_with_laser_gazebo.xacro", "/", 2.0),
    "ur5": ("universal_robot/ur_description/urdf/ur5_robot.urdf.xacro", "/", -2.0),
}
_PARAMETERS = {
    "/arm": ["arm/arm_control/config/arm_control.yaml"],
    "": [f"universal_robot/ur_gazebo/controller/{name}.yaml" for name in ("arm_controller_ur5", "joint_state_controller")],
}
_SOLVER = dict(sor_pgs_iters=50, sor_pgs_w=1.3, contact_surface_layer=0.001, contact_max_correcting_vel=100.0, erp=0.2, max_contacts=20)


def robot_texts() -> dict[str, str]:
    """URDF of the robots, by model name."""
    found = {name: seeds.expanded(Path(seeds.ROOT) / "src/labs" / file) for name, (file, _, _) in _ROBOTS.items()}
    return {name: text.decode() for name, text in found.items() if text is not None}


class Server:
    """A node that is started for this, with a master of its own: it is asked, and its output is read. ``program`` is what it is called in a
    finding, ``node`` its name."""

    program, node = "gzserver", "/gazebo"
    patience = 15.0  # wall s for an answer on a busy machine

    def __init__(self, folder: Path, number: int):
        self._folder = folder
        ros.start_master(folder, number)
        import rospy

        self._rospy = rospy
        self._proxies: dict[str, Any] = {}
        self._publishers: dict[str, Any] = {}
        self._process: subprocess.Popen | None = None

    def start(self, *words: str) -> None:
        """In the place of the one that runs."""
        self.stop()
        self._proxies.clear()
        self._log_path = self._folder / f"{self.program}.log"
        self._log = open(self._log_path, "wb")
        self._read = 0
        self._process = subprocess.Popen(
            words,
            stdout=self._log,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            env=dict(os.environ, PYTHONUNBUFFERED="1"),
            preexec_fn=end_with_parent,
        )
        for publisher in self._publishers.values():
            publisher.unregister()
        self._publishers.clear()

    def stop(self) -> None:
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(5.0)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()

    def wait(self, service: str) -> None:
        self._rospy.wait_for_service(service, timeout=60.0)

    def call(self, name: str, request: Any = None, /, again: bool = True, **fields: Any) -> Any:
        """A service's answer. :raises Found: there is none in time"""
        proxy = self._proxy(name)
        request = proxy.request_class(**fields) if request is None else request
        answer: list[Any] = []

        def ask() -> None:
            try:
                answer.append(proxy(request))
            except Exception as error:  # handed on below
                answer.append(error)

        asking = threading.Thread(target=ask, daemon=True)
        asking.start()
        asking.join(self.patience)
        if asking.is_alive():
            self.check_alive(name)
            raise Found("no answer", name, f"for {self.patience:g} s")
        if isinstance(answer[0], Exception):
            self._proxies.pop(name, None)
            self.check_alive(name)
            if again and isinstance(answer[0], (self._rospy.ServiceException, rospy_closed())):  # the service is a new one now
                return self.call(name, request, again=False)
            raise answer[0]
        return answer[0]

    def _proxy(self, name: str) -> Any:
        if name not in self._proxies:
            import rosservice

            self._proxies[name] = self._rospy.ServiceProxy(name, rosservice.get_service_class_by_name(name), persistent=True)
        return self._proxies[name]

    def publish(self, topic: str, message: Any) -> None:
        publisher = self._publishers.get(topic)
        if publisher is None:
            publisher = self._publishers[topic] = self._rospy.Publisher(topic, type(message), queue_size=10)
            end = time.monotonic() + 5.0
            while not publisher.get_num_connections() and time.monotonic() < end:
                time.sleep(0.01)
        publisher.publish(message)

    def check_alive(self, after: str) -> None:
        try:
            code = self._process.wait(0.0 if self._process.poll() is not None else 0.001)
        except subprocess.TimeoutExpired:
            return
        tail = self._log_path.read_text(errors="replace")[-2000:]
        frames = re.findall(r'File "[^"]*?([^/"]+/[^/"]+)", line (\d+),? in (\S+)', tail)
        place = f"{frames[-1][0]}:{frames[-1][1]} {frames[-1][2]}" if frames else f"after {after}"
        raise Found(f"{self.program} ended with code {code}", place, tail[-300:])

    def check_log(self) -> None:
        with open(self._log_path, "rb") as stream:
            stream.seek(self._read)
            text = stream.read()
        whole = text.rfind(b"\n") + 1
        self._read += whole
        text = re.sub(r"\x1b\[[\d;]*m", "", text[:whole].decode("utf-8", "replace"))
        if "Traceback (most recent call last)" in text:
            from fuzzing import findings

            raise Found.of(findings.of_output(text[text.index("Traceback (most") :]))
        for line in text.splitlines():
            if re.match(r"\[(ERROR|FATAL|WARN)\]", line):
                ros.check_line(re.sub(r"^\[\w+\] \[[\d., -]+\]: ", "", line))

    def targets(self) -> list[Target]:
        """Services of the server and topics that it listens to."""
        import rosservice
        import rostopic

        publishers, subscribers, services = self._rospy.get_master().getSystemState()[2]
        found = [("service", name, rosservice.get_service_type(name)) for name, nodes in services if self.node in nodes]
        found += [
            ("topic", name, rostopic.get_topic_type(name)[0]) for name, nodes in subscribers if self.node in nodes and name != "/clock"
        ]
        return sorted(target for target in found if target[2])


class Simulation(Server):
    """Start it in a worker process. Its server ends with the worker's process group."""

    def __init__(self, folder: Path, number: int):
        super().__init__(folder, number)
        import rospy

        self._texts = robot_texts()
        rospy.set_param("/use_sim_time", True)
        for namespace, files in _PARAMETERS.items():
            for file in files:
                self._load_parameters(namespace, file)
        rospy.set_param("/arm/robot_description", self._texts["arm"])
        rospy.set_param("/robot_description", self._texts["ur5"])
        rospy.init_node("fuzz", disable_signals=True, anonymous=True, disable_rostime=True)
        from gazebo_msgs.msg import LinkStates
        from gazebo_msgs.srv import SetPhysicsPropertiesRequest
        from rosgraph_msgs.msg import Clock
        from sensor_msgs.msg import JointState

        self._clocks, self._states = 0, {}  # type: int, Dict[str, Any]
        rospy.Subscriber("/clock", Clock, self._tick)
        for topic, kind in (("/gazebo/link_states", LinkStates), ("/arm/joint_states", JointState), ("/joint_states", JointState)):
            rospy.Subscriber(topic, kind, lambda message, topic=topic: self._states.__setitem__(topic, message), queue_size=1)
        self._physics = SetPhysicsPropertiesRequest(time_step=0.001, max_update_rate=1000.0)
        self._physics.gravity.z = -9.8
        for field, value in _SOLVER.items():
            setattr(self._physics.ode_config, field, value)
        self.restart()

    def _load_parameters(self, namespace: str, file: str) -> None:
        import yaml

        for name, value in yaml.safe_load((seeds.ROOT / "src/labs" / file).read_text()).items():
            self._rospy.set_param(f"{namespace}/{name}", value)

    def _tick(self, message) -> None:
        self._clocks += 1

    # ------------------------------------------------------------------------------------------ life

    def restart(self) -> None:
        """A new server, with the robots in it."""
        self.start("rosrun", "gazebo_ros", "gzserver", "worlds/empty.world")
        self.wait("/gazebo/set_parameters")  # the last that a server offers
        for name, text in self._texts.items():
            self._spawn(name, text)
        self.repair()

    def recover(self) -> None:
        """After something was found: go on with this server if it still does, else with a new one."""
        try:
            self.check_alive("")
            self.repair()
            self._check_clock("")
        except Exception:  # whatever it is, a new server knows nothing of it
            self.restart()
        self._read = self._log_path.stat().st_size

    def repair(self) -> None:
        """Physics, models and controllers as they were; what a case is allowed to change."""
        if not self._physics_as_it_was():
            self.call("/gazebo/set_physics_properties", self._physics)
            self.call("/gazebo/unpause_physics")
        self.call("/gazebo/clear_body_wrenches")
        names = self.call("/gazebo/get_world_properties").model_names
        for name in names:
            if name not in self._texts and name != "ground_plane":
                self.call("/gazebo/delete_model", model_name=name)
        for name, text in self._texts.items():
            if name not in names:
                self._spawn(name, text)
        self._start_controllers()

    def _physics_as_it_was(self) -> bool:
        now, wanted = self.call("/gazebo/get_physics_properties"), self._physics
        return (
            not now.pause
            and now.gravity == wanted.gravity
            and now.time_step == wanted.time_step
            and now.max_update_rate == wanted.max_update_rate
            and all(getattr(now.ode_config, field) == value for field, value in _SOLVER.items())
        )

    def _spawn(self, name: str, text: str) -> None:
        from geometry_msgs.msg import Point, Pose, Quaternion

        _, namespace, y = _ROBOTS[name]
        answer = self.call(
            "/gazebo/spawn_urdf_model",
            model_name=name,
            model_xml=text,
            robot_namespace=namespace,
            initial_pose=Pose(Point(0.0, y, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0)),
        )
        if not answer.success:
            raise Found("a robot of the labs cannot be spawned again", name, answer.status_message)
        self._proxies.clear()  # they would go on talking to what the robot before had

    def _start_controllers(self) -> None:
        for namespace, names in _CONTROLLERS.items():
            manager = f"{namespace}/controller_manager/"
            states = {controller.name: controller.state for controller in self.call(manager + "list_controllers").controller}
            stopped = [name for name in names if states.get(name) != "running"]
            for name in stopped:
                if states.get(name) not in (None, "running"):
                    self.call(manager + "unload_controller", name=name)
                self.call(manager + "load_controller", name=name)
            if stopped and not self.call(manager + "switch_controller", start_controllers=stopped, strictness=1, timeout=5.0).ok:
                raise Found(
                    "controllers of the labs cannot be started again",
                    f"{manager}switch_controller",
                    f"{states} {self._log_path.read_text(errors='replace')[-400:]}",
                )

    # ------------------------------------------------------------------------------------------ is all well?

    def check(self) -> None:
        """:raises Found: the server is gone, does not answer, time stands still, numbers are no numbers, a log line is no message."""
        self.check_alive("a message")
        if not self._physics_as_it_was():
            physics = self.call("/gazebo/get_physics_properties")
            if not physics.pause and (physics.max_update_rate == 0.0 or physics.max_update_rate >= 20.0):
                self._check_clock(f"time step {physics.time_step:g} s, {physics.max_update_rate:g} Hz")
        self.repair()
        self._check_clock("default physics")
        self._check_numbers()
        self.check_log()

    def _check_clock(self, where: str) -> None:
        before, end = self._clocks, time.monotonic() + self.patience
        while self._clocks < before + 2:
            if time.monotonic() > end:
                self.check_alive(where)
                raise Found("time stands still", "/clock", where)
            time.sleep(0.002)

    def _check_numbers(self) -> None:
        for topic, message in list(self._states.items()):
            numbers = (
                [*message.position, *message.velocity, *message.effort]
                if hasattr(message, "effort")
                else [getattr(pose.position, axis) for pose in message.pose for axis in "xyz"]
                + [getattr(twist.linear, axis) for twist in message.twist for axis in "xyz"]
            )
            if not all(map(math.isfinite, numbers)):
                raise Found("silent NaN", topic)


def rospy_closed() -> type:
    """What a connection that was kept raises when the other side has gone."""
    from rospy.exceptions import TransportException

    return TransportException


def listed(module: str = "fuzzing.simulation") -> list[Target]:
    """The targets of a server that is started for this, in a process of its own."""
    out = subprocess.run([sys.executable, "-m", module], capture_output=True, text=True, timeout=180, start_new_session=True)
    if out.returncode:
        raise RuntimeError(f"{module} cannot be started: {out.stderr.strip().splitlines()[-1:]}")
    return [tuple(target) for target in json.loads(out.stdout.splitlines()[-1])]


def print_targets(kind: type) -> None:
    """And end the process."""
    with tempfile.TemporaryDirectory(prefix="noetic_labs_fuzz_list_") as folder:
        server = kind(Path(folder), 30)
        try:
            print(json.dumps(server.targets()))
        finally:
            server.stop()
    sys.stdout.flush()
    os._exit(0)  # rospy's and the master's threads have nothing more to say


if __name__ == "__main__":
    print_targets(Simulation)

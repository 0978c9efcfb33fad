"""Measures the robot that one running launch file brought up: a process of its own, as a process has one ROS master.

Started by :mod:`.measure` with a JSON job on standard input; answers with one JSON line on standard output.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from dataclasses import asdict

import cv2
import numpy as np
import rospy
from roslib.message import get_message_class
from rosservice import ROSServiceException, get_service_class_by_name

from . import scene, system
from .commands import Wheel, choose, joint_limits, nominal_rates
from .errors import MeasuringError
from .hearing import Ear, is_sensor
from .motion import Motion, longest_silence, reachable
from .simulator import find
from .system import System
from .truth import Truth

_ANSWER = 60.0  # s of wall time for one message
_LEAD = 2.0  # s a command is held before it counts: accelerations are not what is measured
_PATIENCE = 0.2  # s of simulation without a command after which many controllers begin to brake
_PICTURE = 640, 400


def _service(name: str) -> rospy.ServiceProxy:
    return rospy.ServiceProxy(name, get_service_class_by_name(name))


class Measurement:
    """One running system and the figures of it. ``job`` as :func:`.measure.measure` writes it."""

    def __init__(self, job: dict):
        self.job = job
        self.found: dict = {"notes": []}
        self.system = System(job["log"], job["nodes"], job["passing"])

    def note(self, text: str) -> None:
        self.found["notes"].append(text)

    @contextlib.contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """What goes wrong in one phase is noted, and the next one has its turn."""
        try:
            yield
        except (MeasuringError, rospy.ROSException, rospy.ServiceException, ROSServiceException) as error:
            self.note(f"{name}: {' '.join(str(error).split())}")

    def run(self) -> None:
        amiss = self.system.wait_until_settled(self.job["timeout"])
        if amiss:
            self.note(amiss)
        simulator = find(self.system.services())
        if not simulator:
            self.note("no simulator came up: nobody offers /gazebo/get_model_state")
            return
        self.simulator = simulator
        if simulator.service("get_physics_properties")().pause:
            simulator.service("unpause_physics")()
        model = self.job["model"] or scene.subject(simulator, _ANSWER)
        if not model:
            self.note("no robot: nothing in the world can move")
            return
        self.found["model"] = model
        with self.phase("robot"):
            self.truth = Truth(simulator, model)
            for name in ("stand", "listen", "drive", "reach", "picture"):
                if self.job[name]:
                    with self.phase(name):
                        getattr(self, name)()
                    self.save()

    def save(self) -> None:
        """What is known so far, for whoever is interrupted."""
        with open(os.path.join(self.job["folder"], f"{self.job['stem']}.json"), "w") as file:
            json.dump(self.found, file)

    def stand(self) -> None:
        """Drift without a command, as fast as the machine goes."""
        self.truth.pace(0)
        try:
            self.found["settling"] = asdict(Motion.of(self.truth.follow(self.job["settle"])))
            self.found["drift"] = asdict(Motion.of(self.truth.follow(self.job["stand"])))
        finally:
            self.truth.pace(None)

    def listen(self) -> None:
        """Sensors, with the world slowed down: on a busy machine a picture may take longer than the sensor's period."""
        ear = Ear([(topic, kind) for topic, kind in self.system.published() if is_sensor(kind)])
        heard = 0.0
        self.truth.pace(self.job["slow"])
        try:
            self.truth.follow(1.0)  # connections, and what was shared out before them
            ear.forget()
            samples = self.truth.follow(self.job["listen"])
            heard = samples[-1].time - samples[0].time
        finally:
            self.truth.pace(None)
            self.found["sensors"] = ear.close(heard or self.job["listen"])
        self._compare_rates()

    def _compare_rates(self) -> None:
        description = self.simulator.parameter("robot_description", "")
        rates = [sensor["rate"] for sensor in self.found["sensors"] if sensor["rate"]]
        for name, wanted in nominal_rates(description) if description else []:
            if not any(abs(rate - wanted) <= 0.05 * wanted for rate in rates):
                self.note(f"sensor {name} asks for {wanted:g} Hz: no topic comes at that rate")

    def drive(self) -> None:
        """Straight on, stop, turn, stop."""
        job = self.job
        topic, kind = choose(self.system.heard(), [name for name, _ in self.system.published()], job["command"])
        wheel = Wheel(topic, kind)
        sent: list[float] = []  # s of simulation

        def say(time: float, *speeds: float) -> None:
            sent.append(time)
            wheel.send(time, *speeds)

        self.found["command"] = {"topic": topic, "kind": kind}
        self.truth.pace(job["factor"])
        try:
            for name, speed, turn, aside in (
                ("straight", job["speed"], 0.0, 0.0),
                ("aside", 0.0, 0.0, job["aside"]),
                ("turn", job["turn_speed"], job["turn"], 0.0),
            ):
                if not (speed or turn or aside):
                    continue
                self.truth.follow(_LEAD, lambda time: say(time, speed, turn, aside))
                motion = Motion.of(self.truth.follow(job["drive"], lambda time: say(time, speed, turn, aside)))
                self.found[name] = {**asdict(motion), "speed": speed, "rate": turn, "aside": aside}
                self.truth.follow(_LEAD, lambda time: say(time, 0.0, 0.0))
            self.found["rest"] = asdict(Motion.of(self.truth.follow(5.0)))
        finally:
            self.truth.pace(None)
            silence = longest_silence(sent)
            if silence > _PATIENCE:
                self.note(
                    f"commands came up to {silence:.2f} s of simulation apart, and controllers stop without them: "
                    "repeat with a smaller --factor"
                )

    def reach(self) -> None:
        """Every joint of the running trajectory controllers goes a step further; the simulator says where they are."""
        limits = joint_limits(self.simulator.parameter("robot_description", "<robot/>"))
        self.found["reach"] = {}
        tail = "controller_manager/list_controllers"
        for manager in [name for name in self.system.services() if name.endswith(tail)]:
            listed = _service(manager)()
            namespace = manager[: -len(tail)]
            for controller in listed.controller:
                if controller.state == "running" and controller.type.endswith("JointTrajectoryController"):
                    joints = [name for claimed in controller.claimed_resources for name in claimed.resources]
                    topic = f"{namespace}{controller.name}/command"
                    self.found["reach"][controller.name] = self._reach(topic, joints, limits)

    def _position(self, joint: str) -> float:
        answer = self.simulator.service("get_joint_properties")(joint)
        if not answer.success:
            raise MeasuringError(answer.status_message)
        return answer.position[0]

    def _reach(self, topic: str, joints: list[str], limits: dict) -> float:
        """:returns: how far the worst joint is off after twice the trajectory's time, rad or m."""
        step = self.job["reach"]
        targets = [reachable(self._position(joint), step, *limits.get(joint, (None, None))) for joint in joints]
        trajectory = get_message_class("trajectory_msgs/JointTrajectory")(joint_names=joints)
        trajectory.points = [
            get_message_class("trajectory_msgs/JointTrajectoryPoint")(positions=targets, time_from_start=rospy.Duration(3.0))
        ]
        publisher = rospy.Publisher(topic, type(trajectory), queue_size=1, latch=True)
        publisher.publish(trajectory)
        self.truth.follow(6.0)
        return max(abs(self._position(joint) - target) for joint, target in zip(joints, targets))

    def picture(self) -> None:
        answer = self.simulator.service(scene.SERVICE)(self.found["model"], self.job["view"], *_PICTURE)
        if not answer.success:
            raise rospy.ServiceException(answer.status_message)
        image = cv2.imdecode(np.frombuffer(answer.png, np.uint8), cv2.IMREAD_COLOR)
        cv2.imwrite(os.path.join(self.job["folder"], f"{self.job['stem']}.jpg"), image, [cv2.IMWRITE_JPEG_QUALITY, 80])


def main() -> None:
    job = json.load(sys.stdin)
    answers, sys.stdout = sys.stdout, sys.stderr
    system.join(job["timeout"])
    measurement = Measurement(job)
    with measurement.phase("simulator"):
        measurement.run()
    json.dump(measurement.found, answers)
    answers.flush()
    rospy.signal_shutdown("done")


if __name__ == "__main__":
    main()

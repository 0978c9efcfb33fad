"""Takes the pictures of one running launch file: a process of its own, because a process has one ROS master for life.

Started by :mod:`.cli` with a JSON job on standard input; answers with one JSON line on standard output.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import tempfile
import threading

import rosgraph
import rospy
import yaml
from geometry_msgs.msg import Twist
from rosservice import ROSServiceException
from rviz_offscreen.cli import missing_lines, take
from rviz_offscreen.errors import OffscreenError
from sensor_msgs.msg import Image

from . import automatic, images, scene, system
from .simulator import find
from .system import System

_ANSWER = 40.0  # s of wall time for one message


class Visit:
    """One running system and the pictures of it. ``job`` as :func:`.cli.visit` writes it."""

    def __init__(self, job: dict):
        self.job = job
        self.pictures: list[tuple[str, str]] = []  # file name, caption
        self.notes: list[str] = []
        self.system = System(job["log"], job["nodes"], job["passing"])

    def take_scene(self) -> None:
        services = self.system.services()
        simulator = find(services)
        if not simulator or simulator.name(scene.SERVICE) not in services:
            return
        try:
            self.pictures += scene.pictures(simulator, self.job["folder"], self.job["stem"], _ANSWER)
        except (rospy.ROSException, rospy.ServiceException, ROSServiceException) as error:
            self.notes.append(f"no picture of the scene: {error}")

    def take_rviz(self) -> None:
        name = f"{self.job['stem']}-rviz.png"
        drive = self.job["drive"]
        with tempfile.TemporaryDirectory() as folder, Driving(drive[:2]) if drive else contextlib.nullcontext():
            config, whose = self.job["config"], "the launch file's set-up"
            if not config:
                config, whose = os.path.join(folder, "automatic.rviz"), "all that is published"
                parents = automatic.frames(1.5)
                with open(config, "w") as file:
                    yaml.safe_dump(
                        automatic.config(self.system.published(), rospy.has_param("robot_description"), automatic.root_of(parents), 1.0),
                        file,
                    )
            try:
                result = take(
                    config,
                    [],
                    os.path.join(self.job["folder"], name),
                    size=self.job["size"],
                    window=True,
                    timeout=self.job["timeout"],
                    watch=drive[2] if drive else 0.0,
                )
            except OffscreenError as error:
                self.notes.append(f"no RViz picture: {error}")
                return
        self.pictures.append((name, f"RViz, {whose}"))
        self.notes += [f"RViz: {line}" for line in missing_lines(result, self.job["timeout"])]

    def take_cameras(self) -> None:
        for topic in sorted(topic for topic, kind in self.system.published() if kind == "sensor_msgs/Image"):
            name = f"{self.job['stem']}{topic.replace('/', '-')}.png"
            try:
                images.save(rospy.wait_for_message(topic, Image, _ANSWER), os.path.join(self.job["folder"], name))
                self.pictures.append((name, f"Camera, {topic}"))
            except (rospy.ROSException, ValueError) as error:
                self.notes.append(f"no image of {topic}: {error}")


class Driving:
    """While in the context: a speed on every topic of Twist messages that somebody listens to; zero at its end."""

    def __init__(self, speed: list[float]):
        self.twist = Twist()
        self.twist.linear.x, self.twist.angular.z = speed
        self.ended = threading.Event()

    def __enter__(self) -> None:
        master = rosgraph.Master(rospy.get_name())
        listened = {topic for topic, _ in master.getSystemState()[1]}
        self.publishers = [
            rospy.Publisher(topic, Twist, queue_size=1)
            for topic, kind in master.getTopicTypes()
            if kind == "geometry_msgs/Twist" and topic in listened
        ]
        self.thread = threading.Thread(target=self._send)
        self.thread.start()

    def _send(self) -> None:
        while not self.ended.wait(0.1):
            for publisher in self.publishers:
                publisher.publish(self.twist)
        for publisher in self.publishers:
            publisher.publish(Twist())

    def __exit__(self, *_) -> None:
        self.ended.set()
        self.thread.join()


def main() -> None:
    job = json.load(sys.stdin)
    answers, sys.stdout = sys.stdout, sys.stderr
    system.join(job["timeout"])
    visit = Visit(job)
    amiss = visit.system.wait_until_settled(job["timeout"])
    visit.notes += [amiss] if amiss else []
    visit.take_scene()
    visit.take_cameras()
    visit.take_rviz()  # last: it may drive
    json.dump({"pictures": visit.pictures, "notes": visit.notes}, answers)
    answers.flush()
    rospy.signal_shutdown("done")


if __name__ == "__main__":
    main()

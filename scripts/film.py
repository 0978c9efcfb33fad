"""Films what pick_place.launch has launched: the block is picked, and put down behind the post. ``film.py FILE.webp``."""

from __future__ import annotations

import io
import sys
import threading
from typing import Any

import actionlib
import moveit_commander
import numpy as np
import rospy
from controller_manager_tests.client import ManagerClient
from dynamic_reconfigure.client import Client
from gazebo_ros.srv import TakePicture
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GraspPlanning, GraspPlanningRequest
from myur5_pick_place import table
from object_recognition_msgs.msg import ObjectRecognitionAction, ObjectRecognitionGoal
from PIL import Image

SIZE = (1280, 800)  # pixels that are drawn
PART = (384, 0, 1152, 800)  # left, upper, right, lower: where something happens
SHOWN = (480, 500)  # pixels of the film
RATE = 10.0  # pictures a second of simulated time
THERE = (0.5, 0.3, 0.9605)  # m, a hair above the table
SLOW = 150.0  # steps of 1 ms a second: the processor draws a picture in what is 0.03 s then


class Film(threading.Thread):
    """A picture as often as the simulator draws one, from :meth:`start` to :meth:`end`."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.pictures: list[tuple[float, bytes]] = []
        self._ended = threading.Event()
        self._take = rospy.ServiceProxy("/gazebo/take_picture", TakePicture)

    def run(self) -> None:
        while not self._ended.is_set():
            now = rospy.get_time()
            self.pictures.append((now, self._take("", "iso", *SIZE).png))

    def end(self) -> None:
        self._ended.set()
        self.join()

    def write(self, file: str) -> None:
        times = np.array([time for time, _ in self.pictures])
        chosen = [int(np.abs(times - time).argmin()) for time in np.arange(times[0], times[-1], 1.0 / RATE)]
        drawn = (Image.open(io.BytesIO(self.pictures[k][1])).convert("RGB") for k in chosen)
        shown = [picture.resize(SHOWN, Image.Resampling.LANCZOS, PART) for picture in drawn]
        shown[0].save(file, save_all=True, append_images=shown[1:], duration=round(1000 / RATE), loop=0, quality=70, method=6)


def recognize() -> None:
    """What stands on the table becomes part of the planning scene."""
    client = actionlib.SimpleActionClient("recognize_objects", ObjectRecognitionAction)
    client.wait_for_server(rospy.Duration(120))
    client.send_goal_and_wait(ObjectRecognitionGoal())


def grasps(scene: Any) -> Any:
    rospy.wait_for_service("plan_grasps", 120)
    target = scene.get_objects(["block"])["block"]
    return rospy.ServiceProxy("plan_grasps", GraspPlanning)(GraspPlanningRequest(group_name="manipulator", target=target)).grasps


def main(file: str) -> int:
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("film")
    scene = moveit_commander.PlanningSceneInterface()
    arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=120.0)
    ManagerClient().wait_until_running("arm_controller")
    arm.set_max_velocity_scaling_factor(1.0)
    recognize()
    arm.set_support_surface_name("table")
    Client("/gazebo", timeout=60).update_configuration({"max_update_rate": SLOW})
    film = Film()
    film.start()
    done = arm.pick("block", grasps(scene)) == MoveItErrorCodes.SUCCESS and arm.place("block", table.places(*THERE))
    arm.set_named_target("HomePose")
    done = done and arm.go(wait=True)
    film.end()
    if not done:
        print("the block was not carried: see the log of pick_place.launch", file=sys.stderr)
        return 1
    film.write(file)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

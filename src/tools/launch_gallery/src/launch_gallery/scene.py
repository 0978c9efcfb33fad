"""Pictures of the simulated scene, which the simulator draws without a camera in it, also while it is paused."""

from __future__ import annotations

import os

import rospy
from rostopic import get_topic_class

from .simulator import Simulator

SERVICE = "take_picture"


def subject(simulator: Simulator, seconds: float) -> str:
    """What to look at: the movable model with most joints, of several the one that came last; '' if nothing can move.

    :raises rospy.ROSException: the simulator did not answer within ``seconds``
    """
    topic = simulator.name("model_states")
    kind = get_topic_class(topic)[0]
    if kind is None:
        raise rospy.ROSException(f"nobody publishes {topic}")
    properties = simulator.service("get_model_properties")
    known = {name: properties(name) for name in rospy.wait_for_message(topic, kind, seconds).name}
    movable = [name for name in reversed(list(known)) if not known[name].is_static]  # a robot comes after its world's own things
    return max(movable, key=lambda name: len(known[name].joint_names), default="")


def pictures(simulator: Simulator, folder: str, stem: str, seconds: float) -> list[tuple[str, str]]:
    """The robot filling the frame, and all that stands on the ground, as ``stem``-... .png in ``folder``.

    :param seconds: that the robot is waited for
    :returns: (file name, caption) of each
    :raises rospy.ROSException, rospy.ServiceException: the simulator did not answer, or cannot draw
    """
    robot = subject(simulator, seconds)
    wanted = [("world", "", "iso", "The simulator")]
    if robot:
        wanted.insert(0, ("robot", robot, "iso", f"The simulator: {robot}"))
    taken = []
    for kind, model, view, caption in wanted:
        answer = simulator.service(SERVICE)(model, view, 1280, 800)
        if not answer.success:
            raise rospy.ServiceException(answer.status_message)
        name = f"{stem}-{kind}.png"
        with open(os.path.join(folder, name), "wb") as file:
            file.write(answer.png)
        taken.append((name, caption))
    return taken

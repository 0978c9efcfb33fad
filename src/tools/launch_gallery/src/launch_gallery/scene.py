"""Pictures of the simulated scene, which the simulator draws without a camera in it, also while it is paused."""
from __future__ import annotations

import os
from typing import List, Tuple

import rospy
from rosservice import get_service_class_by_name
from rostopic import get_topic_class

SERVICE = "/gazebo/take_picture"


def _service(name: str) -> rospy.ServiceProxy:
    """A service of the simulator, whoever that is: the kind is asked of the running one."""
    return rospy.ServiceProxy(name, get_service_class_by_name(name))


def subject(seconds: float) -> str:
    """What to look at: the movable model with most joints, of several the one that came last; '' if nothing can move.

    :raises rospy.ROSException: the simulator did not answer within ``seconds``
    """
    kind = get_topic_class("/gazebo/model_states")[0]
    if kind is None:
        raise rospy.ROSException("nobody publishes /gazebo/model_states")
    properties = _service("/gazebo/get_model_properties")
    known = {name: properties(name) for name in rospy.wait_for_message("/gazebo/model_states", kind, seconds).name}
    movable = [name for name in reversed(list(known)) if not known[name].is_static]  # a robot comes after its world's own things
    return max(movable, key=lambda name: len(known[name].joint_names), default="")


def pictures(folder: str, stem: str, seconds: float) -> List[Tuple[str, str]]:
    """The robot filling the frame, and all that stands on the ground.

    :returns: (file name, caption) of each
    :raises rospy.ROSException, rospy.ServiceException: the simulator did not answer, or cannot draw
    """
    robot = subject(seconds)
    wanted = [("world", "", "iso", "The simulator")]
    if robot:
        wanted.insert(0, ("robot", robot, "iso", f"The simulator: {robot}"))
    taken = []
    for kind, model, view, caption in wanted:
        answer = _service(SERVICE)(model, view, 1280, 800)
        if not answer.success:
            raise rospy.ServiceException(answer.status_message)
        name = f"{stem}-{kind}.png"
        with open(os.path.join(folder, name), "wb") as file:
            file.write(answer.png)
        taken.append((name, caption))
    return taken

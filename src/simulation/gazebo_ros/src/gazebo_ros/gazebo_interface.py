"""The simulator's services as Python functions."""

from __future__ import annotations

import re
import time
from typing import Any

import rospy
from gazebo_msgs.srv import SetModelConfiguration, SpawnModel
from geometry_msgs.msg import Pose
from node_signals.services import wait_for_service

_SENT_TEXT = re.compile(r"\btext(?=:\d+)")  # the server's name for a description that it was sent


def _call(what: str, name: str, service: type, *arguments: Any, origin: str = "") -> bool | None:
    """Wait for the service, call it and say how ``what`` went; its ``success``, or None when the call itself failed.

    :param origin: where the description was read, by which its lines are named
    """
    rospy.loginfo("Waiting for service %s", name)
    wait_for_service(name)
    try:
        rospy.loginfo("Calling service %s", name)
        response = rospy.ServiceProxy(name, service)(*arguments)
    except rospy.ServiceException as error:
        rospy.logerr("Service call failed: %s", error)
        return None
    status = _SENT_TEXT.sub(lambda _: origin, response.status_message) if origin else response.status_message
    (rospy.loginfo if response.success else rospy.logerr)("%s status: %s", what, status)
    return response.success


def spawn_sdf_model_client(
    model_name: str, model_xml: str, robot_namespace: str, initial_pose: Pose, reference_frame: str, gazebo_namespace: str, origin: str = ""
) -> bool | None:
    """Spawn SDF text. True when it worked, False when the simulator refused, None when the call failed.

    :param model_name: that the model gets. :param model_xml: the text
    :param robot_namespace: of the model's plugins that name none
    :param initial_pose: of the model in ``reference_frame``, m
    :param reference_frame: a model or link; "" or "world" is the world
    :param gazebo_namespace: of the simulator's services, "/gazebo"
    :param origin: where the text was read: errors name its lines by that
    """
    return _call(
        "Spawn",
        gazebo_namespace + "/spawn_sdf_model",
        SpawnModel,
        model_name,
        model_xml,
        robot_namespace,
        initial_pose,
        reference_frame,
        origin=origin,
    )


def spawn_urdf_model_client(
    model_name: str, model_xml: str, robot_namespace: str, initial_pose: Pose, reference_frame: str, gazebo_namespace: str, origin: str = ""
) -> bool | None:
    """Spawn URDF text; parameters and answer as of :func:`spawn_sdf_model_client`.

    ``model_name``, ``model_xml``, ``robot_namespace``, ``initial_pose``, ``reference_frame``, ``gazebo_namespace``, ``origin``
    """
    return _call(
        "Spawn",
        gazebo_namespace + "/spawn_urdf_model",
        SpawnModel,
        model_name,
        model_xml,
        robot_namespace,
        initial_pose,
        reference_frame,
        origin=origin,
    )


def set_model_configuration_client(
    model_name: str, model_param_name: str, joint_names: list[str], joint_positions: list[float], gazebo_namespace: str
) -> bool | None:
    """Put joints to positions, one wall second after the service is there, when controllers have started.

    :param model_name: of the model. :param model_param_name: of its URDF on the parameter server; not used
    :param joint_names, joint_positions: which, and where to (rad, m)
    :param gazebo_namespace: of the simulator's services, "/gazebo"
    :return: as :func:`spawn_sdf_model_client`
    """
    name = gazebo_namespace + "/set_model_configuration"
    wait_for_service(name)
    time.sleep(1.0)
    return _call("Set model configuration", name, SetModelConfiguration, model_name, model_param_name, joint_names, joint_positions)

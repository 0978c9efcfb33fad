"""The simulator's services as Python functions."""
from __future__ import annotations

import time
from typing import Any, List, Optional

import rospy
from gazebo_msgs.srv import SetModelConfiguration, SpawnModel
from geometry_msgs.msg import Pose


def _call(what: str, name: str, service: type, *arguments: Any) -> Optional[bool]:
    """Wait for the service, call it and say how ``what`` went; its ``success``, or None when the call itself failed."""
    rospy.loginfo("Waiting for service %s", name)
    rospy.wait_for_service(name)
    try:
        rospy.loginfo("Calling service %s", name)
        response = rospy.ServiceProxy(name, service)(*arguments)
    except rospy.ServiceException as error:
        rospy.logerr("Service call failed: %s", error)
        return None
    (rospy.loginfo if response.success else rospy.logerr)("%s status: %s", what, response.status_message)
    return response.success


def spawn_sdf_model_client(model_name: str, model_xml: str, robot_namespace: str, initial_pose: Pose,
                           reference_frame: str, gazebo_namespace: str) -> Optional[bool]:
    """Spawn SDF text. True when it worked, False when the simulator refused, None when the call failed."""
    return _call("Spawn", gazebo_namespace + "/spawn_sdf_model", SpawnModel, model_name, model_xml, robot_namespace,
                 initial_pose, reference_frame)


def spawn_urdf_model_client(model_name: str, model_xml: str, robot_namespace: str, initial_pose: Pose,
                            reference_frame: str, gazebo_namespace: str) -> Optional[bool]:
    """Spawn URDF text; returns as :func:`spawn_sdf_model_client`."""
    return _call("Spawn", gazebo_namespace + "/spawn_urdf_model", SpawnModel, model_name, model_xml, robot_namespace,
                 initial_pose, reference_frame)


def set_model_configuration_client(model_name: str, model_param_name: str, joint_names: List[str],
                                   joint_positions: List[float], gazebo_namespace: str) -> Optional[bool]:
    """Put joints to positions (rad, m), one wall second after the service is there, when controllers have started."""
    name = gazebo_namespace + "/set_model_configuration"
    rospy.wait_for_service(name)
    time.sleep(1.0)
    return _call("Set model configuration", name, SetModelConfiguration, model_name, model_param_name, joint_names, joint_positions)

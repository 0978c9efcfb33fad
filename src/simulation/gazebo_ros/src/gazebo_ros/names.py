"""Namespaces and frames of plugins, by the four rules that Gazebo's plugins use.

=====  ============================================  ===================================================
rule   ``<robotNamespace>`` missing                  present but empty
=====  ============================================  ===================================================
A      the model's name                              the model's name
B      root                                          the model's name
C      root                                          root
D      ``/<model>/``                                 root
=====  ============================================  ===================================================

A: diff_drive, tricycle_drive, joint_state_publisher. B: cameras, laser, gpu_laser. C: imu, p3d, bumper, range,
planar_move, skid_steer and most others. D: imu_sensor. spawn_model writes its own namespace (mostly ``/``) into every
plugin without one.
A relative namespace is resolved against that of the gazebo node.
"""

from __future__ import annotations

import rosgraph
import rospy
from rosgraph.names import canonicalize_name, ns_join


def robot_namespace(sdf, model_name: str, rule: str) -> str:
    """Absolute namespace of a plugin, without a slash at the end (root is ``/``).

    :param sdf: :class:`gazebo_ros.SdfElement` of ``<plugin>``
    :param model_name: name of the model the plugin belongs to
    :param rule: ``"A"``, ``"B"``, ``"C"`` or ``"D"``, see the module
    """
    given = sdf.get("robotNamespace", None)
    if given is None:
        namespace = {"A": model_name, "B": "", "C": "", "D": f"/{model_name}/"}[rule]
    elif not given:
        namespace = {"A": model_name, "B": model_name, "C": "", "D": ""}[rule]
    else:
        namespace = given
    return join(rospy.get_namespace(), namespace)


def join(namespace: str, name: str) -> str:
    """``name`` in ``namespace``; a name that starts with a slash stands for itself. Doubled slashes are removed."""
    return canonicalize_name(ns_join(namespace or "/", name)) or "/"


def tf_prefix(namespace: str) -> str:
    """The ``tf_prefix`` parameter nearest to ``namespace`` on the way up to the root; '' when there is none."""
    # the master refuses "/" as the place to begin; from a name below, it looks there on its way up
    namespace = join(rospy.get_namespace(), namespace)
    master = rosgraph.Master(namespace)
    try:
        found = "/tf_prefix" if namespace == "/" else master.searchParam("tf_prefix")  # no search from the root itself
        return str(master.getParam(found))
    except rosgraph.MasterError:  # there is none
        return ""


def resolve_frame(prefix: str, frame: str) -> str:
    """``frame`` with the tf prefix, as ``tf::resolve`` of Noetic: a leading slash goes, and switches the prefix off."""
    if frame.startswith("/"):
        return frame[1:]
    prefix = prefix[1:] if prefix.startswith("/") else prefix
    return f"{prefix}/{frame}" if prefix else frame

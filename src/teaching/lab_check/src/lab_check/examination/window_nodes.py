"""Nodes of launch files that open windows: an examination has no display, and leaves them out."""

_WINDOWS = {
    ("rviz", "rviz"),
    ("gazebo_ros", "gzclient"),
    ("joint_state_publisher_gui", "joint_state_publisher_gui"),
    ("rqt_gui", "rqt_gui"),
    ("rqt_joint_trajectory_controller", "rqt_joint_trajectory_controller"),
    ("rqt_robot_steering", "rqt_robot_steering"),
}


def is_window(package: str, kind: str) -> bool:
    """Whether a node of ``package`` opens a window.

    :param kind: ``type`` of the node
    """
    return (package, kind) in _WINDOWS or (package.startswith("rqt_") and kind == package)

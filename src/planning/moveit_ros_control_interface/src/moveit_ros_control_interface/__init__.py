"""Controllers of a running controller_manager: see :mod:`moveit_ros_control_interface.manager`."""

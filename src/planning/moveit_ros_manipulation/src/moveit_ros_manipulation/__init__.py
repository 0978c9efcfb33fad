"""Pick and place: planned in :mod:`moveit_ros_manipulation.planner`, offered by
:mod:`moveit_ros_manipulation.capability`."""

"""The nodes transform and relay_field: :mod:`.expressions` without ROS, :mod:`.node` with it."""

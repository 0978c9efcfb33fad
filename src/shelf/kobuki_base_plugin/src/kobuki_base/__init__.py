"""libgazebo_ros_kobuki.so: :mod:`.base` drives and publishes, :mod:`.senses` feels bumps, cliffs and dropped wheels."""

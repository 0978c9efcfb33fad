"""Robot simulation without ROS: descriptions, physics, sensors, rendering."""

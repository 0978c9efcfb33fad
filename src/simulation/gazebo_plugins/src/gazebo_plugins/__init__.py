"""Plugins of simulated robots: one module per family, classes named in gazebo_plugins.xml."""

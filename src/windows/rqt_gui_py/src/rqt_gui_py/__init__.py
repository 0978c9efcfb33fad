"""Plugins that use rospy."""

"""Helpers for plugins that know ROS: completion of topics, trees of messages, types of fields."""

"""The node move_group and its capabilities."""

"""Reloading a plugin with its code: the button R, and --reload-import."""

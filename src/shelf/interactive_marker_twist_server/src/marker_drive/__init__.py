"""A marker that drives."""

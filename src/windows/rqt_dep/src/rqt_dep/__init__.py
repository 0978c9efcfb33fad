"""Packages and their dependencies as a graph."""

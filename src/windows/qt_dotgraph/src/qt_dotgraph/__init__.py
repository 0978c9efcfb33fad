"""Graphs laid out by Graphviz and drawn by Qt."""

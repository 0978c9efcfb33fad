"""Bases of views and renderers, and the raw view."""

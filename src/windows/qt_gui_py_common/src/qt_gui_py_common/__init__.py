"""Widgets and helpers that plugins share."""

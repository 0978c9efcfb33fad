"""Hostile inputs for everything that reads or is told something; see docs/fuzzing.md."""

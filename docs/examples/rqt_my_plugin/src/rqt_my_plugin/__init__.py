"""A plugin for rqt to copy."""

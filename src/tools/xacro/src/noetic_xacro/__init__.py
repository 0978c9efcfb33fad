"""Command line of xacro with errors that name file and line."""

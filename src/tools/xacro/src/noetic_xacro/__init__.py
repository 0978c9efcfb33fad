"""Command line of xacro with errors that name file and line."""
import xacro  # noqa: F401  the module first: it takes functions from noetic_xacro.cli, which in turn needs it complete

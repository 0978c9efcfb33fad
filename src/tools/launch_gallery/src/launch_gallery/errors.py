"""What can go wrong when launch files are shown and measured: one tree, each error one line.

::

    GalleryError
    ├── LaunchError        a launch file that cannot be shown
    └── MeasuringError     there is nothing to command, or the simulation cannot be followed
"""


class GalleryError(RuntimeError):
    """The root; the text is the whole line."""


class LaunchError(GalleryError):
    """A launch file that cannot be shown."""


class MeasuringError(GalleryError):
    """There is nothing to command, or the simulation cannot be followed."""

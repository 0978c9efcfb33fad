"""What can go wrong without a screen: one tree, each error one line that says why and what to do.

::

    OffscreenError
    ├── DisplayError        no display to be had
    └── ScreenshotError     no picture
        ├── RvizCrashed     a signal ended RViz before it had taken the pictures
        └── ViewError       a --view that cannot be understood

launch_gallery's, next door, are ``GalleryError``.
"""


class OffscreenError(RuntimeError):
    """The root; the text is the whole line."""


class DisplayError(OffscreenError):
    """No display to be had."""


class ScreenshotError(OffscreenError):
    """No picture."""


class RvizCrashed(ScreenshotError):
    """A signal ended RViz before it had taken the pictures."""


class ViewError(ScreenshotError, ValueError):
    """A --view that cannot be understood."""

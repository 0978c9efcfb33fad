"""What can go wrong in the window, each as one line for the person in front of it."""


class PluginLoadError(Exception):
    """A plugin cannot be loaded; one line saying which and why."""


class UsageError(Exception):
    """Options that cannot be obeyed; one line saying why."""


class PerspectiveError(Exception):
    """A perspective or its file that cannot be used; one line saying why."""

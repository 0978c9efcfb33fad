"""Of ``pipes``, which Python 3.13 dropped, the function that scripts use."""

from shlex import quote  # noqa: F401

"""What can go wrong, in one line each."""

import contextlib


class AssistantError(ValueError):
    """Bad input or a folder that cannot be written; one line that says what is wrong, where, and what to do."""


@contextlib.contextmanager
def files_told():
    """For a function that looks at files: what the system refuses (no permission, a name that is too long) is an AssistantError."""
    try:
        yield
    except OSError as error:
        raise AssistantError(f"'{error.filename}' cannot be read: {error.strerror}") from error

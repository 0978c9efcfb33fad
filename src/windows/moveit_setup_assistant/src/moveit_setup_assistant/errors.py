"""What can go wrong, in one line each."""


class AssistantError(ValueError):
    """Bad input or a folder that cannot be written; one line that says what is wrong, where, and what to do."""

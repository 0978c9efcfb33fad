"""What is told to the user."""


def counted(number: int, thing: str) -> str:
    """``number`` and the word for it; ``thing`` is its singular."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"

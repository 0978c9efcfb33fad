"""Message authentication codes of a rosbridge server's clients."""

"""Plugin of rqt: a shell in the window."""

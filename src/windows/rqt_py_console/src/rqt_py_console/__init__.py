"""Plugin of rqt: a Python console in the window."""

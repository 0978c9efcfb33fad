"""Plugin of rqt: a web browser in the window."""

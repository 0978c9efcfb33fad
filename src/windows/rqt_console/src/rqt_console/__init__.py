"""Plugin of rqt: shows log messages of all nodes as they come, filtered and coloured."""

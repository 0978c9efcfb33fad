"""Plugin of rqt: sets from which severity on the loggers of a node speak."""

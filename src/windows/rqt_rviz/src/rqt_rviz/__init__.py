"""RViz inside rqt."""

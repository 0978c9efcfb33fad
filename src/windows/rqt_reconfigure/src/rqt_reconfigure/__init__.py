"""Plugin of rqt: edits the parameters of nodes with dynamic_reconfigure servers."""

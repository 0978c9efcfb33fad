"""Plots of topics: the plugin rqt_plot, and its parts for other windows."""

"""Tables of plots: the plugin rqt_multiplot of rqt."""

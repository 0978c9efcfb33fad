"""Shows images of topics: the plugin rqt_image_view, and the conversion of images for other windows."""

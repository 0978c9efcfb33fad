"""Images and plots for rqt_bag."""

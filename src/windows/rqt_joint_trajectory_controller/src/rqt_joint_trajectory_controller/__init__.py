"""Plugin of rqt: moves the joints of a running trajectory controller with sliders."""

"""Plugin of rqt: drives a robot with two sliders or the keyboard."""

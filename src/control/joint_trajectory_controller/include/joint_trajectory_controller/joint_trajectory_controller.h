#error \
    "joint_trajectory_controller is written in Python here: a controller in C++ cannot be derived from it; trajectory_interface is there, and a controller in Python can (joint_trajectory_controller.controller)"

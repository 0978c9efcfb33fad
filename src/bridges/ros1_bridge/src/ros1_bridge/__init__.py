"""ROS 1 and ROS 2 see each other, by upstream's names. ROS 2 is a process of its own (:mod:`ros1_bridge.peer`)."""

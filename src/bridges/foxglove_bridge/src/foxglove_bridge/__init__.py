"""ROS 1 by Foxglove's websocket protocol (https://github.com/foxglove/ws-protocol), which PyPI's foxglove-sdk speaks."""

"""Image topics as a Theora stream: :mod:`.encoder` (free of ROS) and :class:`.publisher.TheoraPublisher`."""

"""What launch files bring up: :mod:`.cli` takes pictures of it, :mod:`.measure` tells how the robot of one drives."""

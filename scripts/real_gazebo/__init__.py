"""What real Gazebo Classic 11.1 does, recorded, and what is done here beside it; the command is scripts/truth."""

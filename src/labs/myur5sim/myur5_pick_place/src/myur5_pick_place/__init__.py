"""The UR5 with its gripper at the table: where things are, and how the block is gripped and put down."""

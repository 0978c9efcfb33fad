"""The gripper action controllers."""

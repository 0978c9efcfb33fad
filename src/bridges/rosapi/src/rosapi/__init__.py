"""Services that tell what the master and its nodes have."""

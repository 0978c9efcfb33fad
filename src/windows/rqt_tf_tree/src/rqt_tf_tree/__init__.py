"""The frames of tf as a tree."""

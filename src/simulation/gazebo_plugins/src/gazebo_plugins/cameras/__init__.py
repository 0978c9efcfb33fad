"""Cameras and what they publish (images, depth, point clouds, camera_info)."""

"""Octomap updaters: :mod:`.depth_image` and :mod:`.point_cloud`."""

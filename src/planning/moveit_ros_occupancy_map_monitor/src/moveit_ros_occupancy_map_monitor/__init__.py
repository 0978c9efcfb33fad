"""The octomap of a planning scene: kept by :mod:`.monitor`, fed by classes derived from :mod:`.updater`."""

"""Scenes, requests, constraints and robot states by name, in a local file: :mod:`.storage`; which file: :mod:`.location`."""

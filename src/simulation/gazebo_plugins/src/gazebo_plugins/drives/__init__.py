"""Plugins that move a model by its wheels, its tracks or its body as a whole (diff drive, skid steer, tricycle, planar move)."""

"""The head of an Axis camera in simulation: its joints follow commands of pan and tilt."""

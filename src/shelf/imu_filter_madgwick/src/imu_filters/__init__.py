"""Orientation of an inertial measurement unit: of its accelerations, turn rates and, if wanted, the earth's magnetic field."""

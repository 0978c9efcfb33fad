"""The force-torque publisher."""

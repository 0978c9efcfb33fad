"""The IMU publisher."""

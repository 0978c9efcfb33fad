"""The types must be those that compiled tools of Noetic speak: same MD5 sums."""

from four_wheel_steering_msgs import msg


def test_messages():
    assert msg.FourWheelSteering._md5sum == "04dd0f55e1f168668af1e2587a7cdd2a"
    assert msg.FourWheelSteeringStamped._md5sum == "9226582df815bc6df9e3206bc05923af"

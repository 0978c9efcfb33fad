"""The wire types are upstream's: a recorded bag or a node built against the original messages must connect."""

from rm_msgs.msg import ActuatorState
from rm_msgs.srv import EnableImuTrigger


def test_checksums_are_upstreams():
    assert ActuatorState._md5sum == "f82106ab641e97268a9e8e29a4b47321"
    assert EnableImuTrigger._md5sum == "1e2c36312701f0610562a77ad6902d8f"

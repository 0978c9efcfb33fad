"""The wire types are upstream's: rqt_rosmon and scripts built against the original messages must connect."""

from rosmon_msgs.msg import NodeState, State
from rosmon_msgs.srv import StartStop


def test_checksums_are_upstreams():
    assert NodeState._md5sum == "87292cdbe5a500a95e32714adf10e6dd"
    assert State._md5sum == "93fe347b2ffed78bbacee05fd2655b2e"
    assert StartStop._md5sum == "a95e7883b3762847035c73ffc86de3ea"

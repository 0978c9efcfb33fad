"""Same checksums as upstream, so that nodes of both can talk."""

import pytest
from arbotix_msgs.msg import Analog, Digital
from arbotix_msgs.srv import Enable, Relax, SetSpeed, SetupChannel


@pytest.mark.parametrize(
    "kind, checksum",
    [
        (Analog, "5760aa9c40c2caa52a04d293094e679d"),
        (Digital, "84d79480c76268c7cdf109dc588e00c4"),
        (Enable, "3ea372bdd9923da8a6c7ae2db934a6cb"),
        (Relax, "d41d8cd98f00b204e9800998ecf8427e"),
        (SetSpeed, "4641bb0523a3557209606d9bd91ce33a"),
        (SetupChannel, "c65e58d8b3b4d406126f6dc829a6011f"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_checksum(kind, checksum):
    assert kind._md5sum == checksum

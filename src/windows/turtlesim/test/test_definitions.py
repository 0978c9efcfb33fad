"""The messages are those that every turtlesim speaks."""

import pytest
from turtlesim import msg, srv


@pytest.mark.parametrize(
    "kind, md5",
    [
        (msg.Pose, "863b248d5016ca62ea2e895ae5265cf9"),
        (msg.Color, "353891e354491c51aabe32df673fb446"),
        (srv.SetPen, "9f452acce566bf0c0954594f69a8e41b"),
        (srv.TeleportAbsolute, "a130bc60ee6513855dc62ea83fcc5b20"),
        (srv.TeleportRelative, "9d5c2dcd348ac8f76ce2a4307bd63a13"),
        (srv.Spawn, "0b2d2e872a8e2887d5ed626f2bf2c561"),
        (srv.Kill, "c1f3d28f1b044c871e6eff2e9fc3c667"),
    ],
)
def test_md5(kind, md5):
    assert kind._md5sum == md5

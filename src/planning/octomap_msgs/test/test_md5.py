"""The types must be those that compiled tools of Noetic speak: same MD5 sums."""

from octomap_msgs import msg, srv

MESSAGES = {"Octomap": "9a45536b45c5e409cd49f04bb2d9999f", "OctomapWithPose": "20b380aca6a508a657e95526cddaf618"}
SERVICES = {"BoundingBoxQuery": "93aa3d73b866f04880927745f4aab303", "GetOctomap": "be9d2869d24fe40d6bc21ac21f6bb2c5"}


def test_sums():
    assert {name: getattr(msg, name)._md5sum for name in MESSAGES} == MESSAGES
    assert {name: getattr(srv, name)._md5sum for name in SERVICES} == SERVICES

"""What RViz asks for at every start is answered without a complaint."""

import os
import subprocess


def test_rospack_knows_the_name(tmp_path):
    asked = subprocess.run(
        ["rospack", "plugins", "--attrib=ogre_media_path", "media_export"],
        capture_output=True,
        text=True,
        env={**os.environ, "ROS_HOME": str(tmp_path)},
    )
    assert (asked.returncode, asked.stderr) == (0, "")

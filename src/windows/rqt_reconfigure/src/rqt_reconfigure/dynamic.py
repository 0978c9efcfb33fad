"""dynamic_reconfigure, imported without its search for manifests from before catkin, which ends in a complaint about rosdep."""

import roslib

_search, roslib.load_manifest = roslib.load_manifest, lambda package: None
try:
    from dynamic_reconfigure.client import Client  # noqa: F401
    from dynamic_reconfigure.encoding import Config  # noqa: F401
finally:
    roslib.load_manifest = _search

"""The one function of ament_index_python that xacro's ``$(find pkg)`` calls, answered from ROS_PACKAGE_PATH."""

from xml.etree.ElementTree import ParseError

import rospkg

_rospack = None


class PackageNotFoundError(KeyError):
    """No package of that name; prints as one plain line."""

    def __str__(self) -> str:
        return str(self.args[0])


def get_package_share_directory(package_name: str) -> str:
    """Directory of a ROS 1 package.

    :raises PackageNotFoundError: naming the package and what to do.
    """
    global _rospack
    if _rospack is None:
        _rospack = rospkg.RosPack()
    try:
        return _rospack.get_path(package_name)
    except rospkg.ResourceNotFound as error:
        raise PackageNotFoundError(
            f"package '{error.args[0]}' not found: is it built, and has its workspace's devel/setup.bash been sourced in this shell?"
        ) from None
    except ParseError as error:
        raise PackageNotFoundError(
            f"package '{package_name}' cannot be looked up: some package.xml on ROS_PACKAGE_PATH is not well-formed "
            f"({error}); `rospack find {package_name}` says which"
        ) from None

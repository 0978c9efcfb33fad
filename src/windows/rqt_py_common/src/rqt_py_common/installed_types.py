"""Which messages, services and actions are installed."""

import functools
import os

import rosmsg
import rospkg

from . import rosaction

MODES = (".msg", ".srv", ".action")


@functools.lru_cache(maxsize=len(MODES))
def installed_types(mode: str) -> dict[str, list[str]]:
    """Package to the names of its types, both sorted. Looks through all packages, which takes a moment, once in a process.

    :param mode: .msg, .srv or .action
    """
    rospack = rospkg.RosPack()
    packages = rosaction.iterate_packages(rospack) if mode == ".action" else rosmsg.iterate_packages(rospack, mode)
    found: dict[str, set] = {}
    for package, folder in packages:
        try:
            names = os.listdir(folder)
        except OSError:
            continue
        found.setdefault(package, set()).update(name[: -len(mode)] for name in names if name.endswith(mode))
    return {package: sorted(names) for package, names in sorted(found.items()) if names}

"""needed_packages.py [--without NAME] NAME...: this workspace's packages that NAMEs need to be built and run, themselves included.

What only tests need is left out; so is what --without names, and what that alone would bring.
"""

import argparse
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def needed_by_code(package):
    """Names of what a package is built with and runs with, in the workspace or not; what only its tests need is left out."""
    return {
        depend.name
        for depend in (
            package.buildtool_depends
            + package.build_depends
            + package.build_export_depends
            + package.buildtool_export_depends
            + package.exec_depends
        )
    }


def needed(names, without=()):
    """
    :return: names of packages, sorted
    :raises KeyError: one of ``names`` is no package of the workspace
    """
    from catkin_pkg.packages import find_packages  # here, so that others can have needed_by_code before anything is installed

    packages = {package.name: package for package in find_packages(str(ROOT / "src")).values()}
    found, waiting = set(), list(names)
    while waiting:
        package = packages[waiting.pop()]
        if package.name not in found:
            found.add(package.name)
            waiting += [name for name in needed_by_code(package) if name in packages and name not in without]
    return sorted(found)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="needed_packages.py", description=__doc__.splitlines()[0])
    parser.add_argument("--without", action="append", default=[], metavar="NAME")
    parser.add_argument("names", nargs="+", metavar="NAME")
    options = parser.parse_args()
    try:
        print("\n".join(needed(options.names, options.without)))
    except KeyError as error:
        parser.error(f"this workspace has no package {error.args[0]}")

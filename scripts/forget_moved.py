"""Removes CMake's notes about packages that have moved: ``python3 scripts/forget_moved.py BUILD_FOLDER``

CMake refuses a build folder whose sources lay elsewhere ("does not match the source used to generate cache"), so that a package that
went from one room of src/ to another could not be built any more where an older build is.
"""

import pathlib
import shutil
import sys

_HOME = "CMAKE_HOME_DIRECTORY:INTERNAL="


def forget_moved(build: pathlib.Path) -> list:
    """Names of the packages whose build folder was removed."""
    names = []
    for cache in sorted(build.glob("*/CMakeCache.txt")):
        lines = cache.read_text(errors="replace").splitlines()
        home = next((line[len(_HOME) :] for line in lines if line.startswith(_HOME)), "")
        if home and not pathlib.Path(home, "CMakeLists.txt").exists():
            shutil.rmtree(cache.parent)
            names.append(cache.parent.name)
    return names


if __name__ == "__main__":
    for moved in forget_moved(pathlib.Path(sys.argv[1])):
        print(f"[setup] {moved} has moved or is gone: it is built anew where it is now")

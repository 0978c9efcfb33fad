"""Which packages a change can break: those it is in, those that need them, and those whose tests use any of these."""

import subprocess
from pathlib import Path

from needed_packages import needed_by_code

ROOT = Path(__file__).resolve().parent.parent
#: what every package is built or run with
FOR_ALL = ("scripts/setup", "scripts/debian-packages.txt", "scripts/requirements.txt", ".catkin_tools/")


class UnknownCommit(Exception):
    """git does not know the commit that a change is to be counted from."""


def workspace(root=ROOT):
    """The packages of src/ and of docs/: {folder relative to ``root``: package}."""
    from catkin_pkg.packages import find_packages  # here: --help must do before anything is installed

    return {Path(place) / folder: package for place in ("src", "docs") for folder, package in find_packages(str(root / place)).items()}


def used_by_tests(package):
    """Names of what only a package's tests need: its ``<test_depend>``, and in ``<export>`` the ``<tests_use>`` of what needs the
    package itself, which would be a circle to catkin."""
    return {depend.name for depend in package.test_depends} | {e.content for e in package.exports if e.tagname == "tests_use"}


def changed_files(commit, root=ROOT):
    """
    Paths relative to ``root`` that are not as in ``commit``: committed since, changed, new or gone.

    :raises UnknownCommit:
    """

    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True)

    since = git("diff", "--name-only", "--no-renames", "-z", commit, "--")
    if since.returncode:
        raise UnknownCommit(f"git cannot compare with {commit}: {since.stderr.splitlines()[0].removeprefix('fatal: ')}")
    new = git("ls-files", "--others", "--exclude-standard", "-z").stdout
    return [Path(name) for name in (since.stdout + new).split("\0") if name]


def breakable(files, packages):
    """
    Names of the packages that a change in ``files`` can break.

    :param files: paths relative to the workspace
    :param packages: as ``workspace`` gives them
    :return: a set of names; all of them where a file of no package can matter to each
    """
    everything = {package.name for package in packages.values()}
    broken = set()
    for path in files:
        owner = next((packages[folder].name for folder in path.parents if folder in packages), None)
        if owner is not None:
            broken.add(owner)
        elif path.parts[0] == "src" or path.as_posix().startswith(FOR_ALL):
            return everything
    while True:
        more = {package.name for package in packages.values() if needed_by_code(package) & broken} - broken
        if not more:
            break
        broken |= more
    return broken | {package.name for package in packages.values() if used_by_tests(package) & broken}

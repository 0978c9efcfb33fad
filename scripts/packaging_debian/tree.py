"""The platform as an installed tree: catkin's install space of everything but the labs, with the PyPI add-ons."""

from __future__ import annotations

import filecmp
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

#: Stands in an installed prefix that scripts/package made.
MARK = "share/noetic_environment/package.xml"


class PackagingError(RuntimeError):
    """Packaging cannot go on; one line, what came before is on the terminal."""


def run(command: list[str], what: str, environment: dict[str, str] = os.environ, cwd: Path = None) -> None:
    """
    :param what: of the error message, "... failed"
    :raises PackagingError: the command ended with an error; its own output is on the terminal
    """
    try:
        code = subprocess.run([str(word) for word in command], env=dict(environment), cwd=cwd).returncode
    except OSError as error:
        raise PackagingError(f"{what} failed: {command[0]}: {error.strerror} (has scripts/setup run?)") from None
    if code:
        raise PackagingError(f"{what} failed (its own message is above)")


def refuse_foreign(prefix: Path) -> None:
    """
    :raises PackagingError: ``prefix`` holds something that was not installed there by this script, or cannot be written
    """
    there = next(folder for folder in (prefix.parent, *prefix.parents) if folder.exists())
    if not there.is_dir() or not os.access(there, os.W_OK):
        raise PackagingError(f"nothing can be written to {there}; run this as root, or name another --prefix")
    if prefix.is_symlink() or prefix.exists() and not prefix.is_dir():
        raise PackagingError(f"{prefix} is there and is no folder; remove it or name another --prefix")
    if not prefix.is_dir() or not any(prefix.iterdir()):
        return
    if not (prefix / MARK).is_file():
        raise PackagingError(f"{prefix} holds another installation; name another --prefix")
    owner = subprocess.run(["dpkg-query", "-S", str(prefix / MARK)], capture_output=True, text=True)
    if owner.returncode == 0:
        raise PackagingError(
            f"{prefix} belongs to the Debian package {owner.stdout.split(':')[0]}; remove that with apt first, or name another --prefix"
        )


def replace(prefix: Path, staged: Path) -> None:
    """``prefix`` becomes a copy of ``staged``; until that is complete, what was there stays in its place."""
    prefix.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=prefix.parent, prefix=f".{prefix.name}.") as name:
        shutil.copytree(staged, Path(name, "new"), symlinks=True)
        if prefix.exists():
            prefix.rename(Path(name, "old"))
        Path(name, "new").rename(prefix)


def platform_packages(root: Path) -> list[Path]:
    """Folders of the catkin packages that are installed: all rooms but the labs."""
    return sorted(path.parent for path in (root / "src").glob("*/*/package.xml") if path.parts[-3] != "labs")


def export_sources(root: Path, to: Path) -> None:
    """src/ and scripts/ as of the last commit (of a folder without git: as they are), so that half an edit is never packaged.

    What has not changed since the last time is not touched, so that it is not compiled again.
    """
    with tempfile.TemporaryDirectory(dir=to.parent) as name:
        new = Path(name)
        if (root / ".git").exists():
            run(["git", "-C", root, "archive", "-o", new / "sources.tar", "HEAD", "src", "scripts"], "git archive")
            run(["tar", "-x", "-C", new, "-f", new / "sources.tar"], "unpacking the last commit")
            (new / "sources.tar").unlink()
        else:
            for folder in ("src", "scripts"):
                shutil.copytree(root / folder, new / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))
        wanted = {path.relative_to(new) for path in new.rglob("*")}
        for path in sorted((path for path in to.rglob("*") if path.relative_to(to) not in wanted), reverse=True):
            path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
        for path in sorted(wanted):
            source, target = new / path, to / path
            if source.is_dir() and not source.is_symlink():
                target.mkdir(parents=True, exist_ok=True)
            elif not _same(source, target):
                target.unlink(missing_ok=True)
                shutil.copy2(source, target, follow_symlinks=False)
                if not target.is_symlink():
                    os.utime(target)


def _same(one: Path, other: Path) -> bool:
    if one.is_symlink() or other.is_symlink() or not other.exists():
        return one.is_symlink() and other.is_symlink() and os.readlink(one) == os.readlink(other)
    return one.stat().st_mode == other.stat().st_mode and filecmp.cmp(one, other, shallow=False)


def build(root: Path, prefix: Path, side_by_side: Sequence[str] = ()) -> Path:
    """Build and install for ``prefix``.

    :param root: top of the clone
    :param prefix: absolute path from which the tree will be used; it is not touched
    :param side_by_side: options of ``catkin build``: how many packages and compilers are at work at a time
    :return: folder whose content belongs into ``prefix``
    :raises PackagingError: a step failed
    """
    work = root / "build" / "platform"
    sources, workspace, stage = work / "sources", work / "workspace", work / "stage"
    sources.mkdir(parents=True, exist_ok=True)
    export_sources(root, sources)
    shutil.rmtree(stage, ignore_errors=True)
    _lay_out(workspace, sources)
    environment = {
        key: value
        for key, value in os.environ.items()
        if key not in ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH", "CPLUS_INCLUDE_PATH")
    }
    environment["PATH"] = f"{sources}/src/tools/noetic_environment/debian_python:/usr/sbin:/usr/bin:/sbin:/bin"
    environment["DESTDIR"] = str(stage)
    run([sys.executable, root / "scripts/forget_moved.py", workspace / "build"], "scripts/forget_moved.py", environment)
    _catkin_build(workspace, prefix, environment, side_by_side)
    tree = stage / prefix.relative_to("/")
    _install_add_ons(tree / "share/noetic_environment/python", sources / "scripts/requirements.txt")
    clean(tree)
    missing = not_installed(sources, tree)
    if missing:
        raise PackagingError(
            f"{len(missing)} files have no install rule in their package's CMakeLists.txt: {', '.join(missing[:5])}"
            + (" ..." if len(missing) > 5 else "")
        )
    return tree


def _catkin_build(workspace: Path, prefix: Path, environment: dict[str, str], side_by_side: Sequence[str]) -> None:
    options = (
        # catkin reads the one name on Debian 12, the other on 13; else it takes the first python3 of this build's own PATH
        "-DPYTHON_EXECUTABLE=/usr/bin/python3",
        "-DPython_EXECUTABLE=/usr/bin/python3",
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG",
        "-DCATKIN_ENABLE_TESTING=OFF",
    )
    made = ["catkin", "config", "--init", "--workspace", workspace, "--install", "--install-space", prefix, "--cmake-args", *options]
    run(made, "catkin config", environment)
    # on a terminal catkin says how many packages of how many are done, and for how long it has been at work
    status = [] if sys.stdout.isatty() else ["--no-status"]
    run(["catkin", "build", "--workspace", workspace, "--no-notify", *status, "--summarize", *side_by_side], "catkin build", environment)


def _lay_out(workspace: Path, sources: Path) -> None:
    """A catkin workspace over the packages of the exported sources."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    (workspace / "src").mkdir(parents=True)
    # else catkin takes the clone around it for the workspace; catkin_tools 0.9.5 wants the inner folder too
    (workspace / ".catkin_tools/profiles").mkdir(parents=True, exist_ok=True)
    for room in sorted({package.parent for package in platform_packages(sources)}):
        (workspace / "src" / room.name).symlink_to(room)


def _install_add_ons(folder: Path, requirements: Path) -> None:
    options = "-q --disable-pip-version-check --root-user-action=ignore --no-deps --require-hashes --no-compile".split()
    run(
        [sys.executable, "-m", "pip", "install", *options, "--target", folder, "-r", requirements],
        "installing the PyPI add-ons",
        {**os.environ, "PYTHONPATH": ""},
    )


def clean(tree: Path) -> None:
    """Take out what a build leaves beside the product and where it was made, and strip libraries."""
    shutil.rmtree(tree / "share/catkin_tools_prebuild", ignore_errors=True)
    shutil.rmtree(tree / "share/noetic_environment/python/bin", ignore_errors=True)
    for path in list(tree.rglob("*")):
        if path.name == "__pycache__":
            shutil.rmtree(path)
        elif path.suffix in (".pyc", ".egg-info") and path.is_file() or path.name.startswith("catkin_tools_prebuild"):
            path.unlink()
        elif path.suffix == ".so" and path.is_file() and not path.is_symlink():
            run(["strip", "--strip-unneeded", path], f"stripping {path.name}")
        elif path.suffix in (".cmake", ".py", ".sh") and path.is_file() and str(tree) in (text := path.read_text(encoding="utf-8")):
            # catkin has sourced this tree for the packages that came later, and would look into it again
            path.write_text(text.replace(f";{tree}/lib", "").replace(str(tree), ""), encoding="utf-8")


#: Folders of a package that are not installed as they stand: tests, C++ sources, stand-ins for libraries, what CMake and catkin handle.
_NOT_INSTALLED = {"test", "core", "bindings", "stand_in", "osmesa", "env-hooks", "cmake", "include", "docs", "rosdep"}
#: What a compiler takes; headers in include/ are CMake's business.
_COMPILED = {".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".proto"}


def not_installed(sources: Path, tree: Path) -> list[str]:
    """Files that a package's install rules forgot: modules, programs, messages and whatever is read at run time."""
    missing = []
    for package in platform_packages(sources):
        share = tree / "share" / package.name
        for path in sorted(path for path in package.rglob("*") if path.is_file()):
            inside = path.relative_to(package)
            places = [share / inside]
            if path.suffix in _COMPILED:
                continue
            if len(inside.parts) == 1:
                if path.suffix not in (".xml", ".yaml", ".launch"):
                    continue
            elif (
                inside.parts[0] in _NOT_INSTALLED
                or inside.parts[0].startswith(".")
                or path.parent.name == "__pycache__"
                or path.name == "README.md"
            ):
                continue
            elif inside.parts[0] == "src":
                places = [tree / "lib/python3/dist-packages" / inside.relative_to("src")]
            elif inside.parts[0] in ("scripts", "nodes", "bin"):
                places = [tree / "lib" / package.name / path.name, tree / "bin" / path.name]
            if not any(place.exists() for place in places):
                missing.append(str(path.relative_to(sources / "src")))
    return missing

"""Debian packages from a tree, and the folder that apt takes for a repository."""

from __future__ import annotations

import gzip
import hashlib
import re
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from .names import sections
from .tree import PackagingError

MAINTAINER = "noetic_labs <noetic-labs@users.noreply.github.com>"
PREFIX = "/opt/ros/noetic"

# Python caches that running programs left, so that removing the package leaves nothing.
POSTINST = f"""#!/bin/sh
set -e
if [ "$1" = configure ]; then
  /usr/bin/python3 -m compileall -q {PREFIX}/lib/python3 {PREFIX}/share/noetic_environment/python || true
fi
"""
PRERM = f"""#!/bin/sh
set -e
find {PREFIX} -depth -name __pycache__ -type d -exec rm -rf {{}} +
"""
# dpkg takes an empty /opt away with the last folder in it; base-files made it, and no package owns it.
POSTRM = """#!/bin/sh
set -e
[ -d /opt ] || install -d -m 755 /opt
"""


@dataclass(frozen=True)
class Release:
    """What all packages of one run share. ``time`` in s since the epoch: of the commit, so that a commit gives the same bytes."""

    version: str
    architecture: str
    time: int

    @classmethod
    def of(cls, root: Path) -> Release:
        """Version from noetic_environment's, the commit's time and the Debian release it is built on: later ones upgrade."""
        number = re.search(r"<version>(.*?)</version>", (root / "src/tools/noetic_environment/package.xml").read_text())[1]
        seconds = int(time.time())
        if (root / ".git").exists():
            seconds = int(_output(["git", "-C", str(root), "log", "-1", "--format=%ct"]))
        stamp = time.strftime("%Y%m%d%H%M%S", time.gmtime(seconds))
        suite = re.search(r'^VERSION_ID="?([\d.]+)', Path("/etc/os-release").read_text(), re.MULTILINE)
        return cls(f"{number}+{stamp}~{'deb' + suite[1] if suite else 'sid'}", _output(["dpkg", "--print-architecture"]), seconds)


def _output(command: list[str], **options) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout.strip()
    except subprocess.CalledProcessError as error:
        raise PackagingError(f"{command[0]} failed: {(error.stderr.strip().splitlines() or ['no message'])[-1]}") from None
    except OSError as error:
        raise PackagingError(f"{command[0]}: {error.strerror} (package dpkg-dev?)") from None


def _library_depends(tree: Path) -> list[str]:
    """Debian packages of the shared libraries that the tree's own libraries need, with versions."""
    libraries = [str(path) for path in tree.rglob("*.so*") if path.is_file() and not path.is_symlink()]
    programs = [
        str(path) for path in (tree / "lib").rglob("*") if path.is_file() and not path.suffix and path.open("rb").read(4) == b"\x7fELF"
    ]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "debian").mkdir()
        (Path(folder) / "debian/control").write_text("Source: noetic-labs\n\nPackage: noetic-labs\nArchitecture: any\n")
        found = _output(["dpkg-shlibdeps", "-O", "--ignore-missing-info", *libraries, *programs], cwd=folder)
    return [entry.strip() for entry in found.partition("shlibs:Depends=")[2].split(",") if entry.strip()]


def _python_range() -> list[str]:
    """The extension modules fit one minor version of Python."""
    major, minor = _output(["/usr/bin/python3", "-c", "import sys; print(*sys.version_info[:2])"]).split()
    return [f"python3 (>= {major}.{minor})", f"python3 (<< {major}.{int(minor) + 1}~)"]


def _wrap(text: str) -> str:
    return "\n".join(f" {line}" for line in text.strip().splitlines())


def _build(
    folder: Path,
    name: str,
    release: Release,
    architecture: str,
    depends: list[str],
    summary: str,
    text: str,
    copyright_text: str,
    recommends: tuple[str, ...] = (),
    suggests: tuple[str, ...] = (),
) -> Path:
    """dpkg-deb of ``folder``, which holds the package's files already."""
    (folder / "DEBIAN").mkdir(exist_ok=True)
    about = folder / "usr/share/doc" / name
    about.mkdir(parents=True, exist_ok=True)
    (about / "copyright").write_text(copyright_text)
    size = sum(path.lstat().st_size for path in folder.rglob("*") if path.is_file()) // 1024 + 1
    fields = {
        "Package": name,
        "Version": release.version,
        "Architecture": architecture,
        "Maintainer": MAINTAINER,
        "Installed-Size": str(size),
        "Depends": ", ".join(depends),
        "Recommends": ", ".join(recommends),
        "Suggests": ", ".join(suggests),
        "Section": "science",
        "Priority": "optional",
        "Description": f"{summary}\n{_wrap(text)}",
    }
    (folder / "DEBIAN/control").write_text("".join(f"{key}: {value}\n" for key, value in fields.items() if value))
    for path in [folder, *folder.rglob("*")]:
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o111 else 0o644)
    deb = folder.parent / f"{name}_{release.version}_{architecture}.deb"
    _output(
        ["dpkg-deb", "--root-owner-group", "-Zxz", "-z3", "--build", str(folder), str(deb)],
        env={"SOURCE_DATE_EPOCH": str(release.time), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C.UTF-8"},
    )
    shutil.rmtree(folder)
    return deb


def platform(tree: Path, root: Path, release: Release) -> Path:
    """The package noetic-labs with all files."""
    folder = tree.parents[2].parent / "debs" / "noetic-labs"
    shutil.rmtree(folder.parent, ignore_errors=True)
    (folder / "DEBIAN").mkdir(parents=True)
    for name, text in (("postinst", POSTINST), ("prerm", PRERM), ("postrm", POSTRM)):
        (folder / "DEBIAN" / name).write_text(text)
        (folder / "DEBIAN" / name).chmod(0o755)
    shutil.copytree(tree, folder / PREFIX.lstrip("/"), symlinks=True)
    copyright_text = (root / "LICENSE").read_text() + _add_on_licences(tree)
    _copy_licences(tree, folder / "usr/share/doc/noetic-labs/licences")
    return _build(
        folder,
        "noetic-labs",
        release,
        release.architecture,
        [*_python_range(), *sections(root, "demo", "run"), *_library_depends(tree)],
        "ROS 1 Noetic's other half: simulator, controllers, xacro, planning",
        "What Debian's ROS packages lack to run packages written for ROS Noetic, Gazebo Classic and ros_control,\n"
        f"under the same names, in {PREFIX}. In a new shell: source {PREFIX}/setup.bash",
        copyright_text,
        tuple(sections(root, "windows")),
        ("ros-noetic-desktop-full",),
    )


def _add_on_licences(tree: Path) -> str:
    """What the PyPI add-ons say of their licences."""
    lines = [f"\n\nIn {PREFIX}/share/noetic_environment/python, each under its own licence, with the texts in licences beside this file:\n"]
    for metadata in sorted((tree / "share/noetic_environment/python").glob("*.dist-info/METADATA")):
        head = metadata.read_text().split("\n\n")[0].splitlines()
        fields = dict(line.split(": ", 1) for line in head if ": " in line)
        licence = fields.get("License") or fields.get("License-Expression") or "see its dist-info folder"
        lines.append(f"  {fields['Name']} {fields['Version']}: {licence.splitlines()[0][:100]}\n")
    return "".join(lines)


_LICENCE = re.compile(r"(LICEN[CS]E|COPYING|NOTICE|AUTHORS)", re.IGNORECASE)


def _copy_licences(tree: Path, target: Path) -> None:
    """The licence texts of the PyPI add-ons, a folder for each."""
    for information in sorted((tree / "share/noetic_environment/python").glob("*.dist-info")):
        for text in sorted(path for path in information.rglob("*") if path.is_file() and _LICENCE.match(path.name)):
            place = target / information.name.partition("-")[0] / "_".join(text.relative_to(information).parts)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(text, place)


KEYRING = "noetic-labs.gpg"


def known_key(key: str) -> str:
    """The fingerprint of a secret key of this user.

    :raises PackagingError: there is none, or no gpg
    """
    if not shutil.which("gpg"):
        raise PackagingError("--sign needs gpg: sudo apt install gnupg")
    try:
        lines = _output(["gpg", "--batch", "--with-colons", "--list-secret-keys", key]).splitlines()
    except PackagingError:
        lines = []
    found = [line.split(":")[9] for line in lines if line.startswith("fpr:")]
    if not found:
        raise PackagingError(f"gpg has no secret key '{key}'; gpg --list-secret-keys shows those that it has")
    return found[0]


def sign(index: Path, key: str) -> None:
    """Signs the index of the repository, and writes the public key beside it, in the form that apt's ``signed-by`` takes.

    :param key: of :func:`known_key`
    """
    ours = ["gpg", "--batch", "--yes", "--local-user", key]
    _output([*ours, "--clearsign", "--output", str(index / "InRelease"), str(index / "Release")])
    _output([*ours, "--armor", "--detach-sign", "--output", str(index / "Release.gpg"), str(index / "Release")])
    _output(["gpg", "--batch", "--yes", "--output", str(index / KEYRING), "--export", key])


def name_only(name: str, depends: list[str], stands_for: str, release: Release) -> Path:
    """A package without files that brings what an upstream name stands for."""
    folder = Path(tempfile.mkdtemp()) / name
    folder.mkdir()
    return _build(
        folder,
        name,
        release,
        "all",
        [f"noetic-labs (= {release.version})", *dict.fromkeys(depends)],
        f"name for {stands_for}"[:79],
        f"Depends on {stands_for}.\nIt has no files of its own.",
        "Made by noetic_labs; BSD-3-Clause, see /usr/share/doc/noetic-labs/copyright.\n",
    )


def repository(made: list[Path], out: Path) -> Path:
    """Move the packages into ``out`` and write the index there; older ones of ours in it go.

    :return: ``out``
    """
    out.mkdir(parents=True, exist_ok=True)
    for old in [*out.glob("*.deb"), *out.glob("Packages*"), *(out / name for name in ("Release", "InRelease", "Release.gpg", KEYRING))]:
        old.unlink(missing_ok=True)
    for deb in made:
        shutil.move(str(deb), out / deb.name)
    index = _output(["dpkg-scanpackages", "--multiversion", "."], cwd=out) + "\n"
    (out / "Packages").write_text(index)
    (out / "Packages.gz").write_bytes(gzip.compress(index.encode(), mtime=0))
    sums = "".join(
        f" {hashlib.sha256((out / name).read_bytes()).hexdigest()} {(out / name).stat().st_size} {name}\n"
        for name in ("Packages", "Packages.gz")
    )
    date = time.strftime("%a, %d %b %Y %H:%M:%S UTC", time.gmtime())
    (out / "Release").write_text(
        "Origin: noetic_labs\nLabel: noetic_labs\nSuite: local\n"
        f"Architectures: all {_output(['dpkg', '--print-architecture'])}\nDate: {date}\nSHA256:\n{sums}"
    )
    return out

"""What runs on a node of a cluster: the look at whether it is fit, and one examination. Knows no Ray."""

from __future__ import annotations

import hashlib
import importlib.util
import os
import pathlib
import shutil
import signal
import socket
import sys

from ..isolation import sandbox, temporary_folders
from ..isolation.supervise import descendants
from . import packed_files
from .engines import How, examine

_PACKAGES = ("lab_check", "ode_sim", "gazebo_ros", "gazebo_ros_control", "controller_manager", "node_signals")


def platform_version() -> str:
    """Of the sources on which marks depend, and of Debian: two machines with the same one give the same marks."""
    digest = hashlib.sha256()
    for package in _PACKAGES:
        found = importlib.util.find_spec(package)
        for folder in sorted(set(found.submodule_search_locations or ())) if found else ():
            for file in sorted(pathlib.Path(folder).rglob("*.py")):
                if "/devel/" not in f"{file}":  # catkin's relay, which has the paths of its machine
                    digest.update(f"{file.relative_to(folder)}\0".encode() + file.read_bytes())
    try:
        digest.update(pathlib.Path("/etc/debian_version").read_bytes().split(b".")[0])
    except OSError:
        pass
    return f"{digest.hexdigest()[:12]} on Python {sys.version_info[0]}.{sys.version_info[1]}"


def faults(version: str, unsafe: bool, sent: bytes = b"") -> tuple[str, list[str], bytes]:
    """The name of this machine, and what keeps it from examining: a sentence each, with the cure.

    :param version: of noetic_labs where grade runs. :param unsafe: no sandbox is needed
    :param sent: comes back; what cannot be sent there and back would fail in each examination
    """
    said = []
    mine = platform_version()
    if mine != version:
        said.append(f"its noetic_labs is another than where grade runs ({mine}, not {version}): install the same version on both")
    try:
        sandbox.Platform.here()
        if not unsafe:
            sandbox.check()
    except sandbox.SandboxError as error:
        said.append(str(error))
    if shutil.disk_usage(temporary_folders.top()).free < 500e6:
        said.append(f"less than 500 MB are free in {temporary_folders.top()}")
    return socket.gethostname(), said, sent


def examine_parcel(name: str, submission: bytes, spec: bytes, spec_path: str, how: How, worker: int) -> tuple[int, bytes]:
    """One examination in a folder of its own.

    :param name: of the submission's file or folder
    :param submission, spec: what ``packed_files`` made of them; ``spec_path`` is the spec's file in the latter
    :param how: what ``check`` is told. :param worker: its number on this machine
    :returns: exit code of ``check``; its reports, packed
    """
    with temporary_folders.folder("lab_check_node.") as folder:
        packed_files.unpack(submission, folder / "submission")
        packed_files.unpack(spec, folder / "spec")
        out = folder / "out"
        process = examine(how.words(folder / "spec" / spec_path, folder / "submission" / name, out, worker), out)
        try:
            code = process.wait()
            return code, packed_files.pack(out)
        finally:
            for pid in descendants(process.pid) if process.poll() is None else ():
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    continue

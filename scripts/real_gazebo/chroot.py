"""Real Gazebo Classic 11.1: Debian 11's packages in a folder of their own, and scenes run in it."""

from __future__ import annotations

import gzip
import os
import shutil
import socket
import subprocess
import tempfile
from collections.abc import Iterable

from real_gazebo.records import path_of
from real_gazebo.scene import Scene

HERE = os.path.dirname(os.path.abspath(__file__))
MIRROR = "http://deb.debian.org/debian"
SOURCES = ("build_recorder.sh", "recorder.cc", "deeds.hh", "sensor_rows.hh", "timing.hh")
PACKAGES = ("gazebo", "libgazebo-dev", "g++", "pkg-config")
_KEYRING = "/usr/share/keyrings/debian-archive-keyring.gpg"
_ATTEMPTS = 3  # a server whose port was taken or that did not come up is started again


class ChrootError(Exception):
    """One line that says what is missing and what to do."""


def default_folder() -> str:
    return os.environ.get("TRUTH_CHROOT") or os.path.expanduser("~/.cache/real_gazebo")


def installed(folder: str) -> bool:
    return os.path.exists(os.path.join(folder, "usr/bin/gzserver"))


def make(folder: str) -> None:
    """Debian 11 with Gazebo and its headers: 2.7 GB, a few minutes. Nothing is done where it is there already."""
    if not installed(folder):
        if os.geteuid() or not shutil.which("debootstrap"):
            raise ChrootError("the chroot is made by root with debootstrap: sudo apt-get install debootstrap, then run this with sudo")
        if not os.path.exists(os.path.join(folder, "etc/debian_version")):
            _run(["debootstrap", "--variant=minbase", f"--keyring={_KEYRING}", "bullseye", folder, MIRROR])
        if os.path.exists("/etc/resolv.conf"):
            shutil.copy("/etc/resolv.conf", os.path.join(folder, "etc/resolv.conf"))
        _run(
            [
                "chroot",
                folder,
                "sh",
                "-c",
                "export DEBIAN_FRONTEND=noninteractive; apt-get update -q && "
                "apt-get install -y -q --no-install-recommends " + " ".join(PACKAGES),
            ]
        )
    build_recorder(folder)


def build_recorder(folder: str) -> None:
    """Compile `recorder.cc` within the chroot, if it is newer than what was compiled."""
    place = os.path.join(folder, "truth")
    os.makedirs(place, exist_ok=True)
    sources, library = [os.path.join(HERE, name) for name in SOURCES], os.path.join(place, "librecorder.so")
    if os.path.exists(library) and os.path.getmtime(library) > max(map(os.path.getmtime, sources)):
        return
    for source in sources:
        shutil.copy(source, place)
    _run(["chroot", folder, "sh", "/truth/build_recorder.sh", "/truth", "/truth"])


def _run(command: list[str]) -> None:
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise ChrootError(f"{' '.join(command[:4])} ...: {done.stdout.strip().splitlines()[-1] if done.stdout.strip() else 'failed'}")


def write_scene(scene: Scene, place: str, folder: str, plugin: str) -> None:
    """World and files of a scene in `place`, which the simulator knows as `folder`."""
    os.makedirs(place, exist_ok=True)
    for name, content in scene.files.items():
        path = os.path.join(place, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
    world = scene.world_for(folder).replace("</world>", plugin.replace("{folder}", folder) + "</world>", 1)
    with open(os.path.join(place, "scene.world"), "w", encoding="utf-8") as file:
        file.write(world)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def environment(place: str) -> dict:
    """Of a server in the chroot: its own master, no model database, our plugin, models of the scene."""
    return {
        "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
        "HOME": "/root",
        "GAZEBO_MODEL_DATABASE_URI": "",
        "GAZEBO_MASTER_URI": f"http://127.0.0.1:{free_port()}",
        "GAZEBO_IP": "127.0.0.1",
        "GAZEBO_PLUGIN_PATH": "/truth:/usr/lib/x86_64-linux-gnu/gazebo-11/plugins",
        "GAZEBO_RESOURCE_PATH": "/usr/share/gazebo-11",
        "GAZEBO_MODEL_PATH": place,
        "LC_ALL": "C",
        "TRUTH_OUT": place + "/out.csv",
    }


def record(scene: Scene, folder: str, limit: float = 240.0) -> str:
    """Run one scene in real Gazebo; gives the rows' text.

    :raises ChrootError: it did not come to its end.
    """
    os.makedirs(os.path.join(folder, "truth"), exist_ok=True)
    place = tempfile.mkdtemp(prefix="scene", dir=os.path.join(folder, "truth"))
    inside = "/truth/" + os.path.basename(place)
    try:
        write_scene(scene, place, inside, scene.plugin())
        said = ""
        for _ in range(_ATTEMPTS):
            try:
                done = subprocess.run(
                    ["chroot", folder, "gzserver", "-u", "--verbose", inside + "/scene.world"],
                    env=environment(inside),
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    timeout=limit,
                    text=True,
                    errors="replace",
                )
                said = done.stdout
            except subprocess.TimeoutExpired as late:
                said = str(late.stdout or "")
            out = os.path.join(place, "out.csv")
            if os.path.exists(out):
                with open(out, encoding="utf-8") as file:
                    rows = file.read()
                if "\nend," in rows:
                    return rows
        raise ChrootError(f"{scene.name}: real Gazebo did not finish it; its last words: {' | '.join(said.strip().splitlines()[-4:])}")
    finally:
        shutil.rmtree(place, ignore_errors=True)


def save(scene: Scene, rows: str) -> None:
    os.makedirs(os.path.dirname(path_of(scene.name)), exist_ok=True)
    with gzip.GzipFile(path_of(scene.name), "wb", compresslevel=9, mtime=0) as file:
        file.write(f"# {scene.digest()} {scene.name}: real Gazebo Classic 11.1.0, Debian 11\n{rows}".encode())


def record_all(scenes: Iterable[Scene], folder: str, tell=print) -> list[str]:
    """Record scenes one after the other; gives the names of those that failed."""
    failed = []
    for scene in scenes:
        try:
            save(scene, record(scene, folder))
            tell(f"{scene.name}: {os.path.getsize(path_of(scene.name))} bytes")
        except ChrootError as error:
            failed.append(scene.name)
            tell(str(error))
    return failed

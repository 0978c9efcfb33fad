"""Where a submission's processes run: bubblewrap's namespaces round each, one private network and one small disk round all.

Two walls. The outer one (:func:`outer_words`, util-linux's unshare) holds the examiner, the ROS master and everything else of one
submission: own processes, own loopback, own mounts; it dies as one. The inner one (:func:`inner_words`, bwrap) holds each program of
the submission: it sees Debian's /usr and the platform, read-only, and its own home, which lies on a tmpfs of bounded size. The labs'
solutions, specs, other submissions and the teacher's files are not there at all.
"""
from __future__ import annotations

import ctypes
import fcntl
import os
import pathlib
import shutil
import socket
import struct
import subprocess
from dataclasses import dataclass
from typing import Dict, List

from .errors import LabError

HOME = "/home/student"
UNSAFE, BUBBLEWRAP = "none (--unsafe)", "bubblewrap"


_CLONE_NEWNET = 0x40000000
_CONNECTIONS = 512  # entries in the kernel's table of connections


class SandboxError(LabError, RuntimeError):
    """This machine cannot shut a submission in; one sentence with the remedy."""


@dataclass(frozen=True)
class Platform:
    """``prefixes`` are what CMAKE_PREFIX_PATH names, ``roots`` the folders that hold them and their sources."""

    prefixes: List[str]
    roots: List[str]
    hidden: List[str]

    @classmethod
    def here(cls) -> Platform:
        """
        :raises SandboxError: no workspace is sourced
        """
        prefixes = [p for p in os.environ.get("CMAKE_PREFIX_PATH", "").split(":") if os.path.isfile(os.path.join(p, "setup.bash"))]
        if not prefixes:
            raise SandboxError("no workspace is sourced; run: source devel/setup.bash")
        roots, hidden = [], []
        for prefix in prefixes:
            root = os.path.dirname(prefix) if os.path.basename(prefix) in ("devel", "install") else prefix
            roots.append(root)
            labs = pathlib.Path(root, "src", "labs")
            if labs.is_dir():  # solutions
                names = [manifest.parent.name for manifest in labs.rglob("package.xml")]
                hidden += [str(labs)] + [os.path.join(prefix, part, name) for part in ("share", "lib", ".private") for name in names]
            hidden += [os.path.join(root, part) for part in ("out", "build", ".git", "logs", "src/teaching/lab_check/specs",
                                                             "src/teaching/lab_check/test")]
            hidden.append(os.path.join(prefix, "share/lab_check/specs"))
        return cls(prefixes, roots, [place for place in dict.fromkeys(hidden) if os.path.isdir(place) and not os.path.islink(place)])


def outer_words() -> List[str]:
    """Before the examiner: everything in it ends with it."""
    return ["unshare", "--user", "--map-root-user", "--net", "--mount", "--pid", "--fork", "--mount-proc", "--kill-child"]


def own_network() -> None:
    """Brings up a loopback for this process and its children, who are inside the outer wall.

    The kernel walks its whole table of connections whenever somebody reads /proc/net/tcp, which the lock-step does thousands of times;
    the usual table has 262144 entries and takes 3 ms. A network with a small table of its own (Linux 6.1) takes 0.1 ms. And who only
    listens confirms what came 40 ms later; the lock-step would wait for that in each quantum, so it is confirmed at once.
    """
    try:
        pathlib.Path("/proc/sys/net/ipv4/tcp_child_ehash_entries").write_text(str(_CONNECTIONS))
        ctypes.CDLL(None).unshare(_CLONE_NEWNET)
    except OSError:  # an older kernel: slower, else the same
        pass
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        request = bytearray(struct.pack("16sh22x", b"lo", 0))
        fcntl.ioctl(s, 0x8913, request)  # SIOCGIFFLAGS
        (flags,) = struct.unpack_from("h", request, 16)
        fcntl.ioctl(s, 0x8914, struct.pack("16sh22x", b"lo", flags | 1))  # SIOCSIFFLAGS, IFF_UP
    if shutil.which("ip"):
        loopback = "127.0.0.1 dev lo table local proto kernel scope host src 127.0.0.1"
        subprocess.run(["ip", "route", "change", "local", *loopback.split(), "quickack", "1"], check=False)


def inner_words(platform: Platform, home: str, environment: Dict[str, str]) -> List[str]:
    """Before a program of the submission.

    :param home: the folder that is its home; the only one that it can write to, beside a small /tmp
    """
    words = ["bwrap", "--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try", "--die-with-parent",
             "--new-session", "--hostname", "lab", "--uid", "1000", "--gid", "1000", "--cap-drop", "ALL",
             "--ro-bind", "/usr", "/usr"]
    for link in ("bin", "sbin", "lib", "lib32", "lib64", "libx32"):
        if os.path.islink(f"/{link}"):
            words += ["--symlink", os.readlink(f"/{link}"), f"/{link}"]
        elif os.path.isdir(f"/{link}"):
            words += ["--ro-bind", f"/{link}", f"/{link}"]
    for path in ("alternatives", "ros", "ld.so.cache", "ld.so.conf", "ld.so.conf.d", "fonts", "sgml", "xml", "ssl/certs", "python3",
                 "python3.11", "python3.13", "debian_version", "os-release", "lsb-release", "OpenCL", "glvnd", "localtime", "catkin"):
        words += ["--ro-bind-try", f"/etc/{path}", f"/etc/{path}"]
    words += ["--dev", "/dev", "--proc", "/proc", "--size", "100000000", "--tmpfs", "/tmp", "--size", "64000000", "--tmpfs", "/run"]
    for root in platform.roots:
        words += ["--ro-bind", root, root]
    for place in platform.hidden:
        words += ["--size", "4096", "--perms", "0555", "--tmpfs", place]
    words += ["--bind", home, HOME, "--chdir", HOME, "--clearenv"]
    for passwd, text in (("passwd", "student:x:1000:1000::/home/student:/bin/bash\n"), ("group", "student:x:1000:\n"),
                         ("hosts", "127.0.0.1 localhost lab\n"), ("nsswitch.conf", "passwd: files\ngroup: files\nhosts: files\n")):
        file = pathlib.Path(home).parent / f"etc_{passwd}"
        if not file.exists():
            file.write_text(text)
        words += ["--ro-bind", str(file), f"/etc/{passwd}"]
    for name, value in environment.items():
        words += ["--setenv", name, value]
    return words + ["--"]


def environment(port: int, home: str = HOME) -> Dict[str, str]:
    """What a program of the submission finds in its environment; nothing of the teacher's."""
    return {"HOME": home, "USER": "student", "LOGNAME": "student", "SHELL": "/bin/bash", "LANG": "C.UTF-8", "TERM": "dumb",
            "PATH": "/usr/local/bin:/usr/bin:/bin", "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost",
            "ROS_HOME": f"{home}/.ros", "PYTHONUNBUFFERED": "1", "PYTHONDONTWRITEBYTECODE": "1", "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
            "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DISPLAY": "", "QT_QPA_PLATFORM": "offscreen", "PYTHONHASHSEED": "0"}


def check() -> None:
    """
    :raises SandboxError: a tool is missing, or the kernel refuses the namespaces
    """
    for tool, package in (("bwrap", "bubblewrap"), ("unshare", "util-linux")):
        if not shutil.which(tool):
            raise SandboxError(f"{tool} is not installed, which shuts submissions in: sudo apt install {package}; or --unsafe, for code "
                               "that you trust")
    inner = ["bwrap", "--unshare-user", "--unshare-pid", "--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev", "true"]
    done = subprocess.run(outer_words() + inner, capture_output=True, text=True)
    if done.returncode:
        why = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        raise SandboxError(f"this machine does not allow the namespaces that shut submissions in ({why}). In Docker: --privileged, or a "
                           "seccomp profile that allows them; or --unsafe, for code that you trust as your own")

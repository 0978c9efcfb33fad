"""Where a submission's processes run: bubblewrap's namespaces round each, one private network and one small disk round all.

Two walls. The outer one (:func:`shut_in`, util-linux's unshare) holds the examiner, the ROS master and everything else of one
submission: own processes, own loopback, own mounts; it dies as one. The inner one (:func:`inner_words`, bwrap) holds each program of
the submission: it sees Debian's /usr and the platform, read-only, and its own home, which lies on a tmpfs of bounded size. The labs'
solutions, specs, other submissions and the teacher's files are not there at all.

Where root examines, the programs of the submission have a user of their own, to whom nothing belongs on this machine: root's own files,
those below /proc and /sys above all, are open to whoever is root's user outside of the walls, whatever he is called inside.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import pathlib
import secrets
import shutil
import socket
import stat
import struct
import subprocess
import sys
import time
from dataclasses import dataclass
from typing import Any

from ..errors import LabError
from . import control_group, syscalls

HOME = "/home/student"
UNSAFE, BUBBLEWRAP = "none (--unsafe)", "bubblewrap"
STUDENT = 1000  # inside the outer wall, where root examines
# Of the machine, for STUDENT: systemd keeps these for users that live as long as one program; nothing belongs to them, and a container has
# them, too.
_USERS = range(61184, 65520)
_BORN = 20.0  # s in which a process has to reach its user namespace

_CLONE_NEWNET = 0x40000000
_CONNECTIONS = 512  # entries in the kernel's table of connections
_OWN = 32_000_000  # bytes of the checker's own files in there
_MOST_FILES = 200_000  # of a submission, with what its programs write


class SandboxError(LabError, RuntimeError):
    """This machine cannot shut a submission in; one sentence with the remedy."""


@dataclass(frozen=True)
class Platform:
    """``prefixes`` are what CMAKE_PREFIX_PATH names, ``roots`` the folders that hold them and their sources."""

    prefixes: list[str]
    roots: list[str]
    hidden: list[str]

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
            hidden += [
                os.path.join(root, part)
                for part in ("out", "build", ".git", "logs", "src/teaching/lab_check/specs", "src/teaching/lab_check/test")
            ]
            hidden.append(os.path.join(prefix, "share/lab_check/specs"))
        return cls(prefixes, roots, [place for place in dict.fromkeys(hidden) if os.path.isdir(place) and not os.path.islink(place)])


def outer_words() -> list[str]:
    """Before the examiner: everything in it ends with it. It waits for a line on its standard input, see :func:`shut_in`."""
    # Whoever becomes root by a mapping loses the wish to end with its parent: setpriv renews it.
    inside = ["setpriv", "--pdeathsig", "KILL", "unshare", "--net", "--mount", "--pid", "--fork", "--mount-proc", "--kill-child"]
    return ["unshare", "--user", "sh", "-c", 'read -r mapped && exec "$@" < /dev/null', "sh", *inside]


def shut_in(words: list[str], **streams: Any) -> subprocess.Popen:
    """Starts ``words`` behind the outer wall, as its root.

    :param streams: for ``subprocess.Popen``, without stdin
    """
    process = subprocess.Popen(outer_words() + words, stdin=subprocess.PIPE, **streams)
    try:
        if _has_own_users(process):
            _map_users(process.pid)
        assert process.stdin is not None
        process.stdin.write(b"mapped\n")
        process.stdin.close()
    except OSError:  # it ended: its exit code and its last line tell why
        pass
    return process


def _has_own_users(process: subprocess.Popen) -> bool:
    """It is in its user namespace; False when it ended before."""
    mine, end = os.readlink("/proc/self/ns/user"), time.monotonic() + _BORN
    while process.poll() is None and time.monotonic() < end:
        try:
            if os.readlink(f"/proc/{process.pid}/ns/user") != mine:
                return True
        except OSError:
            pass
        time.sleep(0.001)
    return False


def _map_users(pid: int) -> None:
    """Inside, root is who examines; where that is root, STUDENT is a user that the machine does not know."""
    place, number = pathlib.Path("/proc", str(pid)), _USERS[secrets.randbelow(len(_USERS))]
    if os.getuid() == 0:
        try:
            for kind in ("uid", "gid"):
                (place / f"{kind}_map").write_text(f"0 0 1\n{STUDENT} {number} 1\n")
            return
        except OSError:  # root of a container that knows no such users, and so not root of the machine
            pass
    (place / "setgroups").write_text("deny")
    for kind, mine in (("uid", os.getuid()), ("gid", os.getgid())):
        file = place / f"{kind}_map"
        if not file.read_text().strip():
            file.write_text(f"0 {mine} 1\n")


def student() -> int:
    """Number of the submission's user, inside the outer wall: STUDENT, or 0 where there is none of its own."""
    mapped = [line.split()[0] for line in pathlib.Path("/proc/self/uid_map").read_text().splitlines()]
    return STUDENT if str(STUDENT) in mapped else 0


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


_ALONE = (
    "bwrap --unshare-user --disable-userns --unshare-pid --unshare-ipc --unshare-uts --unshare-cgroup-try --die-with-parent "
    "--new-session --hostname lab --uid 1000 --gid 1000 --cap-drop ALL --ro-bind /usr /usr"
)
_OF_ETC = (
    "alternatives ros ld.so.cache ld.so.conf ld.so.conf.d fonts sgml xml ssl/certs python3 python3.11 python3.13 debian_version "
    "os-release lsb-release OpenCL glvnd localtime catkin"
)


def inner_words(platform: Platform, world: str, place: str, environment: dict[str, str], filter_fd: int) -> list[str]:
    """Before a program of the submission.

    :param world: the folder of :func:`.examination.job.Job.scratch`: home, the platform's roots where the program's user can reach them
    :param place: of this program alone, with folders ``tmp``, ``run`` and ``shm``; with its home the only ones that it can write to
    :param environment: all that it finds in its own
    :param filter_fd: a file that holds :func:`lab_check.isolation.syscalls.program`
    """
    words = _ALONE.split()
    words += ["--seccomp", str(filter_fd)] if os.fstat(filter_fd).st_size else []
    for link in ("bin", "sbin", "lib", "lib32", "lib64", "libx32"):
        if os.path.islink(f"/{link}"):
            words += ["--symlink", os.readlink(f"/{link}"), f"/{link}"]
        elif os.path.isdir(f"/{link}"):
            words += ["--ro-bind", f"/{link}", f"/{link}"]
    for path in _OF_ETC.split():
        words += ["--ro-bind-try", f"/etc/{path}", f"/etc/{path}"]
    words += ["--dev", "/dev", "--bind", f"{place}/shm", "/dev/shm", "--remount-ro", "/dev", "--proc", "/proc"]
    for path in _SHUT:
        if os.path.exists(path):
            words += ["--ro-bind", path, path]
    words += ["--bind", f"{place}/tmp", "/tmp", "--bind", f"{place}/run", "/run"]
    for number, root in enumerate(platform.roots):
        words += ["--ro-bind", f"{world}/roots/{number}", root]
    for hidden in platform.hidden:
        words += ["--size", "4096", "--perms", "0555", "--tmpfs", hidden, "--remount-ro", hidden]
    words += ["--bind", f"{world}/home", HOME]
    for name in _FILES:
        words += ["--ro-bind", f"{world}/etc/{name}", f"/etc/{name}"]
    words += ["--remount-ro", "/", "--chdir", HOME, "--clearenv"]
    for name, value in environment.items():
        words += ["--setenv", name, value]
    return words + ["--"]


# Below /proc, of the whole machine or of the network that the examiner shares; what else is there belongs to the program's own processes.
_SHUT = (
    "/proc/sys",
    "/proc/sysrq-trigger",
    "/proc/irq",
    "/proc/bus",
    "/proc/fs",
    "/proc/acpi",
    "/proc/scsi",
    "/proc/asound",
    "/proc/mtrr",
    "/proc/driver",
    "/proc/pressure",
    "/proc/timer_list",
    "/proc/kcore",
    "/proc/kmsg",
    "/proc/sched_debug",
)
_FILES = {
    "passwd": "student:x:1000:1000::/home/student:/bin/bash\n",
    "group": "student:x:1000:\n",
    "hosts": "127.0.0.1 localhost lab\n",
    "nsswitch.conf": "passwd: files\ngroup: files\nhosts: files\n",
}


def make_world(platform: Platform, world: str, size: int, user: int) -> None:
    """Fills ``world``, inside the outer wall: a disk of bounded size that nobody else sees, with all that programs of the submission see.

    :param size: bytes of all that they write, memory that has the form of files included
    :param user: theirs, inside the outer wall
    :param platform: whose roots are mounted there
    """
    options = f"size={size},nr_inodes={_MOST_FILES},mode=0755,nosuid,nodev"
    subprocess.run(["mount", "-t", "tmpfs", "-o", options, "lab_check", world], check=True)
    for name, text in _FILES.items():
        file = pathlib.Path(world, "etc", name)
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        file.chmod(0o644)
    for number, root in enumerate(platform.roots):
        place = pathlib.Path(world, "roots", str(number))
        place.mkdir(parents=True)
        subprocess.run(["mount", "--rbind", root, str(place)], check=True)
    own = checkers_own(world)
    own.mkdir(mode=0o700)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={_OWN},mode=0700,nosuid,nodev", "lab_check", str(own)], check=True)
    filter_file(world).write_bytes(syscalls.program())
    own_folder(pathlib.Path(world, "home"), user)


def checkers_own(world: str | os.PathLike) -> pathlib.Path:
    """The folder in ``world`` for what the checker writes down meanwhile: the submission's disk may be full."""
    return pathlib.Path(world, "checker")


def filter_file(world: str | os.PathLike) -> pathlib.Path:
    """The file in ``world`` with the system calls that are refused."""
    return pathlib.Path(world, "system_calls")


def own_folder(path: pathlib.Path, user: int) -> None:
    """Make ``path``, a new folder of the submission's ``user``."""
    path.mkdir(parents=True)
    os.chown(path, user, user)


def environment(port: int, home: str = HOME) -> dict[str, str]:
    """What a program of the submission finds in its environment; nothing of the teacher's.

    :param port: of the ROS master. :param home: as the program sees it
    """
    return {
        "HOME": home,
        "USER": "student",
        "LOGNAME": "student",
        "SHELL": "/bin/bash",
        "LANG": "C.UTF-8",
        "TERM": "dumb",
        "PATH": "/usr/local/bin:/usr/bin:/bin",
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOSTNAME": "localhost",
        "ROS_HOME": f"{home}/.ros",
        "PYTHONUNBUFFERED": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
        "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "DISPLAY": "",
        "QT_QPA_PLATFORM": "offscreen",
        "PYTHONHASHSEED": "0",
    }


def isolated() -> list[str]:
    """Python for a process of the checker: modules are the platform's and Debian's, wherever it was started and whoever's home it has."""
    return [sys.executable, "-P", "-s"]


def own_environment() -> dict[str, str]:
    """For processes of the checker, made from nothing: of who started it come the platform's folders, as whole paths, and what names its
    temporary files and its language. What is relative would be looked for in the current folder, which may be the submission's."""
    kept = {name: value for name, value in os.environ.items() if name in _KEPT or name.startswith(("ROS", "LC_", "LAB_CHECK_"))}
    kept.update({name: ":".join(path for path in os.environ.get(name, "").split(":") if os.path.isabs(path)) for name in _PATHS})
    return {**kept, "PYTHONNOUSERSITE": "1", "PYTHONSAFEPATH": "1", "PYTHONHASHSEED": "0"}


_PATHS = ("PATH", "PYTHONPATH", "LD_LIBRARY_PATH", "CMAKE_PREFIX_PATH", "PKG_CONFIG_PATH")
_KEPT = ("HOME", "USER", "LOGNAME", "LANG", "TMPDIR", "PYTHONDONTWRITEBYTECODE", "LIBGL_ALWAYS_SOFTWARE")


def check() -> None:
    """
    :raises SandboxError: a tool is missing, the kernel refuses the namespaces, or the submission's user could not read the platform
    """
    for tool, package in (("bwrap", "bubblewrap"), ("unshare", "util-linux")):
        if not shutil.which(tool):
            raise SandboxError(
                f"{tool} is not installed, which shuts submissions in: sudo apt install {package}; or --unsafe, for code that you trust"
            )
    inner = [
        "bwrap",
        "--unshare-user",
        "--disable-userns",
        "--unshare-pid",
        "--ro-bind",
        "/",
        "/",
        "--proc",
        "/proc",
        "--dev",
        "/dev",
        "true",
    ]
    process = shut_in(inner, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    assert process.stderr is not None
    said = process.stderr.read().decode("utf-8", "replace")
    process.stderr.close()
    if process.wait():
        why = (said.strip().splitlines() or ["no reason given"])[-1]
        raise SandboxError(
            f"this machine does not allow the namespaces that shut submissions in ({why}). In Docker: --privileged, or a "
            "seccomp profile that allows them; or --unsafe, for code that you trust as your own"
        )
    if os.getuid() == 0:
        _readable()


def _readable() -> None:
    """
    :raises SandboxError: root alone may read what the submission's user has to
    """
    here = Platform.here()
    closed = [
        path
        for prefix, root in zip(here.prefixes, here.roots)
        for path in (root, prefix, f"{prefix}/setup.bash")
        if not os.stat(path).st_mode & stat.S_IROTH
    ]
    if closed:
        raise SandboxError(f"{closed[0]} can be read by root alone, and submissions run as a user of their own: chmod -R o+rX {closed[0]}")


def remark(place: str) -> str:
    """What is weaker on this machine, in one line; '' when nothing is.

    :param place: the control group, see :mod:`lab_check.isolation.control_group`
    """
    return (
        ""
        if control_group.counts_memory(place)
        else ("no control group can be made here, so memory is counted ten times a second instead of being bound by the kernel")
    )

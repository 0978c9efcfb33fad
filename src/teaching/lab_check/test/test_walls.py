"""What a submission may not do, tried from inside: by whoever examines (root, or a user), with the kernel's control groups and without."""

import json
import os
import pathlib
import subprocess
import time

import pytest
from teachers import CHECK, MANIFEST, reasons

pytestmark = pytest.mark.slow

SPEC = """\
title: A trap
packages: [evil]
build: {points: 10, timeout: 60}
limits: {disk: 60 MB, memory: 400 MB, processes: 100, log: 5 MB, time: 60}
tasks:
  - {name: A file, points: 5, launch: "", expect: [{file: {path: evil/package.xml}}]}
"""
SECRET = "the-teachers-token-4711"


PROBES = r"""
import ctypes, errno, os, pathlib, subprocess

def writable(top):
    for folder, folders, files in os.walk(top):
        if folder == "/proc":
            folders[:] = [name for name in folders if not name.isdigit() and name not in ("self", "thread-self")]
        for name in files:
            path = os.path.join(folder, name)
            try:
                os.close(os.open(path, os.O_WRONLY | os.O_NONBLOCK | os.O_NOFOLLOW))
                yield path
            except OSError:
                pass

for top in ("/proc", "/sys"):
    for path in writable(top):
        print("WRITABLE", path)
value = pathlib.Path("/proc/sys/kernel/core_pattern").read_text()
try:
    pathlib.Path("/proc/sys/kernel/core_pattern").write_text(value)
    print("WROTE core_pattern")
except OSError as error:
    print("core_pattern:", errno.errorcode[error.errno])
for place in ("/", "/dev", "/etc", "/home", "/usr", "/opt", "/proc", "/var", "/mnt", "/root"):
    try:
        os.mkdir(os.path.join(place, "mine"))
        print("MADE A FOLDER IN", place)
    except OSError:
        pass
print("NAMESPACE", subprocess.run(["unshare", "-Urm", "true"]).returncode)
for line in pathlib.Path("/proc/self/status").read_text().splitlines():
    if line.startswith(("CapEff", "CapPrm", "CapBnd", "NoNewPrivs", "Seccomp:")):
        print(line)
libc = ctypes.CDLL(None, use_errno=True)
numbers = {"x86_64": (29, 248, 425, 321, 323), "aarch64": (194, 217, 425, 280, 282)}[os.uname().machine]
for name, number in zip(("shmget", "add_key", "io_uring_setup", "bpf", "userfaultfd"), numbers):
    ctypes.set_errno(0)
    print("CALL", name, libc.syscall(number, 0, 4096, 0o1600, 0, 0), errno.errorcode.get(ctypes.get_errno()))
for process in [name for name in os.listdir("/proc") if name.isdigit()]:
    try:
        if b"SECRET" in pathlib.Path("/proc", process, "environ").read_bytes():
            print("SECRET OF", process)
    except OSError:
        pass
for place in ("/dev/shm", "/tmp", "/run", os.path.expanduser("~")):
    try:
        with open(os.path.join(place, "big"), "wb") as file:
            for _ in range(200):
                file.write(bytes(1 << 20))
    except OSError:
        pass
sizes = [os.path.getsize(os.path.join(place, "big")) for place in ("/dev/shm", "/tmp", "/run", os.path.expanduser("~"))]
print("HOLDS", sum(sizes) // 1000000, "MB")
print("looked")
"""


def test_nothing_of_the_machine_can_be_written_and_no_room_is_without_bound(teacher):
    """What is expected is the promise: nothing below /proc and /sys, no file outside of its own folders, no capability, no namespace."""
    result, log = teacher.check(SPEC, PROBES.replace("SECRET", SECRET), LAB_SECRET=SECRET)
    assert "looked" in log, log
    for word in ("WRITABLE", "WROTE", "MADE A FOLDER", "SECRET OF"):
        assert word not in log, [line for line in log.splitlines() if word in line]
    assert "NAMESPACE 0" not in log and "NAMESPACE 1" in log
    asked = [note for note in result["notes"] if "unshare" in note]
    assert len(asked) == 1 and "namespace of its own" in asked[0], "the kernel's 'No space left on device' is about namespaces here"
    for line in ("CapEff:\t0000000000000000", "CapPrm:\t0000000000000000", "NoNewPrivs:\t1", "Seccomp:\t2"):
        assert line in log, log
    calls = [line.split() for line in log.splitlines() if line.startswith("CALL")]
    assert calls and all(words[2:] == ["-1", "EPERM"] for words in calls), calls
    held = int(log.partition("HOLDS ")[2].split()[0])
    assert 0 < held <= 60, "all that it writes lies on its own disk of 60 MB"
    assert not result["fault"] and "bubblewrap" in result["sandbox"]


HELD = {
    "memfd": """
import os, time
for _ in range(50):  # each smaller than a file may be
    file = os.memfd_create("x")
    for _ in range(40):
        os.write(file, bytes(1 << 20))
""",
    "shared anonymous memory": """
import mmap, time
held = []
for _ in range(20):
    held.append(mmap.mmap(-1, 100 << 20))
    for place in range(0, 100 << 20, 4096):
        held[-1][place] = 1
""",
    "sockets": """
import socket, time
held = []
while len(held) < 3900:
    pair = socket.socketpair()
    held += pair
    pair[0].setblocking(False)
    pair[0].setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 30)
    try:
        while True:
            pair[0].send(bytes(65536))
    except BlockingIOError:
        pass
""",
    "own memory": """
held = []
while len(held) < 200:
    held.append(bytearray(b"x") * (10 << 20))
""",
    "memory of many": """
import os, time
for _ in range(20):
    if os.fork() == 0:
        held = bytearray(b"x") * (100 << 20)
        time.sleep(60)
""",
}


@pytest.mark.parametrize("what", HELD)
def test_memory_is_bounded_in_whatever_way_it_is_held(teacher, what):
    result, log = teacher.check(SPEC, HELD[what] + "\nimport time\ntime.sleep(5)\nprint('it held all of it', flush=True)\n")
    if what == "sockets" and "it held all of it" in log:
        pytest.skip("sockets of this machine hold less than the limit")
    assert "of memory" in reasons(result), (reasons(result), log[-2000:])
    assert "it held all of it" not in log


def test_a_submission_has_a_user_of_its_own_where_root_examines(teacher):
    if teacher.name == "a user":
        pytest.skip("a user has no other users to give")
    nap = f"4712.{os.getpid()}"
    package = teacher.place / "mallory" / "evil"
    package.mkdir(parents=True)
    (teacher.place / "spec.yaml").write_text(SPEC)
    (package / "package.xml").write_text(MANIFEST.format("evil", ""))
    (package / "CMakeLists.txt").write_text(f"execute_process(COMMAND sleep {nap})\n")
    words = teacher.words([*CHECK, str(teacher.place / "spec.yaml"), str(teacher.place / "mallory"), "--out", str(teacher.place / "out")])
    driver = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    try:
        users: set = set()
        while not users:
            assert driver.poll() is None
            users = {os.stat(f"/proc/{pid}").st_uid for pid in os.listdir("/proc") if pid.isdigit() and words_of(pid)[:2] == ["sleep", nap]}
            time.sleep(0.05)
        assert 0 not in users and os.getuid() not in users
    finally:
        driver.kill()
        driver.wait()


def words_of(pid: str):
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_text().split("\0")
    except OSError:
        return []


@pytest.mark.parametrize(
    "name", ["lab_check/examiner.py", "lab_check/cli.py", "yaml.py", "jsonschema/__init__.py", "sitecustomize.py", "numpy.py"]
)
def test_the_current_folder_is_nobodys_library(tmp_path, walled, name):
    """Whoever examines in the submission's own folder runs none of its modules, whichever of the checker's processes looks for one."""
    folder = tmp_path / "alice"
    module = folder / name
    module.parent.mkdir(parents=True)
    (module.parent / "__init__.py").write_text("")
    module.write_text(f"import pathlib\npathlib.Path({str(tmp_path / 'owned')!r}).write_text('x')\nraise SystemExit(0)\n")
    (tmp_path / "spec.yaml").write_text(SPEC.replace("packages: [evil]\nbuild: {points: 10, timeout: 60}\n", ""))
    paths = {**os.environ, "PYTHONPATH": os.environ.get("PYTHONPATH", "").strip(":")}
    subprocess.run(["rosrun", "lab_check", "grade", "../spec.yaml", ".", "--out", "../out", "--workers", "1"], cwd=folder, env=paths)
    subprocess.run(["rosrun", "lab_check", "check", "../spec.yaml", ".", "--out", "../checked"], cwd=folder, env=paths)
    assert not (tmp_path / "owned").exists()
    assert json.loads((tmp_path / "checked" / "report.json").read_text())["points"] == 0

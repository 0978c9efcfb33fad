"""What a submission puts in the place of its own files while it is built: links out of its home, pipes, folders without end, a full disk.
The checker reads those files afterwards, with more rights than the submission has."""

import os
import pathlib
import sqlite3
import subprocess
import sys

import pytest
from lab_check.classroom import packed_files, similar, store
from lab_check.isolation import control_group, untrusted_files
from teachers import CMAKE, MANIFEST, reasons

pytestmark = pytest.mark.slow

SPEC = """\
title: A trap
packages: [evil]
build: {points: 10, timeout: 60}
limits: {disk: 60 MB, memory: 600 MB, processes: 100, log: 5 MB, time: 60}
tasks:
  - name: A file
    points: 5
    launch: ""
    expect:
      - file: {path: evil/answer.txt, contains: solution}
  - name: Anywhere
    points: 5
    launch: ""
    expect:
      - file: {path: answer.txt}
"""
FAILS = 'message(FATAL_ERROR "as it should")\n'
REPLACED = {
    "the workspace by a link": """
import os
here = os.path.expanduser("~/catkin_ws")
os.rename(here, here + "2")
os.symlink("PRECIOUS", here)
""",
    "the package by a link": """
import os
here = os.path.expanduser("~/catkin_ws/src/mallory/evil")
os.rename(here, here + "2")
os.symlink("PRECIOUS/evil", here)
""",
    "a file by a link": """
import os
os.symlink("PRECIOUS/evil/answer.txt", os.path.expanduser("~/catkin_ws/src/mallory/evil/answer.txt"))
os.symlink("PRECIOUS/evil", os.path.expanduser("~/catkin_ws/src/mallory/more"))
""",
    "the manifest by a pipe": """
import os
manifest = os.path.expanduser("~/catkin_ws/src/mallory/evil/package.xml")
os.unlink(manifest)
os.mkfifo(manifest)
""",
    "the manifest by another": """
import os
with open(os.path.expanduser("~/catkin_ws/src/mallory/evil/package.xml"), "w") as file:
    file.write('<?xml version="1.0" encoding="no-such"?><package/>')
""",
    "the manifest by a device": """
import os
manifest = os.path.expanduser("~/catkin_ws/src/mallory/evil/package.xml")
os.unlink(manifest)
os.symlink("/dev/zero", manifest)
""",
    "folders by deep ones, and reports in each": """
import os
os.chdir(os.path.expanduser("~"))
os.mkdir("catkin_ws/build/deep")
os.chdir("catkin_ws/build/deep")
for _ in range(1500):
    with open("report.json", "w"):
        pass
    os.mkdir("d")
    os.chdir("d")
""",
}


@pytest.mark.parametrize("what", REPLACED)
def test_what_was_replaced_leads_nowhere(teacher, what):
    """The build fails, so that it is tried package by package in a folder that is removed first: not from where a link leads to."""
    precious = teacher.place / "precious"
    for folder in ("build", "evil", "src"):
        (precious / folder).mkdir(parents=True)
        (precious / folder / "answer.txt").write_text("the solution")
    for path in (teacher.place, *precious.rglob("*"), precious):
        path.chmod(0o777)
    result, _ = teacher.check(SPEC, REPLACED[what].replace("PRECIOUS", str(precious)), FAILS)
    assert result["points"] == 0, reasons(result)
    assert sorted(str(path.relative_to(precious)) for path in precious.rglob("*.txt")) == [
        "build/answer.txt",
        "evil/answer.txt",
        "src/answer.txt",
    ]
    assert len([note for note in result["notes"] if "has the name of a report" in note]) <= 10


def test_a_disk_that_is_full_of_files_ends_as_the_submissions_fault(teacher):
    """No folder can be made any more for the next of its programs."""
    fill = """
import os
os.mkdir(os.path.expanduser("~/full"))
try:
    for number in range(1000000):
        os.close(os.open(os.path.expanduser("~/full/%d" % number), os.O_CREAT))
except OSError as error:
    print(error)
"""
    launch = "  - {name: L, points: 5, launch: evil a.launch, ready: {timeout: 20}, expect: [{node: /nobody}]}\n"
    files = {
        "package.xml": MANIFEST.format("evil", ""),
        "fill.py": fill,
        "a.launch": "<launch/>",
        "CMakeLists.txt": CMAKE.format("evil")
        + "add_custom_target(full ALL COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/fill.py)\n",
    }
    result, _, _ = teacher.examine(SPEC + launch, "evil", files)
    assert "the disk that a submission gets is full" in result["tasks"][-1]["verdicts"][0]["reason"], reasons(result)


DAEMON = """
import os, socket, sys, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        door = socket.socket(socket.AF_UNIX)
        door.bind("\\0outlives")
        door.listen()
        while True:
            with open(os.path.expanduser("~/alive"), "w") as file:
                file.write(str(time.time()))
            time.sleep(0.05)
time.sleep(0.5)
"""
LOOKS = """
import os, socket, time
near = socket.socket(socket.AF_UNIX)
try:
    near.connect("\\0outlives")
    print("OUTLIVES", flush=True)
except OSError as error:
    print("ended:", error, flush=True)
"""


def test_no_daemon_outlives_the_build(teacher):
    launch = '<launch><node name="looks" pkg="evil" type="looks.py" output="screen"/></launch>'
    attack = "execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/attack.py OUTPUT_QUIET ERROR_QUIET TIMEOUT 5)\n"
    files = {
        "package.xml": MANIFEST.format("evil", ""),
        "CMakeLists.txt": CMAKE.format("evil") + attack,
        "attack.py": DAEMON,
        "looks.py": "#!/usr/bin/env python3\n" + LOOKS,
        "a.launch": launch,
    }
    task = "  - {name: L, points: 5, launch: evil a.launch, ready: {timeout: 5}, expect: [{node: /nobody}]}\n"
    result, out, _ = teacher.examine(SPEC + task, "evil", files)
    log = (out / "launch_1.log").read_text()
    assert "ended: [Errno 111]" in log and "OUTLIVES" not in log, (log, (out / "build.log").read_text())


# ---------------------------------------------------------------------------------------------- where the checker itself looks


def deep(place, count=1500):
    """A package below so many folders, and a file in each."""
    here = os.getcwd()
    try:
        os.chdir(place)
        for _ in range(count):
            os.mkdir("d")
            os.chdir("d")
            with open("x.py", "w", encoding="utf-8") as file:
                file.write("x = 1\n" * 100)
    finally:
        os.chdir(here)


def test_folders_without_end_end_no_class(tmp_path):
    """The fingerprint at the beginning of a class, and the comparison at its end, which all others' marks wait for."""
    (tmp_path / "sub").mkdir()
    deep(tmp_path / "sub")
    try:
        assert len(store.fingerprint(tmp_path / "sub", "")) == 64
        assert similar.prints(tmp_path / "sub")
        assert len(list(untrusted_files.walk(tmp_path / "sub"))) == 60
        with pytest.raises(packed_files.TooLarge, match="too many folders in each other"):
            packed_files.pack(tmp_path / "sub")
    finally:
        subprocess.run(["rm", "-rf", str(tmp_path / "sub")], check=True)


def check(spec, words, cwd):
    return subprocess.run(["rosrun", "lab_check", *words], cwd=cwd, capture_output=True, text=True, timeout=120)


NO_BUILD = "title: A trap\ntasks:\n  - {name: A file, points: 5, launch: '', expect: [{file: {path: package.xml}}]}\n"


@pytest.mark.parametrize("link", [".", "report.html", ".job", ".examiner.log", "pictures", ".result.json"])
def test_reports_are_written_through_no_link(tmp_path, walled, link):
    """Of a submission in which they are to lie, as in continuous integration."""
    alice, precious = tmp_path / "alice", tmp_path / "precious"
    for folder in (alice / "marks", precious):
        folder.mkdir(parents=True)
    (precious / "kept").write_text("mine")
    (alice / "package.xml").write_text(MANIFEST.format("evil", ""))
    (tmp_path / "spec.yaml").write_text(NO_BUILD)
    if link == ".":
        (alice / "marks").rmdir()
        (alice / "marks").symlink_to(precious)
    else:
        (alice / "marks" / link).symlink_to(precious if link == "pictures" else precious / "kept")
    done = check(tmp_path, ["check", "../spec.yaml", ".", "--out", "marks"], alice)
    assert (precious / "kept").read_text() == "mine" and os.listdir(precious) == ["kept"]
    if link == ".":
        assert done.returncode == 5 and "is a link that the submission brings" in done.stderr and "Traceback" not in done.stderr
    else:
        assert done.returncode == 0 and not (alice / "marks" / link).is_symlink(), done.stdout + done.stderr


@pytest.mark.parametrize(
    "name, words",
    [
        ("--unsafe", ["grade", "../spec.yaml"]),
        ("--out=x", ["grade", "../spec.yaml"]),
        ("-h", ["check", "../spec.yaml"]),
        ("--least=0", ["similar"]),
    ],
)
def test_a_submission_is_called_like_an_option(tmp_path, name, words):
    folder = tmp_path / "class"
    (folder / name).mkdir(parents=True)
    (folder / "bob").mkdir()
    (tmp_path / "spec.yaml").write_text(NO_BUILD)
    done = check(tmp_path, [*words, *sorted(os.listdir(folder))], folder)
    assert done.returncode == 2 and f"'{name}' is the name of a file here; write ./{name}" in done.stderr, done.stderr
    assert sorted(os.listdir(folder)) == sorted([name, "bob"])


def test_results_of_a_class_lie_in_no_submission(tmp_path, walled):
    """Whose own class.sqlite would be taken for what is known of the class."""
    for name in ("lab_check", "bob"):
        (tmp_path / "class" / name).mkdir(parents=True)
    with sqlite3.connect(tmp_path / "class" / "lab_check" / "class.sqlite") as planted:
        planted.execute("CREATE TABLE submissions (name)")
    (tmp_path / "spec.yaml").write_text(NO_BUILD)
    done = check(tmp_path, ["grade", "../spec.yaml", "bob", "lab_check"], tmp_path / "class")
    assert done.returncode == 2 and "which is a submission: name another folder by --out" in done.stderr, done.stderr
    assert os.listdir(tmp_path / "class" / "lab_check") == ["class.sqlite"]


# ---------------------------------------------------------------------------------------------- what a killed driver leaves behind

KILLED = """
import sys, time
from lab_check import group
with group.bounded(10, 1e9) as place:
    print(place, flush=True)
    time.sleep(600)
"""


def test_groups_that_a_killed_driver_left_behind_go_at_the_next_start():
    """Those of a driver that lives stay, and so does one in which a process is left."""
    drivers = [subprocess.Popen([sys.executable, "-c", KILLED], stdout=subprocess.PIPE, text=True) for _ in range(3)]
    sleeper = None
    try:
        made = [driver.stdout.readline().strip().split(os.pathsep) for driver in drivers]
        if not made[0][0]:
            pytest.skip("this user can make no control group here")
        assert all(os.path.isdir(place) for places in made for place in places)
        sleeper = subprocess.Popen(["sleep", "600"], preexec_fn=lambda: control_group.enter(os.pathsep.join(made[1])))
        for driver in drivers[:2]:
            driver.kill()
            driver.wait()
        assert all(os.path.isdir(place) for places in made for place in places), "kill -9 leaves them"
        with control_group.bounded(10, 1e9):
            there = [[os.path.isdir(place) for place in places] for places in made]
        assert not any(there[0]) and all(there[1]) and all(there[2])
        sleeper.kill()
        sleeper.wait()
        with control_group.bounded(10, 1e9):
            assert not any(os.path.isdir(place) for place in made[1])
    finally:
        for process in filter(None, (*drivers, sleeper)):
            process.kill()
            process.wait()
        for driver in drivers:
            driver.stdout.close()
        with control_group.bounded(10):
            pass
    assert not any(pathlib.Path(place).exists() for place in made[2])

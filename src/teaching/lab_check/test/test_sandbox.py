"""Submissions that do harm, each for real: what they try is done while CMake configures them, when nothing holds them but the walls."""

import json
import os
import pathlib
import re
import subprocess
import time

import pytest
from lab_check.check import check
from lab_check.isolation import control_group, sandbox
from lab_check.specs import spec

ROOT = pathlib.Path(__file__).resolve().parents[4]
SECRET = "the-solution-is-42"
EVIL = f"evil_{os.getpid()}.sh"  # processes of another run of these tests are not ours
SPEC = """\
title: A trap
packages: [evil]
build: {points: 10, timeout: 60}
limits: {disk: 60 MB, memory: 400 MB, processes: 100, log: 5 MB, time: 30}
tasks:
  - {name: A file, points: 5, launch: "", expect: [{file: {path: evil/package.xml}}]}
"""
MANIFEST = (
    "<package format='2'><name>evil</name><version>1.0.0</version><description>x</description>"
    "<maintainer email='mallory@example.org'>x</maintainer><license>x</license><buildtool_depend>catkin</buildtool_depend></package>"
)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module", autouse=True)
def namespaces():
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))


@pytest.fixture
def place(tmp_path):
    (tmp_path / "spec.yaml").write_text(SPEC + f"# {SECRET}\n")
    other = tmp_path / "other"
    other.mkdir()
    (other / "answer.txt").write_text(SECRET)
    return tmp_path


def submit(place: pathlib.Path, shell: str, timeout: int = 60):
    """A package whose configuration runs ``shell``, examined."""
    (place / "spec.yaml").write_text((place / "spec.yaml").read_text().replace("timeout: 60", f"timeout: {timeout}"))
    package = place / "mallory" / "evil"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.10)\nproject(evil)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        f"execute_process(COMMAND bash ${{CMAKE_CURRENT_SOURCE_DIR}}/{EVIL})\n"
    )
    (package / EVIL).write_text(shell)
    result = check(spec.load(place / "spec.yaml"), place / "mallory", place / "out")
    assert not result.fault, result.fault
    assert json.loads((place / "out" / "report.json").read_text())["points"] == result.points
    return result, (place / "out" / "build.log").read_text(errors="replace"), (place / "out" / "report.html").read_text()


def processes_with(word: str) -> int:
    return sum(word.encode() in _words(pid) for pid in os.listdir("/proc") if pid.isdigit())


def _words(pid: str) -> bytes:
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:  # it ended meanwhile
        return b""


def test_fork_bomb_is_ended_and_told(place):
    _, _, page = submit(place, "f() { f | f & }; f; sleep 60\n")
    assert "more than 100 processes" in page
    assert not processes_with(EVIL)


def test_threads_are_counted_as_well(place):
    with control_group.bounded(1) as bound:
        if not bound and os.getuid() == 0:
            pytest.skip("root can make no control group here, and nothing else holds for root")
    _, log, _ = submit(
        place,
        """python3 -c '
import threading
over, count = threading.Event(), 0
try:
    while count < 2000:
        threading.Thread(target=over.wait).start()
        count += 1
except RuntimeError as error:
    print(count, "threads, then:", error, flush=True)
over.set()'
""",
    )
    found = re.search(r"(\d+) threads, then: can't start new thread", log)
    assert found and 600 < int(found[1]) < 800, log


def test_a_full_disk_is_the_submissions_own(place):
    result, log, page = submit(
        place, "dd if=/dev/zero of=$HOME/big bs=1M count=3000; for i in $(seq 5); do cat $HOME/big >> /tmp/b; done\n"
    )
    assert "No space left" in log or "File too large" in log
    assert "the disk that a submission gets is full" in page or "a file grew beyond" in page


def test_it_eats_no_more_memory_than_it_may(place):
    _, _, page = submit(place, "python3 -c 'x = []\nwhile True: x.append(bytearray(b\"x\") * 10000000)'; exit 0\n")
    assert "of memory" in page


def test_rm_rf_home_harms_nobody(place):
    mine = pathlib.Path.home()
    before = sorted(os.listdir(mine))
    _, _, page = submit(place, "rm -rf ~ / --no-preserve-root\n")
    assert sorted(os.listdir(mine)) == before
    assert (place / "other" / "answer.txt").read_text() == SECRET and (place / "mallory" / "evil" / EVIL).exists()
    assert "something tried to write where a submission may not" in page


def test_neither_spec_nor_other_submissions_can_be_read(place):
    _, log, page = submit(
        place,
        f"cat {place}/spec.yaml {place}/other/answer.txt; grep -rs {SECRET[:7]} / --include=*.txt --include=*.yaml "
        f"--exclude-dir=proc --exclude-dir=sys --exclude-dir=usr; ls {place}; ls /work /root /home; echo looked\n",
    )
    assert "looked" in log and SECRET not in log
    assert "something looked for the spec or for other submissions" in page
    assert "answer.txt" not in log.replace(f"{place}/other/answer.txt", "")


def test_the_labs_solutions_are_not_there(place):
    _, log, _ = submit(place, f"find {ROOT} -name 'arm_controller_node*' 2>/dev/null; echo looked\n")
    assert "looked" in log and "arm_controller_node.cpp" not in log


def test_there_is_no_network(place):
    _, log, page = submit(
        place,
        "python3 -c 'import socket; socket.create_connection((\"192.0.2.1\", 80), 5)'; "
        "python3 -c 'import socket; socket.create_connection((\"example.org\", 80), 5)'; echo tried\n",
    )
    assert "tried" in log and "unreachable" in log
    assert "there is no network" in page


def test_it_cannot_kill_its_parent(place):
    result, _, page = submit(place, "kill -9 $PPID; kill -9 1; kill -9 -1\n")
    assert "its build was killed by signal 9" in page
    assert result.tasks[1].points == 5  # the examination went on


def test_a_log_without_end_is_cut(place):
    _, log, page = submit(place, "yes 'a line of a log without end' | head -c 10000000000\n")
    assert "printed more than 5 MB" in page
    assert len(log) < 2e6


def test_hanging_is_ended(place):
    _, _, page = submit(place, "trap '' TERM INT HUP; while true; do sleep 1; done\n", timeout=8)
    assert "did not end within" in page or "was not done after" in page
    assert not processes_with(EVIL)


def test_a_report_of_its_own_counts_for_nothing(place):
    forged = json.dumps({"points": 1000, "of": 1000})
    result, _, page = submit(
        place,
        f"for d in . .. ~ /tmp {place}/out /home; do mkdir -p $d; for f in result.json .result.json report.json "
        f"results.json; do echo '{forged}' > $d/$f; done; done; exit 0\n",
    )
    assert result.points == 15 and result.of == 15
    assert "report.json was written, which has the name of a report" in page
    assert json.loads((place / "out" / "results.json").read_text())["score"] == 15


def test_where_namespaces_are_refused_it_says_so(monkeypatch):
    monkeypatch.setattr(sandbox, "outer_words", lambda: ["sh", "-c", "echo 'unshare failed: Operation not permitted' >&2; exit 1", "sh"])
    with pytest.raises(sandbox.SandboxError, match="Operation not permitted.*--unsafe"):
        sandbox.check()


def test_missing_bubblewrap_is_named(monkeypatch):
    monkeypatch.setattr(sandbox.shutil, "which", lambda tool: None)
    with pytest.raises(sandbox.SandboxError, match="apt install bubblewrap"):
        sandbox.check()


def test_nothing_is_left_of_an_examination(place):
    before = set(pathlib.Path("/tmp").glob("lab_check.*"))
    submit(place, "true\n")
    assert set(pathlib.Path("/tmp").glob("lab_check.*")) <= before
    assert "lab_check." not in subprocess.run(["mount"], capture_output=True, text=True).stdout


def test_whoever_kills_the_driver_ends_the_examination(place):
    """kill -9 of check in mid-run: no process of the submission, nor of the examiner, goes on."""
    package = place / "mallory" / "evil"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    nap = f"4711.{os.getpid()}"  # s, as no other process has it
    (package / "CMakeLists.txt").write_text(f"execute_process(COMMAND sleep {nap})\n")
    words = ["rosrun", "lab_check", "check", str(place / "spec.yaml"), str(place / "mallory"), "--out", str(place / "out")]
    driver = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    while not processes_with(nap):  # on a busy machine it takes its time; the limit of the build ends it otherwise
        assert driver.poll() is None, "it ended before the submission ran"
        time.sleep(0.05)
    driver.kill()
    driver.wait()
    end = time.monotonic() + 120
    while processes_with(nap) or processes_with(str(place / "out")):
        assert time.monotonic() < end, "left over"
        time.sleep(0.05)

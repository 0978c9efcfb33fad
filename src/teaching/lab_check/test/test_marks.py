"""Staging, points, reports, logs, the class's store and near-identical submissions: without ROS and without a sandbox."""

import io
import json
import os
import pathlib
import subprocess
import tarfile
import tempfile
import xml.etree.ElementTree as ET
import zipfile

import pytest
from lab_check import explain, faults, report
from lab_check.checks.files import complain, insane
from lab_check.classroom import engines, grade, gradebook, similar, store
from lab_check.isolation import staging, supervise, temporary_folders
from lab_check.outcome import Result, TaskResult, Verdict, failed_task, share
from lab_check.specs import spec

MANIFEST = "<package format='2'><name>{}</name></package>"


def package(folder, name="p"):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(MANIFEST.format(name))
    return folder


# ---------------------------------------------------------------------------------------------- staging


def stage(submission, tmp_path, limit=1e6):
    return staging.stage(pathlib.Path(submission), tmp_path / "ws" / "src", limit)


def test_an_empty_submission_and_one_without_package(tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(staging.StagingError, match="empty"):
        stage(tmp_path / "empty", tmp_path)
    (tmp_path / "text").mkdir()
    (tmp_path / "text" / "essay.txt").write_text("x")
    with pytest.raises(staging.StagingError, match="no package.xml"):
        staging.stage(tmp_path / "text", tmp_path / "other", 1e6)


def test_links_are_not_followed(tmp_path):
    folder = package(tmp_path / "sub" / "p")
    (folder / "root").symlink_to("/")
    (folder / "secret").symlink_to("/etc/passwd")
    found = stage(tmp_path / "sub", tmp_path)
    assert list(found.packages) == ["p"]
    assert not any(path.name in ("root", "secret", "passwd") for path in (tmp_path / "ws").rglob("*"))
    assert sum("links are left out" in note for note in found.notes) == 2
    (tmp_path / "slash").symlink_to("/")
    with pytest.raises(staging.StagingError, match="link to /"):
        staging.stage(tmp_path / "slash", tmp_path / "third", 1e6)


def test_two_gigabytes_are_refused_before_they_are_copied(tmp_path):
    folder = package(tmp_path / "sub" / "p")
    with open(folder / "big.bag", "wb") as file:
        file.truncate(2_000_000_000)
    with pytest.raises(staging.StagingError, match="larger than 200 MB"):
        stage(tmp_path / "sub", tmp_path, 2e8)


def test_names_and_manifests_that_are_no_utf8(tmp_path):
    folder = package(tmp_path / "sub" / "p")
    pathlib.Path(os.fsdecode(os.fsencode(folder) + b"/caf\xe9.py")).write_text("x")
    bad = tmp_path / "sub" / "q"
    bad.mkdir()
    (bad / "package.xml").write_bytes(b"<?xml version='1.0' encoding='utf-8'?><package><name>\xff\xfe</name></package>")
    found = stage(tmp_path / "sub", tmp_path)
    assert list(found.packages) == ["p"] and any("no XML" in note for note in found.notes)
    with pytest.raises(staging.StagingError, match="no package that could be built: .*package.xml is no XML"):
        stage(bad, tmp_path / "alone")


def test_archives_write_nothing_outside(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as file:
        file.writestr("p/package.xml", MANIFEST.format("p"))
        file.writestr("../../evil.txt", "x")
    assert list(stage(tmp_path / "a.zip", tmp_path).packages) == ["p"] and not (tmp_path / "evil.txt").exists()
    with tarfile.open(tmp_path / "a.tar.gz", "w:gz") as file:
        for name, text in (("p/package.xml", MANIFEST.format("p")), ("/tmp/lab_check_evil", "x")):
            entry = tarfile.TarInfo(name)
            entry.size = len(text)
            file.addfile(entry, io.BytesIO(text.encode()))
    found = staging.stage(tmp_path / "a.tar.gz", tmp_path / "tar", 1e6)
    assert list(found.packages) == ["p"] and not os.path.exists("/tmp/lab_check_evil")


# ---------------------------------------------------------------------------------------------- points and reports

TASK = {"name": "A", "points": 10, "all": False, "expect": [{"node": "a"}, {"node": "b"}, {"node": "c", "points": 2}]}


def test_points_are_dealt_by_weight_and_to_the_last_digit():
    verdicts = [Verdict("node", True, ""), Verdict("node", False, ""), Verdict("node", True, "")]
    assert share(TASK, verdicts).points == 7.5
    thirds = {**TASK, "points": 1, "expect": [{"node": "a"}] * 3}
    assert share(thirds, [Verdict("node", True, "")] * 3).points == 1.0
    assert share({**TASK, "all": True}, verdicts).points == 0.0
    assert failed_task(TASK, "why").points == 0.0


def a_result():
    result = Result("Title <b>", "/x/sub", notes=["a note"], sandbox="bubblewrap")
    result.add(
        TaskResult(
            "T & U",
            5.0,
            10.0,
            [Verdict("joint", True, "good", 5.0, 5.0), Verdict("joint", False, "bad \x01 <script>", 0.0, 5.0)],
            ["roslaunch a b"],
            log=["[ERROR] first"],
            hint="a hint",
            series={"j0": [[0.0, 0.0], [1.0, 1.0]]},
        )
    )
    return result


def test_reports_agree_and_let_no_markup_through(tmp_path):
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: a, launch: '', expect: [{file: {path: x}}]}]\n")
    report.write(a_result(), spec.load(tmp_path / "spec.yaml"), tmp_path)
    page = (tmp_path / "report.html").read_text()
    assert "<script>" not in page and "&lt;script&gt;" in page and "a hint" in page and "roslaunch a b" in page and "svg+xml" in page
    suite = ET.parse(tmp_path / "junit.xml").getroot()
    assert suite.get("tests") == "1" and suite.get("failures") == "1" and suite.find("testcase/failure").get("message") == "5 of 10 points"
    scores = json.loads((tmp_path / "results.json").read_text())
    assert scores["score"] == 5 and scores["tests"][0]["max_score"] == 10
    again = Result.from_data(json.loads((tmp_path / "report.json").read_text()))
    assert report.marks(again) == report.marks(a_result())


def test_a_checker_that_failed_gives_no_marks_at_all(tmp_path):
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: 'T & U', points: 10, launch: '', expect: [{file: {path: x}}]}]\n")
    sheet, result = spec.load(tmp_path / "spec.yaml"), a_result()
    result.fault = "the disk is full"
    report.write(result, sheet, tmp_path)
    answer = json.loads((tmp_path / "results.json").read_text())
    assert "score" not in answer and "tests" not in answer and "the disk is full" in answer["output"]
    suite = ET.parse(tmp_path / "junit.xml").getroot()
    assert suite.get("failures") == "0" and suite.get("errors") == "1" and suite.find("testcase/error").get("message") == "the disk is full"
    page = (tmp_path / "report.html").read_text()
    assert "<b>not examined</b>" in page and "5</b> of 10 points" not in page
    book = store.Store(tmp_path / "class.sqlite")
    for name in ("a", "b"):
        book.enlist(name, tmp_path / name, "1")
    book.failed("a", "its worker was killed by signal 9")
    gradebook.write(sheet, book, tmp_path)
    assert (tmp_path / "gradebook.csv").read_text().splitlines()[1:] == [
        "a,,,,not examined: its worker was killed by signal 9",
        "b,,,,not examined yet",
    ]
    assert "not examined: its worker was killed by signal 9" in (tmp_path / "gradebook.html").read_text()


def test_the_first_cause_comes_first():
    log = "\n".join(
        ["fine", "[ERROR] [1.0]: Could not find joint 'j9' in the robot", "more", "[ERROR] [2.0]: later", "process has died [pid 3]"]
    )
    line, meaning = explain.first_cause(log)
    assert "j9" in line and "transmission" in meaning
    assert explain.excerpt(log)[1] == line
    cmake = "CMake Error at a.cmake:198 (message):\n  the package 'roscpp' has been found but\n  is not listed\nCall Stack:\n  a.cmake:1"
    assert explain.error_lines(cmake) == ["CMake Error at a.cmake:198 (message): the package 'roscpp' has been found but is not listed"]
    assert explain.error_lines("[ERROR] [1]: No p gain specified for pid.") == []


def test_what_was_said_since_a_mark():
    said = supervise.Output()
    said.add(b"before\n")
    mark = said.total
    said.add(b"after\n")
    assert said.text() == "before\nafter\n" and said.text(mark) == "after\n"
    said.add(b"x" * 2_000_000)
    late = said.total
    said.add(b"the end")
    assert said.text(late) == "the end" and said.text(mark).startswith("after\n") and "bytes left out" in said.text(mark)


REFUSALS = [
    "Usage: node j1 j2",
    "usage: arm_node [-h]",
    "[ERROR] [1795390434.5]: four angles, please",
    "Error: 3 angles",
    "Invalid argument",
    "[ INFO] [1795390434.5, 2.1]: error: no angle",
    "angle 9 is out of range",
    "'abc' is not a number",
    "can't read 'abc'",
    "fine\n\x1b[31m[FATAL] [1.0]: no\x1b[0m",
    "You must give four angles",
]
WORK = [
    "",
    "moving to 0 0 0 0",
    "[ INFO] [1.0]: position error 0.01",
    "[ WARN] [1.0]: slow",
    "tracking error: 0.2",
    "[ INFO] [1.0]: can open",
]


@pytest.mark.parametrize("said", REFUSALS)
def test_a_program_says_that_it_does_not_take_its_arguments(said):
    assert explain.refusal(said) and not explain.crashed(0, said)


@pytest.mark.parametrize("said", WORK)
def test_what_a_program_says_while_it_works_is_no_refusal(said):
    assert not explain.refusal(said)


def test_which_exit_codes_are_crashes():
    """-11 where the program was our child, 139 where a shell or bwrap stood between; 255 is what return -1 gives, and no crash."""
    assert [code for code in (0, 1, 2, 127, 130, 255, -11, 134, 136, 139) if explain.crashed(code, "")] == [-11, 134, 136, 139]
    assert explain.crashed(1, "Traceback (most recent call last):\n  ...\nValueError: x") and not explain.crashed(None, "")


# ---------------------------------------------------------------------------------------------- descriptions


def robot(inertia="ixx='1' iyy='1' izz='1'", limit="<limit effort='1' velocity='1'/>"):
    return ET.fromstring(
        f"<robot><link name='a'><inertial><mass value='1'/><inertia {inertia}/></inertial></link><link name='b'/>"
        f"<joint name='j' type='revolute'>{limit}</joint></robot>"
    )


def test_descriptions_that_cannot_be():
    assert complain(robot(), {"moving": 1, "joints": ["j"], "inertias": "sane", "limits": True}) == []
    assert "no joint 'k'" in complain(robot(), {"joints": ["k"]})[0]
    assert "no limit" in complain(robot(limit=""), {"limits": True})[0]
    assert "exceed the sum" in insane(robot("ixx='1' iyy='1' izz='3'").find("link"))
    assert "wrong units" in insane(robot("ixx='1e8' iyy='1e8' izz='1e8'").find("link"))
    assert "not positive" in insane(robot("ixx='0' iyy='1' izz='1'").find("link"))


NOT_COMPLETE, NO_BODY = "not complete, or holds what is no finite number", "belong to no body"


@pytest.mark.parametrize(
    "inertia, mass, words",
    [
        # Positive moments, but no positive definite matrix: [[a, b], [b, a]] has the eigenvalues a - b and a + b.
        ("ixx='0.01' iyy='0.01' izz='0.01' ixy='0.5' ixz='0' iyz='0'", "1", NO_BODY),
        ("ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='-0.02' iyz='0'", "1", NO_BODY),
        # Positive definite, and each moment less than the others' sum, but the principal ones are 0.2, 1.0 and 1.8.
        ("ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0.8'", "1", NO_BODY),
        # A cube of 1 kg and 1 m about a corner.
        ("ixx='0.6667' iyy='0.6667' izz='0.6667' ixy='-0.25' ixz='-0.25' iyz='-0.25'", "1", ""),
        ("ixx='nan' iyy='1' izz='1'", "1", NOT_COMPLETE),
        ("ixx='1' iyy='inf' izz='1'", "1", NOT_COMPLETE),
        ("ixx='1' iyy='1' izz='1' ixy='nan' ixz='0' iyz='0'", "1", NOT_COMPLETE),
        ("ixx='1' iyy='1' izz='1' ixy='x' ixz='0' iyz='0'", "1", NOT_COMPLETE),
        ("ixx='1' iyy='1'", "1", NOT_COMPLETE),
        ("ixx='1' iyy='1' izz='1'", "nan", NOT_COMPLETE),
        ("ixx='1' iyy='1' izz='1'", "inf", NOT_COMPLETE),
        ("ixx='1' iyy='1' izz='1'", "-1", "not positive"),
    ],
)
@pytest.mark.parametrize("format", ["urdf", "sdf"])
def test_inertias_that_no_body_has(inertia, mass, words, format):
    """Of a matrix: positive definite, and its principal moments none more than the sum of the others."""
    numbers = f"<mass value='{mass}'/><inertia {inertia}/>"
    if format == "sdf":
        pairs = (word.split("=") for word in inertia.replace("'", "").split())
        numbers = f"<mass>{mass}</mass><inertia>{''.join(f'<{key}>{value}</{key}>' for key, value in pairs)}</inertia>"
    link = f"<link name='a'><inertial>{numbers}</inertial></link>"
    root = ET.fromstring(
        f"<robot name='r'>{link}</robot>" if format == "urdf" else f"<sdf version='1.6'><model name='r'>{link}</model></sdf>"
    )
    said = complain(root, {"inertias": "sane", "links": ["a"]})
    assert words in said[0] if words else not said, said


def test_what_is_not_there_is_not_as_asked():
    """A description without links, shapes, inertias or joints has nothing wrong with them, and nothing right."""
    for wanted in ({}, {"collisions": True}, {"limits": True}, {"inertias": "sane"}, {"moving": 0}):
        assert "has no link" in complain(ET.fromstring("<robot name='r'/>"), wanted)[0]
    bare = ET.fromstring("<robot name='r'><link name='a'/></robot>")
    assert complain(bare, {"collisions": True}) == ["no link has a collision"]
    assert complain(bare, {"limits": True}) == ["no joint can move, so that none has limits"]
    assert complain(bare, {"inertias": "sane"}) == ["no link has an inertia"]
    assert "no limit" in complain(robot(limit="<limit effort='inf' velocity='nan'/>"), {"limits": True})[0]


def test_figures_that_are_no_numbers_stay_out_of_reports():
    """JSON has no word for them: whoever reads results.json strictly would read none of it."""
    result = share(TASK, [Verdict("joint", False, "", figures={"closest": float("inf"), "xyz": [0.0, float("nan")], "last": 1.0})])
    assert result.verdicts[0].figures == {"last": 1.0}
    assert json.loads(json.dumps(result.verdicts[0].figures, allow_nan=False))


# ---------------------------------------------------------------------------------------------- a class


class FakePool:
    """Workers that need no time; ``deaths`` says how often the worker of a submission dies."""

    def __init__(self, deaths, why="its worker was killed by signal 9"):
        self.why = why
        self.running, self.deaths, self.begun, self.workers = {}, dict(deaths), [], 2

    def start(self, name, path):
        self.running[name] = path
        self.begun.append(name)

    def ended(self):
        return list(self.running)

    def take(self, name):
        del self.running[name]
        self.deaths[name] = self.deaths.get(name, 0) - 1
        return self.why if self.deaths[name] >= 0 else a_result()


def test_a_dead_worker_is_replaced_once_and_what_is_done_stays_done(tmp_path):
    book = store.Store(tmp_path / "class.sqlite")
    for name in "abc":
        book.enlist(name, tmp_path / name, "1")
    pool, lines = FakePool({"b": 1, "c": 2}), []
    grade.run(book, pool, lines.append)
    assert book.counts() == {"done": 2, "failed": 1} and sorted(pool.begun) == ["a", "b", "b", "c", "c"]
    assert any("signal 9" in line and "tried again" in line for line in lines)
    book.enlist("a", tmp_path / "a", "1")
    book.enlist("b", tmp_path / "b", "changed")
    book.begin_again()
    pool = FakePool({})
    grade.run(book, pool, lines.append)
    assert sorted(pool.begun) == ["b", "c"] and book.counts() == {"done": 3}


def test_what_never_began_was_no_try(tmp_path):
    book = store.Store(tmp_path / "class.sqlite")
    book.enlist("a", tmp_path / "a", "1")
    pool = FakePool({"a": 5}, engines.NotBegun("the node was gone before it began"))
    grade.run(book, pool, lambda line: None)
    assert book.counts() == {"done": 1} and len(pool.begun) == 6


def test_what_was_killed_leaves_no_folder_for_long(tmp_path, monkeypatch):
    monkeypatch.setattr(temporary_folders, "top", lambda: tmp_path)
    (tmp_path / "lab_x.killed").mkdir()
    (tmp_path / "lab_x.killed" / "rest").write_text("x")
    with temporary_folders.folder("lab_x.") as mine:
        assert mine.is_dir() and (tmp_path / "lab_x.killed").exists()  # it might be new
        temporary_folders.sweep("lab_x.", young=-1.0)
        assert mine.is_dir() and not (tmp_path / "lab_x.killed").exists()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("closed", ["itself", "a folder above it"])
def test_a_private_folder_of_temporary_files_is_not_used_by_root(tmp_path, monkeypatch, closed):
    """As pam_tmpdir makes one for each user: the user that submissions run as could not enter it."""
    if os.getuid() != 0:
        pytest.skip("only root's submissions run as another user")
    private = tmp_path / "private"
    private.mkdir(mode=0o700 if closed == "itself" else 0o755)
    place = private if closed == "itself" else private / "inner"
    place.mkdir(exist_ok=True)
    private.chmod(0o700)
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    with temporary_folders.folder("lab_x.") as mine:
        assert tmp_path not in mine.parents and all(path.stat().st_mode & 0o001 for path in mine.parents)


def test_gradebook(tmp_path):
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: 'T & U', points: 10, launch: '', expect: [{file: {path: x}}]}]\n")
    book = store.Store(tmp_path / "class.sqlite")
    book.enlist("=cmd()", tmp_path / "x", "1")
    book.done("=cmd()", a_result())
    gradebook.write(spec.load(tmp_path / "spec.yaml"), book, tmp_path)
    assert (tmp_path / "gradebook.csv").read_text().splitlines()[1].startswith("'=cmd(),5.0,10.0,5.0")
    assert "T &amp; U" in (tmp_path / "gradebook.html").read_text() and "bad" in (tmp_path / "comparison.html").read_text()


def test_copies_are_found_under_another_layout(tmp_path):
    code = "\n".join(f"int f{i}(int a) {{ return a * {i} + g{i}(a, {i * 3}); }}" for i in range(40))
    other = "\n".join(f"double h{i}(double b) {{ if (b > {i}) return k{i}(b); return {i}.5 / b; }}" for i in range(40))
    for name, text in (("a", code), ("b", "// mine\n" + code.replace(" {", "\n{").replace("; }", ";\n  /* own */ }")), ("c", other)):
        package(tmp_path / name)
        (tmp_path / name / "x.cpp").write_text(text)
    found = similar.pairs({name: tmp_path / name for name in "abc"})
    assert [(pair.first, pair.second) for pair in found] == [("a", "b")] and found[0].share > 0.95


def test_seeded_faults_are_the_same_every_time(tmp_path):
    good = pathlib.Path(__file__).parents[3] / "labs" / "arm"
    first, second = (faults.make(good, tmp_path / name, len(faults.FAULTS), seed=3) for name in "ab")
    assert first == second and len({entry["fault"] for entry in first}) == len(faults.FAULTS)
    for entry in first:
        a, b = (tmp_path / name / entry["submission"] for name in "ab")
        texts = [{str(f.relative_to(x)): f.read_bytes() for f in x.rglob("*") if f.is_file()} for x in (a, b)]
        assert texts[0] == texts[1]
        same = texts[0] == {str(f.relative_to(good)): f.read_bytes() for f in good.rglob("*") if f.is_file()}
        assert same == (entry["fault"] == "none")


def test_reasons_hold_no_wall_time():
    first, second = ("[ERROR] [1795390434.547, 3.25]: x", "[ERROR] [1795390999.1, 3.25]: x")
    assert explain.timeless(first) == explain.timeless(second) == "[ERROR] [3.25]: x"
    assert explain.timeless("[ERROR] [1795390434.547]: y") == "[ERROR] y"


@pytest.mark.slow
def test_a_full_disk_is_one_line_and_the_same_command_goes_on(tmp_path):
    """In a mount namespace of its own, with a disk of 120 kB for the class."""
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: a, points: 1, launch: '', expect: [{file: {path: '*/x'}}]}]\n")
    for number in range(3):
        package(tmp_path / "class" / f"s{number}")
        (tmp_path / "class" / f"s{number}" / "x").write_text("x")
    grade_it = f"rosrun lab_check grade {tmp_path}/spec.yaml {tmp_path}/class/* --workers 1 --out {tmp_path}/out"
    script = (
        f"mkdir {tmp_path}/out; mount -t tmpfs -o size=120k full {tmp_path}/out && head -c 60000 /dev/zero > {tmp_path}/out/fills; "
        f"{grade_it}; echo first $?; rm -f {tmp_path}/out/fills; mount -o remount,size=5M {tmp_path}/out; {grade_it}; echo then $?; "
        f"cat {tmp_path}/out/gradebook.csv"
    )
    done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "bash", "-c", script], capture_output=True, text=True)
    if "Operation not permitted" in done.stderr:
        pytest.skip(done.stderr)
    assert "Traceback" not in done.stderr, done.stderr
    assert "first 4" in done.stdout or "first 5" in done.stdout, done.stdout + done.stderr
    assert "No space left" in done.stdout + done.stderr or "is full" in done.stdout + done.stderr
    assert "then 0" in done.stdout and done.stdout.count(",1.0,1.0,") == 3, done.stdout + done.stderr


def test_a_name_that_is_no_utf8_does_not_stop_the_class(tmp_path):
    name = os.fsdecode(b"\xff\xfename")
    package(tmp_path / name)
    ((found, path),) = grade.named([tmp_path / name]).items()
    book = store.Store(tmp_path / "class.sqlite")
    book.enlist(found, path, store.fingerprint(path, ""))
    assert found == "\ufffd\ufffdname" and book.path_of(found) == path
    result = a_result()
    result.submission = str(path)
    book.done(found, result)
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: a, launch: '', expect: [{file: {path: x}}]}]\n")
    report.write(result, spec.load(tmp_path / "spec.yaml"), tmp_path)
    gradebook.write(spec.load(tmp_path / "spec.yaml"), book, tmp_path)
    assert found in (tmp_path / "gradebook.csv").read_text() and found in (tmp_path / "report.html").read_text()

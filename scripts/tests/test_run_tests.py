"""scripts/run_tests.py: what a file that fails once, or each time, makes of the whole run."""

import sys
import threading
from pathlib import Path

import pytest
import run_tests


@pytest.fixture
def whole_run(monkeypatch, tmp_path, capsys):
    """Run with these results: {file: [failures of the first try, of the second ...]}; (exit code, lines printed)."""

    def run(results, *options):
        jobs = [run_tests.Job(tmp_path, "pytest", tmp_path / name) for name in results]
        tries = {name: list(failures) for name, failures in results.items()}
        last = {}

        def run_one(job, scratch):
            failed = tries[job.path.name].pop(0)
            of = last[job.path.name] if job.failed_only else 2
            last[job.path.name] = failed
            return run_tests.Result(job, of - failed, failed, 0, 0.1, "output", [f"case: reason {failed}"] * failed)

        monkeypatch.setattr(run_tests, "find_jobs", lambda packages, kind, scripts, slow: jobs)
        monkeypatch.setattr(run_tests, "run", run_one)
        monkeypatch.setattr(sys, "argv", ["run_tests.py", *options])
        return run_tests.main(), capsys.readouterr().out.splitlines()

    return run


def test_one_failure_fails_the_run(whole_run):
    code, lines = whole_run({"a": [0], "b": [1]})
    assert code == 1
    assert lines[-1] == "3 passed, 1 failed, 0 skipped"
    assert lines[-2].endswith("b: case: reason 1") and lines[-2].startswith("failed: ")


def test_what_passes_the_second_time_is_told(whole_run):
    code, lines = whole_run({"a": [0], "b": [1, 0]}, "--again")
    assert code == 0
    assert lines[-1] == "4 passed, 0 failed, 0 skipped"
    assert lines[-2].startswith("unsteady: ") and lines[-2].endswith("b: case: reason 1")


def test_what_fails_three_times_fails_the_run(whole_run):
    code, lines = whole_run({"a": [2, 2, 1], "b": [1, 1, 0]}, "--again")
    assert code == 1
    assert lines[-1] == "3 passed, 1 failed, 0 skipped"
    assert [line.split(":")[0] for line in lines[-3:-1]] == ["unsteady", "failed"]


def test_what_passed_does_not_run_once_more(package, tmp_path):
    """One test fails the first time, another always."""
    package(
        {
            "test_a.py": "import pathlib\nran = pathlib.Path(__file__).parent / 'ran'\n"
            "def test_good():\n    assert not ran.exists()\n"
            "def test_unsteady():\n    before = ran.exists()\n    ran.touch()\n    assert before\n"
            "def test_bad():\n    assert False\n"
        }
    )
    (job,) = run_tests.find_jobs({"box"}, "all", scripts=False, slow=True)
    first = run_tests.run(job, tmp_path)
    assert (first.passed, first.failed) == (1, 2), first.output
    results = {job.path: first}
    assert len(run_tests.second_tries(results, tmp_path, quiet=True)) == 0  # told only when the whole file passes
    assert (results[job.path].passed, results[job.path].failed) == (2, 1)


def test_what_is_left_behind_is_ended_and_keeps_nobody_waiting(package, tmp_path):
    """A process of a session of its own that holds the output open, as a simulator whose test was killed does."""
    package(
        {
            "test_a.py": "import pathlib, subprocess\ndef test_it():\n"
            "    child = subprocess.Popen(['sleep', '1000'], start_new_session=True)\n"
            f"    pathlib.Path({str(tmp_path / 'pid')!r}).write_text(str(child.pid))\n"
        }
    )
    (tmp_path / "logs").mkdir()
    (job,) = run_tests.find_jobs({"box"}, "all", scripts=False, slow=True)
    result = run_tests.run(job, tmp_path / "logs")
    assert (result.passed, result.failed, result.left_behind) == (1, 0, ["sleep"]) and "left behind: sleep" in result.output
    assert result.seconds < 60
    assert not Path("/proc", (tmp_path / "pid").read_text(), "cwd").exists()


def test_many_failures_are_no_accident(whole_run):
    code, lines = whole_run({name: [1, 0] for name in "abcdef"}, "--again")
    assert code == 1
    assert lines[-1] == "6 passed, 6 failed, 0 skipped"


def test_quiet_tells_what_fails_alone(whole_run):
    code, lines = whole_run({"a": [0], "b": [1]}, "--quiet")
    assert code == 1
    assert not any(line.startswith("ok") for line in lines)
    assert lines.index("     case: reason 1") < lines.index("output")  # what failed first, then how
    assert lines[-1] == "3 passed, 1 failed, 0 skipped"


FAST, SLOW = "<launch/>", "<launch>\n  <!-- slow -->\n</launch>"


@pytest.fixture
def package(monkeypatch, tmp_path):
    """A workspace of one package with these tests: {name of a file: its text}."""
    monkeypatch.setattr(run_tests, "ROOT", tmp_path)
    (tmp_path / "src" / "box" / "test").mkdir(parents=True)
    (tmp_path / "docs").mkdir()
    (tmp_path / "src" / "box" / "package.xml").write_text("<package/>")

    def write(files):
        for name, text in files.items():
            (tmp_path / "src" / "box" / "test" / name).write_text(text)

    return write


def test_slow_files_of_rostest_are_left_out(package):
    package({"fast.test": FAST, "slow.test": SLOW})
    for slow, names in ((False, ["fast.test"]), (True, ["fast.test", "slow.test"])):
        assert sorted(job.path.name for job in run_tests.find_jobs({"box"}, "all", scripts=False, slow=slow)) == names


@pytest.mark.parametrize("slow, counts", [(False, (1, 1)), (True, (2, 0))])
def test_slow_tests_of_pytest_are_left_out(package, tmp_path, slow, counts):
    package({"test_a.py": "import pytest\ndef test_fast(): pass\n@pytest.mark.slow\ndef test_slow(): pass\n"})
    (job,) = run_tests.find_jobs({"box"}, "all", scripts=False, slow=slow)
    result = run_tests.run(job, tmp_path)
    assert (result.passed, result.left_out) == counts and not result.failed, result.output


@pytest.mark.parametrize(
    "slow, text", [(True, "import pytest\n"), (False, "import pytest\n"), (True, "syntax error"), (False, "syntax error")]
)
def test_a_folder_without_tests_fails_if_they_are_not_left_out_but_missing(package, tmp_path, slow, text):
    package({"test_a.py": text})
    (job,) = run_tests.find_jobs({"box"}, "all", scripts=False, slow=slow)
    assert run_tests.run(job, tmp_path).failed == 1


def test_a_folder_of_slow_tests_does_not_fail(package, tmp_path):
    package({"test_a.py": "import pytest\n@pytest.mark.slow\ndef test_slow(): pass\n"})
    (job,) = run_tests.find_jobs({"box"}, "all", scripts=False, slow=False)
    result = run_tests.run(job, tmp_path)
    assert (result.passed, result.failed, result.left_out) == (0, 0, 1)


@pytest.mark.parametrize("options, slow", [([], False), (["--all"], True), (["--since", "HEAD"], True), (["ode_sim"], True)])
def test_who_asks_for_all_or_for_a_package_gets_what_is_slow(monkeypatch, options, slow):
    asked = []
    monkeypatch.setattr(run_tests, "find_jobs", lambda packages, kind, scripts, slow: asked.append(slow) or [])
    monkeypatch.setattr(sys, "argv", ["run_tests.py", *options])
    run_tests.main()
    assert asked == [slow]


def test_of_one_package_one_rostest_is_at_work(tmp_path, monkeypatch):
    """The others go on with other packages; pytest runs beside it."""
    jobs = [
        run_tests.Job(tmp_path / package, kind, tmp_path / package / f"{number}")
        for package, kind, number in [("a", "rostest", 1), ("a", "rostest", 2), ("a", "pytest", 3), ("b", "rostest", 4)]
    ]
    waiting = run_tests.Queue(jobs)
    first, second, third = waiting.take(0), waiting.take(0), waiting.take(0)
    assert [first, second, third] == [jobs[0], jobs[3], jobs[2]]
    waiting.done(first)
    assert waiting.take(0) == jobs[1] and waiting.take(1) is None
    at_work, most = [], []

    def run_one(job, scratch):
        at_work.append(job.package)
        most.append(max(at_work.count(package) for package in at_work))
        threading.Event().wait(0.01)
        at_work.remove(job.package)
        return run_tests.Result(job, 1, 0, 0, 0.0, "")

    monkeypatch.setattr(run_tests, "run", run_one)
    many = [run_tests.Job(tmp_path / f"{number % 4}", "rostest", tmp_path / f"{number}") for number in range(40)]
    assert sorted(result.job.path for result in run_tests.run_all(many, 3, tmp_path)) == sorted(job.path for job in many)
    assert set(most) == {1}

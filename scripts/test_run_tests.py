"""scripts/run_tests.py: what a file that fails once, or each time, makes of the whole run."""
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))
import run_tests


@pytest.fixture
def whole_run(monkeypatch, tmp_path, capsys):
    """Run with these results: {file: [failures of the first try, of the second ...]}; (exit code, lines printed)."""
    def run(results, *options):
        jobs = [run_tests.Job(tmp_path, "pytest", tmp_path / name) for name in results]
        tries = {name: list(failures) for name, failures in results.items()}

        def run_one(job, scratch):
            failed = tries[job.path.name].pop(0)
            return run_tests.Result(job, 2 - failed, failed, 0, 0.1, "output", [f"case: reason {failed}"] * failed)

        monkeypatch.setattr(run_tests, "find_jobs", lambda packages, kind, scripts: jobs)
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
    code, lines = whole_run({"a": [1, 1, 2], "b": [1, 1, 0]}, "--again")
    assert code == 1
    assert lines[-1] == "2 passed, 2 failed, 0 skipped"
    assert [line.split(":")[0] for line in lines[-4:-1]] == ["unsteady", "failed", "failed"]


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

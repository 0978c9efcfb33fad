"""scripts/coverage_of_tests.py: what a process and those it starts have run, however they end."""

import os
import subprocess
import sys
from pathlib import Path

import coverage_of_tests
import pytest

NODE = """
import os, signal, subprocess, sys

def by_{name}():
    return {ending}

def never():
    return 1

if sys.argv[1:]:
    subprocess.run([sys.executable, *sys.argv[1:]])
by_{name}()
"""
ENDINGS = {"return": "None", "exit": "os._exit(0)", "signal": "os.kill(os.getpid(), signal.SIGTERM)"}


def test_processes_are_counted_however_they_end(tmp_path):
    if not coverage_of_tests.TOOL.is_dir():
        pytest.skip("the tool is not installed; scripts/test --coverage does it")
    source = tmp_path / "source"
    source.mkdir()
    files = []
    for name, ending in ENDINGS.items():
        (source / f"{name}.py").write_text(NODE.format(name=name, ending=ending))
        files.append(str(source / f"{name}.py"))
    environment = dict(os.environ, **coverage_of_tests.environment(tmp_path / "seen", source))
    subprocess.run([sys.executable, *files], env=environment, check=True, timeout=60)
    lines = coverage_of_tests.report(tmp_path / "seen", tmp_path / "out", [])
    assert (tmp_path / "out" / "index.html").is_file()
    # of eight statements each never() leaves one out, and the last process starts nobody
    assert lines[-1].startswith("all of these") and lines[-1].split()[3:6] == ["20", "of", "24"], lines


def test_lines_count_for_their_package():
    def entry(run, lines):
        return {"summary": {"covered_lines": run, "num_statements": lines}}

    files = {
        "src/simulation/ode_sim/src/ode_sim/world.py": entry(3, 4),
        "src/simulation/ode_sim/src/ode_sim/math3.py": entry(1, 6),
        "src/common/test_support/src/test_support/cases.py": entry(5, 5),
    }
    assert list(coverage_of_tests.table(files, [])) == [("ode_sim", 4, 10), ("test_support", 5, 5)]
    assert list(coverage_of_tests.table(files, ["test_support"])) == [("test_support", 5, 5)]
    assert coverage_of_tests.package_of(Path("scripts/run_tests.py")) == "scripts"

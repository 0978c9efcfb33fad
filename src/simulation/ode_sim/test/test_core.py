"""Runs test_core.cpp: the pure functions of the core."""

import pathlib
import subprocess

from ode_sim import _core

PROGRAM = pathlib.Path(_core.__file__).parents[3] / "ode_sim" / "test_core"  # devel/lib/ode_sim


def test_pure_functions():
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    run = subprocess.run([str(PROGRAM), "--gtest_brief=1"], capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-1000:]

"""Ctrl-C while a node script imports what it needs: it ends by the signal, without a word."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[3]
#: put in front of a script: the first import from outside Python's own library says so and stands still
STANDSTILL = """
import sys, time

class Standstill:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in sys.stdlib_module_names | {"sitecustomize", "usercustomize", EXCEPTED}:
            print("importing", flush=True)
            time.sleep(600)

sys.meta_path.insert(0, Standstill())
"""


#: nodes that launch files start: for them even the import of node_signals would be too long
LAUNCHED = {"gzserver", "spawn_model", "spawner", "unspawner"}


def scripts():
    """Every Python script that a package of the workspace installs."""
    found = [
        path
        for pattern in ("scripts/*", "bin/*")
        for path in SOURCES.rglob(pattern)
        if path.is_file() and "test" not in path.relative_to(SOURCES).parts
    ]
    return sorted(path for path in found if path.read_bytes()[:40].startswith(b"#!/usr/bin/env python3"))


@pytest.mark.parametrize("script", scripts(), ids=lambda path: f"{path.parent.parent.name}-{path.name}")
def test_ctrl_c_in_the_first_second(script, tmp_path):
    excepted = "" if script.name in LAUNCHED else "node_signals"
    (tmp_path / "sitecustomize.py").write_text(STANDSTILL.replace("EXCEPTED", repr(excepted)))
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"}
    process = subprocess.Popen(
        [sys.executable, script, "name"], env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    try:
        first = process.stdout.readline()
        if first != "importing\n":  # it needs nothing that takes long
            assert "Traceback" not in first + process.communicate(timeout=60)[0]
            return
        process.send_signal(signal.SIGINT)
        rest, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert (rest, process.returncode) == ("", -signal.SIGINT)


@pytest.mark.parametrize("raised, told", [("print('a line\\n' * 100000)", "code 141\n"), ("raise BrokenPipeError()", "Traceback")])
def test_what_nobody_reads_ends_without_a_word(tmp_path, raised, told):
    script = tmp_path / "script"
    script.write_text(f"import node_signals\nwith node_signals.silent():\n    {raised}\n")
    process = subprocess.run(
        ["bash", "-c", f"{{ {sys.executable} {script}; echo code $? >&2; }} | head -n 1"], capture_output=True, text=True, timeout=60
    )
    assert process.stderr.startswith(told), process.stderr

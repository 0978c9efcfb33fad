"""Every program of scripts/ and docker/chroot says what it is for when asked, and does nothing else."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = sorted(path for path in (ROOT / "scripts").iterdir() if path.is_file() and path.stat().st_mode & 0o100 and not path.suffix)


@pytest.mark.parametrize("program", [*PROGRAMS, ROOT / "docker/chroot"], ids=lambda path: path.name)
def test_help_is_told_from_any_folder(program, tmp_path):
    ended = subprocess.run([program, "--help"], capture_output=True, text=True, timeout=20, cwd=tmp_path, stdin=subprocess.DEVNULL)
    assert ended.returncode == 0 and ended.stderr == "", ended.stderr
    assert program.name in ended.stdout or "usage:" in ended.stdout
    assert len(ended.stdout.splitlines()) > 1 and not list(tmp_path.iterdir())

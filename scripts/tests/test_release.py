"""scripts/release in a repository of its own: changelog, version, commit, tag; and what keeps it from that."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NEEDED = (
    "scripts/release",
    "pyproject.toml",
    "CHANGELOG.md",
    "changes/template.md",
    "changes/README.md",
    "src/tools/noetic_environment/package.xml",
)

pytestmark = pytest.mark.skipif(shutil.which("towncrier") is None, reason="apt install towncrier")


@pytest.fixture
def clone(tmp_path):
    for name in NEEDED:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    git(tmp_path, "init", "-q")
    git(tmp_path, "config", "user.name", "n")
    git(tmp_path, "config", "user.email", "n@example.org")
    (tmp_path / "changes/arm.new.md").write_text("The arm waves,\nwith both hands.\n")
    (tmp_path / "changes/wheel.mended.md").write_text("A wheel turns.\n")
    commit(tmp_path)
    return tmp_path


def git(folder, *words):
    return subprocess.run(["git", *words], cwd=folder, check=True, capture_output=True, text=True).stdout


def commit(folder):
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "x")


def release(folder, *words):
    return subprocess.run([folder / "scripts/release", *words], capture_output=True, text=True, timeout=60)


def test_a_release_is_a_section_a_version_and_a_tag(clone):
    before = (clone / "CHANGELOG.md").read_text()
    done = release(clone, "7.8.9")
    assert done.returncode == 0, done.stderr
    section = r"## 7\.8\.9 \(\d{4}-\d\d-\d\d\)\n+### New\n+- The arm waves,\n  with both hands\.\n+### Mended\n+- A wheel turns\.\n"
    assert re.search(section, done.stdout)
    after = (clone / "CHANGELOG.md").read_text()
    assert re.search(section, after) and after.index("7.8.9") < after.index("0.2.0")
    assert before.partition("<!-- releases -->\n")[2].strip() in after
    assert "<version>7.8.9</version>" in (clone / "src/tools/noetic_environment/package.xml").read_text()
    assert git(clone, "tag", "--points-at", "HEAD").split() == ["v7.8.9"] and git(clone, "status", "--porcelain") == ""
    assert sorted(path.name for path in (clone / "changes").iterdir()) == ["README.md", "template.md"]


def test_a_draft_changes_nothing(clone):
    assert "The arm waves" in release(clone, "--draft", "7.8.9").stdout
    assert git(clone, "status", "--porcelain") == "" and git(clone, "tag") == ""


def test_what_is_in_the_way_is_said_in_a_line(clone):
    (clone / "stray").write_text("x")
    assert "not committed" in release(clone, "7.8.9").stderr
    commit(clone)
    git(clone, "tag", "v7.8.9")
    assert "v7.8.9 is there" in release(clone, "7.8.9").stderr
    for name in ("arm.new.md", "wheel.mended.md"):
        (clone / "changes" / name).unlink()
    commit(clone)
    assert "no file of a change" in release(clone, "8.0.0").stderr
    assert release(clone, "eight").returncode == release(clone).returncode == 2


def test_each_file_of_a_change_has_a_kind():
    names = {path.name for path in (ROOT / "changes").iterdir()} - {"README.md", "template.md"}
    assert all(re.fullmatch(r"[\w-]+\.(new|changed|mended)\.md", name) for name in names), names

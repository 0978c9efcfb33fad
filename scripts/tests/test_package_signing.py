"""What scripts/package writes into a repository: an index that apt takes by its signature alone, and licences; requirements by hash."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[1]
from packaging_debian import debs  # noqa: E402
from packaging_debian.tree import PackagingError  # noqa: E402

REQUIREMENTS = sorted(SCRIPTS.glob("requirements*.txt"))


def test_all_requirements_are_pinned_by_hash():
    """pip itself says so: --require-hashes refuses a file in which one has none, before it fetches anything."""
    assert len(REQUIREMENTS) == 6
    for file in REQUIREMENTS:
        entries = re.sub(r"\\\n", " ", file.read_text()).splitlines()
        for entry in entries:
            if entry and not entry.startswith("#"):
                assert re.fullmatch(r"[A-Za-z0-9._-]+==\S+( +--hash=sha256:[0-9a-f]{64})+ *", entry), entry


@pytest.fixture
def key(tmp_path, monkeypatch):
    if not shutil.which("gpg"):
        pytest.skip("gpg is not installed")
    home = tmp_path / "gnupg"
    home.mkdir(mode=0o700)
    monkeypatch.setenv("GNUPGHOME", str(home))
    make = ["gpg", "--batch", "--quiet", "--passphrase", "", "--quick-generate-key", "course@example.org", "ed25519", "sign"]
    subprocess.run(make, check=True)
    yield "course@example.org"
    subprocess.run(["gpgconf", "--kill", "gpg-agent"], env=os.environ)


def a_repository(folder: Path) -> Path:
    package = folder / "made" / "nothing"
    package.mkdir(parents=True)
    deb = debs._build(package, "nothing", debs.Release("1.0", "all", 1_700_000_000), "all", [], "nothing", "Nothing.", "None.\n")
    return debs.repository([deb], folder / "repository")


def update(folder: Path, line: str) -> "subprocess.CompletedProcess[str]":
    """apt-get update on that line alone, in folders of its own."""
    for name in ("state/lists/partial", "cache", "parts"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    (folder / "sources.list").write_text(line + "\n")
    options = {
        "Dir::State": folder / "state",
        "Dir::Cache": folder / "cache",
        "Dir::Etc::sourcelist": folder / "sources.list",
        "Dir::Etc::sourceparts": folder / "parts",
        "Dir::State::status": "/dev/null",
        "APT::Sandbox::User": "root",
        "Debug::NoLocking": "1",
    }
    words = ["apt-get", "update", *(f"-o{name}={value}" for name, value in options.items())]
    return subprocess.run(words, capture_output=True, text=True)


@pytest.mark.skipif(not shutil.which("dpkg-scanpackages"), reason="dpkg-dev is not installed")
def test_apt_takes_what_was_signed_and_nothing_that_was_changed_afterwards(tmp_path, key):
    index = a_repository(tmp_path)
    line = f"deb [signed-by={index}/{debs.KEYRING}] file:{index} ./"
    assert update(tmp_path / "unsigned", f"deb file:{index} ./").returncode != 0
    debs.sign(index, debs.known_key(key))
    taken = update(tmp_path / "signed", line)
    assert taken.returncode == 0 and "Err:" not in taken.stdout + taken.stderr, taken.stdout + taken.stderr
    release = (index / "InRelease").read_text()
    (index / "InRelease").write_text(release.replace("Suite: local", "Suite: other"))
    (index / "Release.gpg").unlink()
    assert update(tmp_path / "changed", line).returncode != 0


def test_a_key_that_is_not_there_is_one_line(key):
    with pytest.raises(PackagingError, match="gpg has no secret key 'nobody@example.org'"):
        debs.known_key("nobody@example.org")


def test_the_add_ons_licences_lie_beside_the_copyright(tmp_path):
    information = tmp_path / "tree/share/noetic_environment/python/viser-1.1.1.dist-info"
    (information / "licenses").mkdir(parents=True)
    (information / "METADATA").write_text("Name: viser\nVersion: 1.1.1\nLicense-Expression: Apache-2.0\n\ntext")
    (information / "licenses" / "LICENSE").write_text("Apache License")
    (information / "RECORD").write_text("x")
    debs._copy_licences(tmp_path / "tree", tmp_path / "doc")
    copied = [str(path.relative_to(tmp_path / "doc")) for path in (tmp_path / "doc").rglob("*") if path.is_file()]
    assert copied == ["viser/licenses_LICENSE"]
    assert "viser 1.1.1: Apache-2.0" in debs._add_on_licences(tmp_path / "tree")

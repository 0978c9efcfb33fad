"""scripts/package without its build: names, what is refused, and a repository that apt reads."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "scripts"))
debs = pytest.importorskip("packaging_debian.debs", reason="the package stands without the clone's scripts")
from packaging_debian import names, tree  # noqa: E402


def test_every_debian_package_is_listed_once_and_in_a_section_that_somebody_installs():
    wanted = ("build", "demo", "run", "headers", "desktop", "planning", "windows", "test", "docs")
    listed = names.sections(ROOT, *wanted)
    lines = [line for line in (ROOT / "scripts/debian-packages.txt").read_text().splitlines() if line and not line.startswith("#")]
    assert len(listed) == len(set(listed)) > 80
    assert {line for line in lines if not line.endswith("?")} <= set(listed) <= {line.rstrip("?") for line in lines}


def test_what_the_courses_install_is_covered():
    made = names.covered(ROOT)
    for name in (
        "xacro",
        "gazebo-ros-control",
        "gazebo-ros-pkgs",
        "ros-control",
        "ros-controllers",
        "rm-hw",
        "desktop-full",
        "rviz",
        "joint-state-publisher-gui",
        "robot-state-publisher",
        "roscpp",
        "tf2-ros",
    ):
        assert f"ros-noetic-{name}" in made, name
    assert made["ros-noetic-rviz"][0][0] == "rviz" and made["ros-noetic-xacro"][0] == []
    assert {"librviz-dev", "build-essential", "libpcl-ros-dev"} <= set(made["ros-noetic-desktop-full"][0])
    assert not any("ament" in name or "arm-gazebo" in name or "rosidl" in name for name in made)


def test_an_installation_of_somebody_else_is_left_alone(tmp_path):
    prefix = tmp_path / "noetic"
    tree.refuse_foreign(prefix)
    prefix.mkdir()
    tree.refuse_foreign(prefix)
    (prefix / "setup.bash").write_text("somebody's\n")
    ended = subprocess.run([ROOT / "scripts/package", "--prefix", prefix], capture_output=True, text=True, timeout=60)
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "holds another installation" in ended.stderr
    assert (prefix / "setup.bash").read_text() == "somebody's\n"
    (prefix / tree.MARK).parent.mkdir(parents=True)
    (prefix / tree.MARK).write_text("ours\n")
    tree.refuse_foreign(prefix)


def test_a_prefix_that_cannot_be_written_is_refused_before_the_build(tmp_path):
    (tmp_path / "file").write_text("")
    ended = subprocess.run(
        [ROOT / "scripts/package", "--prefix", tmp_path / "file/noetic", "--check"], capture_output=True, text=True, timeout=60
    )
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "nothing can be written to" in ended.stderr
    free = subprocess.run([ROOT / "scripts/package", "--prefix", tmp_path / "a/b", "--check"], capture_output=True, text=True, timeout=60)
    assert (free.returncode, free.stderr, (tmp_path / "a").exists()) == (0, "", False)


def test_an_older_tree_is_replaced_as_a_whole(tmp_path):
    staged, prefix = tmp_path / "staged", tmp_path / "opt/noetic"
    for number in ("1", "2"):
        (staged / number).mkdir(parents=True)
        tree.replace(prefix, staged)
        assert [path.name for path in prefix.iterdir()] == [number] and [path.name for path in prefix.parent.iterdir()] == ["noetic"]
        (staged / number).rmdir()


def test_apt_reads_the_repository_and_a_later_version_is_an_upgrade(tmp_path):
    made = [
        debs.name_only(
            "ros-noetic-rviz",
            ["rviz"],
            "Debian's packages of rviz",
            debs.Release(f"0.1.0+2025010{day}000000~deb12", "amd64", 1735689600 + day),
        )
        for day in (1, 2)
    ]
    repository = debs.repository(made, tmp_path / "repository")
    assert sorted(path.name for path in repository.iterdir()) == [
        "Packages",
        "Packages.gz",
        "Release",
        "ros-noetic-rviz_0.1.0+20250101000000~deb12_all.deb",
        "ros-noetic-rviz_0.1.0+20250102000000~deb12_all.deb",
    ]
    (tmp_path / "sources.list").write_text(f"deb [trusted=yes] file:{repository} ./\n")
    (tmp_path / "lists/partial").mkdir(parents=True)
    (tmp_path / "cache/archives/partial").mkdir(parents=True)
    (tmp_path / "status").write_text("")
    options = [
        f"-oDir::Etc::SourceList={tmp_path}/sources.list",
        "-oDir::Etc::SourceParts=/dev/null",
        "-oAPT::Sandbox::User=",
        f"-oDir::State::lists={tmp_path}/lists",
        f"-oDir::Cache={tmp_path}/cache",
        f"-oDir::State::status={tmp_path}/status",
    ]
    updated = subprocess.run(["apt-get", *options, "update"], capture_output=True, text=True, timeout=60)
    assert updated.returncode == 0 and "W:" not in updated.stderr and "E:" not in updated.stderr, updated.stderr
    shown = subprocess.run(
        ["apt-cache", *options, "show", "--no-all-versions", "ros-noetic-rviz"], capture_output=True, text=True, timeout=60
    ).stdout
    assert "Version: 0.1.0+20250102000000~deb12" in shown
    assert "Depends: noetic-labs (= 0.1.0+20250102000000~deb12), rviz" in shown and "BSD" not in shown


def test_the_same_commit_gives_the_same_bytes():
    release = debs.Release("1~deb12", "amd64", 1735689600)
    one, other = (debs.name_only("ros-noetic-x", [], "x", release).read_bytes() for _ in range(2))
    assert one == other


def test_a_file_without_install_rule_is_found(tmp_path):
    sources, installed = tmp_path / "sources", tmp_path / "tree"
    package = sources / "src/tools/p"
    for name in (
        "package.xml",
        "plugins.xml",
        "launch/a.launch",
        "worlds/w.world",
        "scripts/node",
        "nodes/turtle",
        "src/p/m.py",
        "src/core.cpp",
        "panel/gui.h",
        "test/test_p.py",
        "README.md",
    ):
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text("")
    for name in ("share/p/package.xml", "share/p/plugins.xml", "share/p/launch/a.launch", "lib/p/node", "lib/p/turtle"):
        (installed / name).parent.mkdir(parents=True, exist_ok=True)
        (installed / name).write_text("")
    assert tree.not_installed(sources, installed) == ["tools/p/src/p/m.py", "tools/p/worlds/w.world"]

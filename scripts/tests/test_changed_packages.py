"""scripts/changed_packages.py: which packages are tested after which change, and that the manifests it reads are complete."""

import contextlib
import re
import subprocess
from pathlib import Path

import changed_packages
import pytest
from needed_packages import needed_by_code
from test_workspace import imports

MANIFEST = """<package format="2"><name>{name}</name><version>0.0.0</version><description>One of the chain.</description>
<maintainer email="somebody@example.org">A</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>{uses}</package>"""


@pytest.fixture
def root(tmp_path):
    """core <- face <- lab; bench's tests use face; helper is used by core's tests, and needs face."""
    uses = {
        "core": "<export><tests_use>helper</tests_use></export>",
        "face": "<build_depend>core</build_depend>",
        "room/lab": "<exec_depend>face</exec_depend>",
        "bench": "<test_depend>face</test_depend>",
        "helper": "<depend>face</depend>",
        "alone": "",
    }
    for place, used in uses.items():
        folder = tmp_path / "src" / place
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(MANIFEST.format(name=folder.name, uses=used))
    (tmp_path / "docs").mkdir()
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-q", "-m", "begin")
    return tmp_path


def git(root, *arguments):
    subprocess.run(["git", "-c", "user.name=A", "-c", "user.email=a@b.c", *arguments], cwd=root, check=True)


def breakable(root, *files):
    return changed_packages.breakable([Path(name) for name in files], changed_packages.workspace(root))


def test_whoever_needs_it_is_tested_and_whose_tests_use_these(root):
    assert breakable(root, "src/core/src/step.cpp") == {"core", "face", "lab", "bench", "helper"}
    assert breakable(root, "src/room/lab/launch/lab.launch") == {"lab"}
    assert breakable(root, "src/helper/src/helper.py") == {"helper", "core"}  # who needs core has nothing of helper


def test_a_test_helper_reaches_no_further_than_the_tests(root):
    assert breakable(root, "src/bench/test/test_bench.py") == {"bench"}


def test_files_of_no_package(root):
    everything = {"core", "face", "lab", "bench", "helper", "alone"}
    assert breakable(root, "README.md", "scripts/lint") == set()
    assert breakable(root, "scripts/setup") == everything
    assert breakable(root, "src/gone/package.xml") == everything  # of a package that is no more


def test_what_differs_is_committed_changed_new_or_gone(root):
    first = subprocess.run(["git", "rev-parse", "HEAD"], cwd=root, capture_output=True, text=True).stdout.strip()
    (root / "src/alone/committed.py").write_text("")
    git(root, "add", "-A")
    git(root, "commit", "-q", "-m", "one more")
    (root / "src/face/package.xml").write_text(MANIFEST.format(name="face", uses=""))
    (root / "src/room/lab/new file.py").write_text("")
    (root / "src/bench/package.xml").unlink()
    since_first = {path.as_posix() for path in changed_packages.changed_files(first, root)}
    assert since_first == {"src/alone/committed.py", "src/face/package.xml", "src/room/lab/new file.py", "src/bench/package.xml"}
    assert Path("src/alone/committed.py") not in changed_packages.changed_files("HEAD", root)


def test_an_unknown_commit_is_told(root):
    with pytest.raises(changed_packages.UnknownCommit, match="git cannot compare with nowhere: "):
        changed_packages.changed_files("nowhere", root)


PACKAGES = {package.name: (folder, package) for folder, package in changed_packages.workspace().items()}


def used(path):
    """Names of packages that a file speaks of: imports, ``$(find ...)``, nodes, controllers' types, meshes, commands."""
    try:
        text = path.read_text()
    except UnicodeDecodeError:
        return set()
    names = set(re.findall(r"type[\"']?: *[\"']?(\w+)/[A-Z]", text))
    if path.suffix == ".py" or text.startswith("#!/usr/bin/env python"):
        if "test" in path.parts:
            names |= set(re.findall(r"(?:rosrun|roslaunch)[\s\"',]+(\w+)", text))
        with contextlib.suppress(SyntaxError):  # some file that is to be told as broken
            names |= imports(path)
    if path.suffix in (".launch", ".test", ".xacro", ".xml", ".world", ".urdf"):
        names |= set(re.findall(r"\$\(find (\w+)\)|(?:pkg|type)=\"(\w+)\"|package://(\w+)/", text))
    return {name for found in names for name in ([found] if isinstance(found, str) else found) if name}


def declared(name):
    """All that a package's files may speak of: what it needs, what its tests use, and what these need."""
    _, package = PACKAGES[name]
    found, waiting = {name}, [*needed_by_code(package), *changed_packages.used_by_tests(package)]
    while waiting:
        one = waiting.pop()
        if one in PACKAGES and one not in found:
            found.add(one)
            waiting += needed_by_code(PACKAGES[one][1])
    return found


@pytest.mark.parametrize("name", sorted(PACKAGES))
def test_manifests_name_what_tests_use(name):
    """Else ``--since`` leaves out a test that a change can break."""
    # the example in C++ exports its controller under the name of its twin in Python
    may = declared(name) | ({"my_controllers"} if name == "my_cpp_controllers" else set())
    folder = changed_packages.ROOT / PACKAGES[name][0]
    missing = {(one, path.name) for path in folder.rglob("*") if path.is_file() for one in used(path) & set(PACKAGES) - may}
    assert not missing, f"{folder / 'package.xml'}: <test_depend>, or <tests_use> in <export> where that would be a circle"

"""What scripts/debian-packages.txt must hold is derived: from manifests and CMake files, by rosdep's rules and apt's dependencies."""

import functools
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
import needed_packages  # noqa: E402

pytestmark = pytest.mark.skipif(not Path("/usr/share/python3-rosdep2/debian.yaml").exists(), reason="rosdep's rules are not installed")
#: what CMake's own modules look for, and who has it in Debian
CMAKE_MODULES = {
    "Boost": "libboost-dev",
    "OpenGL": "libgl-dev",
    "PkgConfig": "pkgconf|pkg-config",
    "Python": "python3-dev",
    "Threads": "libc6-dev",
    "X11": "libx11-dev",
    "SQLite3": "libsqlite3-dev",
}
#: packages whose own exec_depends the Debian package does not bring, and why
NOT_FOR_USERS = {
    "rqt_testing": "clicks through windows in the workspace's own tests",
    "roslint": "runs while something is compiled, and what compiles comes with ros-noetic-desktop-full",
}
FIND = re.compile(r"\bfind_package\(\s*(\w+)(?=[\s)])([^)]*)\)", re.S)
SET = re.compile(r"\bset\(\s*(\w+)\s+([^)]*)\)", re.S)
MODULES = re.compile(r"\bpkg_check_modules\(\s*\w+\s+([^)]*)\)", re.S)
TEST_BLOCK = re.compile(r"^if\(CATKIN_ENABLE_TESTING.*?^endif\(\)", re.S | re.M)
COMPILED_BLOCK = re.compile(r"^if\((?:compiled|NOETIC_LABS_COMPILED_PLUGINS)\b.*?^endif\(\)", re.S | re.M)


def sections():
    """name -> Debian packages; what is optional (a name with ?) is in it where this release has it."""
    found, name = {}, None
    for line in (ROOT / "scripts/debian-packages.txt").read_text().splitlines():
        if line.startswith("# section: "):
            name = line.split(": ")[1]
            found[name] = []
        elif line and not line.startswith("#") and (not line.endswith("?") or line.rstrip("?") in known()):
            found[name].append(line.rstrip("?"))
    return found


@functools.cache
def not_in_this_release():
    """What is optional and is not there: other releases of Debian have it."""
    lines = (ROOT / "scripts/debian-packages.txt").read_text().splitlines()
    return {line.rstrip("?") for line in lines if line.endswith("?")} - known()


@functools.cache
def known():
    """Every name that apt knows."""
    return frozenset(subprocess.run(["apt-cache", "pkgnames"], capture_output=True, text=True, check=True, timeout=120).stdout.split())


@functools.cache
def owner(pattern):
    """The Debian package that has a file of this name here, None where none is installed."""
    said = subprocess.run(["dpkg", "-S", pattern], capture_output=True, text=True, timeout=120).stdout
    return said.partition(":")[0] or None


@functools.cache
def brought(*names):
    """What apt installs for the sections ``names``, without recommendations: names, virtual ones among them."""
    wanted = [package for name in names for package in sections()[name]]
    said = subprocess.run(
        ["apt-cache", "depends", "--recurse", "--important", *wanted], capture_output=True, text=True, check=True, timeout=120
    ).stdout
    return frozenset(word.strip("<>") for word in re.findall(r"^\s*\|?(?:Depends: |PreDepends: |)(\S+)$", said, re.M))


@functools.cache
def rules():
    """rosdep key -> Debian packages."""
    found = {}
    for path in ("/usr/share/python3-rosdep2/debian.yaml", ROOT / "src/tools/noetic_environment/rosdep/rules.yaml"):
        for key, system in yaml.safe_load(Path(path).read_text()).items():
            names = system.get("debian", [])
            found[key] = names.get("*", []) if isinstance(names, dict) else names
    return found


@functools.cache
def workspace():
    packages = pytest.importorskip("catkin_pkg.packages")
    return {package.name: (package, ROOT / "src" / path) for path, package in packages.find_packages(str(ROOT / "src")).items()}


DEMO = re.search(r"--demo\) demo=\(([^)]*)\)", (ROOT / "scripts/setup").read_text()).group(1).split()


def demo_packages():
    workspace()
    return needed_packages.needed(DEMO, ["theora_image_transport"])


def asked_by_cmake(name, compiled):
    """CMake packages and pkg-config modules that the package cannot be configured without, tests apart."""
    text = TEST_BLOCK.sub("", (workspace()[name][1] / "CMakeLists.txt").read_text())
    if not compiled:
        text = COMPILED_BLOCK.sub("", text)
    text = re.sub(r"#.*", "", text)
    for variable, words in SET.findall(text):
        text = text.replace(f"${{{variable}}}", words)
    for found, rest in FIND.findall(text):
        words = rest.split()
        if "REQUIRED" not in words:
            continue
        if found == "catkin":
            yield from (word for word in words[words.index("COMPONENTS") + 1 :] if "$" not in word) if "COMPONENTS" in words else ()
        else:
            yield found
    for rest in MODULES.findall(text):
        words = rest.split()
        if "REQUIRED" in words:
            yield from (re.split("[<>=]", word)[0] for word in words if word not in ("REQUIRED", "QUIET", "IMPORTED_TARGET"))


def debian_for(key, kind):
    """
    Debian packages behind a name that a manifest or CMake asks for; of what rosdep names those of the ``kind``: build (headers) or run.

    :return: names, "a|b" where either does; None where nothing is known
    """
    if key in CMAKE_MODULES:
        return [CMAKE_MODULES[key]]
    named = rules().get(key) or rules().get(key.lower()) or ([key] if key in known() else None)
    if named is None:
        found = owner(f"*/pkgconfig/{key}.pc") or owner(f"*/{key}Config.cmake") or owner(f"*/{key}-config.cmake")
        return [found] if found else None
    headers = [name for name in named if name.endswith("-dev")]
    return headers or named if kind == "build" else [name for name in named if not name.endswith("-dev")]


def lacking(names, key_source, kind, have):
    """Lines "package: key wants Debian package", for what ``have`` does not hold."""
    lines = []
    for name in names:
        for key in sorted(set(key_source(name))):
            if key in workspace() or key == "catkin" or key in not_in_this_release():
                continue
            found = debian_for(key, kind)
            if found is None:
                lines.append(f"{name}: no rule knows {key}")
            lines += [f"{name}: {key} wants {debian}" for debian in found or [] if not set(debian.split("|")) & have]
    return lines


def built_with(name):
    package = workspace()[name][0]
    return [depend.name for depend in package.buildtool_depends + package.build_depends + package.build_export_depends]


def run_with(name):
    return [depend.name for depend in workspace()[name][0].exec_depends]


def test_a_bare_machine_can_configure_what_the_demo_builds():
    assert lacking(demo_packages(), lambda name: asked_by_cmake(name, compiled=False), "build", brought("build")) == []


def test_what_the_demo_runs_with_is_installed():
    assert lacking(demo_packages(), run_with, "run", brought("build", "demo")) == []


def test_everything_can_be_configured_and_run_with_what_scripts_setup_installs():
    everything = sorted(workspace())
    assert lacking(everything, lambda name: asked_by_cmake(name, compiled=True), "build", brought(*sections())) == []
    assert lacking(everything, built_with, "build", brought(*sections())) == []
    assert lacking(everything, run_with, "run", brought(*sections())) == []


def test_the_debian_package_depends_on_what_its_programs_run_with():
    platform = [
        name for name, (_, path) in workspace().items() if "labs" not in path.relative_to(ROOT / "src").parts and name not in NOT_FOR_USERS
    ]
    assert lacking(platform, run_with, "run", brought("demo", "run", "planning", "windows")) == []


def test_a_missing_name_is_seen(monkeypatch):
    """The fault that this file is for: gazebo_ros_control asked for angles, and nothing brought it."""
    names = [name for name in sections()["build"] if name != "libangles-dev"]
    monkeypatch.setattr(sys.modules[__name__], "sections", lambda: {"build": names})
    brought.cache_clear()
    try:
        assert "gazebo_ros_control: angles wants libangles-dev" in lacking(
            demo_packages(), lambda name: asked_by_cmake(name, compiled=False), "build", brought("build")
        )
    finally:
        brought.cache_clear()

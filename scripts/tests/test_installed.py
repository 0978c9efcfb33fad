"""What the build would install, without compiling it again: the tree of scripts/package and of scripts/setup --prefix."""

import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from packaging_debian import tree

ROOT = Path(__file__).resolve().parents[2]


def install(package: Path, stage: Path) -> str:
    """:return: what cmake said where it failed, else nothing"""
    rules = ROOT / "build" / package.name / "cmake_install.cmake"
    if not rules.exists():
        return f"{package.name} is not built: scripts/setup"
    environment = {**os.environ, "DESTDIR": str(stage), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
    ended = subprocess.run(["cmake", "-P", rules], capture_output=True, text=True, env=environment, cwd=rules.parent, timeout=300)
    return f"{package.name}: {ended.stdout}{ended.stderr}" if ended.returncode else ""


def test_where_it_was_built_is_not_looked_into_from_where_it_is_installed(tmp_path):
    (tmp_path / "lib").mkdir()
    files = {
        "_setup_util.py": (f"CMAKE_PREFIX_PATH = r'{tmp_path}'.split(';')\n", "CMAKE_PREFIX_PATH = r''.split(';')\n"),
        "lib/armConfig.cmake": (f"foreach(path /opt/x/lib;{tmp_path}/lib)\n", "foreach(path /opt/x/lib)\n"),
        "setup.sh": ("export A=/opt/x\n", "export A=/opt/x\n"),
    }
    for name, (before, _) in files.items():
        (tmp_path / name).write_text(before)
    tree.clean(tmp_path)
    assert {name: (tmp_path / name).read_text() for name in files} == {name: after for name, (_, after) in files.items()}


@pytest.mark.slow
def test_every_file_that_a_package_needs_where_it_is_installed_has_an_install_rule(tmp_path):
    packages, whole = tree.platform_packages(ROOT), tmp_path / "whole"
    with ThreadPoolExecutor(os.cpu_count()) as workers:  # each for itself: all of them write setup.sh
        for package, said in zip(packages, workers.map(lambda package: install(package, tmp_path / package.name), packages)):
            assert said == ""
            shutil.copytree(tmp_path / package.name, whole, symlinks=True, dirs_exist_ok=True)
            shutil.rmtree(tmp_path / package.name)
    (setup_file,) = whole.rglob("_setup_util.py")
    assert tree.not_installed(ROOT, setup_file.parent) == []

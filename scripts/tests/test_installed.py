"""What the build would install, without compiling it again: the tree of scripts/package and of scripts/setup --prefix."""

import os
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


@pytest.mark.slow
def test_every_file_that_a_package_needs_where_it_is_installed_has_an_install_rule(tmp_path):
    packages = tree.platform_packages(ROOT)
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        assert [said for said in workers.map(lambda package: install(package, tmp_path), packages) if said] == []
    (setup_file,) = tmp_path.rglob("_setup_util.py")
    assert tree.not_installed(ROOT, setup_file.parent) == []

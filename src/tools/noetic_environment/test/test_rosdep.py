"""rosdep as the courses type it, without a network."""

import os
import subprocess
from pathlib import Path

import pytest

PREFIX = next(
    (
        Path(prefix)
        for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
        if (Path(prefix) / "share/noetic_environment/rosdep").is_dir()
    ),
    None,
)
pytestmark = pytest.mark.skipif(PREFIX is None, reason="no sourced workspace has noetic_environment")


@pytest.fixture(scope="module")
def rosdep(tmp_path_factory):
    """Function that runs rosdep in a sourced shell with a home of its own that knows the rules."""
    home = tmp_path_factory.mktemp("home")

    def run(*arguments, cwd=home):
        return subprocess.run(
            ["/bin/bash", "-c", f'source {PREFIX}/setup.bash; exec rosdep "$@"', "-", *arguments],
            cwd=cwd,
            capture_output=True,
            text=True,
            timeout=120,
            env={"HOME": str(home), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "https_proxy": "http://127.0.0.1:9"},
        )

    updated = run("update")
    assert updated.returncode == 0 and "ERROR" not in updated.stderr, updated.stderr
    return run


@pytest.mark.slow
def test_what_is_covered_resolves_and_what_is_not_is_named(rosdep, tmp_path):
    package = tmp_path / "src/p"
    package.mkdir(parents=True)
    names = "roscpp gazebo gazebo_ros hector_gazebo_plugins controller_manager rviz octovis eigen python-lxml amcl"
    depends = "".join(f"<depend>{name}</depend>" for name in names.split())
    (package / "package.xml").write_text(
        "<package format='2'><name>p</name><version>1.0.0</version><description>d</description>"
        f"<maintainer email='a@example.org'>m</maintainer><license>BSD</license>{depends}</package>"
    )
    install = ("install", "--from-paths", "src", "--ignore-src", "-y", "--simulate", "--reinstall")
    refused = rosdep(*install, cwd=tmp_path)
    assert refused.returncode == 1 and "p: Cannot locate rosdep definition for [amcl]" in refused.stderr
    assert refused.stderr.count("Cannot locate") == 1
    taken = rosdep(*install, "--skip-keys", "amcl", cwd=tmp_path)
    assert taken.returncode == 0, taken.stderr
    named = set(taken.stdout.split())
    assert {"librviz-dev", "liboctovis-dev", "libeigen3-dev", "python3-lxml"} <= named and not any("gazebo" in word for word in named)


def test_every_package_of_the_platform_resolves_to_nothing_to_install(rosdep):
    names = [
        line.split(":")[0]
        for line in (PREFIX / "share/noetic_environment/rosdep/platform.yaml").read_text().splitlines()
        if not line.startswith("#")
    ]
    assert {"xacro", "gazebo_ros", "ros_control", "joint_state_publisher_gui"} <= set(names) and "arm_gazebo" not in names
    resolved = rosdep("resolve", *names)
    assert resolved.returncode == 0, resolved.stderr
    assert {line for line in resolved.stdout.splitlines() if line and not line.startswith("#")} == set()

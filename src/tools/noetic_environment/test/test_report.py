"""The report for somebody who helps: what it holds, and what it must not."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from noetic_environment import report

SCRIPT = Path(__file__).resolve().parents[1] / "scripts/report"
VEIL = report.Veil("/home/ada", "ada", "analytical-engine")


@pytest.mark.parametrize(
    "written, veiled",
    [
        ("/home/ada/catkin_ws/src", "~/catkin_ws/src"),
        ("file:///home/ada/x.sdf", "file://~/x.sdf"),
        ("/home/adam/x and /home/charles/y", "/home/USER/x and /home/USER/y"),
        ("ROS_MASTER_URI: http://analytical-engine:11311", "ROS_MASTER_URI: http://HOST:11311"),
        ("started by ada on analytical-engine.", "started by USER on HOST."),
        ("adapter, canada, ada-core stay", "adapter, canada, ada-core stay"),
        ("ROS_IP: 192.168.3.14, 127.0.0.1 stays", "ROS_IP: ADDRESS, 127.0.0.1 stays"),
        ("by ada.lovelace@example.org", "by MAIL"),
        ("https://user:word@host.org/x", "https://host.org/x"),
        ("token=abc123 password: hunter2", "token=... password: ..."),
    ],
)
def test_who_and_where_are_taken_out(written, veiled):
    assert VEIL.over(written) == veiled


def test_roots_machine_keeps_its_words():
    assert report.Veil("/root", "root", "localhost").over("root of the tree, /root/ws, /rooted, localhost") == (
        "root of the tree, ~/ws, /rooted, localhost"
    )


def written(tmp_path, **variables):
    environment = {**os.environ, "HOME": str(tmp_path / "ada"), **variables}
    for name in ("ROS_HOME", "ROS_LOG_DIR"):
        environment.pop(name, None)
    (tmp_path / "ada").mkdir(exist_ok=True)
    return subprocess.run([sys.executable, SCRIPT], env=environment, cwd=tmp_path, capture_output=True, text=True, timeout=100)


@pytest.mark.slow
def test_the_report_holds_versions_what_draws_and_the_last_logs(tmp_path):
    last = tmp_path / "ada/.ros/log/run"
    last.mkdir(parents=True)
    (last / "gazebo-2.log").write_text("".join(f"line {n} of {tmp_path}/ada/world\n" for n in range(1000)))
    (tmp_path / "ada/.ros/log/latest").symlink_to(last)
    ended = written(tmp_path, ROS_IP="10.1.2.3", SECRET_OF_MINE="never")
    assert ended.returncode == 0 and ended.stdout.startswith("noetic_report.txt: "), ended.stderr
    text = (tmp_path / "noetic_report.txt").read_text()
    release = next(line for line in Path("/etc/os-release").read_text().splitlines() if line.startswith("PRETTY_NAME"))
    assert f"system: {release.split('=')[1].strip(chr(34))}" in text
    for part in ("libode8", f"python: {sys.version.split()[0]}", "OpenGL: ", "ROS_IP: ADDRESS", "line 999 of ~/world", "line 800 of "):
        assert part in text, part
    for part in ("line 799 ", "10.1.2.3", str(tmp_path / "ada"), "never"):
        assert part not in text, part


@pytest.mark.slow
def test_without_any_log_and_without_a_place_to_write(tmp_path):
    ended = subprocess.run(
        [sys.executable, SCRIPT, "--output", tmp_path / "no/such/folder"],
        env={**os.environ, "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert (ended.returncode, ended.stderr) == (1, f"{tmp_path}/no/such/folder: No such file or directory\n")

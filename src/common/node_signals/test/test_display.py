"""rosrun and rviz where there is no display for a window, and everywhere else."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from node_signals.display import asked_for, choose_platform, next_on_path

BIN = Path(__file__).resolve().parents[1] / "bin"


@pytest.mark.parametrize(
    "words, window",
    [
        (["/x/bin/rviz", "-d", "a.rviz"], "rviz"),
        (["rosrun", "rviz", "rviz"], "rviz"),
        (["rosrun", "--debug", "--prefix", "gdb --args", "rviz", "rviz"], "rviz"),
        (["rosrun", "image_view", "stereo_view"], "stereo_view"),
        (["rosrun", "image_view", "image_saver"], None),
        (["rosrun", "rviz", "rviz_tests"], None),
        (["rosrun", "rviz"], None),
        (["rosrun"], None),
        (["rosrun", "--help"], None),
        (["rosrun", "my_rviz", "rviz"], None),
    ],
)
def test_which_commands_open_a_window(words, window):
    assert asked_for(words) == window


def program(folder, name, says):
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(f'#!/bin/sh\necho {says} "$@"\n')
    (folder / name).chmod(0o755)
    return folder


def test_what_comes_next_on_path_is_run_never_what_stands_before(tmp_path, monkeypatch):
    before, own, after = (program(tmp_path / name, "rviz", name) for name in ("before", "own", "after"))
    monkeypatch.setenv("PATH", f"{before}:{own}:{own}:{tmp_path / 'none'}:{after}")
    assert next_on_path(f"{own}/rviz") == f"{after}/rviz"
    monkeypatch.setenv("PATH", f"{after}:{own}")
    assert next_on_path(f"{own}/rviz") == "/usr/bin/rviz"
    monkeypatch.setenv("PATH", f"{before}:{after}")
    assert next_on_path(f"{own}/rviz") == f"{before}/rviz"  # called by its path
    (after / "rviz").chmod(0o644)
    monkeypatch.setenv("PATH", f"{own}:{after}")
    assert next_on_path(f"{own}/rviz") == "/usr/bin/rviz"


def run(tmp_path, *command, **changed):
    """A wrapper as PATH finds it, with other programs of its name behind it."""
    programs = program(tmp_path / "bin", "rosrun", "rosrun:")
    program(programs, "rviz", "rviz:")
    variables = {**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": "", "QT_QPA_PLATFORM": "", "PATH": f"{BIN}:{programs}:/usr/bin:/bin"}
    return subprocess.run(
        [sys.executable, BIN / command[0], *command[1:]], env={**variables, **changed}, capture_output=True, text=True, timeout=60
    )


@pytest.mark.parametrize("command", [["rviz", "-d", "a.rviz"], ["rosrun", "rviz", "rviz"]])
def test_without_a_display_one_line_names_the_remedy(tmp_path, command):
    ended = run(tmp_path, *command)
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (1, "", 1)
    assert ended.stderr.startswith("rviz: no display to open a window on (DISPLAY is not set)")
    assert "scripts/offscreen" in ended.stderr and "rosrun rviz_offscreen" in ended.stderr
    assert run(tmp_path, *command, DISPLAY="nowhere:77").stderr.startswith("rviz: the display nowhere:77 (DISPLAY) cannot be opened")


@pytest.mark.parametrize(
    "command, changed",
    [(["rosrun", "tf", "view_frames", "a b"], {}), (["rosrun"], {}), (["rviz", "--help"], {"QT_QPA_PLATFORM": "offscreen"})],
)
def test_everything_else_is_passed_on_word_by_word(tmp_path, command, changed):
    ended = run(tmp_path, *command, **changed)
    assert (ended.returncode, ended.stderr) == (0, "") and ended.stdout.split() == f"{command[0]}: {' '.join(command[1:])}".split()


@pytest.mark.parametrize("options", [[], ["--prefix", "nice -n 5"]])
def test_view_frames_of_tf_is_that_of_tf2(tmp_path, options):
    ended = run(tmp_path, "rosrun", *options, "tf", "view_frames")
    assert ended.stdout.split() == f"rosrun: {' '.join(options)} tf2_tools view_frames.py".split(), ended.stderr


def test_in_a_wayland_session_with_an_x_server_qt_is_sent_there():
    for given, chosen in (
        ({"WAYLAND_DISPLAY": "wayland-0", "DISPLAY": ":0"}, "xcb"),
        ({"WAYLAND_DISPLAY": "wayland-0"}, None),
        ({"DISPLAY": ":0"}, None),
        ({"WAYLAND_DISPLAY": "w", "DISPLAY": ":0", "QT_QPA_PLATFORM": "wayland"}, "wayland"),
    ):
        choose_platform(given)
        assert given.get("QT_QPA_PLATFORM") == chosen


@pytest.mark.parametrize("command", [["rviz"], ["rosrun", "rviz", "rviz"]])
def test_rviz_on_wayland_alone_is_told_what_is_missing(tmp_path, command):
    ended = run(tmp_path, *command, WAYLAND_DISPLAY="wayland-0")
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "xwayland" in ended.stderr

"""Libraries are judged before they are loaded, and what stands beside them helps out."""

import os
import subprocess
import sys

import pytest

PLUGIN = 'int help(int); extern "C" int answer() { return help(20); }'
HELPER = "int help(int value) { return 2 * value + 2; }"
JUDGED = """
import ctypes, sys
import compiled_plugins
said = compiled_plugins.why_not(sys.argv[1])
print(said or ctypes.CDLL(sys.argv[1]).answer())
"""


def library(path, source):
    subprocess.run(["c++", "-shared", "-fPIC", "-x", "c++", "-", "-o", str(path)], input=source, text=True, check=True)


def judged(path):
    """What a process of its own says: the reason, or what the plugin answers; and the warnings."""
    ended = subprocess.run([sys.executable, "-c", JUDGED, str(path)], capture_output=True, text=True, check=True)
    return ended.stdout.strip(), ended.stderr


@pytest.fixture
def plugin(tmp_path):
    path = tmp_path / "libplugin.so"
    library(path, PLUGIN)
    return path


def test_what_nobody_defines_is_told(plugin):
    (plugin.parent / "libtext.so").write_text("no library")
    (plugin.parent / "libcut.so").write_bytes(plugin.read_bytes()[:3000])
    said, _ = judged(plugin)
    assert "lacks the symbol help(int)" in said and "target_link_libraries" in said


def test_what_is_no_library_or_cut_off_is_told(plugin):
    cut = plugin.parent / "libcut.so"
    whole = plugin.read_bytes()
    for size in (0, 10, 200, 3000, 9000, 12000):
        cut.write_bytes(whole[:size])
        assert "libcut.so is no library, or not all of one" in judged(cut)[0], size
    cut.write_text("no library")
    assert "is no library" in judged(cut)[0]


def test_a_library_beside_it_supplies_what_it_forgot_to_link(plugin):
    library(plugin.parent / "libhelper.so", HELPER)
    said, warned = judged(plugin)
    assert said == "42"
    assert warned.count("[WARN]") == 1 and "libhelper.so" in warned and "target_link_libraries" in warned


def test_a_library_of_a_sourced_workspace_supplies_it_too(plugin, tmp_path, monkeypatch):
    (tmp_path / "workspace").mkdir()
    library(tmp_path / "workspace/libhelper.so", HELPER)
    monkeypatch.setenv("LD_LIBRARY_PATH", f"{os.environ.get('LD_LIBRARY_PATH', '')}:/nowhere:{tmp_path}:{tmp_path}/workspace")
    said, warned = judged(plugin)
    assert said == "42"
    assert warned.count("[WARN]") == 1 and "workspace/libhelper.so" in warned


def test_a_library_that_the_simulator_has_supplies_it_as_well(tmp_path):
    """Unitree's joint controller calls urdf::Model without linking it."""
    source = """#include <string>
        namespace urdf { struct Model { bool initFile(const std::string&); }; }
        extern "C" int answer() { bool (urdf::Model::* volatile f)(const std::string&) = &urdf::Model::initFile; return f ? 42 : 0; }"""
    library(tmp_path / "libplugin.so", source)
    said, warned = judged(tmp_path / "libplugin.so")
    assert said == "42"
    assert warned.count("[WARN]") == 1 and "liburdf.so" in warned


def test_what_two_of_them_define_is_nobodys(plugin):
    library(plugin.parent / "libone.so", HELPER)
    library(plugin.parent / "libother.so", HELPER)
    assert "lacks the symbol help(int)" in judged(plugin)[0]


def test_a_whole_library_needs_nothing(tmp_path):
    library(tmp_path / "libwhole.so", PLUGIN + HELPER)
    assert judged(tmp_path / "libwhole.so") == ("42", "")

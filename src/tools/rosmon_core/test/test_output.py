"""Severity, escapes, wrapping, colours of a line."""
import pytest
from hypothesis import given, strategies as st

from rosmon_core import colors
from rosmon_core.plain import format_line
from rosmon_core.severity import of_line, only_colours, without_escapes


@pytest.mark.parametrize("line, is_stderr, level", [
    ("[INFO] [123]: x", False, "info"), ("[ WARN] [1]: x", True, "warn"),
    ("\x1b[31m[ERROR] [1]: x\x1b[0m", True, "error"),
    ("\x1b[33m[main]: careful\x1b[0m", True, "warn"), ("\x1b[31m[main]: broken", False, "error"),
    ("\x1b[32m[main]: detail", False, "debug"), ("plain", False, "info"), ("plain", True, "warn"), ("", False, "info")])
def test_level(line, is_stderr, level):
    assert of_line(line, is_stderr) == level


def test_terminal_commands_of_a_node_do_not_reach_the_screen():
    line = "\x1b[2J\x1b]0;title\x07\x1b[31mred\x1b[0m\x1b[5A\x07end"
    assert only_colours(line) == "\x1b[31mred\x1b[0mend"
    assert without_escapes(line) == "redend"


@given(st.text(st.characters(blacklist_categories=("Cc", "Cs")), max_size=300), st.integers(20, 80))
def test_wrapping_loses_nothing(text, columns):
    lines = format_line("node", text, "info", 0, 6, 3, "ansi", columns).split("\n")
    plain = [without_escapes(line) for line in lines]
    assert all(len(line) <= columns for line in plain)
    assert plain[0].startswith("  node: ") and all(line.startswith("     ~: ") for line in plain[1:])
    assert "".join(line[8:] for line in plain) == text


def test_wrapped_lines_keep_their_colour():
    lines = format_line("n", "\x1b[31m" + "x" * 30, "info", 0, 1, 1, "ansi", 20).split("\n")
    assert len(lines) == 2 and all("\x1b[31mx" in line for line in lines)


@pytest.mark.parametrize("environment, mode", [
    ({"ROSMON_COLOR_MODE": "ansi", "COLORTERM": "truecolor"}, "ansi"), ({"COLORTERM": "truecolor"}, "truecolor"),
    ({"TERM": "xterm-256color"}, "256colors"), ({"TERM": "linux"}, "ansi"), ({}, "ansi")])
def test_colour_mode(environment, mode):
    assert colors.mode(environment) == mode


@pytest.mark.parametrize("mode", ["truecolor", "256colors"])
def test_labels_differ(mode):
    assert len({colors.label_escape(i, 12, mode) for i in range(12)}) == 12

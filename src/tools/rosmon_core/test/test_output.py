"""Severity, escapes, wrapping, colours of a line."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rosmon_core import colors, terminal
from rosmon_core.plain import format_line
from rosmon_core.process import console_format
from rosmon_core.severity import of_line, only_colours, without_escapes


@pytest.mark.parametrize(
    "line, is_stderr, level",
    [
        ("[INFO] [123]: x", False, "info"),
        ("[ WARN] [1]: x", True, "warn"),
        ("\x1b[31m[ERROR] [1]: x\x1b[0m", True, "error"),
        ("\x1b[33m[main]: careful\x1b[0m", True, "warn"),
        ("\x1b[31m[main]: broken", False, "error"),
        ("\x1b[32m[main]: detail", False, "debug"),
        ("plain", False, "info"),
        ("plain", True, "warn"),
        ("", False, "info"),
    ],
)
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


@pytest.mark.parametrize(
    "environment, mode",
    [
        ({"ROSMON_COLOR_MODE": "ansi", "COLORTERM": "truecolor"}, "ansi"),
        ({"COLORTERM": "truecolor"}, "truecolor"),
        ({"TERM": "xterm-256color"}, "256colors"),
        ({"TERM": "linux"}, "ansi"),
        ({}, "ansi"),
    ],
)
def test_colour_mode(environment, mode):
    assert colors.mode(environment) == mode


@pytest.mark.parametrize("mode", ["truecolor", "256colors"])
def test_labels_differ(mode):
    assert len({colors.label_escape(i, 12, mode) for i in range(12)}) == 12


#: Red, green, blue of the eight colours and their bright kin as terminals draw them: VGA (the Linux console), xterm, GNOME's Tango.
PALETTES = {
    "vga": "000000 aa0000 00aa00 aa5500 0000aa aa00aa 00aaaa aaaaaa 555555 ff5555 55ff55 ffff55 5555ff ff55ff 55ffff ffffff",
    "xterm": "000000 cd0000 00cd00 cdcd00 0000ee cd00cd 00cdcd e5e5e5 7f7f7f ff0000 00ff00 ffff00 5c5cff ff00ff 00ffff ffffff",
    "tango": "2e3436 cc0000 4e9a06 c4a000 3465a4 75507b 06989a d3d7cf 555753 ef2929 8ae234 fce94f 729fcf ad7fa8 34e2e2 eeeeec",
}
NAMES = dict(black=0, red=1, green=2, yellow=3, blue=4, magenta=5, cyan=6, gray=7, white=15)  # as prompt_toolkit has them


def contrast(palette, text, background):
    """WCAG 2.1: 1 to 21; 3 is asked of parts of a user interface, 4.5 of text."""

    def luminance(index):
        channels = [int(PALETTES[palette].split()[index][i : i + 2], 16) / 255 for i in (0, 2, 4)]
        return sum(w * (c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4) for w, c in zip((0.2126, 0.7152, 0.0722), channels))

    light, dark = sorted((luminance(text), luminance(background)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("palette", ["vga", "xterm"])
def test_labels_can_be_read_on_16_colours(palette):
    escapes = {colors.label_escape(i, 20, "ansi") for i in range(20)}
    assert len(escapes) >= 6
    for escape in escapes:
        codes = [int(code) for code in escape[2:-1].split(";")]
        text = [code - 90 + 8 if code >= 90 else code - 30 for code in codes if 30 <= code < 40 or code >= 90][-1]
        assert contrast(palette, text, next(code - 40 for code in codes if 40 <= code < 50)) >= 4.5, escape


@pytest.mark.parametrize("palette", PALETTES)
def test_boxes_and_labels_can_be_told_from_their_ground_on_16_colours(palette):
    for name in ("bar", "bar.key", "running", "crashed", "waiting", "muted"):
        style = terminal._STYLE.get_attrs_for_style_str(f"class:{name}")
        assert contrast(palette, *(NAMES[colour.replace("ansi", "")] for colour in (style.color, style.bgcolor))) >= 3, name
    assert not terminal._STYLE.get_attrs_for_style_str("class:dim").color, "grey on black is lost on many consoles"


@pytest.mark.parametrize(
    "first, function", [("#!/usr/bin/env python3", False), ("#!/usr/bin/python2 -u", False), ("#!/bin/sh", True), ("\x7fELF", True)]
)
def test_names_of_python_functions_are_not_printed(tmp_path, first, function):
    (tmp_path / "node").write_text(first + "\n")
    assert ("${function}" in console_format(str(tmp_path / "node"))) == function

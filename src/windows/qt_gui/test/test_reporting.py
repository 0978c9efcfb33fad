"""Lines about what plugins raise."""

import sys

from qt_gui.application import reporting


def test_an_exception_is_one_line_with_its_place():
    try:
        {}["key of\na dict"]
    except KeyError as error:
        line = reporting.describe(error)
    assert line.startswith("KeyError: ") and "\n" not in line and line.endswith("in test_an_exception_is_one_line_with_its_place)")
    assert f"{__file__}, line " in line


def test_traceback_when_asked_for(monkeypatch):
    monkeypatch.setitem(reporting._options, "verbose", True)
    try:
        raise ValueError("x" * 1000)
    except ValueError as error:
        lines = reporting.describe(error).splitlines()
    assert len(lines[0]) < 500 and lines[1] == "Traceback (most recent call last):"


def test_an_error_that_repeats_is_printed_three_times(monkeypatch, capfd):
    monkeypatch.setattr(sys, "excepthook", reporting._on_exception)
    heard = []
    monkeypatch.setattr(reporting, "listeners", [heard.append])
    reporting.install()
    for _ in range(10):
        try:
            raise RuntimeError("x")
        except RuntimeError:
            sys.excepthook(*sys.exc_info())
    assert len(heard) == 3 and heard[-1].endswith("(not shown again)")

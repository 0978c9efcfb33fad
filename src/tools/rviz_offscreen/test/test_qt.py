"""Which Qt RViz's Python module is for, told from its file."""

import importlib

import pytest
from rviz_offscreen import qt


@pytest.mark.parametrize(
    "content, package", [(b"\0PyQt6.sip._C_API\0PyQt6.sip\0", "PyQt6"), (b"..\0PyQt5.sip\0PyQt6\0", "PyQt5"), (b"", None)]
)
def test_the_package_named_in_the_module(tmp_path, monkeypatch, content, package):
    folder = tmp_path / "my_rviz"
    folder.mkdir()
    (folder / "__init__.py").write_text("raise ImportError('it is not loaded')")
    (folder / "rviz.so").write_bytes(content)
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    assert qt.package("my_rviz") == package


def test_this_machines_rviz_is_for_a_qt_that_is_installed():
    assert importlib.util.find_spec(qt.package())
    assert qt.package("no_such_module") is None

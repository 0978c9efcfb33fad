"""scripts/docstrings.py: a public function of a library that leaves a parameter out of its docstring is named, by file and line."""

import docstrings

MODULE = '''
class Base:
    """Base."""

    def update(self, time, period):
        """At `time` (s), `period` s after the one before."""


class Wheel(Base):
    """A wheel."""

    def update(self, time, period):
        pass

    def turn(self, speed: float, axis=0) -> None:
        """Turn at `speed` (rad/s)."""

    @property
    def load(self):
        """N."""

    def _hidden(self, a, b):
        pass


def told(start: float, *, end: float) -> float:
    """From `start` on.

    :param end: s.
    """

    def inner(a, b):
        pass


def silent(first, second):
    pass


def alone(name):
    pass


class _Private:
    def silent(self, first, second):
        pass
'''


def complaints(path, *others):
    return list(docstrings.complaints(path, docstrings.Classes([path, *others])))


def test_a_parameter_that_is_left_out_is_named_by_file_and_line(tmp_path):
    path = tmp_path / "module.py"
    path.write_text(MODULE)
    assert complaints(path) == [
        f"{path}:15: Wheel.turn() takes axis; say in its docstring what that is (shape, unit, frame)",
        f"{path}:36: silent() takes first, second; say in its docstring what that is (shape, unit, frame)",
    ]


def test_a_parameter_is_told_by_its_whole_name(tmp_path):
    path = tmp_path / "module.py"
    path.write_text('def between(a, b):\n    """As far as above."""\n\n\ndef at(a, b_W):\n    """From `a` to `b_W`."""\n')
    assert [line.split(";")[0] for line in complaints(path)] == [f"{path}:1: between() takes a, b"]


def test_what_a_method_overrides_may_be_in_another_module(tmp_path):
    base, path = tmp_path / "base.py", tmp_path / "module.py"
    base.write_text('class Base:\n    def update(self, time, period):\n        """`time`, `period`: s."""\n')
    path.write_text("import base\n\n\nclass Wheel(base.Base):\n    def update(self, time, period):\n        pass\n")
    assert complaints(path, base) == []
    assert len(complaints(path)) == 1


def test_private_modules_and_what_lies_beside_src_are_no_library(tmp_path):
    for name in ("src/cup/__init__.py", "src/cup/tea.py", "src/cup/_water.py", "test/test_tea.py", "setup.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    assert [path.name for path in docstrings.modules(tmp_path)] == ["__init__.py", "tea.py"]


def test_overloads_and_setters_are_left_to_what_help_shows(tmp_path):
    path = tmp_path / "module.py"
    path.write_text(
        "@overload\ndef get(a: int, b: int) -> int: ...\n\n\n@typing.overload\ndef get(a: str, b: str) -> str: ...\n\n\n"
        'def get(a, b):\n    """`a` or `b`."""\n'
    )
    assert complaints(path) == []

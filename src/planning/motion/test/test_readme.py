"""The example of the README runs as it stands."""

import contextlib
import io
import re
import sys
from pathlib import Path


def test_example_runs_and_plans():
    text = (Path(__file__).resolve().parent.parent / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(example, "README.md", "exec"), {"__name__": "readme"})
    assert "planned in" in said.getvalue() and "straight up: 100%" in said.getvalue()


def test_no_ros_in_the_library():
    for path in (Path(__file__).resolve().parent.parent / "src").rglob("*.py"):
        imported = set(re.findall(r"^\s*(?:import|from)\s+(\w+)", path.read_text(encoding="utf-8"), re.MULTILINE))
        assert imported <= {"motion", "numpy", *sys.stdlib_module_names}, path

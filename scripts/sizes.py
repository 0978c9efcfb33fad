"""Names files of more than 500 lines, functions of more than 60 and folders of more than 25 modules of Python; scripts/lint calls it.

Exit code: 0 none, 1 some.
"""

import ast
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

LONGEST_FILE, LONGEST_FUNCTION, FULLEST_FOLDER = 500, 60, 25
_CPP = {".cpp", ".hpp", ".h", ".hh", ".cc"}
_NO_FUNCTION = re.compile(r"namespace|class|struct|enum|union|using|typedef|template|extern|[}#/]")


def tracked():
    """The checkout's own text files that hold code, by git."""
    for name in subprocess.run(["git", "ls-files", "-z"], check=True, capture_output=True, text=True).stdout.split("\0"):
        path = Path(name)
        if name and path.is_file() and not path.is_symlink():
            yield path


def is_python(path):
    if path.suffix or path.name == "CMakeLists.txt":
        return path.suffix == ".py"
    with open(path, "rb") as file:
        first = file.readline(100)
    return first.startswith(b"#!") and b"python" in first


def python_functions(text, path):
    """(name, first line, lines) of each function, methods and inner ones included."""
    for node in ast.walk(ast.parse(text, str(path))):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno - node.lineno + 1


def cpp_functions(text):
    """As :func:`python_functions`, of C++: functions that stand at the margin, as clang-format leaves them."""
    start = None
    for number, line in enumerate(text.split("\n"), 1):
        if line[:1].isalpha() or line[:1] == "_":
            if _NO_FUNCTION.match(line):
                start = None
            elif "(" in line:
                start = number, line.split("(")[0].split()[-1]
        elif line.startswith("};"):
            start = None
        elif line == "}" and start is not None:
            yield start[1], start[0], number - start[0] + 1
            start = None


def complaints(path):
    python = is_python(path)
    if not python and path.suffix not in _CPP:
        return
    text = path.read_text(encoding="utf-8", errors="replace")
    lines = text.count("\n")
    if lines > LONGEST_FILE:
        yield f"{path}: {lines} lines; split it, the most is {LONGEST_FILE}"
    for name, line, length in python_functions(text, path) if python else cpp_functions(text):
        if length > LONGEST_FUNCTION:
            yield f"{path}:{line}: {name}() has {length} lines; split it, the most is {LONGEST_FUNCTION}"


def full_folders(paths):
    """One line for each folder that holds too many of `paths`, as far as they are modules of Python."""
    for folder, modules in sorted(Counter(path.parent for path in paths if path.suffix == ".py").items()):
        if modules > FULLEST_FOLDER:
            yield f"{folder}: {modules} modules; sort them into folders, the most is {FULLEST_FOLDER}"


def main():
    paths = list(tracked())
    found = [*full_folders(paths), *(line for path in paths for line in complaints(path))]
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

"""Names public functions of libraries whose docstrings leave a parameter out; scripts/lint calls it. Exit code: 0 none, 1 some.

The rule: a public function or method of a library that takes two or more parameters names each of them in its docstring, in a sentence
or a ``:param``. What a method's docstring leaves out may stand in that of the method which it overrides: help() shows it there.
"""

import ast
import functools
import re
import sys
from pathlib import Path

#: Packages below src/ of which other people's code calls the functions. Each keeps the rule; others come in when they do.
LIBRARIES = (
    "bridges/*",
    "common/*",
    "control/*",
    "hardware/*",
    "labs/lab_tools",
    "planning/*",
    "shelf/*",
    "simulation/*",
    "teaching/*",
    "tools/*",
    "windows/*",
)


def packages():
    """The folders of LIBRARIES, from the top of the checkout."""
    return sorted(folder for pattern in LIBRARIES for folder in Path("src").glob(pattern) if folder.is_dir())


def modules(package):
    """The Python modules that `package`, a folder, offers: those in its src/ whose names do not begin with "_"."""
    for path in sorted(Path(package, "src").rglob("*.py")):
        if path.name == "__init__.py" or not path.name.startswith("_"):
            yield path


def _public(name):
    return not name.startswith("_")


def functions(node, owner=None):
    """(class or None, function) of the public functions and methods below `node`, of which the class or module is `owner`.

    Functions inside functions are nobody's to call; help() shows neither those of @overload nor setters of properties.
    """
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.ClassDef) and _public(child.name):
            yield from functions(child, child)
        elif isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)) and _public(child.name):
            if not any(re.search(r"\boverload$|\.setter$", ast.unparse(decorator)) for decorator in child.decorator_list):
                yield owner, child


def parameters(function):
    """Names of what a caller hands to `function` (a node of ast), without self, cls and what begins with "_"."""
    given = function.args
    names = [argument.arg for argument in [*given.posonlyargs, *given.args, *given.kwonlyargs]]
    return [name for name in names if _public(name) and name not in ("self", "cls")]


def _mentions(docstring, parameter):
    return re.search(rf"(?<!\w){re.escape(parameter)}(?!\w)", docstring) is not None


class Classes:
    """What the classes in `paths`, files, say of their methods. They are told apart by their names alone."""

    def __init__(self, paths):
        self._bases, self._said = {}, {}
        for path in paths:
            for node in ast.walk(_tree(path)):
                if isinstance(node, ast.ClassDef):
                    self._bases.setdefault(node.name, []).extend(re.sub(r"\[.*|.*\.", "", ast.unparse(base)) for base in node.bases)
                    for child in node.body:
                        if isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)):
                            self._said[node.name, child.name] = ast.get_docstring(child) or ""

    def above(self, owner, method, seen=()):
        """The docstrings of `method` in the classes above `owner` (names), as one text; `seen`: classes that were asked on the way."""
        bases = [base for base in self._bases.get(owner, ()) if base not in seen]
        return "\n".join(self._said.get((base, method), "") + "\n" + self.above(base, method, (*seen, owner)) for base in bases)


@functools.cache
def _tree(path):
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def complaints(path, classes):
    """One line for each function of the module `path` that leaves a parameter out; `classes`: those of all libraries."""
    for owner, function in functions(_tree(path)):
        names = parameters(function)
        said = ast.get_docstring(function) or ""
        whole = function.name
        if owner is not None:
            said += "\n" + classes.above(owner.name, function.name)
            whole = f"{owner.name}.{function.name}"
        missing = [name for name in names if not _mentions(said, name)]
        if len(names) > 1 and missing:
            yield f"{path}:{function.lineno}: {whole}() takes {', '.join(missing)}; say in its docstring what that is (shape, unit, frame)"


def main():
    paths = [path for package in packages() for path in modules(package)]
    classes = Classes(paths)
    found = [line for path in paths for line in complaints(path, classes)]
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

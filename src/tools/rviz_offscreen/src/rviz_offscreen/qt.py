"""Which Python binding of Qt RViz's own stands on: a process can load one version of Qt only, so this is asked before."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path


def package(module: str = "rviz") -> str | None:
    """``PyQt5`` (Debian 12), ``PyQt6`` (Debian 13), or None where RViz's Python module is missing. Loads neither."""
    spec = importlib.util.find_spec(module)
    for folder in spec.submodule_search_locations or () if spec else ():
        for library in sorted(Path(folder).glob("*.so")):
            found = re.search(rb"\0(PyQt\d)\.sip\0", library.read_bytes())
            if found:
                return found[1].decode()
    return None

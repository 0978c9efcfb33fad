"""The real inputs of the workspace that cases are made from."""

from __future__ import annotations

import contextlib
import functools
import io
import os
from pathlib import Path

from fuzzing.findings import ROOT

_NOT_SEEDS = ("/test_launches/", "/.venv/")


@functools.cache
def files(*suffixes: str) -> list[Path]:
    """Below src/, by name."""
    found = [path for path in sorted((ROOT / "src").rglob("*")) if path.suffix.lower() in suffixes and path.is_file()]
    return [path for path in found if not any(part in str(path) for part in _NOT_SEEDS)]


@functools.cache
def packages() -> dict[str, str]:
    """Folder of each package of the workspace."""
    return {manifest.parent.name: str(manifest.parent) for manifest in sorted((ROOT / "src").rglob("package.xml"))}


@functools.cache
def finder():
    from ode_sim.description import ResourceFinder

    stock = packages()["gazebo_stock"]
    return ResourceFinder([f"{stock}/models"], [stock], lambda name: packages().get(name))


@functools.cache
def robots() -> dict[str, bytes]:
    """URDF by file name: plain files, and xacro files expanded where they expand without arguments."""
    texts: dict[str, bytes] = {}
    for path in sorted(files(".urdf"), key=lambda path: "/labs/" not in str(path)):  # the labs' keep their plain names
        _add(texts, path, path.name, path.read_bytes())
    for path in files(".xacro"):
        text = expanded(path)
        if text is not None and b"<link" in text and path.name.split(".")[0] + ".urdf" not in texts:
            texts[path.name.split(".")[0] + ".urdf"] = text
    return texts


def _add(texts: dict[str, bytes], path: Path, name: str, text: bytes) -> None:
    """By its name, or by one that says where it is when there are two."""
    texts[name if name not in texts else f"{path.parents[1].name}_{name}"] = text


def expanded(path: Path) -> bytes | None:
    """A xacro file as URDF, None if it is only a part of one."""
    import xacro

    with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
        try:
            return xacro.process_file(os.fspath(path)).toxml().encode()
        except Exception:  # a macro file that needs arguments or others beside it: no seed
            return None


@functools.cache
def models() -> dict[str, bytes]:
    """SDF by file name; a model directory's by the directory's."""
    texts: dict[str, bytes] = {}
    for path in files(".sdf"):
        _add(texts, path, path.parent.name + ".sdf" if path.name == "model.sdf" else path.name, path.read_bytes())
    return texts


@functools.cache
def worlds() -> dict[str, bytes]:
    texts: dict[str, bytes] = {}
    for path in files(".world"):
        _add(texts, path, path.name, path.read_bytes())
    return texts

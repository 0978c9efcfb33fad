"""What scripts use of ``imp``, which Python 3.12 dropped."""

import importlib.machinery as _machinery
import importlib.util as _util
import os as _os
import sys as _sys
import types as _types
from importlib import reload  # noqa: F401

SEARCH_ERROR, PY_SOURCE, PY_COMPILED, C_EXTENSION, PY_RESOURCE, PKG_DIRECTORY, C_BUILTIN, PY_FROZEN = range(8)
cache_from_source, source_from_cache = _util.cache_from_source, _util.source_from_cache


def new_module(name):
    return _types.ModuleType(name)


def get_suffixes():
    """[(suffix, mode, type)]"""
    kinds = (
        (_machinery.EXTENSION_SUFFIXES, "rb", C_EXTENSION),
        (_machinery.SOURCE_SUFFIXES, "r", PY_SOURCE),
        (_machinery.BYTECODE_SUFFIXES, "rb", PY_COMPILED),
    )
    return [(suffix, mode, kind) for suffixes, mode, kind in kinds for suffix in suffixes]


def get_magic():
    return _util.MAGIC_NUMBER


def acquire_lock():
    """Modules have locks of their own."""


release_lock = acquire_lock


def lock_held():
    return False


def _load(name, pathname, loader):
    spec = _util.spec_from_file_location(name, pathname, loader=loader)
    module = _sys.modules.get(name) or _util.module_from_spec(spec)
    module.__spec__ = spec
    _sys.modules[name] = module
    spec.loader.exec_module(module)
    return _sys.modules[name]


def load_source(name, pathname, file=None):
    return _load(name, pathname, _machinery.SourceFileLoader(name, pathname))


def load_compiled(name, pathname, file=None):
    return _load(name, pathname, _machinery.SourcelessFileLoader(name, pathname))


def load_dynamic(name, path, file=None):
    return _load(name, path, _machinery.ExtensionFileLoader(name, path))


def load_package(name, path):
    return load_source(name, _os.path.join(path, "__init__.py"))


def find_module(name, path=None):
    """(open file or None, path, (suffix, mode, type))

    :raises ImportError: there is none
    """
    if path is None and name in _sys.builtin_module_names:
        return None, None, ("", "", C_BUILTIN)
    spec = _machinery.PathFinder.find_spec(name, path)
    if spec is None or spec.origin is None:
        raise ImportError(f"No module named {name!r}", name=name)
    if spec.submodule_search_locations is not None:
        return None, _os.path.dirname(spec.origin), ("", "", PKG_DIRECTORY)
    details = next(kind for kind in get_suffixes() if spec.origin.endswith(kind[0]))
    return open(spec.origin, details[1]), spec.origin, details


def load_module(name, file, filename, details):
    """What :func:`find_module` has found."""
    kind = details[2]
    if kind == C_BUILTIN:
        return __import__(name)
    load = {PY_SOURCE: load_source, PY_COMPILED: load_compiled, C_EXTENSION: load_dynamic, PKG_DIRECTORY: load_package}[kind]
    return load(name, filename)

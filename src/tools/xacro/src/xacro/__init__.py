"""``import xacro`` as in ROS Noetic: PyPI's xacro in this module's own namespace, with what the command adds to it.

Its package has the same name and stands behind this one on sys.path: it is found there and executed here, so that its
functions and those that replace some of them see one set of globals.
"""

import sys as _sys
import typing as _typing
from importlib.machinery import PathFinder as _PathFinder


def _distribution():
    """Spec of PyPI's xacro: the first one on sys.path that brings xacro's own command line."""
    for folder in _sys.path:
        spec = _PathFinder.find_spec("xacro", [folder])
        if (
            spec
            and spec.submodule_search_locations
            and _PathFinder.find_spec("xacro.substitution_args", list(spec.submodule_search_locations))
        ):
            return spec
    raise ModuleNotFoundError(
        "xacro's PyPI distribution is not on PYTHONPATH: run scripts/setup, or source setup.bash in this shell", name="xacro"
    )


if _typing.TYPE_CHECKING:

    def __getattr__(name: str) -> _typing.Any: ...  # what the code executed below defines


_spec = _distribution()
__path__[:] = [*_spec.submodule_search_locations]
__version__ = "1.14.20"
exec(compile(_spec.loader.get_source("xacro"), _spec.origin, "exec"))

from noetic_xacro import reading as _reading  # noqa: E402  needs the functions above

_reading.install(_sys.modules[__name__])

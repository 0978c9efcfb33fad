"""Names that the Python of Noetic (Ubuntu 20.04: Python 3.8, NumPy 1.17, SciPy 1.3, Matplotlib 3.1, Pillow 7, OpenCV 4.2, PyYAML 5.3,
KDL 1.4) has and Debian's has dropped.

Python imports this when it starts in a shell that is sourced. Nothing else is imported here: what is missing is put into a module
when a program imports that module (``noetic_names``), and a name that is there stays as it is.
"""

import sys
import time
from importlib.machinery import BuiltinImporter

TYPE_CHECKING = False  # importing typing takes longer than all of this
if TYPE_CHECKING:
    from typing import Any

#: Which module of noetic_names completes which module.
COMPLETED_BY = {
    name: group
    for group, names in {
        "standard": "array asyncio base64 cgi collections configparser fractions html.parser importlib inspect json locale math plistlib "
        "random threading unittest xml.etree.ElementTree",
        "numbers": "numpy numpy.lib scipy scipy.fft scipy.integrate scipy.interpolate scipy.linalg scipy.misc scipy.signal scipy.sparse "
        "scipy.spatial scipy.spatial.distance scipy.spatial.transform scipy.stats",
        "drawings": "matplotlib matplotlib.axes matplotlib.axis matplotlib.backend_bases matplotlib.backends.backend_agg matplotlib.cbook "
        "matplotlib.cm matplotlib.colorbar matplotlib.colors matplotlib.contour matplotlib.dates matplotlib.figure "
        "matplotlib.lines matplotlib.patches matplotlib.pyplot matplotlib.scale matplotlib.style matplotlib.widgets "
        "mpl_toolkits.mplot3d.axes3d",
        "pictures": "PIL.Image PIL.ImageDraw PIL.ImageFont cv2",
        "files": "yaml PyKDL",
    }.items()
    for name in names.split()
}

#: Those that only lack names: nothing that is in them is replaced.
ONLY_LACKS = {"base64", "collections", "fractions", "importlib", "inspect", "locale", "threading"}
#: Modules that are gone from Python, and Debian's package that has them.
GONE = {
    "asynchat": "python3-pyasynchat",
    "asyncore": "python3-pyasyncore",
    "cgi": "python3-legacy-cgi",
    "cgitb": "python3-legacy-cgi",
    "distutils": "python3-setuptools",
    "telnetlib": "python3-zombie-telnetlib",
}
#: Those of which noetic_names has what scripts use.
REMADE = {
    "imp": "noetic_names.remade_imp",
    "numpy.core.umath_tests": "noetic_names.remade_umath_tests",
    "pipes": "noetic_names.remade_pipes",
}


def _add(module, **names):
    for name, value in names.items():
        if name not in vars(module):
            setattr(module, name, value)


def _complete(name, module):
    from importlib import import_module

    try:
        import_module("noetic_names." + COMPLETED_BY[name]).COMPLETE[name](module)
    except (AttributeError, ImportError, LookupError, TypeError):  # another module of that name, or one yet to come: it stays as it is
        pass


def _complete_when_asked(name, module):
    """For what Python itself has loaded when it starts: at the first name that the module lacks."""

    def __getattr__(attribute):
        if not attribute.startswith("__") and vars(module).pop("__getattr__", None):
            _complete(name, module)
            if attribute in vars(module):
                return vars(module)[attribute]
        raise AttributeError(f"module {name!r} has no attribute {attribute!r}")

    if "__getattr__" in vars(module):
        _complete(name, module)
    else:
        module.__getattr__ = __getattr__


class _BuiltIn:
    """Loads a module that is compiled into Python, and completes it."""

    create_module = staticmethod(BuiltinImporter.create_module)

    @staticmethod
    def exec_module(module):
        BuiltinImporter.exec_module(module)
        _complete(module.__name__, module)


def _find(name, path, target):
    """The spec that Python's other finders give."""
    for finder in sys.meta_path:
        if finder is not Finder and finder is not Gone and hasattr(finder, "find_spec"):
            spec = finder.find_spec(name, path, target)
            if spec is not None:
                return spec
    return None


class Finder:
    """Finds the modules above where Python does, and has what is missing added once they are loaded."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        spec: Any = _find(name, path, target) if name in COMPLETED_BY else None
        if spec is None or not hasattr(spec.loader, "exec_module"):
            return None
        if spec.loader is BuiltinImporter:
            spec.loader = _BuiltIn()
            return spec
        load = spec.loader.exec_module

        def exec_module(module):
            load(module)
            _complete(name, module)

        spec.loader.exec_module = exec_module
        return spec


class Gone:
    """Comes last: makes what is gone, or says who has it."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        if name in REMADE:
            spec: Any = _find(REMADE[name], __import__("noetic_names").__path__, None)
            if spec is not None:
                spec.name = spec.loader.name = name
            return spec
        if name in GONE:
            raise ModuleNotFoundError(f"No module named '{name}': Python has dropped it; sudo apt install {GONE[name]}", name=name)
        return None


def _run_the_next():
    """Runs the file of this name that this one hides: Debian's own, or a tool's."""
    from importlib.machinery import PathFinder

    here = __file__.rpartition("/")[0]
    spec: Any = PathFinder.find_spec("sitecustomize", [folder for folder in sys.path if folder.rstrip("/") != here])
    if spec and hasattr(spec.loader, "get_code"):
        exec(spec.loader.get_code(spec.name), {"__name__": spec.name, "__file__": spec.origin, "__spec__": spec})


_add(sys, getcheckinterval=lambda: 100, setcheckinterval=lambda instructions: None)
_add(time, clock=time.process_time)  # as on Linux; older than Noetic, and what scripts of its time still measure with
for _name in [name for name in COMPLETED_BY if name in sys.modules]:
    (_complete_when_asked if _name in ONLY_LACKS else _complete)(_name, sys.modules[_name])
sys.meta_path.insert(0, Finder)
sys.meta_path.append(Gone)
_run_the_next()

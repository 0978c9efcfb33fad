"""Names that the Python of Noetic (Ubuntu 20.04: Python 3.8, NumPy 1.17, PyYAML 5.3, Matplotlib 3.1, KDL 1.4) has and Debian's has dropped.

Python imports this when it starts in a shell that is sourced. Nothing is imported here: what is missing is put into a module
when a program imports that module, and a name that is there stays as it is.
"""
import sys
from importlib.machinery import PathFinder

TYPE_CHECKING = False  # importing typing takes longer than all of this
if TYPE_CHECKING:
    from typing import Any


def _add(module, **names):
    for name, value in names.items():
        if name not in vars(module):
            setattr(module, name, value)


def _collections(module):
    from collections import abc
    _add(module, **{name: getattr(abc, name) for name in abc.__all__ if name[0].isupper()})


def _fractions(module):
    from math import gcd
    _add(module, gcd=gcd)


def _threading(module):
    _add(module.Thread, isAlive=module.Thread.is_alive)


def _base64(module):
    _add(module, encodestring=module.encodebytes, decodestring=module.decodebytes)


def _inspect(module):
    if hasattr(module, "getargspec"):
        return
    from collections import namedtuple
    ArgSpec = namedtuple("ArgSpec", "args varargs keywords defaults")

    def getargspec(func):
        """Names and defaults of a function's parameters; :func:`inspect.getfullargspec` knows them all."""
        spec = module.getfullargspec(func)
        if spec.kwonlyargs or spec.annotations:
            raise ValueError("Function has keyword-only parameters or annotations, use inspect.signature() API which can support them")
        return ArgSpec(*spec[:4])
    _add(module, ArgSpec=ArgSpec, getargspec=getargspec)


#: Names of NumPy 1.17, by what they stood for; the second half went with NumPy 2.
_NUMPY = {"cumproduct": "cumprod", "product": "prod", "sometrue": "any", "alltrue": "all", "float_": "float64", "complex_": "complex128",
          "unicode_": "str_", "string_": "bytes_", "Inf": "inf", "Infinity": "inf", "PINF": "inf", "infty": "inf", "NaN": "nan",
          "in1d": "isin", "row_stack": "vstack", "trapz": "trapezoid"}


def _numpy(module):
    _add(module, float=float, int=int, bool=bool, complex=complex, object=object, str=str, long=int, unicode=str, NINF=-module.inf,
         asscalar=lambda a: a.item(), alen=lambda a: len(module.array(a, ndmin=1)))
    _add(module, **{old: getattr(module, new) for old, new in _NUMPY.items() if hasattr(module, new)})


def _yaml(module):
    if module.load.__defaults__:
        return
    new_load, new_load_all = module.load, module.load_all

    def load(stream, Loader=module.FullLoader):
        """The first document of a stream; as in PyYAML 5, without a Loader by FullLoader."""
        return new_load(stream, Loader)

    def load_all(stream, Loader=module.FullLoader):
        """All documents of a stream; as in PyYAML 5, without a Loader by FullLoader."""
        return new_load_all(stream, Loader)
    module.load, module.load_all = load, load_all


def _figure(module):
    from functools import wraps  # pyplot asks the function of which class it is

    new_gca = module.Figure.gca

    @wraps(new_gca)
    def gca(self, **kwargs):
        """The current axes; with arguments (``projection="3d"``) those of that kind, made if the current ones are others."""
        if not kwargs:
            return new_gca(self)
        axes = self.axes and new_gca(self)
        same = axes and all(getattr(axes, {"projection": "name"}.get(key, key), None) == value for key, value in kwargs.items())
        return axes if same else self.add_subplot(1, 1, 1, **kwargs)
    module.Figure.gca = gca


def _pyplot(module):
    module.gca = lambda **kwargs: module.gcf().gca(**kwargs)


def _pykdl(module):
    """Debian's KDL, 1.5, calls the type of a joint that does not move "Fixed"; Noetic's, 1.4, "None"."""
    new_name = module.Joint.getTypeName

    def getTypeName(self):
        name = new_name(self)
        return "None" if name == "Fixed" else name
    module.Joint.getTypeName = getTypeName


MISSING = {"collections": _collections, "fractions": _fractions, "threading": _threading, "base64": _base64, "inspect": _inspect,
           "numpy": _numpy, "yaml": _yaml, "PyKDL": _pykdl, "matplotlib.figure": _figure, "matplotlib.pyplot": _pyplot}


def _complete(name, module):
    try:
        MISSING[name](module)
    except (AttributeError, TypeError):  # another module of that name, or one yet to come: it stays as it is
        pass


class Finder:
    """Finds the modules above where Python does, and has what is missing added once they are loaded."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        spec = PathFinder.find_spec(name, path, target) if name in MISSING else None
        loader: Any = spec and spec.loader
        if not loader:
            return None
        load = loader.exec_module

        def exec_module(module):
            load(module)
            _complete(name, module)
        loader.exec_module = exec_module
        return spec


def _run_the_next():
    """Runs the file of this name that this one hides: Debian's own, or a tool's."""
    here = __file__.rpartition("/")[0]
    spec: Any = PathFinder.find_spec("sitecustomize", [folder for folder in sys.path if folder.rstrip("/") != here])
    if spec and hasattr(spec.loader, "get_code"):
        exec(spec.loader.get_code(spec.name), {"__name__": spec.name, "__file__": spec.origin, "__spec__": spec})


for _name in MISSING:
    if _name in sys.modules:
        _complete(_name, sys.modules[_name])
sys.meta_path.insert(0, Finder)
_run_the_next()

"""NumPy 1.18 to 2.2, SciPy 1.4 to 1.15."""

import functools

from noetic_names import add, add_to_compiled, aliases, renamed, replace_in_compiled, without

#: Names of NumPy 1.17, by what they stood for; the second half went with NumPy 2.
_NUMPY = {
    "cumproduct": "cumprod",
    "product": "prod",
    "sometrue": "any",
    "alltrue": "all",
    "float_": "float64",
    "complex_": "complex128",
    "unicode_": "str_",
    "string_": "bytes_",
    "Inf": "inf",
    "Infinity": "inf",
    "PINF": "inf",
    "infty": "inf",
    "NaN": "nan",
    "NAN": "nan",
    "in1d": "isin",
    "row_stack": "vstack",
    "trapz": "trapezoid",
    "mat": "asmatrix",
    "round_": "round",
    "bool8": "bool_",
    "int0": "intp",
    "uint0": "uintp",
    "str0": "str_",
    "bytes0": "bytes_",
    "object0": "object_",
    "void0": "void",
    "cfloat": "complex128",
    "singlecomplex": "complex64",
    "clongfloat": "clongdouble",
    "longcomplex": "clongdouble",
    "longfloat": "longdouble",
    "typeDict": "sctypeDict",
    "rank": "ndim",
}


def _numpy(module):
    add(
        module,
        float=float,
        int=int,
        bool=bool,
        complex=complex,
        object=object,
        str=str,
        long=int,
        unicode=str,
        NINF=-module.inf,
        PZERO=0.0,
        NZERO=-0.0,
        asscalar=lambda a: a.item(),
        alen=lambda a: len(module.array(a, ndmin=1)),
        asfarray=lambda a, dtype=module.float64: module.asarray(a, dtype if module.issubdtype(dtype, module.inexact) else module.float64),
        msort=lambda a: module.sort(a, axis=0),
        issubclass_=lambda a, b: isinstance(a, type) and issubclass(a, b),
        disp=lambda mesg, device=None, linefeed=True: print(mesg, file=device, end="\n" if linefeed else ""),
        find_common_type=lambda array_types, scalar_types: module.result_type(*array_types, *scalar_types),
        cast=_Casts(module),
        fromstring=_from_binary(module),
        ptp=lambda a, *args, **kw: a.max(*args, **kw) - a.min(*args, **kw),
    )
    add(module, **{old: getattr(module, new) for old, new in _NUMPY.items() if hasattr(module, new)})
    add(
        module,
        **{
            name: getattr(module.exceptions, name)
            for name in (
                "VisibleDeprecationWarning",
                "ComplexWarning",
                "AxisError",
                "RankWarning",
                "TooHardError",
                "ModuleDeprecationWarning",
            )
            if hasattr(module, "exceptions") and hasattr(module.exceptions, name)
        },
    )
    for name in ("array", "asarray", "asanyarray"):
        setattr(module, name, _of_lists_of_any_length(module, getattr(module, name)))
    for name in ("linspace", "logspace", "geomspace"):
        setattr(module, name, _of_a_whole_number(getattr(module, name)))
    for name in ("histogram", "histogram2d", "histogramdd"):
        setattr(module, name, renamed(getattr(module, name), normed="density"))
    if module.__version__ >= "2":
        _methods_of_arrays(module)
        module.__all__ = [*module.__all__, *(name for name in _NUMPY if name in vars(module) and name not in module.__all__)]
        module.set_printoptions(legacy="1.25")  # a number in a list is written as a number: [1.5], not [np.float64(1.5)]


class _Casts(dict):
    """``numpy.cast[type](values)``"""

    def __init__(self, module):
        super().__init__()
        self._asarray = module.asarray

    def __missing__(self, kind):
        return functools.partial(self._asarray, dtype=kind)


def _from_binary(module):
    def fromstring(string, dtype=float, count=-1, sep=""):
        if sep:
            return module.array([float(word) for word in string.split(sep if sep.strip() else None)], dtype=dtype)[: count or None]
        return module.frombuffer(string.encode() if isinstance(string, str) else string, dtype, count).copy()

    return fromstring


def _of_lists_of_any_length(module, function):
    """Lists of lists that differ in length become an array of objects; without a copy means: where none is needed."""

    @functools.wraps(function)
    def make(*arguments, **options):
        try:
            return function(*arguments, **options)
        except ValueError as error:
            if "inhomogeneous shape" in str(error) and options.get("dtype") is None and len(arguments) < 2:
                return function(*arguments, **{**options, "dtype": object})
            if options.get("copy") is False and "avoid copy" in str(error):
                return function(*arguments, **{**options, "copy": None})
            raise

    return make


def _of_a_whole_number(function):
    @functools.wraps(function)
    def make(start, stop, num=50, *arguments, **options):
        return function(start, stop, int(num) if isinstance(num, float) else num, *arguments, **options)

    return make


def _methods_of_arrays(module):
    """NumPy 2 keeps methods that only say that they are gone."""
    import gc

    attributes = gc.get_referents(vars(module.ndarray))[0]

    def itemset(self, *arguments):
        *index, value = arguments
        if len(index) == 1 and not isinstance(index[0], tuple):
            self.flat[index[0]] = value
        else:
            self[tuple(index[0]) if len(index) == 1 else tuple(index) or ()] = value

    attributes["itemset"] = itemset
    attributes["ptp"] = module.ptp
    attributes["newbyteorder"] = lambda self, new_order="S": self.view(self.dtype.newbyteorder(new_order))
    attributes.setdefault("tostring", lambda self, order="C": self.tobytes(order))


def _numpy_lib(module):
    import numpy

    add(module, pad=numpy.pad)


def _scipy(module):
    """SciPy was NumPy as well: ``scipy.array``, ``scipy.pi``, ``from scipy import sqrt``."""
    own = module.__getattr__

    def __getattr__(name):
        try:
            return own(name)
        except AttributeError:
            import numpy

            place = {"rand": numpy.random, "randn": numpy.random, "ifft": numpy.fft}.get(name, numpy)
            if name.startswith("_") or name not in vars(place):
                raise
            return getattr(place, name)

    module.__getattr__ = __getattr__
    import numpy

    types = {"bool", "bytes", "complex", "float", "int", "long", "object", "str", "unicode"}
    kept = {"abs", "max", "min", "pow", "round", "fft", "test", *module.__all__}
    more = {name for name in numpy.__all__ if name[0] != "_"} - types - kept
    module.__all__ = [*module.__all__, *sorted(more), "rand", "randn"]


def _fft(module):
    """It was a function."""

    class Transforms(type(module)):
        def __call__(self, *arguments, **options):
            return self.fft(*arguments, **options)

    module.__class__ = Transforms


def _integrate(module):
    import numpy

    simpson = module.simpson

    def simps(y, x=None, dx=1.0, axis=-1, even="avg"):
        """Simpson's rule; with an even number of samples the last interval, the first, or the mean of both is a trapezium."""
        y = numpy.moveaxis(numpy.asarray(y), axis, -1)
        if x is not None:
            x = numpy.asarray(x)
            x = x if x.ndim == 1 else numpy.moveaxis(x, axis, -1)
        count = y.shape[-1]

        def part(rule, start, end):
            return rule(y[..., start:end], x=None if x is None else x[..., start:end], dx=dx)

        if count % 2:
            return part(simpson, 0, count)
        trapezium = getattr(numpy, "trapezoid", None) or numpy.trapz
        first = part(simpson, 0, count - 1) + part(trapezium, count - 2, count) if even in ("avg", "first") else 0.0
        last = part(simpson, 1, count) + part(trapezium, 0, 2) if even in ("avg", "last") else 0.0
        return (first + last) / 2 if even == "avg" else first + last

    def quadrature(func, a, b, args=(), **_options):
        return module.quad(func, a, b, args)[:2]

    def romberg(function, a, b, args=(), **_options):
        return module.quad(function, a, b, args)[0]

    add(module, simps=simps, quadrature=quadrature, romberg=romberg)
    aliases(module, cumtrapz="cumulative_trapezoid", trapz="trapezoid")


def _interpolate(module):
    try:
        module.interp2d([0, 1], [0, 1], [[0, 0], [0, 0]])
    except NotImplementedError:
        pass
    except Exception:
        return
    else:
        return
    import numpy

    class interp2d:
        """z of (x, y), on a grid or of scattered points, by splines of degree 1 (linear), 3 (cubic) or 5 (quintic); outside: the nearest,
        or ``fill_value``."""

        def __init__(self, x, y, z, kind="linear", copy=True, bounds_error=False, fill_value=None):
            x, y, z = numpy.ravel(x), numpy.ravel(y), numpy.asarray(z)
            degree = {"linear": 1, "cubic": 3, "quintic": 5}[kind]
            self.bounds_error, self.fill_value = bounds_error, fill_value
            self.x_min, self.x_max, self.y_min, self.y_max = x.min(), x.max(), y.min(), y.max()
            if z.size == len(x) * len(y):
                z = z.reshape(len(y), len(x))
                order_x, order_y = numpy.argsort(x), numpy.argsort(y)
                spline = module.RectBivariateSpline(x[order_x], y[order_y], z[order_y][:, order_x].T, kx=degree, ky=degree, s=0)
                self._at = lambda u, v: spline(u, v)
            else:
                tck = module.bisplrep(x, y, z.ravel(), kx=degree, ky=degree, s=0.0)
                self._at = lambda u, v: numpy.atleast_2d(module.bisplev(u, v, tck)).reshape(len(u), len(v))

        def __call__(self, x, y, dx=0, dy=0, assume_sorted=False):
            x, y = numpy.atleast_1d(x).astype(float), numpy.atleast_1d(y).astype(float)
            if not assume_sorted:
                x, y = numpy.sort(x), numpy.sort(y)
            outside_x = (x < self.x_min) | (x > self.x_max)
            outside_y = (y < self.y_min) | (y > self.y_max)
            if self.bounds_error and (outside_x.any() or outside_y.any()):
                raise ValueError(f"Values out of range; x must be in [{self.x_min}, {self.x_max}], y in [{self.y_min}, {self.y_max}]")
            z = self._at(numpy.clip(x, self.x_min, self.x_max), numpy.clip(y, self.y_min, self.y_max)).T
            if self.fill_value is not None:
                z[:, outside_x] = self.fill_value
                z[outside_y, :] = self.fill_value
            return z[0] if len(z) == 1 else z

    module.interp2d = interp2d


def _linalg(module):
    import numpy

    aliases(module, pinv2="pinv")
    add(module, tri=numpy.tri, tril=numpy.tril, triu=numpy.triu)
    for name in ("eigh", "eigvalsh"):
        setattr(module, name, without(renamed(getattr(module, name), eigvals="subset_by_index"), "turbo"))
    new_solve = without(module.solve, "debug")

    @functools.wraps(module.solve)
    def solve(a, b, sym_pos=False, *arguments, **options):
        if isinstance(sym_pos, bool) and sym_pos:
            options.setdefault("assume_a", "pos")
        return new_solve(a, b, *([] if isinstance(sym_pos, bool) else [sym_pos]), *arguments, **options)

    module.solve = solve


def _misc(module):
    import numpy

    def central_diff_weights(Np, ndiv=1):
        """Weights of the derivative of order ``ndiv`` from ``Np`` points with a distance of 1."""
        half = Np >> 1
        powers = numpy.vander(numpy.arange(-half, half + 1.0), increasing=True)
        return numpy.prod(numpy.arange(1, ndiv + 1), axis=0) * numpy.linalg.inv(powers)[ndiv]

    def derivative(func, x0, dx=1.0, n=1, args=(), order=3):
        """The ``n``-th derivative of ``func`` at ``x0`` by central differences over ``order`` points."""
        if order < n + 1 or order % 2 == 0:
            raise ValueError("'order', the number of points, must be odd and at least the derivative's order + 1")
        weights = central_diff_weights(order, n)
        return sum(w * func(x0 + (k - (order >> 1)) * dx, *args) for k, w in enumerate(weights)) / dx**n

    add(module, central_diff_weights=central_diff_weights, derivative=derivative)
    for name in ("ascent", "electrocardiogram", "face"):

        def load(*arguments, _name=name, **options):
            from scipy import datasets

            return getattr(datasets, _name)(*arguments, **options)

        add(module, **{name: load})


def _signal(module):
    from scipy.signal import windows

    add(
        module,
        **{
            name: getattr(windows, name)
            for name in (
                "barthann",
                "bartlett",
                "blackman",
                "blackmanharris",
                "bohman",
                "boxcar",
                "chebwin",
                "cosine",
                "exponential",
                "flattop",
                "gaussian",
                "general_gaussian",
                "hamming",
                "hann",
                "kaiser",
                "nuttall",
                "parzen",
                "triang",
                "tukey",
            )
        },
        hanning=windows.hann,
    )
    import numpy

    def ricker(points, a):
        """The Mexican hat of width ``a``."""
        square = (numpy.arange(points) - (points - 1.0) / 2) ** 2 / a**2
        return 2 / (numpy.sqrt(3 * a) * numpy.pi**0.25) * (1 - square) * numpy.exp(-square / 2)

    def cwt(data, wavelet, widths):
        """(len(widths), len(data)): the wavelet transform."""
        return numpy.array([module.convolve(data, wavelet(min(10 * width, len(data)), width), mode="same") for width in widths])

    add(module, ricker=ricker, cwt=cwt)
    aliases(module, lsim2="lsim", impulse2="impulse", step2="step")
    for name in ("firls", "firwin", "firwin2", "remez"):
        setattr(module, name, _of_a_nyquist_frequency(getattr(module, name)))


def _of_a_nyquist_frequency(function):
    @functools.wraps(function)
    def design(*arguments, **options):
        if options.pop("Hz", None) is not None:
            raise TypeError("write fs for Hz")
        if options.get("nyq") is not None:
            options["fs"] = 2.0 * options.pop("nyq")
        return function(*arguments, **options)

    return design


def _sparse(module):
    """``m.A`` is the array, ``m.H`` the conjugate transpose."""
    for cls in {module.csr_matrix.__mro__[-2], *module.csr_matrix.__mro__[:-1]}:
        if "toarray" in vars(cls):
            add(cls, A=property(lambda self: self.toarray()), H=property(lambda self: self.conjugate().transpose()))


def _spatial(module):
    replace_in_compiled(
        module.cKDTree, query=lambda new: renamed(new, n_jobs="workers"), query_ball_point=lambda new: renamed(new, n_jobs="workers")
    )


def _distance(module):
    aliases(module, matching="hamming")
    import numpy

    add(module, wminkowski=lambda u, v, p, w: module.minkowski(u, v, p, numpy.abs(w) ** p))


def _transform(module):
    import numpy

    Rotation = module.Rotation

    def match_vectors(cls, a, b, weights=None, normalized=False):
        """(rotation that takes b to a, its sensitivity matrix)"""
        if not normalized:
            a, b = (v / numpy.linalg.norm(v, axis=-1, keepdims=True) for v in (numpy.asarray(a, float), numpy.asarray(b, float)))
        rotation, _, sensitivity = cls.align_vectors(a, b, weights, return_sensitivity=True)
        return rotation, sensitivity

    add_to_compiled(
        Rotation,
        from_dcm=classmethod(lambda cls, dcm: cls.from_matrix(dcm)),
        as_dcm=lambda self: self.as_matrix(),
        match_vectors=classmethod(match_vectors),
    )


def _stats(module):
    import numpy

    new_mode = module.mode

    @functools.wraps(new_mode)
    def mode(a, axis=0, *arguments, **options):
        """The axis stays: ``mode(x)[0][0]``."""
        if "keepdims" not in options:
            options["keepdims"] = True
            a, axis = (numpy.ravel(a), 0) if axis is None else (a, axis)
        return new_mode(a, axis, *arguments, **options)

    module.mode = mode
    distribution = module.rv_continuous.__mro__[1]
    distribution.interval = renamed(distribution.interval, alpha="confidence")
    distribution.moment = renamed(distribution.moment, n="order")

    def itemfreq(a):
        """(n, 2): values and how often each is there"""
        return numpy.array(numpy.unique(a, return_counts=True)).T

    add(module, itemfreq=itemfreq)

    def binom_test(x, n=None, p=0.5, alternative="two-sided"):
        if n is None:
            x, n = x[0], sum(x)
        return module.binomtest(x, n, p, alternative).pvalue

    add(
        module,
        binom_test=binom_test,
        median_absolute_deviation=without(
            lambda x, axis=0, center=None, scale=1.4826, nan_policy="propagate": module.median_abs_deviation(
                x, axis=axis, scale=1.0 / scale, nan_policy=nan_policy
            )
        ),
    )


COMPLETE = {
    "numpy": _numpy,
    "numpy.lib": _numpy_lib,
    "scipy": _scipy,
    "scipy.fft": _fft,
    "scipy.integrate": _integrate,
    "scipy.interpolate": _interpolate,
    "scipy.linalg": _linalg,
    "scipy.misc": _misc,
    "scipy.signal": _signal,
    "scipy.sparse": _sparse,
    "scipy.spatial": _spatial,
    "scipy.spatial.distance": _distance,
    "scipy.spatial.transform": _transform,
    "scipy.stats": _stats,
}

"""Python 3.9 to 3.13."""

from noetic_names import add, add_to_compiled, aliases, without


def _array(module):
    add_to_compiled(
        module.array,
        tostring=lambda self: self.tobytes(),
        fromstring=lambda self, data: self.frombytes(data.encode() if isinstance(data, str) else data),
    )


def _asyncio(module):
    import functools
    import inspect
    import types

    def coroutine(func):
        """A generator function, or one that returns something to wait for, as a coroutine function."""
        if inspect.iscoroutinefunction(func):
            return func
        inner = types.coroutine(func) if inspect.isgeneratorfunction(func) else of_result(func)

        @functools.wraps(func)
        async def call(*arguments, **options):
            return await inner(*arguments, **options)

        return call

    def of_result(func):
        @types.coroutine
        def call(*arguments, **options):
            result = func(*arguments, **options)
            if inspect.isgenerator(result) or module.isfuture(result):
                result = yield from result
            elif hasattr(result, "__await__"):
                result = yield from result.__await__()
            return result

        return call

    if hasattr(module, "coroutine"):
        return
    new_wait = module.wait

    @functools.wraps(new_wait)
    async def wait(aws, *, loop=None, **options):
        return await new_wait([module.ensure_future(one) for one in aws], **options)

    module.coroutine, module.wait = coroutine, wait
    for name in ("BoundedSemaphore", "Condition", "Event", "Lock", "LifoQueue", "PriorityQueue", "Queue", "Semaphore"):
        cls = getattr(module, name)
        cls.__init__ = without(cls.__init__, "loop")
    for name in ("gather", "shield", "sleep", "wait_for", "open_connection", "start_server"):
        setattr(module, name, without(getattr(module, name), "loop"))


def _base64(module):
    aliases(module, encodestring="encodebytes", decodestring="decodebytes")


def _cgi(module):
    from html import escape
    from urllib.parse import parse_qs, parse_qsl

    add(module, escape=lambda s, quote=None: escape(s, bool(quote)), parse_qs=parse_qs, parse_qsl=parse_qsl)


def _collections(module):
    from collections import abc

    add(module, **{name: getattr(abc, name) for name in abc.__all__ if name[0].isupper()})


def _configparser(module):
    aliases(module, SafeConfigParser="ConfigParser")

    def readfp(self, fp, filename=None):
        self.read_file(fp, filename)

    add(module.RawConfigParser, readfp=readfp)


def _fractions(module):
    import math

    def gcd(a, b):
        """With the sign of ``b``, or of ``a`` where ``b`` is 0."""
        if type(a) is int is type(b):
            return -math.gcd(a, b) if (b or a) < 0 else math.gcd(a, b)
        while b:
            a, b = b, a % b
        return a

    add(module, gcd=gcd)


def _html_parser(module):
    from html import unescape

    add(module.HTMLParser, unescape=lambda self, s: unescape(s))


def _importlib(module):
    def find_loader(name, path=None):
        from importlib.util import find_spec

        spec = find_spec(name)
        return spec and spec.loader

    add(module, find_loader=find_loader)


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

    add(module, ArgSpec=ArgSpec, getargspec=getargspec)


def _json(module):
    module.loads, module.load = without(module.loads, "encoding"), without(module.load, "encoding")


def _locale(module):
    def format(percent, value, grouping=False, monetary=False, *additional):
        return module.format_string(percent, (value, *additional) if additional else value, grouping, monetary)

    add(module, format=format)


def _math(module):
    new_factorial = module.factorial
    module.factorial = lambda x: new_factorial(int(x) if isinstance(x, float) and x.is_integer() else x)


def _plistlib(module):
    def on_file(function, mode):
        def call(value, path):
            if not isinstance(path, str):
                return function(value, path)
            with open(path, mode) as file:
                return function(value, file)

        return call

    read = on_file(lambda _, file: module.load(file), "rb")
    add(
        module,
        readPlist=lambda path: read(None, path),
        writePlist=on_file(module.dump, "wb"),
        readPlistFromBytes=module.loads,
        writePlistToBytes=module.dumps,
    )


def _random(module):
    import functools
    from collections.abc import Set

    new_sample, new_shuffle, new_randrange = module.Random.sample, module.Random.shuffle, module.Random.randrange
    new_seed = module.Random.seed

    @functools.wraps(new_seed)
    def seed(self, a=None, version=2):
        """Anything that has a hash may be a seed."""
        return new_seed(self, a if a is None or isinstance(a, (int, float, str, bytes, bytearray)) else hash(a), version)

    @functools.wraps(new_sample)
    def sample(self, population, k, **options):
        return new_sample(self, tuple(population) if isinstance(population, Set) else population, k, **options)

    @functools.wraps(new_shuffle)
    def shuffle(self, x, random=None):
        if random is None:
            return new_shuffle(self, x)
        for i in reversed(range(1, len(x))):
            j = int(random() * (i + 1))
            x[i], x[j] = x[j], x[i]
        return None

    @functools.wraps(new_randrange)
    def randrange(self, start, *more):
        return new_randrange(self, *(int(value) if isinstance(value, float) and value.is_integer() else value for value in (start, *more)))

    def randint(self, a, b):
        """Random integer in range [a, b], including both end points."""
        return self.randrange(a, b + 1)

    for method in (sample, shuffle, randrange, randint, seed):
        setattr(module.Random, method.__name__, method)
        setattr(module, method.__name__, getattr(module._inst, method.__name__))


def _threading(module):
    add(module.Thread, isAlive=module.Thread.is_alive)


def _unittest(module):
    aliases(
        module.TestCase,
        assertEquals="assertEqual",
        assertNotEquals="assertNotEqual",
        assert_="assertTrue",
        failUnless="assertTrue",
        failIf="assertFalse",
        failUnlessEqual="assertEqual",
        failIfEqual="assertNotEqual",
        failUnlessRaises="assertRaises",
        assertAlmostEquals="assertAlmostEqual",
        assertNotAlmostEquals="assertNotAlmostEqual",
        assertRegexpMatches="assertRegex",
        assertNotRegexpMatches="assertNotRegex",
        assertRaisesRegexp="assertRaisesRegex",
        failUnlessAlmostEqual="assertAlmostEqual",
        failIfAlmostEqual="assertNotAlmostEqual",
    )

    def assertDictContainsSubset(self, subset, dictionary, msg=None):
        self.assertEqual(dictionary, {**dictionary, **subset}, msg)

    add(module.TestCase, assertDictContainsSubset=assertDictContainsSubset)

    def makeSuite(testCaseClass, prefix="test", sortUsing=None, suiteClass=module.TestSuite):
        loader = module.TestLoader()
        loader.testMethodPrefix, loader.suiteClass = prefix, suiteClass
        return loader.loadTestsFromTestCase(testCaseClass)

    add(module, makeSuite=makeSuite)


def _element_tree(module):
    def getiterator(self, tag=None):
        return list(self.iter(tag))

    add_to_compiled(module.Element, getchildren=lambda self: list(self), getiterator=getiterator)
    add(module.ElementTree, getiterator=getiterator)


COMPLETE = {
    "array": _array,
    "asyncio": _asyncio,
    "base64": _base64,
    "cgi": _cgi,
    "collections": _collections,
    "configparser": _configparser,
    "fractions": _fractions,
    "html.parser": _html_parser,
    "importlib": _importlib,
    "inspect": _inspect,
    "json": _json,
    "locale": _locale,
    "math": _math,
    "plistlib": _plistlib,
    "random": _random,
    "threading": _threading,
    "unittest": _unittest,
    "xml.etree.ElementTree": _element_tree,
}

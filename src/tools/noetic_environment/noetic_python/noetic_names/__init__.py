"""What :mod:`sitecustomize` adds to modules. Each of these has ``COMPLETE``: name of a module -> function that completes it."""

import functools
import gc


def add(module, **names):
    """Give a module, or a class, the names that it lacks."""
    for name, value in names.items():
        if name not in vars(module):
            setattr(module, name, value)


def add_to_compiled(cls, **methods):
    """As :func:`add`, for a class in C that takes no attributes. Nobody has looked for them yet: the class was made a moment ago."""
    attributes = gc.get_referents(vars(cls))[0]
    for name, value in methods.items():
        attributes.setdefault(name, value)


def aliases(module, **names):
    """New name by old name, of those that the module has."""
    add(module, **{old: getattr(module, new) for old, new in names.items() if hasattr(module, new)})


def without(function, *names):
    """``function``, which no longer takes the keyword arguments ``names``: they are ignored."""

    @functools.wraps(function)
    def call(*arguments, **options):
        return function(*arguments, **{name: value for name, value in options.items() if name not in names})

    return call


def renamed(function, **names):
    """``function``, which calls the keyword argument ``old`` ``new`` now."""

    @functools.wraps(function)
    def call(*arguments, **options):
        return function(*arguments, **{names.get(name, name): value for name, value in options.items()})

    return call


def positional(function, *names):
    """``function``, whose arguments ``names``, after those that it still takes in order, were once given in order as well.

    :param names: of all parameters, ``self`` among them
    """
    import inspect

    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    count = sum(one.kind in kinds for one in inspect.signature(function).parameters.values())

    @functools.wraps(function)
    def call(*arguments, **options):
        if len(arguments) <= count or len(arguments) > len(names):
            return function(*arguments, **options)
        return function(*arguments[:count], **dict(zip(names[count:], arguments[count:])), **options)

    return call


def replace_in_compiled(cls, **wrappers):
    """A method of a class in C is replaced by what a wrapper makes of it; one that the class lacks is left out."""
    attributes = gc.get_referents(vars(cls))[0]
    for name, wrapper in wrappers.items():
        if name in attributes:
            attributes[name] = wrapper(attributes[name])

"""Calls of macros from a file that was included with ``ns=``, as in Noetic: arguments, defaults and blocks know the names of that file.

PyPI's xacro (2.1) evaluates them among the caller's names alone, Noetic's (1.14) among those of the file alone. Here a name of the file
comes first, and one that it does not know is the caller's: what is right for Noetic means the same, and what is right for 2.1 is
expanded, too.
"""

from __future__ import annotations

from typing import Any

xacro: Any = None  # the module ``xacro``, once it is there


def _scope_class(namespace: Any) -> Any:
    """A table of names, ``own`` ones before those of the ``caller``; what is defined in it is ``own``."""

    class Scope(namespace):
        def __init__(self, own: Any, caller: Any) -> None:
            super().__init__(own.parent)
            self.own, self.caller = own, caller
            self.root, self.depth, self.unevaluated, self.recursive = own.root, own.depth, own.unevaluated, own.recursive
            self.call: Any = None  # what the name of the call that this scope is of stands for, until it is asked for

        def __getitem__(self, key: str) -> Any:
            return self.own[key] if key in self.own else self.caller[key]

        def __contains__(self, key: object) -> bool:
            """Only blocks of the caller count: ``default=`` of a property asks, and is about the file's own names."""
            return key in self.own or (str(key).startswith("*") and key in self.caller)

        def get(self, key: str, default: Any = None) -> Any:
            return self.own.get(key, default)

        def _setitem(self, key: str, value: Any, unevaluated: bool) -> None:
            self.own._setitem(key, value, unevaluated)

        def __delitem__(self, key: str) -> None:
            del self.own[key]

    return Scope


def install(module: Any) -> None:
    """Put this module's functions into ``module``, which is ``xacro``."""
    global xacro
    xacro = module
    scope_class = _scope_class(xacro.NameSpace)
    resolve, handle, evaluate = xacro.resolve_macro, xacro.handle_macro_call, xacro.eval_default_arg

    def resolve_macro(name: str, macros: Any, symbols: Any) -> Any:
        if not isinstance(macros, scope_class):
            return resolve(name, macros, symbols)
        call, macros.call = macros.call, None
        if call is not None:
            return call
        try:
            return resolve(name, macros.own, symbols.own)
        except KeyError:
            return xacro.resolve_macro(name, macros.caller, symbols.caller)

    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> bool:
        if node.tagName.startswith("xacro:") and "." in node.tagName:
            try:
                call = xacro.resolve_macro(node.tagName.removeprefix("xacro:"), macros, symbols)
            except KeyError:
                return handle(node, macros, symbols)
            macros, symbols = scope_class(call[0], macros), scope_class(call[1], symbols)
            macros.call = call
        return handle(node, macros, symbols)

    def eval_default_arg(forward: str | None, default: str | None, symbols: Any, macro: Any) -> Any:
        if isinstance(symbols, scope_class) and default is not None and forward not in symbols.own:
            forward = None  # ``^|default``: the name of the caller is another one
        return evaluate(forward, default, symbols, macro)

    xacro.resolve_macro, xacro.handle_macro_call, xacro.eval_default_arg = resolve_macro, handle_macro_call, eval_default_arg

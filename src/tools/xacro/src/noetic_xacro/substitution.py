"""``$(env X)``, ``$(anon x)``, ``$(eval ...)`` and their kin, as roslaunch has them in Noetic."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from noetic_xacro.expressions import bound_symbols, safe_eval


def substituted(text: str, context: dict[str, Any], upstream: ModuleType) -> str:
    """What ``text`` stands for.

    :param context: what xacro keeps of one file; holds ``arg``, and ``anon``: the same name twice is the same name.
    :param upstream: the module ``xacro.substitution_args``, which knows the others.
    :raises upstream.SubstitutionException: written wrongly; and whatever an expression has to say.
    """
    inside = text[2:-1]
    words = inside.split()
    if inside.startswith("eval "):
        return _evaluated(inside[len("eval ") :], context, upstream)
    if words[:1] == ["anon"]:
        if len(words) != 2:
            what = "may only specify one name" if words[1:] else "must specify a name"
            raise upstream.SubstitutionException(f"$(anon var) {what} [{inside}]")
        return _anonymous(words[1], context)
    try:
        return upstream.resolve_args(text, context=context)
    except upstream.SubstitutionException as error:
        if str(error).startswith("Unknown substitution command"):
            raise upstream.SubstitutionException("unknown; there are find, env, optenv, dirname, anon, arg, eval") from None
        raise


def _anonymous(name: str, context: dict[str, Any]) -> str:
    from rosgraph.names import anonymous_name

    names = context.setdefault("anon", {})
    if name not in names:
        names[name] = anonymous_name(name)
    return names[name]


def _evaluated(expression: str, context: dict[str, Any], upstream: ModuleType) -> str:
    """Bounded as ``${...}`` is; arguments are known by their names."""
    if "__" in expression:
        raise upstream.SubstitutionException("$(eval ...) may not contain double underscore expressions")
    arguments = context.setdefault("arg", {})
    offered = dict(upstream._eval_dict)
    symbols = {
        **{name: upstream.convert_value(value, "auto") for name, value in arguments.items() if isinstance(value, str)},
        **offered.pop("__builtins__"),
        **offered,
    }
    symbols["arg"] = lambda name: upstream.convert_value(upstream._eval_arg(name, args=arguments), "auto")
    symbols["anon"] = lambda name: _anonymous(name, context)
    symbols["dirname"] = lambda: upstream._eval_dirname(context.get("filename"))
    bound_symbols(symbols)
    return str(safe_eval(expression, symbols))

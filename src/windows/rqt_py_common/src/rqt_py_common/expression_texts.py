"""Texts that expressions make: formats and methods that neither reach other objects nor grow without bound."""

import re
import string

LONGEST = 100000  # elements of a list or text that an expression may make
_WIDEST = 1000  # of one field of a format


def checked_format(value, spec: str) -> str:
    """``value`` as text.

    :param value: what ``format()`` takes
    :param spec: as for ``format()``
    :raises ValueError: it is too wide
    """
    if any(int(number) > _WIDEST for number in re.findall(r"\d{1,9}", spec)):
        raise ValueError("the text would be too long")
    return format(value, spec)


class _Formatter(string.Formatter):
    def get_field(self, field_name, args, kwargs):
        if "." in field_name or "[" in field_name:
            raise ValueError(f"{{{field_name}}}: members are not allowed here")
        return super().get_field(field_name, args, kwargs)

    def format_field(self, value, format_spec):
        return checked_format(value, format_spec)


def _limited(length: int) -> None:
    if length > LONGEST:
        raise ValueError(f"more than {LONGEST} elements")


def _join(text, parts):
    parts = list(parts)
    _limited(sum(len(part) + len(text) for part in parts))
    return text.join(parts)


def _replace(text, old, new, count=-1):
    _limited(len(text) + text.count(old) * len(new))
    return text.replace(old, new, count)


def _padded(name):
    def pad(text, width, *fill):
        _limited(width)
        return getattr(text, name)(width, *fill)

    return pad


#: methods of a text that are other functions here
METHODS = {
    "format": lambda text, *values, **named: _Formatter().vformat(text, values, named),
    "join": _join,
    "replace": _replace,
    **{name: _padded(name) for name in ("zfill", "rjust", "ljust", "center")},
}

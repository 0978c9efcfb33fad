"""``xacro FILE [a:=b ...]`` as in ROS Noetic: PyPI's xacro, ``$(find pkg)`` through rospkg, errors with file and line.

PyPI's xacro reads with minidom, which forgets line numbers. ``reading`` notes file and line on each element; a failing run
reports the innermost element that was being expanded.
"""

from __future__ import annotations

import os
import sys
import xml.dom.minidom
from xml.parsers.expat import ExpatError

import xacro
import xacro.cli
from ament_index_python.packages import PackageNotFoundError

from noetic_xacro.marks import PLACE
from noetic_xacro.reading import shortened

_LINES = 10  # of the files and macros around an error


def _place_of(error: BaseException) -> str:
    """Place of the innermost element that the failing call chain was working on, '' if unknown."""
    place = ""
    trace = error.__traceback__
    while trace is not None:
        for name, value in trace.tb_frame.f_locals.items():
            if name == "body":  # of a macro whose arguments are being evaluated
                continue
            if isinstance(value, xml.dom.minidom.Element) and hasattr(value, PLACE):
                place = getattr(value, PLACE)
        trace = trace.tb_next
    return place


def _fail(message: str, verbosity: int, error: BaseException) -> None:
    lines = message.splitlines() or [""]
    print("\n".join([f"xacro: error: {shortened(lines[0])}"] + [shortened(line) for line in lines[1:_LINES]]), file=sys.stderr)
    if verbosity > 0:
        for stack in (xacro.macrostack, xacro.filestack):
            del (stack or [])[:-_LINES]  # the outer ones of what calls itself
        xacro.print_location()
    if verbosity > 1:
        raise error
    sys.exit(2)


def main() -> None:
    """Expand one file to standard output or to ``-o FILE``. Exit code 2 on any error, as upstream."""
    options, file_name = xacro.cli.process_args(sys.argv[1:])
    if options.root_dir:
        xacro.root_dir = options.root_dir
    try:
        doc = xacro.process_file(file_name, **vars(options))
        text = " ".join(sorted(set(xacro.all_includes))) if options.just_deps else doc.toprettyxml(indent="  ")
        if options.output:
            with xacro.open_output(options.output) as out:
                out.write(text)
        else:
            sys.stdout.write(text)
    except ExpatError as error:
        file = (xacro.filestack or [file_name])[-1]
        _fail(f"{file}:{error.lineno}: not well-formed XML: {error}", options.verbosity, error)
    except BrokenPipeError:
        os._exit(1)  # the reader went away (`xacro f | head`): nothing to report, nothing left to flush
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:  # noqa: BLE001  expressions in a xacro file may raise anything
        place = _place_of(error)
        if isinstance(error, RecursionError) or isinstance(getattr(error, "exc", None), RecursionError):
            _fail(f"{place or file_name}: nests too deep; does a macro or a file include itself?", options.verbosity, error)
        cause = getattr(error, "exc", None)
        message = str(cause if isinstance(cause, PackageNotFoundError) else error) or repr(error)
        _fail(f"{place}: {message}" if place and not message.startswith(place) else message, options.verbosity, error)

"""The commands of ``rosrun lab_check``."""

from __future__ import annotations

import argparse
import os
import pathlib
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .specs.spec import Spec


def load_spec(path: str) -> Spec:
    """The spec of the file ``path``; its faults go to the terminal, and the program ends with 2."""
    from .specs.spec import SpecError, load

    try:
        return load(path)
    except SpecError as error:
        for line in error.problems:
            print(line, file=sys.stderr)
        raise SystemExit(2) from None


def allowed(unsafe: bool) -> None:
    from .isolation.control_group import bounded
    from .isolation.sandbox import Platform, SandboxError, remark
    from .isolation.sandbox import check as try_it

    try:
        Platform.here()
        if unsafe:
            print("lab_check: --unsafe: the submission's code runs as you, and may do what you may", file=sys.stderr)
        else:
            try_it()
            with bounded(1, 1e9) as place:
                weaker = remark(place)
            if weaker:
                print(f"lab_check: {weaker}", file=sys.stderr)
    except SandboxError as error:
        print(f"lab_check: {error}", file=sys.stderr)
        raise SystemExit(3) from None


class Parser(argparse.ArgumentParser):
    """Of words among which there may be names of submissions: with ``*`` the shell makes an option of a file that is called so."""

    def parse_args(self, args: Sequence[str] | None = None, namespace: Any = None) -> Any:  # type: ignore[override]
        """As argparse's, of ``args`` into ``namespace``; a word that looks like an option and is the name of a file here is an error."""
        for word in sys.argv[1:] if args is None else args:
            if word == "--":
                break
            if word.startswith("-") and os.path.lexists(word):
                self.error(f"'{word}' is the name of a file here; write ./{word} for it (./* for all), and the option in another folder")
        return super().parse_args(args, namespace)


def parser_for(name: str, text: str) -> argparse.ArgumentParser:
    """A parser for the command ``name``, which takes a spec; ``text`` says what the command does."""
    parser = Parser(prog=f"rosrun lab_check {name}", description=text)
    parser.add_argument("spec", help="YAML: what is asked for; docs/grading.md")
    return parser


def sandbox_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of all that examines to ``parser``."""
    parser.add_argument("--unsafe", action="store_true", help="without a sandbox, for code that you trust and machines that allow none")
    parser.add_argument("--no-films", action="store_true", help="leave the films out, which cost most of the time")
    parser.add_argument("--port", type=int, default=0, help="with --unsafe: first port to try for the ROS master")


def check(arguments: list[str] | None = None) -> int:
    """Exit code 0 full marks, 1 less, 2 the spec is faulty, 3 no sandbox, 4 the checker itself failed, 5 no reports can be written."""
    from node_signals.progress import progress

    from .check import NoPlace
    from .check import check as examine

    parser = parser_for("check", "Mark one submission; reports in --out.")
    parser.add_argument(
        "submission",
        type=pathlib.Path,
        nargs="?",
        help="a folder with packages, or a zip or tar of one; without it the spec alone is checked",
    )
    parser.add_argument("--out", type=pathlib.Path, help="default: lab_check/<name of the submission>")
    sandbox_options(parser)
    options = parser.parse_args(arguments)
    spec = load_spec(options.spec)
    if options.submission is None:
        print(f"{options.spec}: {len(spec.data['tasks'])} tasks, {spec.points:g} points")
        return 0
    allowed(options.unsafe)
    out = options.out or pathlib.Path("lab_check", options.submission.name or "submission")
    try:
        with progress(len(spec.data["tasks"]), "examining", "tasks") as bar:
            result = examine(
                spec,
                options.submission,
                out,
                options.unsafe,
                not options.no_films,
                options.port,
                (lambda done, now: bar.at(done, shown(now))) if bar.shown else None,
            )
    except NoPlace as error:
        print(f"lab_check: {error}", file=sys.stderr)
        return 5
    for task in result.tasks:
        print(f"{task.points:6g} of {task.of:<5g} {task.name}")
        for verdict in task.verdicts:
            if not verdict.passed:
                print(f"                - {shown(verdict.reason)}")
    for note in result.notes:
        print(f"note: {shown(note)}")
    if result.fault:
        print(f"lab_check: the checker itself failed: {shown(result.fault)}", file=sys.stderr)
    marks = "not examined" if result.fault else f"{result.points:g} of {result.of:g} points in {result.seconds:.1f} s"
    print(f"{marks}; {shown(str(out / 'report.html'))}")
    return 4 if result.fault else int(result.points < result.of)


def shown(text: str) -> str:
    """``text`` for a terminal: what a submission wrote moves no cursor and begins no line."""
    from .outcome import readable

    return "".join(c if c.isprintable() or c == " " else "\ufffd" for c in readable(text))


def grade(arguments: list[str] | None = None) -> int:
    from .classroom.grade import main

    return main(arguments)


def new(arguments: list[str] | None = None) -> int:
    from .specs.new_spec import main

    return main(arguments)


def similar(arguments: list[str] | None = None) -> int:
    from .classroom.similar import main

    return main(arguments)


def faults(arguments: list[str] | None = None) -> int:
    from .faults import main

    return main(arguments)


def sweep(arguments: list[str] | None = None) -> int:
    from .sweep import main

    return main(arguments)

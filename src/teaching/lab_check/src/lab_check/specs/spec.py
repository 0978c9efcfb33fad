"""The teacher's file: read, checked against ``spec_schema.json``, with file and line in every complaint."""

from __future__ import annotations

import difflib
import json
import pathlib
import re
from dataclasses import dataclass, field
from typing import Any

import jsonschema
import yaml

from ..errors import LabError
from .spec_messages import misfit
from .spec_numbers import problems_of_numbers

SCHEMA = json.loads((pathlib.Path(__file__).parent / "spec_schema.json").read_text(encoding="utf-8"))
EXTRAS = ("points", "say")  # of an expectation, beside its kind
_PATTERNS = {"file": ("contains",), "exit": ("says",), "no_errors": ("ignore",)}  # where a regular expression stands
_UNITS = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
LIMITS = {"memory": "3 GB", "disk": "1 GB", "log": "50 MB", "input": "200 MB", "processes": 400, "time": 300.0}
# Who a run, or an answer, is called when nobody gave it a name.
UNNAMED = "it"


class SpecError(LabError, ValueError):
    """The spec cannot be used; ``problems`` has one line each: file:line: what is wrong and what to do."""

    def __init__(self, problems: list[str]):
        super().__init__("\n".join(problems))
        self.problems = problems


@dataclass
class Spec:
    """``data`` as the file has it, with defaults filled in; ``lines`` from a path of keys to a line number."""

    path: pathlib.Path
    data: dict[str, Any]
    lines: dict[tuple, int] = field(default_factory=dict)

    def limit(self, name: str) -> float:
        """The limit ``name``: bytes, processes or seconds."""
        value = self.data["limits"][name]
        return size(value) if isinstance(value, str) else value

    @property
    def points(self) -> float:
        return self.data["build"]["points"] + sum(task["points"] for task in self.data["tasks"])


def size(text: str) -> float:
    """``text`` as '1.5 GB' in bytes."""
    return float(text[:-2]) * _UNITS[text[-2:]]


def kind_of(expectation: dict[str, Any]) -> str:
    """The kind of ``expectation``, an entry of ``expect``."""
    return next(key for key in expectation if key not in EXTRAS)


def load(path: str | pathlib.Path) -> Spec:
    """The spec of the file ``path``. :raises SpecError: the file is not there, no YAML, or not what the schema allows"""
    path = pathlib.Path(path)
    data, lines = read(path, SCHEMA)
    _fill(data)
    problems = _further(path, data, lines)
    if problems:
        raise SpecError(problems)
    return Spec(path.resolve(), data, lines)


def read(path: pathlib.Path, schema: dict[str, Any]) -> tuple[dict[str, Any], dict[tuple, int]]:
    """YAML that the schema allows, and the line of each of its values by the path of keys to it.

    :raises SpecError: as :func:`load`
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise SpecError([f"{path}: cannot be read: {error}"]) from error
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        lines: dict[tuple, int] = {}
        problems: list[str] = []
        data = _plain(node, (), lines, problems, path) if node else None
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{path}:{mark.line + 1}" if mark else str(path)
        raise SpecError([f"{where}: no YAML: {getattr(error, 'problem', None) or error}"]) from error
    problems += _schema_problems(path, data, lines, schema)
    if problems or data is None:
        raise SpecError(problems)
    return data, lines


def _plain(node: yaml.Node, where: tuple, lines: dict[tuple, int], problems: list[str], path: pathlib.Path, depth: int = 0) -> Any:
    """A YAML node as Python data; where each value stands goes to ``lines``, keys given twice to ``problems``."""
    lines[where] = node.start_mark.line + 1
    if depth > 40:
        raise RecursionError("nested more than 40 deep")
    if isinstance(node, yaml.MappingNode):
        found = {}
        for key_node, value_node in node.value:
            key = key_node.value if isinstance(key_node, yaml.ScalarNode) else str(key_node.start_mark)
            if key in found:
                problems.append(f"{path}:{key_node.start_mark.line + 1}: '{key}' stands here for the second time")
            found[key] = _plain(value_node, (*where, key), lines, problems, path, depth + 1)
            lines[(*where, key)] = key_node.start_mark.line + 1
        return found
    if isinstance(node, yaml.SequenceNode):
        return [_plain(child, (*where, index), lines, problems, path, depth + 1) for index, child in enumerate(node.value)]
    constructor = yaml.SafeLoader("")
    return constructor.construct_object(node, deep=True)


def _schema_problems(path: pathlib.Path, data: Any, lines: dict[tuple, int], schema: dict[str, Any]) -> list[str]:
    validator = jsonschema.Draft7Validator(schema)
    problems = []
    for error in sorted(validator.iter_errors(data), key=lambda e: lines.get(tuple(e.absolute_path), 0)):
        where = tuple(error.absolute_path)
        right = example(schema, where)
        problems += [f"{path}:{line_of(lines, (*where, *more))}: {text}{right}" for more, text in _words(error, where)]
    return problems


def example(schema: dict[str, Any], where: tuple) -> str:
    """How the command or the expectation at ``where``, a path of keys, is written, to be put behind a complaint; '' elsewhere.

    :param schema: spec_schema.json
    """
    definitions = schema.get("definitions", {})
    kinds = [definitions.get(part, {}).get("properties", {}) for part in ("command", "expectation")]
    written = next((kind[where[4]]["examples"] for kind in kinds if len(where) > 4 and "examples" in kind.get(where[4], {})), None)
    return f"; the right form: {written[0]}" if written else ""


def line_of(lines: dict[tuple, int], where: tuple) -> int:
    """The line, by ``lines``, of the value at ``where``, a path of keys, or of the nearest that holds it."""
    while where and where not in lines:
        where = where[:-1]
    return lines.get(where, 1)


def _place(where: tuple) -> str:
    return ".".join(str(part + 1) if isinstance(part, int) else part for part in where) or "the file"


def _words(error: jsonschema.ValidationError, where: tuple) -> list[tuple[tuple, str]]:
    """What jsonschema found, in a teacher's words, with the rest of the path to the place."""
    place = _place(where)
    value = json.dumps(error.instance, default=str)
    value = value if len(value) < 60 else value[:57] + "..."
    if error.validator == "additionalProperties":
        known = sorted(error.schema.get("properties", {}))
        answers = []
        for key in error.instance:
            if key not in known:
                near = difflib.get_close_matches(str(key), known, 1)
                advice = f"did you mean '{near[0]}'?" if near else f"known are {', '.join(known)}"
                answers.append(((key,), f"{place}: '{key}' is not known here; {advice}"))
        return answers
    sentences = {
        "required": f"{place}: {error.message.split(' is a ')[0]} is missing",
        "type": f"{place}: {value} is no {_kind(error.validator_value)}",
        "minimum": f"{place}: {value} is less than {error.validator_value}",
        "exclusiveMinimum": f"{place}: {value} must be more than {error.validator_value}",
        "maximum": f"{place}: {value} is more than {error.validator_value}",
        "pattern": f"{place}: {value} has not the form asked for ({_form(str(error.validator_value))})",
        "enum": f"{place}: {value} is none of {', '.join(map(str, error.validator_value or []))}" if error.validator == "enum" else "",
        "minItems": f"{place}: needs at least {error.validator_value} entries",
        "maxItems": f"{place}: takes at most {error.validator_value} entries",
        "minProperties": f"{place}: is empty",
        "maxProperties": f"{place}: holds several commands ({', '.join(error.instance) if isinstance(error.instance, dict) else ''});"
        " give each a '-' of its own",
        "uniqueItems": f"{place}: has an entry twice",
    }
    return [((), sentences.get(error.validator, f"{place}: {error.message}"))]


def _kind(name: str | list[str]) -> str:
    if isinstance(name, list):
        return " and no ".join(map(_kind, name))
    return {"object": "table (key: value)", "array": "list", "string": "text", "boolean": "true or false"}.get(name, str(name))


def _form(pattern: str) -> str:
    return {
        SCHEMA["definitions"]["size"]["pattern"]: "a size such as 500 MB or 2 GB",
        SCHEMA["definitions"]["name"]["pattern"]: "a name of letters, digits and _",
    }.get(pattern, "package/Type")


def _fill(data: dict[str, Any]) -> None:
    data.setdefault("packages", [])
    data.setdefault("also", [])
    data["build"] = {"points": 0, "timeout": 240.0, **data.get("build", {})}
    data["limits"] = {**LIMITS, **data.get("limits", {})}
    data.setdefault("seed", 0)
    data.setdefault("quantum", 0.02)
    data.setdefault("launch", "")
    data.setdefault("ready", {})
    data.setdefault("interference", "noted")
    data.setdefault("own_plugins", False)
    for task in data["tasks"]:
        task.setdefault("points", 0)
        task.setdefault("launch", data["launch"])
        task["ready"] = {"timeout": 60.0, **data["ready"], **task.get("ready", {})}
        task.setdefault("do", [])
        task.setdefault("film", True)
        task.setdefault("all", False)
        task.setdefault("interference", data["interference"])


def _further(path: pathlib.Path, data: dict[str, Any], lines: dict[tuple, int]) -> list[str]:
    """What a schema cannot say."""
    problems = [
        f"{path}:{line_of(lines, where)}: {_place(where)}: {text}{example(SCHEMA, where)}" for where, text in problems_of_numbers(data)
    ]
    names = {}
    for number, task in enumerate(data["tasks"]):
        here = ("tasks", number)
        if task["name"] in names:
            problems.append(f"{path}:{line_of(lines, (*here, 'name'))}: a task '{task['name']}' is there already")
        names[task["name"]] = number
        runs = {c["run"].get("name", UNNAMED) for c in task["do"] if "run" in c}
        calls = {c[k].get("name", UNNAMED) for c in task["do"] for k in ("call", "action") if k in c}
        for index, command in enumerate(task["do"]):
            at = f"{path}:{line_of(lines, (*here, 'do', index))}: tasks.{number + 1}.do.{index + 1}"
            wrong = _no_run(command["stop"], runs) if "stop" in command and command["stop"] not in runs else misfit(command)
            problems += [f"{at}: {wrong}"] if wrong else []
        for index, expectation in enumerate(task["expect"]):
            kinds = [key for key in expectation if key not in EXTRAS]
            at = f"{path}:{line_of(lines, (*here, 'expect', index))}: tasks.{number + 1}.expect.{index + 1}"
            if len(kinds) != 1:
                problems.append(f"{at}: holds {'several kinds (' + ', '.join(kinds) + ')' if kinds else 'no kind'}; give one")
                continue
            problems += [f"{at}: {text}" for text in _references(kinds[0], expectation[kinds[0]], runs, calls, path)]
            if kinds[0] not in ("file",) and not task["launch"]:
                problems.append(f"{at}: '{kinds[0]}' needs something that runs, but neither the task nor the file says 'launch'")
    if data["build"]["points"] and not data["packages"]:
        problems.append(f"{path}:{line_of(lines, ('build',))}: build has points, but 'packages' names none")
    for index, folder in enumerate(data["also"]):
        if not (path.parent / folder).is_dir():
            problems.append(f"{path}:{line_of(lines, ('also', index))}: there is no folder {path.parent / folder}")
    return problems


def _no_run(name: str, runs: set[str]) -> str:
    return f"no 'run' of this task is named '{name}'; there are: {', '.join(sorted(runs)) or 'none'}"


def _references(kind: str, wanted: Any, runs: set[str], calls: set[str], path: pathlib.Path) -> list[str]:
    patterns = [wanted[key] for key in _PATTERNS.get(kind, ()) if key in wanted]
    for pattern in (each for one in patterns for each in (one if isinstance(one, list) else [one])):
        try:
            re.compile(pattern)
        except (re.error, OverflowError) as error:
            return [f"'{pattern}' is no regular expression: {error}; write \\ before ( ) [ ] . * + ? that stand for themselves"]
    if kind == "exit" and wanted["run"] not in runs:
        return [_no_run(wanted["run"], runs)]
    if kind == "answer" and wanted["call"] not in calls:
        return [f"no 'call' or 'action' of this task is named '{wanted['call']}'; there are: {', '.join(sorted(calls)) or 'none'}"]
    if kind == "python" and not (path.parent / wanted["file"]).is_file():
        return [f"there is no file {path.parent / wanted['file']}"]
    return []

"""A sweep's file: which parameters take which values, and where they go in spec and submission."""

from __future__ import annotations

import hashlib
import itertools
import json
import math
import pathlib
import re
import shutil
from dataclasses import dataclass
from typing import Any

import numpy as np
import yaml

from ..errors import LabError
from .spec import SpecError, line_of, load, read

SCHEMA = json.loads((pathlib.Path(__file__).parent / "sweep_schema.json").read_text(encoding="utf-8"))
_PLACES = ("spec", "launch", "yaml", "file")
_MOST = 100000  # cases


class PlaceError(LabError, ValueError):
    """A value cannot be put where it should go; the reason in one line."""


@dataclass
class Sweep:
    """``cases``: for each its parameters' values, in the file's order."""

    path: pathlib.Path
    data: dict[str, Any]
    spec: pathlib.Path
    submission: pathlib.Path
    cases: list[dict[str, Any]]

    @property
    def touches_files(self) -> bool:
        return any("yaml" in place or "file" in place for place in self.data["set"])

    def write_case(self, values: dict[str, Any], folder: pathlib.Path) -> pathlib.Path:
        """Spec with ``values`` (by parameter) into ``folder`` and, where values go into files, a copy of the submission.

        :returns: the submission to examine
        :raises PlaceError: a place is not there
        """
        folder.mkdir(parents=True, exist_ok=True)
        data = yaml.safe_load(self.spec.read_text(encoding="utf-8"))
        _stay_beside(data, self.spec.parent)
        submission = self.submission
        if self.touches_files:
            submission = folder / self.submission.name
            shutil.rmtree(submission, ignore_errors=True)
            shutil.copytree(self.submission, submission, symlinks=True, ignore=shutil.ignore_patterns(".git", "build", "devel", "logs"))
        for place in self.data["set"]:
            put(place, values[place["parameter"]], data, submission)
        (folder / "spec.yaml").write_text(yaml.safe_dump(data, sort_keys=False, allow_unicode=True), encoding="utf-8")
        return submission


def load_sweep(path: str | pathlib.Path) -> Sweep:
    """The sweep of the file ``path``. :raises SpecError: a line for each mistake: file, line, what is wrong"""
    path = pathlib.Path(path)
    data, lines = read(path, SCHEMA)
    data = {"seed": 0, "draws": 1, **data}
    sweep = Sweep(path.resolve(), data, path.resolve().parent / data["spec"], path.resolve().parent / data["submission"], [])
    problems = _ranges(path, data, lines) + _places(path, data, lines)
    if not sweep.submission.is_dir():
        problems.append(f"{path}:{line_of(lines, ('submission',))}: there is no folder {sweep.submission}")
    try:
        load(sweep.spec)
    except SpecError as error:
        problems += error.problems
    if problems:
        raise SpecError(problems)
    sweep.cases = cases(data)
    problems = _try_places(path, sweep, lines)
    if problems:
        raise SpecError(problems)
    return sweep


def _ranges(path: pathlib.Path, data: dict[str, Any], lines: dict[tuple, int]) -> list[str]:
    problems, number = [], data["draws"]
    for name, given in data["parameters"].items():
        at = f"{path}:{line_of(lines, ('parameters', name))}: parameters.{name}"
        kinds = sorted(set(given) - {"from", "to", "steps"}) + (["from, to, steps"] if set(given) & {"from", "to", "steps"} else [])
        if len(kinds) != 1:
            problems.append(f"{at}: holds {' and '.join(kinds)}; give one of values; from, to, steps; uniform; log")
        elif kinds[0] == "from, to, steps" and len(given) != 3:
            problems.append(f"{at}: from, to and steps belong together")
        elif "uniform" in given and not given["uniform"][0] < given["uniform"][1]:
            problems.append(f"{at}: uniform: the first number must be the lesser one")
        elif "log" in given and not 0 < given["log"][0] < given["log"][1]:
            problems.append(f"{at}: log: both numbers must be above 0, the first the lesser one")
        elif kinds[0] in ("values", "from, to, steps"):
            number *= len(given["values"]) if "values" in given else given["steps"]
    if number > _MOST:
        problems.append(f"{path}:{line_of(lines, ('parameters',))}: these are {number} cases; {_MOST} are the most")
    random = [name for name, given in data["parameters"].items() if "uniform" in given or "log" in given]
    if data["draws"] > 1 and not random:
        problems.append(f"{path}:{line_of(lines, ('draws',))}: draws: no parameter is random (uniform, log): each would be the same")
    return problems


def _places(path: pathlib.Path, data: dict[str, Any], lines: dict[tuple, int]) -> list[str]:
    problems = []
    for index, place in enumerate(data["set"]):
        at = f"{path}:{line_of(lines, ('set', index))}: set.{index + 1}"
        kinds = [kind for kind in _PLACES if kind in place]
        if len(kinds) != 1:
            problems.append(f"{at}: holds {' and '.join(kinds) or 'no place'}; give one of {', '.join(_PLACES)}")
            continue
        if place["parameter"] not in data["parameters"]:
            problems.append(f"{at}: there is no parameter '{place['parameter']}'; there are {', '.join(data['parameters'])}")
        for kind, other in (("yaml", "key"), ("file", "find")):
            if (kind in place) != (other in place):
                problems.append(f"{at}: '{kind}' and '{other}' belong together")
        if "find" in place:
            try:
                groups = re.compile(place["find"]).groups
            except re.error as error:
                problems.append(f"{at}: find: {error}")
            else:
                if groups != 1:
                    problems.append(f"{at}: find needs one group in ( ) round what is replaced; it has {groups}")
    for name in data["parameters"]:
        if not any(place["parameter"] == name for place in data["set"]):
            problems.append(f"{path}:{line_of(lines, ('parameters', name))}: parameters.{name}: goes nowhere; name it under 'set'")
    return problems


def _try_places(path: pathlib.Path, sweep: Sweep, lines: dict[tuple, int]) -> list[str]:
    """Each place is tried with the first case's value, on the texts alone."""
    problems = []
    for index, place in enumerate(sweep.data["set"]):
        data = yaml.safe_load(sweep.spec.read_text(encoding="utf-8"))
        try:
            put(place, sweep.cases[0][place["parameter"]], data, sweep.submission, write=False)
        except PlaceError as error:
            problems.append(f"{path}:{line_of(lines, ('set', index))}: set.{index + 1}: {error}")
    return problems


def cases(data: dict[str, Any]) -> list[dict[str, Any]]:
    """The grid of ``data``, the file's, each of its points ``draws`` times. A parameter's draws depend on the seed and its name alone."""
    listed: dict[str, list[Any]] = {}
    drawn = {}
    for name, given in data["parameters"].items():
        if "values" in given:
            listed[name] = list(given["values"])
        elif "steps" in given:
            listed[name] = [float(value) for value in np.linspace(given["from"], given["to"], given["steps"])]
        else:
            digest = hashlib.sha256(f"{data['seed']}/{name}".encode()).digest()
            drawn[name] = (np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "little"))), given)
    found = []
    for point in itertools.product(*listed.values()):
        for _ in range(data["draws"]):
            values = dict(zip(listed, point))
            for name, (generator, given) in drawn.items():
                low, high = given.get("uniform") or [math.log(value) for value in given["log"]]
                value = float(generator.uniform(low, high))
                values[name] = value if "uniform" in given else math.exp(value)
            found.append({name: values[name] for name in data["parameters"]})
    return found


# ---------------------------------------------------------------------------------------------- places


def put(place: dict[str, Any], value: Any, spec: dict[str, Any], submission: pathlib.Path, write: bool = True) -> None:
    """``value`` to its ``place`` in the data of the ``spec``, or in a file of the ``submission``.

    :param write: False only looks whether there is such a place
    :raises PlaceError: there is no such place
    """
    if "spec" in place:
        _set(spec, [int(part) - 1 if part.isdigit() else part for part in place["spec"].split(".")], value, "the spec")
    elif "launch" in place:
        launches = [holder for holder in (spec, *spec["tasks"]) if holder.get("launch")]
        if not launches:
            raise PlaceError("the spec launches nothing")
        for holder in launches:
            first, *rest = holder["launch"].split(" + ")
            holder["launch"] = " + ".join([f"{first} {place['launch']}:={_shown(value)}", *rest])
    else:
        _put_into_file(place, value, submission, write)


def _put_into_file(place: dict[str, Any], value: Any, submission: pathlib.Path, write: bool) -> None:
    name = place.get("yaml") or place["file"]
    path = submission / name
    if ".." in pathlib.PurePath(name).parts or not path.is_file() or path.is_symlink():
        raise PlaceError(f"the submission has no file {name}")
    text = path.read_text(encoding="utf-8", errors="surrogateescape")
    if "yaml" in place:
        try:
            data = yaml.safe_load(text)
        except yaml.YAMLError as error:
            raise PlaceError(f"{name} is no YAML: {' '.join(str(error).split())}") from None
        _set(data, place["key"].strip("/").split("/"), value, name)
        text = yaml.safe_dump(data, sort_keys=False)
    else:

        def replaced(match: re.Match[str]) -> str:
            begin, end = match.span(1)
            whole = match.group(0)
            return whole[: begin - match.start()] + _shown(value) + whole[end - match.start() :] if begin >= 0 else whole

        text, number = re.subn(place["find"], replaced, text)
        if not number:
            raise PlaceError(f"{name} holds nothing like {place['find']}")
    if write:
        path.write_text(text, encoding="utf-8", errors="surrogateescape")


def _set(data: Any, keys: list, value: Any, where: str) -> None:
    """The last key of a table may be new, as many values have a default."""
    for number, key in enumerate(keys):
        last = number == len(keys) - 1
        there = isinstance(data, dict) and (key in data or last) or isinstance(data, list) and isinstance(key, int) and 0 <= key < len(data)
        if not there:
            shown = ".".join(str(part + 1) if isinstance(part, int) else part for part in keys[: number + 1])
            raise PlaceError(f"{where} has no {shown}")
        if last:
            data[key] = value
        else:
            data = data[key]


def _shown(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)


def _stay_beside(data: dict[str, Any], folder: pathlib.Path) -> None:
    """A case's spec lies elsewhere: what the original names beside itself gets its whole path."""
    if "also" in data:
        data["also"] = [str(folder / name) for name in data["also"]]
    for task in data["tasks"]:
        for expectation in task["expect"]:
            if "python" in expectation:
                expectation["python"]["file"] = str(folder / expectation["python"]["file"])

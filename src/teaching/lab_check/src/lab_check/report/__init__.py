"""What came of a submission, for people (HTML), programs (JSON), CI (JUnit XML) and Gradescope (results.json)."""

from __future__ import annotations

import json
import pathlib
import xml.etree.ElementTree as ET
from dataclasses import replace

from ..outcome import Result
from ..specs.spec import Spec
from .page import page


def write(result: Result, spec: Spec, out: pathlib.Path) -> None:
    """Write ``result``, of an examination by ``spec``, into ``out``: report.html, report.json, junit.xml, results.json."""
    (out / "report.html").write_text(page(result, spec, out), encoding="utf-8")
    (out / "report.json").write_text(json.dumps(result.data(), indent=1, sort_keys=True), encoding="utf-8")
    (out / "junit.xml").write_bytes(junit(result))
    (out / "results.json").write_text(json.dumps(gradescope(result), indent=1), encoding="utf-8")


def marks(result: Result) -> str:
    """All of ``result`` that decides about marks and what was measured, as one text: the same in every run."""
    data = {
        "points": result.points,
        "of": result.of,
        "fault": result.fault,
        "tasks": [
            {"name": t.name, "points": t.points, "verdicts": [[v.kind, v.passed, v.reason, v.points, v.figures] for v in t.verdicts]}
            for t in result.tasks
        ],
    }
    return json.dumps(data, sort_keys=True)


def junit(result: Result) -> bytes:
    """``result`` as JUnit XML; where the checker itself failed one error, and no task failed."""
    if result.fault:
        result = replace(result, tasks=[])
    failed = [task for task in result.tasks if task.points < task.of or not all(v.passed for v in task.verdicts)]
    suite = ET.Element(
        "testsuite",
        name=clean(result.title),
        tests=str(len(result.tasks) + bool(result.fault)),
        failures=str(len(failed)),
        errors=str(int(bool(result.fault))),
        skipped="0",
        time=f"{result.seconds:.1f}",
    )
    for task in result.tasks:
        case = ET.SubElement(suite, "testcase", classname="lab_check", name=clean(task.name), time="0")
        if task in failed:
            reasons = "\n".join(v.reason for v in task.verdicts if not v.passed)
            failure = ET.SubElement(case, "failure", message=clean(f"{task.points:g} of {task.of:g} points"))
            failure.text = clean(reasons + "\n\n" + "\n".join(task.log))
    if result.fault:
        case = ET.SubElement(suite, "testcase", classname="lab_check", name="the checker itself", time="0")
        ET.SubElement(case, "error", message=clean(result.fault))
    return ET.tostring(suite, encoding="utf-8", xml_declaration=True)


def clean(text: str) -> str:
    """``text`` without what XML cannot hold."""
    return "".join(c if c in "\t\n" or 0x20 <= ord(c) <= 0xD7FF or 0xE000 <= ord(c) <= 0xFFFD or ord(c) >= 0x10000 else "?" for c in text)


def gradescope(result: Result) -> dict:
    """results.json of ``result``; without a score where the checker itself failed: Gradescope then tells of a failed autograder instead of
    giving 0.
    """
    if result.fault:
        return {
            "execution_time": round(result.seconds),
            "output": f"The checker itself failed, ask your teacher: {result.fault}",
            "stdout_visibility": "hidden",
        }
    tests = [
        {
            "name": task.name,
            "score": task.points,
            "max_score": task.of,
            "status": "passed" if task.points >= task.of else "failed",
            "output": "\n".join(("+ " if v.passed else "- ") + v.reason for v in task.verdicts),
            "visibility": "visible",
        }
        for task in result.tasks
    ]
    return {
        "score": result.points,
        "execution_time": round(result.seconds),
        "output": "\n".join(result.notes),
        "tests": tests,
        "stdout_visibility": "hidden",
    }

"""Does it build? catkin_make first, as courses type it; where that fails, package by package, to say which."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field

from ..explain import error_lines, excerpt, meaning, timeless
from ..isolation.supervise import STRETCH, Guard
from .job import Job, NoRoom


@dataclass
class Built:
    """``failed`` from package to the reason; ``log`` all that was printed."""

    failed: dict[str, str] = field(default_factory=dict)
    log: str = ""
    excerpt: list[str] = field(default_factory=list)
    seconds: float = 0.0
    spent: float = 0.0  # s as on a machine of its own
    code: int = 0  # with which the last of make ended
    broke: str = ""


def build(job: Job) -> Built:
    start = time.monotonic()
    built = Built()
    timeout = job.spec["build"]["timeout"]
    order = _order(job)
    everything = _make(job, built, timeout, [])
    if not everything and not built.broke:
        # One CMake run holds all packages: one bad CMakeLists.txt takes the others down. Leave the culprits out, one by one.
        _one_by_one(job, built, timeout, order)
    if built.broke:
        for name in job.packages:
            built.failed.setdefault(name, f"the build was stopped: {built.broke}")
    built.seconds = time.monotonic() - start
    return built


def _make(job: Job, built: Built, timeout: float, only: list[str]) -> bool:
    """:param only: these packages, from the beginning; otherwise all"""
    chosen = f"-DCATKIN_WHITELIST_PACKAGES='{';'.join(only)}'" if only else ""
    # The folder is the submission's: it may lead anywhere by now, and is removed from where it leads nowhere.
    anew = f"rm -rf {job.workspace}/build; " if only else ""
    line = (
        f"{anew}cd {job.workspace} && catkin_make -j2 -DCMAKE_BUILD_TYPE=Release -DCATKIN_ENABLE_TESTING=OFF "
        f"-DPYTHON_EXECUTABLE=/usr/bin/python3 {chosen}"
    )
    try:
        program = job.start(line, built=False)
    except NoRoom as error:
        built.broke = str(error)
        return False
    guard = Guard(lambda: [program], {**job.limits, "time": timeout}, job.group, job.written, not job.unsafe)
    guard.start()
    program.wait(STRETCH * timeout)
    guard.stop()
    text = program.output.text()
    built.spent += guard.spent
    built.code = program.code or 0
    built.log += text
    built.broke = program.broke
    if program.code != 0 and not built.excerpt:
        built.excerpt = excerpt(text)
    return program.code == 0


def _one_by_one(job: Job, built: Built, timeout: float, order: list[str]) -> None:
    """Each package with those before it that built; dependencies come first."""
    good: list[str] = []
    end = built.spent + timeout
    for name in order:
        before = len(built.log)
        if built.spent > end:
            built.failed[name] = "the time for building was over"
        elif _make(job, built, max(end - built.spent, 1.0), [*good, name]):
            good.append(name)
        else:
            cause = next((line for line in error_lines(built.log[before:])), _ended(built.code))
            cause = f"it was stopped: {built.broke}" if built.broke else cause
            built.failed[name] = f"{timeless(cause)[:300]}{'. ' + meaning(cause) if meaning(cause) else ''}"
            built.broke = ""
    if good:
        _make(job, built, max(end - built.spent, 30.0), good)


def _ended(code: int) -> str:
    """What there is to say where nothing was printed as an error."""
    number = -code if code < 0 else code - 128  # which is how shells and bwrap tell of a signal
    return f"its build was killed by signal {number}" if 0 < number < 65 else f"its build ended with code {code}"


def _order(job: Job) -> list[str]:
    """Of the manifests as they were handed in: before any program of the submission has run."""
    import xml.etree.ElementTree as ET

    needs = {}
    for name, folder in job.packages.items():
        try:
            root = ET.parse(os.path.join(job.home, folder, "package.xml")).getroot()
        except (ET.ParseError, OSError):
            root = ET.Element("package")
        needs[name] = {e.text.strip() for e in root if "depend" in e.tag and e.text} & set(job.packages)
    order: list[str] = []
    while len(order) < len(needs):
        ready = [name for name in needs if name not in order and needs[name] <= {*order, name}]
        order += sorted(ready) or [sorted(set(needs) - set(order))[0]]
    return order

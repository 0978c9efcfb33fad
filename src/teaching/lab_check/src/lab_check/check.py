"""One submission from the outside: makes the job, starts the examiner behind the wall, writes the reports."""

from __future__ import annotations

import errno
import importlib.util
import json
import os
import pathlib
import re
import resource
import signal
import socket
import subprocess
import time
import uuid
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from . import report
from .errors import LabError
from .examination.job import Job, most_tasks
from .isolation import control_group, sandbox, temporary_folders
from .isolation.supervise import STRETCH, die_with_parent
from .outcome import Result
from .specs.spec import Spec

_KEPT = (
    "lab_check.examination.probe",
    "lab_check.examination.session",
    "lab_check.examination.guarded_roslaunch",
    "gazebo_ros_control.plugin",
    "gazebo_plugins.cameras.ros_camera",
    "gazebo_plugins.drives.diff_drive",
    "ode_sim_rendering.portrait",
    "ode_sim_rendering.renderer",
    "joint_state_controller",
    "xacro",
)


Watch = Callable[[int, str], None]  # how many tasks are done, and what is done now

_LOOK = 0.5  # s between two looks at how far an examination is
_BEGINS = re.compile(r"task '(.*)' begins at ")  # what a session says of each task
_LARGEST = 200_000_000  # bytes of a file of the report: films are the largest
_OURS = re.compile(
    r"report\.(html|json)|results?\.json|\.result\.json|junit\.xml|build\.log|launch_\d+\.log|pictures|\.examiner\.log"
    r"|\.job(\.json)?|\.session_\d+\.json"
)


class NoPlace(LabError, RuntimeError):
    """Reports cannot be written there; a sentence for whoever examines."""


def free_port(first: int = 0) -> int:
    """Of this machine; from ``first`` on when that is given."""
    for port in range(first, first + 100) if first else (0,):
        with socket.socket() as s:
            s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                s.bind(("localhost", port))
            except OSError:
                continue
            return s.getsockname()[1]
    raise OSError(f"no free port from {first} on")


def keep_bytecode() -> None:
    """Has Python keep the compiled modules of the simulator: nothing of the platform can be written in the sandbox, and on a machine where
    nobody has run them yet each process of each submission would compile them anew.
    """
    found = importlib.util.find_spec("gazebo_ros.node")
    if found is None or found.origin is None:
        return
    kept = pathlib.Path(importlib.util.cache_from_source(found.origin))
    if not kept.exists() and os.access(kept.parent if kept.parent.exists() else kept.parents[1], os.W_OK):
        environment = {name: value for name, value in sandbox.own_environment().items() if name != "PYTHONDONTWRITEBYTECODE"}
        for module in _KEPT:  # each by itself: one that cannot be imported here keeps no other from it
            subprocess.run([*sandbox.isolated(), "-c", f"import {module}"], env=environment, cwd="/", capture_output=True)


def _place_of(out: pathlib.Path, submission: pathlib.Path) -> pathlib.Path:
    """
    :raises NoPlace: it is a link of the submission, in which it lies
    """
    wanted, mine = os.path.abspath(out), {os.path.abspath(submission), os.path.realpath(submission)}
    for place in [wanted, *map(str, pathlib.Path(wanted).parents)]:
        if os.path.islink(place) and any(place.startswith(f"{folder}/") for folder in mine):
            raise NoPlace(f"{out}: {place} is a link that the submission brings; name another folder by --out")
    return out.resolve()


def _clear(out: pathlib.Path) -> None:
    """Away with the reports of an earlier examination, and with whatever else has their names: ``out`` may lie in the submission.

    :raises NoPlace: it cannot be made, or written to
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        for entry in list(os.scandir(out)):
            if _OURS.fullmatch(entry.name):
                temporary_folders.remove(pathlib.Path(entry.path))
        if not os.access(out, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    except OSError as error:
        raise NoPlace(f"{out}: {error.strerror}") from error


def check(
    spec: Spec,
    submission: pathlib.Path,
    out: pathlib.Path,
    unsafe: bool = False,
    films: bool = True,
    port: int = 0,
    watch: Watch | None = None,
) -> Result:
    """Examine ``submission``, a folder or an archive, by ``spec``.

    :param out: reports go there; what an earlier examination left there goes
    :param unsafe: without the sandbox; ``port``: the first to try for the ROS master then
    :param films: draw them
    :param watch: is called twice a second
    :raises sandbox.SandboxError: this machine cannot shut it in
    :raises NoPlace: reports cannot be written there
    """
    out = _place_of(out, submission)
    sandbox.Platform.here()  # complains before the reports of an earlier examination go
    _clear(out)
    keep_bytecode()
    limits = {name: spec.limit(name) for name in spec.data["limits"]}
    # Its files lie in memory: the kernel's bound holds for both together, the Guard tells one from the other.
    with (
        temporary_folders.folder("lab_check.") as place,
        control_group.bounded(most_tasks(limits), limits["memory"] + limits["disk"]) as bounds,
    ):
        os.chmod(place, 0o755)
        job = Job(
            spec.data,
            str(spec.path.parent),
            os.path.abspath(submission),
            str(place),
            str(out),
            unsafe,
            free_port(port) if unsafe else 11311,
            limits,
            asdict(sandbox.Platform.here()),
            f"LAB_CHECK_RUN={uuid.uuid4().hex}",
            films=films,
            group=bounds,
        )
        result = _examine(job, spec, submission, out, watch)
    report.write(result, spec, out)
    return result


def _examine(job: Job, spec: Spec, submission: pathlib.Path, out: pathlib.Path, watch: Watch | None) -> Result:
    job_file = out / ".job"
    job.save(job_file)
    words = [*sandbox.isolated(), "-m", "lab_check.examination.examiner", str(job_file)]
    sessions = len({task["launch"] for task in spec.data["tasks"]})
    patience = STRETCH * (spec.data["build"]["timeout"] * 2 + sessions * (job.limits["time"] + 90))
    try:
        fault = _run(words, job.unsafe, out, patience, watch)
        return _read(out, fault, spec, submission)
    finally:
        for name in (".job", ".job.json"):
            (out / name).unlink(missing_ok=True)


def _in_bounds() -> None:
    """For the examiner: what it says of a submission that makes it say the same thing for ever fills no disk."""
    die_with_parent()
    resource.setrlimit(resource.RLIMIT_FSIZE, (_LARGEST, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))


def _run(words: list[str], unsafe: bool, out: pathlib.Path, patience: float, watch: Watch | None) -> str:
    """'' or why there is no result."""
    with open(out / ".examiner.log", "w", encoding="utf-8") as log:
        streams: dict[str, Any] = dict(stdout=log, stderr=log, start_new_session=True, env=sandbox.own_environment(), cwd="/")
        streams["preexec_fn"] = _in_bounds
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, **streams) if unsafe else sandbox.shut_in(words, **streams)
        try:
            code = _ended(process, patience, out, watch)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
    if code is None:
        return f"the examination was stopped after {patience:.0f} s"
    if code:
        lines = (out / ".examiner.log").read_text(encoding="utf-8", errors="replace").strip().splitlines()
        return f"the examiner ended with code {code}: {lines[-1] if lines else 'no reason given'}"
    return ""


def _ended(process: subprocess.Popen, patience: float, out: pathlib.Path, watch: Watch | None) -> int | None:
    """The exit code; None if it has not ended after ``patience`` seconds."""
    end, begun = time.monotonic() + patience, []
    with open(out / ".examiner.log", encoding="utf-8", errors="replace") as said:
        while True:
            left = max(0.0, end - time.monotonic())
            try:
                return process.wait(min(_LOOK, left) if watch else left)
            except subprocess.TimeoutExpired:
                if watch is None or left <= 0:
                    return None
            begun += [found[1] for found in map(_BEGINS.match, said.readlines()) if found]
            watch(max(0, len(begun) - 1), begun[-1] if begun else "building, starting")


def _read(out: pathlib.Path, fault: str, spec: Spec, submission: pathlib.Path) -> Result:
    path = out / "result.json"
    data: dict | None = None
    if not fault:
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            fault = f"the examiner left no result: {error}"
    if data is None:
        return Result(spec.data["title"], str(submission), 0.0, spec.points, fault=fault)
    path.unlink()
    return Result.from_data(data)

"""Runs one examination inside the outer wall: ``python3 -m lab_check.examination.examiner JOB`` writes ``result.json`` beside the job's
out."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys
import time
from typing import Any

from ..checks import make
from ..checks.base import Context
from ..explain import first_cause
from ..isolation.sandbox import Platform, isolated, make_world, own_environment, own_network, student
from ..isolation.staging import StagingError, stage, within_bounds
from ..isolation.supervise import STRETCH
from ..isolation.untrusted_files import walk
from ..outcome import Result, TaskResult, Verdict, failed_task, rounded, sentence, share, task_from
from ..specs.spec import kind_of
from .build import Built, build
from .job import Job

# Packages that the examination itself stands on: one of that name in a submission would answer in their place.
TRUSTED = {
    "lab_check",
    "gazebo_ros",
    "gazebo_ros_control",
    "gazebo_msgs",
    "gazebo_plugins",
    "ode_sim",
    "node_signals",
    "rospy",
    "roslaunch",
    "rosgraph",
    "roslib",
    "rosmaster",
    "std_srvs",
    "controller_manager",
    "controller_manager_msgs",
    "realtime_tools",
    "plugin_loader",
}

# What the kernel says at the walls -> what that means.
REFUSED = (
    ("unshare failed", "something asked for a namespace of its own, which a submission may not have"),
    ("No space left on device", "the disk that a submission gets is full"),
    ("File too large", "a file grew beyond what a submission may write"),
    ("Read-only file system", "something tried to write where a submission may not"),
    ("Network is unreachable", "something tried to open a network connection; there is no network"),
    ("Temporary failure in name resolution", "something tried to open a network connection; there is no network"),
    ("Name or service not known", "something tried to open a network connection; there is no network"),
    ("Operation not permitted", "something was tried that a submission may not do"),
    ("Resource temporarily unavailable", "more processes were started than a submission may"),
)


_MOST_FORGED = 10  # that are noted
_REPORTS = frozenset(("result.json", ".result.json", "report.json", "report.html", "results.json", "junit.xml"))


class Examiner:
    def __init__(self, job: Job):
        self.job = job
        self.result = Result(job.spec["title"], job.submission, sandbox="none (--unsafe)" if job.unsafe else "bubblewrap")

    def run(self) -> Result:
        start = time.monotonic()
        if not self.job.unsafe:
            self._own_world()
        os.makedirs(self.job.home, exist_ok=True)
        try:
            with within_bounds():
                self._stage()
        except StagingError as error:
            self._nothing(str(error))
        else:
            own = self._forged()
            needed = self.job.spec["packages"] or any(task["launch"] for task in self.job.spec["tasks"])
            self._tasks(self._build() if needed else Built())
            self._look_through_logs()
            for path in sorted(self._forged() - own)[:_MOST_FORGED]:
                self.result.notes.append(f"{path} was written, which has the name of a report; only the examiner's own reports count")
        self.result.notes = [sentence(note) for note in self.result.notes]
        self.result.seconds = time.monotonic() - start
        return self.result

    def _forged(self) -> set[str]:
        """Files of the submission's home that are named as the examiner's are."""
        return {path for path, _ in walk(self.job.home) if path.rpartition("/")[2] in _REPORTS}

    def _teachers(self) -> list[str]:
        """Folders of the spec and of the submissions, as nobody in the sandbox knows them who does not look for them."""
        folders = {os.path.abspath(self.job.spec_folder), os.path.dirname(os.path.abspath(self.job.submission))}
        return [f"{folder}/" for folder in sorted(folders) if folder.count("/") > 1 and folder != os.path.expanduser("~")]

    def _look_through_logs(self) -> None:
        """What the walls refused, as far as the submission's programs said so."""
        refused = (*REFUSED, *((folder, "something looked for the spec or for other submissions") for folder in self._teachers()))
        for path in sorted(pathlib.Path(self.job.out).glob("*.log")):
            if path.name.startswith("."):
                continue
            lines = [line.strip() for line in path.read_text(encoding="utf-8", errors="replace").splitlines()]
            for words, note in refused:
                line = next((line for line in lines if words in line), None)
                if line is not None:
                    lines = [other for other in lines if words not in other]  # what one wall said is no other's
                    self.result.notes.append(f"{path.name}: {note}: {line[:160]}")

    def _own_world(self) -> None:
        """The loopback of this network, and a disk of bounded size that nobody else sees."""
        own_network()
        self.job.user = student()
        make_world(Platform(**self.job.platform), self.job.scratch, int(self.job.limits["disk"]), self.job.user)

    def _stage(self) -> None:
        source = pathlib.Path(self.job.home, "catkin_ws", "src")
        staged = stage(pathlib.Path(self.job.submission), source, self.job.limits["input"])
        self.result.notes += staged.notes[:40]
        for name in sorted(TRUSTED & set(staged.packages)):
            (staged.packages.pop(name) / "CATKIN_IGNORE").touch()
            self.result.notes.append(f"your package {name} has the name of one that the examination stands on; it is left out")
        for folder in self.job.spec["also"]:
            place = pathlib.Path(self.job.spec_folder, folder)
            more = stage(place, source / f"_{place.name}", 2e8)
            for name, path in more.packages.items():
                if name in staged.packages:
                    (path / "CATKIN_IGNORE").touch()
                else:
                    staged.packages[name] = path
        self.job.hand_over()
        self.job.packages = {name: str(path.relative_to(self.job.home)) for name, path in staged.packages.items()}

    def _nothing(self, reason: str) -> None:
        build_of = self.job.spec["build"]["points"]
        if build_of:
            self.result.add(TaskResult("Build", 0.0, build_of, [Verdict("build", False, reason, 0.0, build_of)]))
        for task in self.job.spec["tasks"]:
            self.result.add(failed_task(task, reason))

    # ------------------------------------------------------------------------------------------ building

    def _build(self) -> Built:
        built = build(self.job)
        pathlib.Path(self.job.out, "build.log").write_text(built.log, encoding="utf-8")
        wanted, points = self.job.spec["packages"], self.job.spec["build"]["points"]
        if wanted:
            verdicts = []
            for name in wanted:
                of = points / len(wanted)
                if name not in self.job.packages:
                    verdicts.append(
                        Verdict(
                            "build",
                            False,
                            f"package {name} is not in your submission (there are: {', '.join(sorted(self.job.packages))})",
                            0.0,
                            rounded(of),
                        )
                    )
                elif name in built.failed:
                    verdicts.append(Verdict("build", False, f"package {name} does not build: {built.failed[name]}", 0.0, rounded(of)))
                else:
                    verdicts.append(Verdict("build", True, f"package {name} builds", rounded(of), rounded(of)))
            good = sum(verdict.passed for verdict in verdicts)
            self.result.add(
                TaskResult("Build", rounded(points * good / len(wanted)), rounded(points), verdicts, ["catkin_make"], log=built.excerpt)
            )
        for name, reason in built.failed.items():
            if name not in wanted:
                self.result.notes.append(f"package {name} does not build: {reason}")
        return built

    # ------------------------------------------------------------------------------------------ tasks

    def _tasks(self, built: Built) -> None:
        spec = self.job.spec
        launches = list(dict.fromkeys(task["launch"] for task in spec["tasks"]))
        found: dict[str, TaskResult] = {}
        for number, launch in enumerate(launches):
            tasks = [task for task in spec["tasks"] if task["launch"] == launch]
            if not launch:
                found.update((task["name"], self._static(task)) for task in tasks)
            elif not os.path.exists(os.path.join(self.job.home, "catkin_ws", "devel", "setup.bash")):
                line, _ = first_cause(built.log)
                found.update(
                    (task["name"], failed_task(task, f"not tried, as nothing was built{': ' + line if line else ''}")) for task in tasks
                )
            else:
                found.update(self._session(number, tasks))
        for task in spec["tasks"]:
            self.result.add(found[task["name"]])

    def _static(self, task: dict[str, Any]) -> TaskResult:
        job = self.job
        context = Context(
            pathlib.Path(job.spec_folder),
            pathlib.Path(job.home),
            pathlib.Path(job.home, "catkin_ws", "src"),
            {name: pathlib.Path(job.home, folder) for name, folder in job.packages.items()},
            required=job.spec["packages"],
        )
        verdicts = []
        for expectation in task["expect"]:
            kind = kind_of(expectation)
            passed, reason, figures = make(kind, expectation[kind], context).verdict()
            if not passed and "say" in expectation:
                reason = f"{expectation['say']} ({reason})"
            verdicts.append(Verdict(kind, passed, reason, figures=figures))
        return share(task, verdicts)

    def _session(self, number: int, tasks: list[dict[str, Any]]) -> dict[str, TaskResult]:
        """In a process of its own: rospy knows one master in a process's life, and what breaks there does not break this one."""
        job_file = os.path.join(self.job.out, ".job.json")
        answer = os.path.join(self.job.out, f".session_{number}.json")
        self.job.save(job_file)
        with open(os.path.join(self.job.out, ".examiner.log"), "a", encoding="utf-8") as log:
            process = subprocess.Popen(
                [*isolated(), "-m", "lab_check.examination.session", job_file, str(number), answer],
                stdout=log,
                stderr=log,
                stdin=subprocess.DEVNULL,
                env=own_environment(),
                cwd="/",
            )
            try:
                process.wait(STRETCH * self.job.limits["time"] + 60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        os.unlink(job_file)
        try:
            data = json.loads(pathlib.Path(answer).read_text(encoding="utf-8"))
            os.unlink(answer)
        except (OSError, ValueError):
            last = (pathlib.Path(self.job.out, ".examiner.log").read_text(encoding="utf-8").strip().splitlines() or ["no reason given"])[-1]
            self.result.fault = f"the examination of 'roslaunch {tasks[0]['launch']}' broke off: {last}"
            return {task["name"]: failed_task(task, "not examined: the checker itself failed") for task in tasks}
        self.result.notes += data["notes"]
        if data["broke"]:
            self.result.notes.append(f"the submission was stopped: {data['broke']}")
        return {task["name"]: task_from(result) for task, result in zip(tasks, data["tasks"])}


def main() -> None:
    os.umask(0o022)  # the submission's user reads what is written here
    job = Job.load(sys.argv[1])
    examiner = Examiner(job)
    result = examiner.run()
    path = pathlib.Path(job.out, ".result.json")
    path.write_text(json.dumps(result.data()), encoding="utf-8")
    path.rename(pathlib.Path(job.out, "result.json"))


if __name__ == "__main__":
    main()

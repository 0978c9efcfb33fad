"""One launch and its tasks: ``python3 -m lab_check.session JOB NUMBER`` writes ``session_NUMBER.json`` into the job's folder."""

from __future__ import annotations

import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import uuid
from dataclasses import asdict
from itertools import zip_longest
from typing import Any, Dict, List, Optional, Sequence

import rosgraph
import rospy

from . import checks, film
from .bench import Bench, Gone, wait_for_simulator
from .checks.base import Context
from .commands import Actor, CommandError
from .explain import excerpt, first_cause
from .job import Job
from .lockstep import Nodes
from .outcome import TaskResult, failed_task, share
from .spec import kind_of
from .supervise import Guard, Program

_READY_REST = 0.35  # s of rest that show a start-up to be over: spawners look for services every few tenths
_READY_PATIENCE = 10.0  # s of work without rest after which a node of the launch is waited for no more
_READY_STEP = 0.1  # s of simulated time between two looks at what has come


class Session:
    def __init__(self, job: Job, tasks: List[Dict[str, Any]], number: int):
        self.job, self.tasks, self.number = job, tasks, number
        self.programs: List[Program] = []
        self.notes: List[str] = []
        self.bench: Optional[Bench] = None
        self.launches: List[Program] = []
        self.guard = Guard(lambda: self.programs, job.limits)
        self._begin = time.monotonic()

    def run(self) -> List[TaskResult]:
        core = subprocess.Popen(
            ["python3", "-m", "lab_check.held_master", str(self.job.port)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "ROS_LOG_DIR": self.job.scratch},
        )
        try:
            self._wait_for_master(core)
            rospy.init_node("lab_check", anonymous=True, disable_signals=True, disable_rostime=True, log_level=rospy.FATAL)
            self.nodes = Nodes(self.job.mark if self.job.unsafe else None, [os.getpid(), os.getppid(), core.pid, 1])
            return self._examine()
        finally:
            self.guard.stop()
            for program in self.programs:
                program.kill()
            core.kill()

    def _wait_for_master(self, core: subprocess.Popen) -> None:
        end = time.monotonic() + 30
        while not rosgraph.is_master_online():
            if core.poll() is not None or time.monotonic() > end:
                raise RuntimeError("the ROS master of this examination did not start")
            time.sleep(0.02)

    def _examine(self) -> List[TaskResult]:
        launch = self.tasks[0]["launch"]
        # What roscore's launcher does: roslaunch would otherwise make one of its own, and a second would not fit.
        rosgraph.Master("/lab_check").setParam("/run_id", str(uuid.uuid4()))
        self._launch(launch.split(" + ")[0])
        self.guard.start()
        try:
            self._get_ready(self.tasks[0]["ready"])
        except Gone as error:
            return [self._with_log(failed_task(task, f"'roslaunch {launch}': {error}"), ()) for task in self.tasks]
        results = []
        for index, task in enumerate(self.tasks):
            mark = self._said()
            print(
                f"task '{task['name']}' begins at {self.bench.now.time:.3f} s of simulation, "
                f"{time.monotonic() - self._begin:.1f} s of wall time",
                flush=True,
            )
            try:
                results.append(self._task(task))
            except Gone as error:
                results.append(self._with_log(failed_task(task, str(error)), mark))
                results += [failed_task(later, f"not tried: {error}") for later in self.tasks[index + 1 :]]
                break
        if self.bench is not None:
            self._remarks()
        return results

    def _remarks(self) -> None:
        for name in self.nodes.restless_names:
            self.notes.append(
                f"{name} never rests: a loop without sleep? It is no longer waited for, and what it does may differ from run to run"
            )

    # ------------------------------------------------------------------------------------------ programs

    def start(self, line: str, keys: bool = False) -> Program:
        program = self.job.start(line, keys)
        self.programs.append(program)
        return program

    def _launch(self, words: str) -> None:
        self.launches.append(self.start(f"exec python3 -m lab_check.held_launch {self.job.spec['seed']} {words}"))

    def _log(self, since: Sequence[int] = ()) -> str:
        """What all programs said, each after as many bytes of it as ``since`` says; :meth:`_said` makes such a mark."""
        return "".join(program.output.text(mark) for program, mark in zip_longest(self.programs, since, fillvalue=0))

    def _said(self) -> List[int]:
        return [program.output.total for program in self.programs]

    def _alive(self) -> None:
        """
        :raises Gone: the launch ended, a limit was broken, or somebody ended the examiner's node
        """
        if self.guard.broke:
            raise Gone(f"your code was stopped: {self.guard.broke}")
        for launch in self.launches:
            if launch.broke:
                raise Gone(f"your code was stopped: {launch.broke}")
            # A later one that only loads something is done when its nodes are.
            if not launch.running and (launch.code != 0 or launch is self.launches[0]):
                line, meaning = first_cause(launch.output.text())
                raise Gone(
                    f"roslaunch ended by itself with code {launch.code}"
                    + (f": {line}" if line else "")
                    + (f" ({meaning})" if meaning else "")
                )
        if rospy.is_shutdown():
            raise Gone("the examiner's node was told to shut down by your code")

    # ------------------------------------------------------------------------------------------ readiness

    def _get_ready(self, ready: Dict[str, Any]) -> None:
        def left() -> float:
            return max(ready["timeout"] - self.guard.spent, 0.0)

        simulated = wait_for_simulator(self._alive, left, lambda: False)
        if not simulated:
            raise Gone(
                f"no simulator came up within {ready['timeout']:g} s: does the launch file include gazebo_ros's empty_world.launch?"
            )
        self._make_bench()
        for part in self.tasks[0]["launch"].split(" + ")[1:]:  # as in a second shell, when the first has come up
            self.bench.settle(_READY_REST, patience=min(max(left(), 1.0), _READY_PATIENCE))
            self.bench.pass_time(_READY_STEP)
            self._launch(part)
        missing = ["everything"]
        while missing:
            self.bench.settle(_READY_REST, patience=min(max(left(), 1.0), _READY_PATIENCE))
            missing = self._missing(ready)
            if missing and not left():
                raise Gone(f"not ready after {ready['timeout']:g} s: still missing {', '.join(missing)}")
            if missing:
                self.bench.pass_time(_READY_STEP)
        self.bench.connect()
        # Whatever the start took, tasks begin at a moment that is the same in every run.
        begin = max(ready.get("at", 0.0), self.bench.dt * self.bench.count)
        while begin < self.bench.now.time + 0.5:
            begin += 1.0
        self.bench.pass_time(begin - self.bench.now.time)

    def _make_bench(self) -> None:
        self.nodes.find()
        for pid in self.nodes.pids:
            try:
                words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode("utf-8", "replace").split("\0")
            except OSError:
                continue
            if (
                any(word.endswith("/lab_check/gzserver") or word.endswith("/scripts/gzserver") for word in words[:3])
                and "bwrap" not in words[0]
            ):
                self.nodes.simulator_is(pid)
                self._simulator = pid
        self.bench = Bench(self.nodes, self.job.spec["quantum"], self._alive)

    def _simulator_seconds(self) -> float:
        try:
            fields = pathlib.Path(f"/proc/{self._simulator}/stat").read_text().rpartition(")")[2].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except (OSError, AttributeError, IndexError):
            return 0.0

    def _missing(self, ready: Dict[str, Any]) -> List[str]:
        import fnmatch

        published, subscribed, services = rosgraph.Master("/lab_check").getSystemState()
        me = rospy.get_name()
        topics = [topic for topic, nodes in published + subscribed if set(nodes) - {me}]
        there = {
            "topics": topics,
            "services": [name for name, _ in services],
            "models": list(self.bench.now.models),
            "nodes": [node for part in (published, subscribed, services) for _, nodes in part for node in nodes],
        }
        return [
            f"{kind[:-1]} {name}"
            for kind, found in there.items()
            for name in ready.get(kind, [])
            if not any(fnmatch.fnmatchcase(one, name) for one in found)
        ]

    # ------------------------------------------------------------------------------------------ tasks

    def _task(self, task: Dict[str, Any]) -> TaskResult:
        mark = self._said()
        job, bench = self.job, self.bench
        actor = Actor(bench, self.start)
        context = Context(
            pathlib.Path(job.spec_folder),
            pathlib.Path(job.home, "catkin_ws", "src"),
            {name: pathlib.Path(job.home, folder) for name, folder in job.packages.items()},
            log=lambda: self._log(mark) if task["do"] else self._log(),
            bench=bench,
            actor=actor,
            model=task.get("model", ""),
            simulator_seconds=self._simulator_seconds,
        )
        monitors = [checks.make(kind_of(e), e[kind_of(e)], context) for e in task["expect"]]
        filming = film.Film(bench, task.get("model", "")) if task["film"] and job.films else None

        def look(sample) -> None:
            context.samples.append(sample)
            for monitor in monitors:
                monitor.sample(sample)
            if filming:
                filming.sample(sample)

        trouble = ""
        for monitor in monitors:
            monitor.start()
        bench.on_sample.append(look)
        try:
            for command in task["do"]:
                actor.give(command)
            for monitor in monitors:
                monitor.commanded()
            self._watch(monitors)
        except CommandError as error:
            trouble = str(error)
        finally:
            bench.on_sample.remove(look)
        verdicts = [self._verdict(monitor, e, trouble) for monitor, e in zip(monitors, task["expect"])]
        result = share(task, verdicts)
        for monitor in monitors:
            result.series.update(monitor.series)
        stem = os.path.join(job.out, "pictures", f"session{self.number}_task{self.tasks.index(task)}")
        result.pictures = film.picture(bench, task.get("model", ""), stem)
        result.film = filming.write(stem + ".mp4") if filming else ""
        result.commands = [*_typed(task["launch"]), *actor.by_hand]
        actor.end()
        bench.settle(0.05)
        return self._with_log(result, mark) if result.points < result.of else result

    def _watch(self, monitors) -> None:
        begin = self.bench.now.time
        while True:
            open_ones = [m for m in monitors if not m.settled and self.bench.now.time < begin + m.horizon - 1e-9]
            if not open_ones:
                return
            self.bench.tick()

    @staticmethod
    def _verdict(monitor, expectation: Dict[str, Any], trouble: str):
        from .outcome import Verdict

        kind = kind_of(expectation)
        if trouble:
            return Verdict(kind, False, trouble)
        try:
            passed, reason, figures = monitor.verdict()
        except Gone:
            raise
        except rospy.ROSException as error:
            passed, reason, figures = False, f"could not be asked: {error}", {}
        if not passed and "say" in expectation:
            reason = f"{expectation['say']} ({reason})"
        return Verdict(kind, bool(passed), reason, figures=figures)

    def _with_log(self, result: TaskResult, mark: Sequence[int]) -> TaskResult:
        result.log = excerpt(self._log(mark) or self._log())
        result.commands = result.commands or _typed(self.tasks[0]["launch"])
        return result


def _typed(launch: str) -> List[str]:
    return [f"roslaunch {part}" for part in launch.split(" + ")]


def main() -> None:
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))
    job, number = Job.load(sys.argv[1]), int(sys.argv[2])
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{job.port}", ROS_HOSTNAME="localhost", ROS_LOG_DIR=job.scratch)
    launches = list(dict.fromkeys(task["launch"] for task in job.spec["tasks"]))
    tasks = [task for task in job.spec["tasks"] if task["launch"] == launches[number]]
    session = Session(job, tasks, number)
    results = session.run()
    log = session._log()
    pathlib.Path(job.out, f"launch_{number}.log").write_text(log, encoding="utf-8")
    answer = {
        "tasks": [asdict(result) for result in results],
        "notes": session.notes,
        "broke": session.guard.broke,
        "peak_memory": session.guard.peak_memory,
        "peak_processes": session.guard.peak_processes,
    }
    pathlib.Path(sys.argv[3]).write_text(json.dumps(answer), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)  # rospy's threads would take seconds to leave


if __name__ == "__main__":
    main()

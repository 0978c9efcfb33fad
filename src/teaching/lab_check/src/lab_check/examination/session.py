"""One launch and its tasks: ``python3 -m lab_check.examination.session JOB NUMBER`` writes ``session_NUMBER.json`` into the job's
folder."""

from __future__ import annotations

import contextlib
import http.client
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time
import traceback
import uuid
import xmlrpc.client
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any
from xml.parsers.expat import ExpatError

import genpy
import rosgraph
import rospy

from .. import checks
from ..checks.base import Check, Context
from ..explain import excerpt, first_cause
from ..isolation import sandbox
from ..isolation.supervise import Guard, Program, bound
from ..outcome import TaskResult, Verdict, failed_task, sentence, share
from ..specs.spec import kind_of
from . import connections, film, submission_code
from .commands import Actor, CommandError
from .interference import Interference
from .job import Job, NoRoom
from .lockstep import Nodes
from .simulated_world import Bench, Gone, Sample
from .simulator import Lost, Starter

# What reading from the submission's nodes, or from a master that they have led astray, can raise.
UNREADABLE = (
    OSError,
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    RecursionError,
    MemoryError,
    ArithmeticError,
    xmlrpc.client.Error,
    ExpatError,
    http.client.HTTPException,
    rosgraph.MasterException,
    rospy.ROSException,
    genpy.MessageException,
)
_MORE_MEMORY = 1e9  # bytes over the submission's own limit that its messages can make this process take
_READY_REST = 0.35  # s of rest that show a start-up to be over: spawners look for services every few tenths
_READY_PATIENCE = 10.0  # s of work without rest after which a node of the launch is waited for no more
_LOOK_STEP = 0.05  # s of wall time between two looks for what has still to come, when its simulated time is over
_READY_STEP = 0.1  # s of simulated time between two looks at what has come


class Session:
    def __init__(self, job: Job, tasks: list[dict[str, Any]], number: int):
        self.job, self.tasks, self.number = job, tasks, number
        self.programs: list[Program] = []
        self.notes: list[str] = []
        self._running: Bench | None = None
        self.launches: list[Program] = []
        self.guard = Guard(lambda: self.programs, job.limits, job.group, job.written, not job.unsafe)
        self.core: subprocess.Popen | None = None
        self.interference = Interference()
        self.asked: dict[str, int] = {}  # service of the simulator -> how often the spec itself had it called
        self._begin = time.monotonic()

    @property
    def bench(self) -> Bench:
        """The simulated world, once it is up."""
        if self._running is None:
            raise RuntimeError("no simulator has come up yet")
        return self._running

    def run(self) -> list[TaskResult]:
        core = self.core = subprocess.Popen(
            [*sandbox.isolated(), "-m", "lab_check.examination.guarded_master", str(self.job.port), str(int(self.job.limits["memory"]))],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**sandbox.own_environment(), "ROS_LOG_DIR": self.job.logs},
            cwd="/",
        )
        try:
            self._wait_for_master(core)
            rospy.init_node("lab_check", anonymous=True, disable_signals=True, disable_rostime=True, log_level=rospy.FATAL)
            self.nodes = Nodes(self.job.mark if self.job.unsafe else None, [os.getpid(), os.getppid(), core.pid, 1])
            self.starter = Starter(self.job, self.job.spec["seed"], self.programs.append, self._alive)
            return self._examine()
        finally:
            self.guard.stop()
            for program in list(self.programs):
                program.kill()
            core.kill()

    def _wait_for_master(self, core: subprocess.Popen) -> None:
        end = time.monotonic() + 30
        while not rosgraph.is_master_online():
            if core.poll() is not None or time.monotonic() > end:
                raise RuntimeError("the ROS master of this examination did not start")
            time.sleep(0.02)

    def _examine(self) -> list[TaskResult]:
        launch = self.tasks[0]["launch"]
        # What roscore's launcher does: roslaunch would otherwise make one of its own, and a second would not fit.
        rosgraph.Master("/lab_check").setParam("/run_id", str(uuid.uuid4()))
        self.guard.start()
        try:
            self._launch(launch.split(" + ")[0])
            self._get_ready(self.tasks[0]["ready"])
        except (Gone, *UNREADABLE) as error:
            why = self._in_words(error)
            self._remarks()
            return [self._with_log(failed_task(task, f"'roslaunch {launch}': {why}"), ()) for task in self.tasks]
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
            except (Gone, *UNREADABLE) as error:
                why = self._in_words(error)
                results.append(self._with_log(failed_task(task, why), mark))
                results += [failed_task(later, f"not tried: {why}") for later in self.tasks[index + 1 :]]
                break
        self._remarks()
        return results

    @staticmethod
    def _in_words(error: BaseException) -> str:
        """What came from inside and could not be read is the submission's doing, whatever it was."""
        if isinstance(error, Gone):
            return str(error)
        traceback.print_exception(error)  # for whoever doubts it
        return f"what your nodes said could not be read ({type(error).__name__}: {str(error)[:200]})"

    def _remarks(self) -> None:
        if self._running is None:
            return
        with contextlib.suppress(Gone, *UNREADABLE):  # it has ended
            self._look_who_interferes()
        self.notes += self.interference.notes()
        if not self.job.spec["own_plugins"]:
            self.notes += [
                f"{path}, code of the submission, ran inside the simulator, where it could have changed what was measured"
                for path in self._own_code()
            ]
        for name in self.nodes.restless_names:
            self.notes.append(
                f"{name} never rests: a loop without sleep? It is no longer waited for, and what it does may differ from run to run"
            )

    # ------------------------------------------------------------------------------------------ programs

    def start(self, line: str, keys: bool = False, launch: bool = False) -> Program:
        """Start the submission's program ``line``, of a shell.

        :param keys: on a terminal, whose keys are what is written to it. :param launch: it starts the simulator
        :raises Gone: it cannot be started
        """
        try:
            program = self.job.start(line, keys, {"LAB_CHECK_SIMULATOR": self.starter.address} if launch else {})
        except NoRoom as error:
            raise Gone(str(error)) from error
        self.programs.append(program)
        return program

    def _launch(self, words: str) -> None:
        self.launches.append(self.start(f"exec python3 -P -m lab_check.examination.guarded_roslaunch {words}", launch=True))

    def _log(self, since: Sequence[int] = ()) -> str:
        """What all programs said, each after as many bytes of it as ``since`` says; :meth:`_said` makes such a mark."""
        later = [0] * (len(self.programs) - len(since))
        return "".join(program.output.text(mark) for program, mark in zip(self.programs, [*since, *later]))

    def _said(self) -> list[int]:
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
        if self.core is not None and self.core.poll() is not None:
            raise Gone("the ROS master was ended by your code")
        if rospy.is_shutdown():
            raise Gone("the examiner's node was told to shut down by your code")

    # ------------------------------------------------------------------------------------------ readiness

    def _get_ready(self, ready: dict[str, Any]) -> None:
        def left() -> float:
            return max(ready["timeout"] - self.guard.spent, 0.0)

        self._make_bench(self._simulator(ready["timeout"], left))
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

    def _simulator(self, timeout: float, left: Callable[[], float]) -> dict[str, str]:
        """Waits until it is up.

        :returns: name and URI of its node
        :raises Gone: it did not come
        """
        try:
            while left():
                self._alive()
                hello = self.starter.wire.hello() if self.starter.wire else None
                if hello:
                    return hello
                time.sleep(0.02)
        except Lost as error:
            raise Gone(str(error)) from error
        raise Gone(f"no simulator came up within {timeout:g} s: does the launch file include gazebo_ros's empty_world.launch?")

    def _make_bench(self, simulator: dict[str, str]) -> None:
        self.nodes.find()
        if self.starter.program is None or self.starter.wire is None:
            raise RuntimeError("no simulator has come up yet")
        pid = self.starter.program.process.pid
        self.nodes.simulator_is(pid)
        self.simulator = simulator["uri"]
        connections.simulator_is(rosgraph.Master("/lab_check"), simulator["name"], simulator["uri"], pid)
        self._running = Bench(self.nodes, self.starter.wire, self.job.spec["quantum"], self._alive)
        self.bench.simulator = simulator["uri"]

    def _own_code(self) -> list[str]:
        return [] if self.starter.loaded is None else submission_code.told(self.starter.loaded)

    def _look_who_interferes(self, actor: Actor | None = None) -> None:
        """What was done since the launch to the world, and to the simulator's own names."""
        mine = rospy.get_name()
        for what, who, count, first in self.bench.changes():
            if who == mine and actor is not None:
                self.asked[what] = self.asked.get(what, 0) + actor.calls(what)
            if who != mine or count > self.asked.get(what, 0):
                self.interference.changed(what, who, count, first)
        for line in connections.told(rosgraph.Master("/lab_check")):
            self.interference.names.add(line)

    def _missing(self, ready: dict[str, Any]) -> list[str]:
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

    def _task(self, task: dict[str, Any]) -> TaskResult:
        mark = self._said()
        job, bench = self.job, self.bench
        actor = Actor(bench, self.start)
        context = Context(
            pathlib.Path(job.spec_folder),
            pathlib.Path(job.home),
            pathlib.Path(job.home, "catkin_ws", "src"),
            {name: pathlib.Path(job.home, folder) for name, folder in job.packages.items()},
            log=lambda: self._log(mark) if task["do"] else self._log(),
            running=bench,
            actor=actor,
            model=task.get("model", ""),
            simulator_seconds=self.starter.seconds,
            required=job.spec["packages"],
        )
        monitors = [checks.make(kind_of(e), e[kind_of(e)], context) for e in task["expect"]]
        filming = film.Film(bench, task.get("model", "")) if task["film"] and job.films else None

        def look(sample: Sample) -> None:
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
            bench.look()
            for monitor in monitors:
                monitor.commanded()
            given = Moment(bench)
            self._watch(monitors)
        except CommandError as error:
            trouble = str(error)
        finally:
            bench.on_sample.remove(look)
        verdicts = self._verdicts(monitors, task["expect"], given) if not trouble else _nothing(task["expect"], trouble)
        for monitor in monitors:
            monitor.end()
        self._look_who_interferes(actor)
        self.interference.twice |= {line for monitor in monitors for line in monitor.doubts}
        if task["interference"] == "costs" and self.interference.found:
            verdicts = [Verdict(v.kind, False, f"no points, as {self.interference.first()}", figures=v.figures) for v in verdicts]
        result = share(task, verdicts)
        for monitor in monitors:
            result.series.update(monitor.series)
        stem = os.path.join(job.out, "pictures", f"session{self.number}_task{self.tasks.index(task)}")
        result.pictures = film.picture(bench, task.get("model", ""), stem)
        result.film = filming.write(stem + ".mp4") if filming else ""
        result.commands = [*_typed(task["launch"]), *map(sentence, actor.by_hand)]
        actor.end()
        bench.settle(0.05)
        return self._with_log(result, mark) if result.points < result.of else result

    def _watch(self, monitors: Sequence[Check]) -> None:
        begin = self.bench.now.time
        while True:
            open_ones = [m for m in monitors if not m.settled and self.bench.now.time < begin + m.horizon - 1e-9]
            if not open_ones:
                return
            self.bench.tick()

    def _verdicts(self, monitors: Sequence[Check], expectations: Sequence[dict[str, Any]], given: Moment) -> list[Verdict]:
        """Of all: at once of those that have what they look at, of the others as soon as it is there, or they have waited long enough.

        :param given: when the commands had been given
        """
        waiting = [monitor for monitor in monitors if monitor.patience and not _is_there(monitor)]
        found = {monitor: self._verdict(monitor, e) for monitor, e in zip(monitors, expectations) if monitor not in waiting}

        def look(sample: Sample) -> None:
            for monitor in waiting:
                monitor.sample(sample)

        self.bench.on_sample.append(look)
        try:
            while waiting:
                if any(given.simulated(monitor) for monitor in waiting):
                    self.bench.tick()
                else:
                    time.sleep(_LOOK_STEP)
                    self.bench.settle()
                for monitor, expectation in zip(monitors, expectations):
                    if monitor in waiting and (_is_there(monitor) or not (given.simulated(monitor) or given.wall(monitor))):
                        found[monitor] = self._verdict(monitor, expectation)
                        waiting.remove(monitor)
        finally:
            self.bench.on_sample.remove(look)
        return [found[monitor] for monitor in monitors]

    @staticmethod
    def _verdict(monitor: Check, expectation: dict[str, Any]) -> Verdict:
        kind = kind_of(expectation)
        try:
            passed, reason, figures = monitor.verdict()
        except Gone:
            raise
        except Exception as error:  # what a submission's nodes can answer has no end; the teacher's own function may fail on it, too
            what = "the spec's own function failed" if kind == "python" else "could not be asked"
            passed, reason, figures = False, f"{what}: {type(error).__name__}: {str(error)[:200]}", {}
        if not passed and "say" in expectation:
            reason = f"{expectation['say']} ({reason})"
        return Verdict(kind, bool(passed), reason, figures=figures)

    def _with_log(self, result: TaskResult, mark: Sequence[int]) -> TaskResult:
        result.log = excerpt(self._log(mark) or self._log())
        result.commands = result.commands or _typed(self.tasks[0]["launch"])
        return result


def _nothing(expectations: Sequence[dict[str, Any]], trouble: str) -> list[Verdict]:
    return [Verdict(kind_of(expectation), False, trouble) for expectation in expectations]


class Moment:
    """Now, in simulated and in wall time: how long after it a check may go on waiting."""

    def __init__(self, bench: Bench):
        self._bench = bench
        self._simulated, self._wall = bench.now.time, time.monotonic()

    def simulated(self, monitor: Check) -> bool:
        return self._bench.now.time < self._simulated + monitor.patience - 1e-9

    def wall(self, monitor: Check) -> bool:
        return monitor.in_wall_time and time.monotonic() < self._wall + monitor.patience


def _is_there(monitor: Check) -> bool:
    try:
        return monitor.there()
    except Gone:
        raise
    except Exception:  # the verdict says what
        return False


def _typed(launch: str) -> list[str]:
    return [f"roslaunch {part}" for part in launch.split(" + ")]


def main() -> None:
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))
    os.umask(0o022)
    os.environ["LAB_CHECK_WORD"] = uuid.uuid4().hex  # by which the master knows this process
    job, number = Job.load(sys.argv[1]), int(sys.argv[2])
    bound(job.limits["memory"] + _MORE_MEMORY)
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{job.port}", ROS_HOSTNAME="localhost", ROS_LOG_DIR=job.logs)
    launches = list(dict.fromkeys(task["launch"] for task in job.spec["tasks"]))
    tasks = [task for task in job.spec["tasks"] if task["launch"] == launches[number]]
    session = Session(job, tasks, number)
    results = session.run()
    resource.setrlimit(resource.RLIMIT_DATA, (resource.getrlimit(resource.RLIMIT_DATA)[1],) * 2)  # to write down what was seen
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

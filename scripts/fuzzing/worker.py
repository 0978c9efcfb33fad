"""A process that runs cases, and what its parent knows of it."""

from __future__ import annotations

import ctypes
import faulthandler
import gc
import multiprocessing.connection
import os
import resource
import shutil
import signal
import time
import traceback
import warnings
from multiprocessing import Pipe
from pathlib import Path
from random import Random

from fuzzing import findings
from fuzzing.findings import Finding, Found
from fuzzing.kinds import Kind

Job = int | bytes  # the number of a case to make, or a case
_START_LIMIT = 120.0  # s until a new worker is ready
_LIBC = ctypes.CDLL(None)
_TICKS = os.sysconf("SC_CLK_TCK")


def case_of(kind: Kind, seed: int, number: int) -> bytes:
    """Case ``number`` of a run: the same for the same seed, whatever ran before."""
    return kind.generate(Random(f"{seed}/{kind.name}/{number}"))


class Worker:
    """The parent's side. ``job`` is what it works on, None when it is idle."""

    def __init__(self, kind: Kind, seed: int, folder: Path, number: int):
        self.kind, self.folder = kind, folder
        self.done = 0
        self.job: Job | None = None
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        self._output = folder.parent / f"{folder.name}.out"
        self.connection, other = Pipe()
        parent = os.getpid()
        self.pid = os.fork()
        if self.pid == 0:
            code = 70
            try:
                self.connection.close()
                _serve(kind, seed, number, other, folder, self._output, parent)
                code = 0
            except Exception:
                traceback.print_exc()
            finally:
                os._exit(code)
        other.close()
        _lead_group(self.pid)  # here as well: end() may come before the new process has run at all
        self._begun, self._spent, self._mark = time.monotonic(), 0.0, 0
        self.ready = False

    def give(self, job: Job) -> None:
        self.job = job
        self._begun, self._spent = time.monotonic(), self._processor_time()
        self._mark = self._output.stat().st_size
        self.connection.send(job)

    def over_time(self) -> bool:
        """By processor time, so that a busy machine finds no hangs, and in the end by the wall's."""
        wall = time.monotonic() - self._begun
        if not self.ready:
            return wall > _START_LIMIT
        return self.job is not None and (wall > self.kind.wall_limit or self._processor_time() - self._spent > self.kind.time_limit)

    def hung(self) -> Finding:
        """End it, and say where it was."""
        try:
            os.kill(self.pid, signal.SIGUSR1)  # faulthandler writes the stack
            time.sleep(0.5)
        except ProcessLookupError:
            pass
        self.end()
        return findings.of_stack("hang" if self.ready else "worker does not start", self.said())

    def died(self) -> Finding:
        """Say how it ended."""
        status = self.end()
        if os.WIFSIGNALED(status):
            how = signal.Signals(os.WTERMSIG(status)).name
        else:
            how = f"exit code {os.waitstatus_to_exitcode(status)}"
        return findings.of_stack(f"process ended by {how}", self.said())

    def said(self) -> str:
        """What its process has written since it got its job."""
        with open(self._output, errors="replace") as stream:
            stream.seek(self._mark)
            return stream.read(1 << 20)

    def end(self) -> int:
        """Kill it with all that it started. :return: its status as of os.waitpid"""
        deadline = time.monotonic() + 0.3  # it may be at its own end, whose status tells more
        pid, status = os.waitpid(self.pid, os.WNOHANG)
        while pid == 0 and time.monotonic() < deadline and self.connection.closed:
            time.sleep(0.01)
            pid, status = os.waitpid(self.pid, os.WNOHANG)
        try:
            os.killpg(self.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        if pid == 0:
            _, status = os.waitpid(self.pid, 0)
        self.connection.close()
        return status

    def retire(self) -> None:
        """Let it end in order."""
        try:
            self.connection.send(None)
            end = time.monotonic() + 20.0
            while time.monotonic() < end and not self.connection.poll(0.1):
                pass
        except OSError:
            pass
        self.end()

    def _processor_time(self) -> float:
        """s, without that of processes it started."""
        try:
            fields = Path(f"/proc/{self.pid}/stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            return 0.0
        return (int(fields[11]) + int(fields[12])) / _TICKS


# ---------------------------------------------------------------------------------------------- the process


def _serve(
    kind: Kind, seed: int, number: int, connection: multiprocessing.connection.Connection, folder: Path, output: Path, parent: int
) -> None:
    _become_worker(kind, folder, output, parent)
    kind.start(folder, number)
    connection.send("ready")
    said = open(output, errors="replace")
    while True:
        job = connection.recv()
        if job is None:
            kind.stop()
            connection.send("bye")
            return
        case = case_of(kind, seed, job) if isinstance(job, int) else job
        said.seek(0, os.SEEK_END)
        finding = examine(kind, case, said)
        gc.collect()  # what goes wrong when a world is destroyed belongs to this case
        connection.send(finding)


def examine(kind: Kind, case: bytes, said) -> Finding | None:
    """What is wrong with how ``case`` is taken, None if nothing."""
    try:
        kind.run(case)
    except Found as found:
        return found.finding
    except BaseException as error:  # whatever it is: nobody declared it
        return findings.of_exception(error)
    text = said.read() if kind.silent else ""
    return findings.of_output(text) if text.strip() else None


def _lead_group(pid: int) -> None:
    """Make process ``pid`` (0 is this one) the leader of a process group of its own."""
    try:
        os.setpgid(pid, pid)
    except ProcessLookupError:
        pass  # it has ended


def end_with_parent() -> None:
    """Be killed when the process that started this one ends, however it ends."""
    _LIBC.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def _become_worker(kind: Kind, folder: Path, output: Path, parent: int) -> None:
    _lead_group(0)
    end_with_parent()
    if os.getppid() != parent:
        os._exit(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends the run
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_AS, (kind.memory, kind.memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open(os.devnull) as nothing:
        os.dup2(nothing.fileno(), 0)
    stream = open(output, "wb", buffering=0)
    os.dup2(stream.fileno(), 1)
    os.dup2(stream.fileno(), 2)
    faulthandler.enable(all_threads=False)
    faulthandler.register(signal.SIGUSR1, all_threads=False)
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", RuntimeWarning)  # numpy's: each time, so that each case shows its own
    os.chdir(folder)
    gc.freeze()

"""Cases on some worker processes; one that dies or hangs is reported and replaced, the run goes on."""

from __future__ import annotations

import multiprocessing.connection
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from fuzzing.findings import Finding
from fuzzing.kinds import Kind
from fuzzing.worker import Job, Worker

_POLL = 0.2  # s between looks at the clocks of the workers
_STARTS = 3  # of workers that may fail


class Pool:
    """``jobs`` workers of one kind. Use as a context manager."""

    def __init__(self, kind: Kind, seed: int, folder: Path, jobs: int):
        self._kind, self._seed, self._folder = kind, seed, folder
        self._workers: list[Worker | None] = [None] * jobs
        self._failed_starts = 0

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_) -> None:
        for worker in self._workers:
            if worker is not None:
                if worker.ready and worker.job is None:
                    worker.retire()
                else:
                    worker.end()

    def run(self, jobs: Iterator[Job], report: Callable[[Job, Finding | None], bool]) -> None:
        """All ``jobs``; ``report`` is told of each, None where nothing is wrong, and says whether to go on."""
        pending: Job | None = next(jobs, None)
        going = True
        while True:
            for slot, worker in enumerate(self._workers):
                if not going or pending is None:
                    break
                if worker is None or worker.job is None and worker.done >= self._kind.cases_per_worker:
                    if worker is not None:
                        worker.retire()
                    worker = self._workers[slot] = Worker(self._kind, self._seed, self._folder / f"worker{slot}", slot)
                if worker.ready and worker.job is None:
                    worker.give(pending)
                    pending = next(jobs, None)
            busy: dict[object, Worker] = {w.connection: w for w in self._workers if w and (w.job is not None or not w.ready)}
            if not any(w.job is not None for w in busy.values()) and (pending is None or not going):
                return
            for connection in multiprocessing.connection.wait(list(busy), timeout=_POLL):
                going &= self._hear(busy[connection], report)
            for worker in list(busy.values()):
                if not worker.connection.closed and worker.over_time() and not worker.connection.poll():
                    going &= self._ended(worker, worker.hung(), report)

    def one(self, case: bytes) -> Finding | None:
        """What is found in one case."""
        answer: list[Finding | None] = []
        self.run(iter([case]), lambda job, finding: answer.append(finding) or True)
        return answer[0]

    def fresh(self) -> None:
        """End the workers: the next case starts in a new process."""
        self.__exit__()
        self._workers = [None] * len(self._workers)

    def _hear(self, worker: Worker, report) -> bool:
        try:
            answer = worker.connection.recv()
        except (EOFError, OSError):
            worker.connection.close()
            return self._ended(worker, worker.died(), report)
        if not worker.ready:
            worker.ready = True
            return True
        job, worker.job = worker.job, None
        worker.done += 1
        return report(job, answer)

    def _ended(self, worker: Worker, finding: Finding, report) -> bool:
        self._workers[self._workers.index(worker)] = None
        if worker.job is not None:
            return report(worker.job, finding)
        self._failed_starts += 1  # what a worker starts may be slow on a busy machine
        if self._failed_starts > _STARTS:
            raise RuntimeError(f"a worker for {self._kind.name} cannot start: {finding}; its output: {worker.said()[-1000:]}")
        return True


class Clock:
    """Cases a second of a run."""

    def __init__(self):
        self._begun = time.monotonic()
        self.cases = 0

    @property
    def seconds(self) -> float:
        return time.monotonic() - self._begun

    @property
    def rate(self) -> float:
        return self.cases / max(self.seconds, 1e-9)

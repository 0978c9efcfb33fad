"""What the processes of one examination tell each other: a file of JSON, and how programs of the submission are started."""

from __future__ import annotations

import json
import os
import pathlib
import shlex
import uuid
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from ..errors import LabError
from ..isolation import sandbox
from ..isolation.supervise import Program, Streams


class NoRoom(LabError, RuntimeError):
    """No program of the submission can be started any more: its disk is full. A sentence for the student."""


@dataclass
class Job:
    """``spec`` is the data of the spec; ``scratch`` holds ``home``, which is the submission's own; ``out`` is the teacher's."""

    spec: dict[str, Any]
    spec_folder: str
    submission: str
    scratch: str
    out: str
    unsafe: bool
    port: int
    limits: dict[str, float]
    platform: dict[str, list[str]]
    mark: str
    packages: dict[str, str] = field(default_factory=dict)  # name -> folder below home
    films: bool = True
    group: str = ""  # the control group of all that the submission starts, see lab_check.isolation.control_group
    user: int = 0  # of the submission's programs, inside the outer wall
    handed_in: int = 0  # bytes that lie on the submission's disk from the beginning

    def save(self, path: str | os.PathLike) -> None:
        """Write it to ``path``, for :meth:`load` in another process."""
        pathlib.Path(path).write_text(json.dumps(asdict(self)), encoding="utf-8")

    @classmethod
    def load(cls, path: str) -> Job:
        """The job that :meth:`save` wrote to ``path``."""
        return cls(**json.loads(pathlib.Path(path).read_text(encoding="utf-8")))

    @property
    def home(self) -> str:
        """As the examiner sees it."""
        return os.path.join(self.scratch, "home")

    @property
    def inner_home(self) -> str:
        """As the submission sees it."""
        return self.home if self.unsafe else sandbox.HOME

    @property
    def logs(self) -> str:
        """Folder for logs of the checker's own nodes."""
        return self.scratch if self.unsafe else str(sandbox.checkers_own(self.scratch))

    @property
    def workspace(self) -> str:
        return f"{self.inner_home}/catkin_ws"

    def start(self, line: str, keys: bool = False, more: dict[str, str] | None = None, built: bool = True) -> Program:
        """A shell line in the submission's world.

        :param keys: on a terminal, whose keys are what is written to the program
        :param more: of the environment
        :param built: with its workspace sourced, otherwise the platform alone
        """
        setup = f"{self.workspace}/devel/setup.bash" if built else f"{self.platform['prefixes'][0]}/setup.bash"
        shell = f"source {shlex.quote(setup)} && cd {shlex.quote(self.inner_home)} && {line}"
        words = ["bash", "-c", shell]
        if keys:
            words = ["script", "-qfec", shlex.join(words), "/dev/null"]
        return self.program(words, {**sandbox.environment(self.port, self.inner_home), **(more or {})})

    def program(
        self, words: list[str], environment: dict[str, str], streams: Streams | None = None, pass_fds: Sequence[int] = ()
    ) -> Program:
        """One of the submission's programs, ``words``, inside the inner wall.

        :param environment: all that it finds in its own, but for the mark. :param pass_fds: descriptors that it is given
        :param streams: its standard streams; by default what it says is kept
        :raises NoRoom: see there
        """
        environment = {**environment, self.mark.partition("=")[0]: self.mark.partition("=")[2]}
        if self.unsafe:
            return Program(words, self.limits, environment, self.home, self.group, streams=streams, pass_fds=pass_fds)
        platform, place = sandbox.Platform(**self.platform), os.path.join(self.scratch, "programs", uuid.uuid4().hex)
        try:
            for folder in ("tmp", "run", "shm"):
                sandbox.own_folder(pathlib.Path(place, folder), self.user)
        except OSError as error:
            raise NoRoom(f"no program can be started any more, as the disk that a submission gets is full ({error.strerror})") from error
        most = ["prlimit", f"--nproc={most_tasks(self.limits)}", "--"]
        refused = os.open(sandbox.filter_file(self.scratch), os.O_RDONLY)
        try:
            walls = sandbox.inner_words(platform, self.scratch, place, environment, refused)
            # bwrap's own environment can be read inside: it holds nothing.
            return Program(
                walls + most + words,
                self.limits,
                {"PATH": "/usr/bin:/bin"},
                place=self.group,
                user=self.user,
                streams=streams,
                pass_fds=[refused, *pass_fds],
            )
        finally:
            os.close(refused)

    def hand_over(self) -> None:
        """What was staged is the submission's own from here on."""
        if self.user:
            for folder, folders, files in os.walk(self.home):
                for name in (".", *folders, *files):
                    os.chown(os.path.join(folder, name), self.user, self.user, follow_symlinks=False)
        disk = os.statvfs(self.scratch)
        self.handed_in = (disk.f_blocks - disk.f_bfree) * disk.f_frsize

    def written(self) -> float:
        """Bytes that the submission's programs have on its disk: memory, to the kernel, but no memory that they took."""
        if self.unsafe:
            return 0.0
        disk = os.statvfs(self.scratch)
        return max(float(disk.f_blocks - disk.f_bfree) * disk.f_frsize - self.handed_in, 0.0)


def most_tasks(limits: dict[str, float]) -> int:
    """The bound by ``limits`` that the kernel keeps, on processes and threads; the Guard counts processes."""
    return int(limits["processes"]) * 8

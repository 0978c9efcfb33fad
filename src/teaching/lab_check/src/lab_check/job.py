"""What the processes of one examination tell each other: a file of JSON, and how programs of the submission are started."""
from __future__ import annotations

import json
import os
import pathlib
import shlex
from dataclasses import asdict, dataclass, field
from typing import Any, Dict, List

from . import sandbox
from .supervise import Program


@dataclass
class Job:
    """``spec`` is the data of the spec; ``scratch`` holds ``home``, which is the submission's own; ``out`` is the teacher's."""

    spec: Dict[str, Any]
    spec_folder: str
    submission: str
    scratch: str
    out: str
    unsafe: bool
    port: int
    limits: Dict[str, float]
    platform: Dict[str, List[str]]
    mark: str
    packages: Dict[str, str] = field(default_factory=dict)  # name -> folder below home
    films: bool = True
    group: str = ""  # the control group of all that the submission starts

    def save(self, path: "str | os.PathLike") -> None:
        pathlib.Path(path).write_text(json.dumps(asdict(self)), encoding="utf-8")

    @classmethod
    def load(cls, path: str) -> Job:
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
    def workspace(self) -> str:
        return f"{self.inner_home}/catkin_ws"

    def start(self, line: str, keys: bool = False, built: bool = True) -> Program:
        """A shell line in the submission's world.

        :param keys: on a terminal, whose keys are what is written to the program
        :param built: with its workspace sourced, otherwise the platform alone
        """
        setup = f"{self.workspace}/devel/setup.bash" if built else f"{self.platform['prefixes'][0]}/setup.bash"
        python = os.environ.get("PYTHONPATH", "")
        shell = f"source {shlex.quote(setup)} && cd {shlex.quote(self.inner_home)} && {line}"
        words = ["bash", "-c", shell]
        if keys:
            words = ["script", "-qfec", shlex.join(words), "/dev/null"]
        environment = {**sandbox.environment(self.port, self.inner_home), "LAB_CHECK_PLATFORM_PYTHON": python,
                       self.mark.partition("=")[0]: self.mark.partition("=")[2]}
        if self.unsafe:
            return Program(words, self.limits, environment, self.home, self.group)
        platform = sandbox.Platform(**self.platform)
        most = ["prlimit", f"--nproc={most_tasks(self.limits)}", "--"]
        return Program(sandbox.inner_words(platform, self.home, environment) + most + words, self.limits, place=self.group)


def most_tasks(limits: Dict[str, float]) -> int:
    """The bound that the kernel keeps, on processes and threads; the Guard counts processes."""
    return int(limits["processes"]) * 8

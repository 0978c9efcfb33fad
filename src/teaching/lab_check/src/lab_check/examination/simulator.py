"""The simulator from the examiner's side. The launch file is the submission's, and so are roslaunch, its environment and its folder; the
simulator is the examiner's: it starts it, with code of the platform, behind walls of its own, and what is measured comes through a pair of
sockets that only the two of them have."""

from __future__ import annotations

import base64
import json
import math
import os
import select
import socket
import sysconfig
import threading
import time
import uuid
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from ..errors import LabError
from ..isolation import sandbox
from ..isolation.supervise import Program, descendants, processor_time
from .job import Job

_LONGEST = 64_000_000  # bytes of an answer
_LONGEST_WISH = 200_000  # bytes
_MOST_WISHES = 8  # that are heard at a time
_LOOK = 0.2  # s
_TAKEN = 255  # exit code of Gazebo beside another one
_LEAVING = 5.0  # s that the simulator gets for its end
# What of the launch file's environment the simulator reads: where its files are, and what it is called.
_WISHED = ("GAZEBO_", "IGN_", "SDF_", "ODE_SIM_")
_WISHED_TOO = ("ROS_NAMESPACE", "ROS_PACKAGE_PATH", "CMAKE_PREFIX_PATH", "ROSCONSOLE_CONFIG_FILE", "ROSCONSOLE_FORMAT", "ROS_LOG_DIR")


class Lost(LabError, RuntimeError):
    """The simulator does not answer, or with what it cannot have said; a sentence for the student."""


class Wire:
    """Questions to the simulator.

    :param alive: raises an error of its own when the session has ended
    """

    def __init__(self, connection: Connection, alive: Callable[[], None]):
        self._connection, self._alive, self._lock = connection, alive, threading.Lock()

    def ask(self, what: str, *arguments: Any) -> Any:
        """The answer to ``what``, with its ``arguments``.

        :raises Refused: it cannot, with its reason
        :raises Lost: see there
        """
        with self._lock:
            try:
                self._connection.send_bytes(json.dumps([what, *arguments]).encode())
            except OSError as error:
                raise self._lost("it has ended") from error
            answer = self._receive()
        if not isinstance(answer, list) or len(answer) != 2:
            raise self._lost("it answers what was not asked")
        if answer[0] is not True:
            raise Refused(str(answer[1])[:300])
        return answer[1]

    def hello(self) -> dict[str, str] | None:
        """Name and URI of its node, as soon as it is up; None before."""
        if not self._connection.poll(0):
            return None
        answer = self._receive()
        if not isinstance(answer, dict) or not all(isinstance(answer.get(key), str) for key in ("name", "uri")):
            raise self._lost("it answers what was not asked")
        return answer

    def _receive(self) -> Any:
        try:
            while not self._connection.poll(_LOOK):
                self._alive()
            return json.loads(self._connection.recv_bytes(_LONGEST))
        except (EOFError, OSError) as error:
            raise self._lost("it has ended") from error
        except (ValueError, RecursionError, MemoryError) as error:
            raise self._lost("its answer cannot be read") from error

    def _lost(self, why: str) -> Exception:
        self._alive()
        return Lost(f"the simulator does not answer any more: {why}")


class Refused(LabError, RuntimeError):
    """The simulator cannot do what was asked; its own sentence."""


def checked_state(data: Any) -> dict[str, Any]:
    """``data``, if it is what :class:`lab_check.examination.probe.Probe` tells of the world.

    :raises Lost: it is not that
    """
    try:
        good = data["dt"] > 0 and math.isfinite(data["dt"]) and data["time_ns"] >= 0 and isinstance(data["contacts"], list)
        for entry in data["models"].values():
            good = good and len(entry["pose"]) == 7 and isinstance(entry["static"], bool) and isinstance(entry["serial"], int)
        if good:
            return data
    except (TypeError, KeyError, AttributeError):
        pass
    raise Lost("the simulator does not answer any more: its world cannot be read")


def png_of(text: Any) -> bytes:
    """The bytes of ``text``, a picture in base64; b'' for what is none."""
    try:
        return base64.b64decode(text)
    except (TypeError, ValueError):
        return b""


class Starter:
    """Waits for launch files that want the simulator.

    :param started: is given each program that is started
    """

    def __init__(self, job: Job, seed: int, started: Callable[[Program], None], alive: Callable[[], None]):
        self.address = f"lab_check.{uuid.uuid4().hex}"  # without a file: of this network alone
        self.program: Program | None = None
        self.wire: Wire | None = None
        self.loaded: int | None = None  # a pipe, see lab_check.examination.submission_code
        self._job, self._seed, self._started, self._alive = job, seed, started, alive
        self._listens = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._listens.bind(f"\0{self.address}")
        self._listens.listen(4)
        self._room = threading.BoundedSemaphore(_MOST_WISHES)
        threading.Thread(target=self._serve, daemon=True).start()

    def seconds(self) -> float:
        """Of processor time that the simulator has taken, without what it started."""
        return max((processor_time(pid)[0] for pid in descendants(self.program.process.pid)), default=0.0) if self.program else 0.0

    def _serve(self) -> None:
        while True:
            try:
                wish, _ = self._listens.accept()
            except OSError:  # too many files are open at the moment
                time.sleep(_LOOK)
                continue
            if self._room.acquire(blocking=False):
                threading.Thread(target=self._answer, args=(wish,), daemon=True).start()
            else:
                wish.close()

    def _answer(self, wish: socket.socket) -> None:
        files: list[int] = []
        try:
            wish.settimeout(10.0)
            data, files, _, _ = socket.recv_fds(wish, _LONGEST_WISH, 3)
            code = self._fulfil(json.loads(data), files, wish)
            wish.send(b"%d" % code)
        except Exception:  # not what the platform's own script says
            pass
        finally:
            for number in files:
                os.close(number)
            wish.close()
            self._room.release()

    def _fulfil(self, wished: dict[str, Any], files: list[int], wish: socket.socket) -> int:
        if self.program is not None and self.program.running:
            os.write(files[2], b"gzserver: a simulator runs already and goes on; models are spawned into that world\n")
            return _TAKEN
        mine, its = socket.socketpair()
        loaded, loads = os.pipe2(os.O_CLOEXEC | os.O_NONBLOCK)
        words = [*sandbox.isolated(), "-m", "lab_check.examination.probe", str(its.fileno()), str(loads), self._job.inner_home]
        words += ["--pause", "--lockstep", "--seed", str(self._seed)]
        words[0] = "/usr/bin/python3"
        words += _without_seed([str(word) for word in wished["arguments"]])
        folder = str(wished["folder"])
        inside = folder if folder.startswith(f"{self._job.inner_home}/") else self._job.inner_home
        words = ["env", "-C", inside, *words]
        try:
            streams = (files[0], files[1], files[2])
            program = self._job.program(words, self._environment(wished["environment"]), streams, [its.fileno(), loads])
        finally:
            its.close()
            os.close(loads)
        self._started(program)
        self.loaded = loaded
        self.wire, self.program = Wire(Connection(mine.detach()), self._alive), program
        return self._follow(program, wish)

    def _follow(self, program: Program, wish: socket.socket) -> int:
        """Until the simulator ends, or nobody wants it any more."""
        while program.running:
            gone, _, _ = select.select([wish], [], [], _LOOK)
            if gone:  # roslaunch ended it
                program.interrupt()
                if not program.wait(_LEAVING):
                    break
        return program.code or 0

    def _environment(self, wished: dict[str, str]) -> dict[str, str]:
        """For the simulator: no library or module of the submission comes before one of the platform or of Debian."""
        mine = sandbox.own_environment()
        places = ("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP")
        found = {
            **sandbox.environment(self._job.port, self._job.inner_home),
            **{name: value for name, value in mine.items() if name.startswith("ROS") and name not in places},
            **{str(name): str(value) for name, value in wished.items() if name.startswith(_WISHED) or name in _WISHED_TOO},
        }
        multiarch = sysconfig.get_config_var("MULTIARCH") or ""
        system = [f"/usr/lib/{multiarch}", f"/lib/{multiarch}", "/usr/lib", "/lib"]
        libraries = [*mine["LD_LIBRARY_PATH"].split(":"), *system, *str(wished.get("LD_LIBRARY_PATH", "")).split(":")]
        home = "/tmp" if not self._job.unsafe else self._job.scratch
        return {
            **found,
            "HOME": home,
            "ROS_HOME": f"{home}/.ros",
            "PYTHONPATH": mine["PYTHONPATH"],
            "PYTHONNOUSERSITE": "1",
            "PYTHONSAFEPATH": "1",
            "LD_LIBRARY_PATH": ":".join(dict.fromkeys(path for path in libraries if os.path.isabs(path))),
        }


def _without_seed(words: list[str]) -> list[str]:
    """The examination has a seed of its own."""
    kept, skip = [], False
    for word in words:
        if skip or word.startswith("--seed="):
            skip = False
        elif word == "--seed":
            skip = True
        else:
            kept.append(word)
    return kept

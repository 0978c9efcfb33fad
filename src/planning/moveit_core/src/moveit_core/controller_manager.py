"""The base of controller managers: what executes trajectories for move_group.

A package that depends on ``moveit_core`` exports its managers with
``<export><moveit_core plugin="${prefix}/plugins.xml"/></export>``; ``~moveit_controller_manager`` of move_group names
the one.
"""

from __future__ import annotations

import enum
import threading
from abc import ABC, abstractmethod
from collections.abc import Sequence

from moveit_msgs.msg import RobotTrajectory


class ExecutionStatus(enum.Enum):
    """How an execution ended, or that it did not yet."""

    UNKNOWN = "UNKNOWN"
    RUNNING = "RUNNING"
    SUCCEEDED = "SUCCEEDED"
    PREEMPTED = "PREEMPTED"
    TIMED_OUT = "TIMED_OUT"
    ABORTED = "ABORTED"
    FAILED = "FAILED"

    def __bool__(self) -> bool:
        return self is ExecutionStatus.SUCCEEDED


class ControllerHandle(ABC):
    """One controller: takes a trajectory of its own joints. Methods may be called from several threads."""

    def __init__(self, name: str):
        self.name = name
        #: why the last trajectory was refused or failed, in one line
        self.reason = ""

    @abstractmethod
    def send(self, trajectory: RobotTrajectory) -> bool:
        """Start to move along ``trajectory``; False (and ``reason``) when the controller does not take it."""

    @abstractmethod
    def cancel(self) -> bool:
        """Stop what was sent."""

    @abstractmethod
    def wait(self, timeout: float | None = None) -> bool:
        """Wait (``timeout`` wall seconds; None: for ever) until the trajectory has ended."""

    @property
    @abstractmethod
    def status(self) -> ExecutionStatus:
        """Of the trajectory sent last."""


class ControllerManager(ABC):
    """Knows the controllers and the joints of each. ``model`` is the robot, ``node`` the namespace of move_group's
    parameters."""

    def __init__(self, model, namespace: str = "~"):
        self.model = model
        self.namespace = namespace

    @abstractmethod
    def controllers(self) -> list[str]:
        """Names of all controllers."""

    @abstractmethod
    def joints(self, controller: str) -> list[str]:
        """Joints that a controller moves."""

    @abstractmethod
    def handle(self, controller: str) -> ControllerHandle | None:
        """How to reach a controller; None when it cannot be reached now."""

    def active_controllers(self) -> list[str]:
        """Controllers that take trajectories now."""
        return self.controllers()

    def is_default(self, controller: str) -> bool:
        """Whether ``controller`` is preferred where several would do."""
        return False

    def is_active(self, controller: str) -> bool:
        """Whether ``controller`` takes trajectories at the moment."""
        return controller in self.active_controllers()

    def switch(self, activate: Sequence[str], deactivate: Sequence[str]) -> bool:
        """Activate the controllers ``activate`` and stop ``deactivate`` (names); False when that cannot be done."""
        return False

    def reload(self) -> None:
        """Look for controllers anew."""

    def describe(self) -> str:
        """One line: which controllers there are, and where they were looked up."""
        return ", ".join(f"{name} ({', '.join(self.joints(name))})" for name in self.controllers()) or "none"


class Completion:
    """A status with an event, for handles that finish in another thread."""

    def __init__(self) -> None:
        self._done = threading.Event()
        self._done.set()
        self._status = ExecutionStatus.SUCCEEDED
        self._lock = threading.Lock()

    def begin(self) -> None:
        with self._lock:
            self._status = ExecutionStatus.RUNNING
            self._done.clear()

    def finish(self, status: ExecutionStatus) -> bool:
        """Set the end, ``status``; False when it had ended before (the first end counts)."""
        with self._lock:
            if self._status is not ExecutionStatus.RUNNING:
                return False
            self._status = status
            self._done.set()
            return True

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until it has ended, up to ``timeout`` wall s (None: for ever). :return: whether it has"""
        return self._done.wait(timeout)

    @property
    def status(self) -> ExecutionStatus:
        return self._status

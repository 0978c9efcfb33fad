"""What can go wrong in the simulator: one tree, each error one line for a student.

::

    SimulationError                    .message, and .source: file, line and element, where a text is at fault
    ├── DescriptionError   ValueError  a text, mesh or picture cannot be used
    │   └── PlanError                  building_editor.plan_file: the plan of a building; names the entry
    ├── CameraError        ValueError  a camera that cannot be made; names the value and what is allowed
    ├── Refused            ValueError  what was asked for is not done; says why, and what to do
    │   └── UnknownDevice              rendering.devices: there is no such card; lists those that there are
    ├── Failure                        gazebo_ros.commands.command_line: a command ends, with this line and exit code 1
    └── Unavailable        RuntimeError  something is missing here and now: a package, a free port
        ├── RenderingUnavailable       no OpenGL on this machine
        └── Stopped                    gazebo_ros.server: the simulator is shutting down; the call was not made

The faces (gazebo_ros, gzclient) derive theirs from these. Errors of plugins are plugin_loader's ``PluginError``.
"""

from __future__ import annotations

from dataclasses import dataclass


def one_line(text: object, most: int = 1000) -> str:
    """``text`` for a message: on one line, printable, its middle left out where it is longer than ``most`` characters."""
    text = str(text)
    if len(text) > most:
        text = f"{text[: most - most // 3]} ... {text[-(most // 3) :]}"
    return "".join(c if c.isprintable() else " " if c.isspace() else "?" for c in text)


def quoted(text: object, most: int = 60) -> str:
    """``text`` of an input for a message: :func:`one_line` of up to ``most`` characters, without the white space around and inside."""
    return " ".join(one_line(text, most).split())


@dataclass(frozen=True)
class Source:
    """Where an element was written."""

    file: str = ""
    line: int = 0
    element: str = ""

    def __str__(self) -> str:
        place = self.file or "text"
        if self.line:
            place += f":{self.line}"
        return f"{place} {self.element}".strip()

    def before(self, message: str) -> str:
        """``message`` behind the place, if there is one."""
        return f"{self}: {message}" if self.file or self.line or self.element else message


class SimulationError(Exception):
    """The root. ``str(error)`` is the whole line: ``source``, the place, if it is known, and the ``message``."""

    def __init__(self, message: object = "", source: Source = Source()) -> None:
        self.message = one_line(message)
        self.source = source
        super().__init__(one_line(source.before(str(message))))

    def __reduce__(self) -> tuple[type[SimulationError], tuple[str, Source]]:
        return type(self), (self.message, self.source)


class DescriptionError(SimulationError, ValueError):
    """The text cannot be turned into a model or world at all, or a file not into what it should hold."""


class CameraError(SimulationError, ValueError):
    """A camera that cannot be made; names the value and what is allowed."""


class Refused(SimulationError, ValueError):
    """The simulator does not do what was asked for; says why and what to do."""


class Unavailable(SimulationError, RuntimeError):
    """Something is missing here and now; says what to do."""


class RenderingUnavailable(Unavailable):
    """No OpenGL on this machine; says what was tried and what to install."""

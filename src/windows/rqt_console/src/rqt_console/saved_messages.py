"""Messages in a file as Noetic's rqt_console writes them: each a record of quoted fields with semicolons between, where only quotes have
a backslash before them."""

import re
from collections.abc import Iterable, Iterator

from qt_gui.errors import WindowError

from .message import Message

_BETWEEN = '";"'  # two fields; a quote within one has a backslash before it
HEADER = ["message", "severity", "node", "stamp", "topics", "location"]


class SavedMessagesError(WindowError, ValueError):
    """A file that holds no messages; one line says why."""


def save(path: str, messages: Iterable[Message]) -> None:
    """Write ``messages`` into the file ``path``, below a line with the names of the columns.

    :raises OSError: if it cannot be written
    """

    def quoted(*values):
        return ";".join('"' + str(value).replace('"', '\\"') + '"' for value in values) + "\n"

    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(";".join(HEADER) + "\n")
        for m in messages:
            file.write(quoted(m.message, m.severity, m.node, f"{m.stamp[0]}.{m.stamp[1]:09d}", ",".join(m.topics), m.location))


def load(path: str) -> list[Message]:
    """:raises SavedMessagesError: if the file cannot be read, or is something else"""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            header = [name.strip('"') for name in file.readline().strip().split(";")]
            if sorted(header) != sorted(HEADER):
                raise SavedMessagesError(f"{path}: the first line is not {';'.join(HEADER)}")
            return [_message(dict(zip(header, fields)), path, line) for line, fields in _records(file)]
    except OSError as error:
        raise SavedMessagesError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise SavedMessagesError(f"{path} is no file of messages: {error}") from error


def _records(lines: Iterable[str]) -> Iterator[tuple[int, list[str]]]:
    """The number of the last line of each record in the file, and its fields; a message may have several lines."""
    kept: list[str] = []
    between = 0
    number = 1
    for number, line in enumerate(lines, 2):
        if not kept and not line.strip():
            continue
        kept.append(line)
        between += line.count(_BETWEEN)
        if between >= len(HEADER) - 1 and line.rstrip().endswith('"'):
            yield number, _fields(kept)
            kept, between = [], 0
    if kept:
        yield number, _fields(kept)


def _fields(lines: list[str]) -> list[str]:
    text = "".join(lines).strip().removeprefix('"').removesuffix('"')
    return [field.replace('\\"', '"') for field in text.split(_BETWEEN)]


def _message(record: dict, path: str, line: int) -> Message:
    stamp = re.fullmatch(r"(\d{1,10})\.(\d{1,9})", record.get("stamp", ""))
    if len(record) != len(HEADER) or stamp is None or not record["severity"].isdecimal():
        raise SavedMessagesError(f"{path}: the record that ends in line {line} is no message")
    topics = [topic for topic in record["topics"].split(",") if topic]
    return Message(
        record["message"], int(record["severity"]), record["node"], (int(stamp[1]), int(stamp[2].ljust(9, "0"))), topics, record["location"]
    )

"""Messages in a file, one per record, separated by semicolons."""

import csv
import re
from collections.abc import Iterable

from qt_gui.errors import WindowError

from .message import Message

HEADER = ["message", "severity", "node", "stamp", "topics", "location"]


class SavedMessagesError(WindowError, ValueError):
    """A file that holds no messages; one line says why."""


def save(path: str, messages: Iterable[Message]) -> None:
    """Write ``messages`` into the file ``path``, below a line with the names of the columns.

    :raises OSError: if it cannot be written
    """

    def quoted(*values):
        return ";".join('"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"' for value in values) + "\n"

    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(";".join(HEADER) + "\n")
        for m in messages:
            file.write(quoted(m.message, m.severity, m.node, f"{m.stamp[0]}.{m.stamp[1]:09d}", ",".join(m.topics), m.location))


def load(path: str) -> list[Message]:
    """:raises SavedMessagesError: if the file cannot be read, or is something else"""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = csv.reader(file, delimiter=";", quotechar='"', escapechar="\\", doublequote=False)
            header = next(rows, None)
            if header is None or sorted(header) != sorted(HEADER):
                raise SavedMessagesError(f"{path}: the first line is not {';'.join(HEADER)}")
            return [_message(dict(zip(header, row)), path, rows.line_num) for row in rows if row]
    except OSError as error:
        raise SavedMessagesError(f"{path}: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise SavedMessagesError(f"{path} is no file of messages: {error}") from error


def _message(record: dict, path: str, line: int) -> Message:
    stamp = re.fullmatch(r"(\d{1,10})\.(\d{1,9})", record.get("stamp", ""))
    if len(record) != len(HEADER) or stamp is None or not record["severity"].isdecimal():
        raise SavedMessagesError(f"{path}: the record that ends in line {line} is no message")
    topics = [topic for topic in record["topics"].split(",") if topic]
    return Message(
        record["message"], int(record["severity"]), record["node"], (int(stamp[1]), int(stamp[2].ljust(9, "0"))), topics, record["location"]
    )

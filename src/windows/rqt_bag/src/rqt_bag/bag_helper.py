"""Small questions to `rosbag.Bag`, and texts of stamps and sizes."""

from __future__ import annotations

import time

import genpy


def stamp_to_str(t: genpy.Time) -> str:
    """A stamp as date and time, in milliseconds; one of a simulation as seconds."""
    seconds = t.to_sec()
    if seconds < 86400.0 * 365:
        return f"{seconds:.3f}s"
    return time.strftime("%b %d %Y %H:%M:%S", time.localtime(t.secs)) + f".{t.nsecs // 1_000_000:03d}"


def get_topics(bag) -> list[str]:
    """Names of the topics in a bag, sorted."""
    return sorted({connection.topic for connection in bag._get_connections()})


def get_start_stamp(bag) -> genpy.Time | None:
    """Stamp of the first message; None of an empty bag."""
    firsts = [index[0].time for index in bag._connection_indexes.values() if index]
    return min(firsts, default=None)


def get_end_stamp(bag) -> genpy.Time | None:
    """Stamp of the last message; None of an empty bag."""
    lasts = [index[-1].time for index in bag._connection_indexes.values() if index]
    return max(lasts, default=None)


def get_topics_by_datatype(bag) -> dict[str, list[str]]:
    """Type -> topics of that type."""
    topics: dict[str, list[str]] = {}
    for connection in bag._get_connections():
        names = topics.setdefault(connection.datatype, [])
        if connection.topic not in names:
            names.append(connection.topic)
    return topics


def get_datatype(bag, topic: str) -> str | None:
    """Type of a topic; None when the bag has no such topic."""
    return next((connection.datatype for connection in bag._get_connections(topic)), None)


def filesize_to_str(size: int) -> str:
    """A size in bytes as a person reads it."""
    value = float(size)
    for unit in ("B", "KB", "MB", "GB"):
        if value < 1024:
            return f"{value:.1f} {unit}" if unit != "B" else f"{size} B"
        value /= 1024
    return f"{value:.1f} TB"

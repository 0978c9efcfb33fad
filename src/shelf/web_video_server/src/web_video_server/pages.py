"""The page that lists image topics, and the one that shows a stream."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from urllib.parse import quote

_INFO = "camera_info"


def groups(topics: Iterable[tuple[str, str]]) -> list[tuple[str, list[str]]]:
    """[(camera's namespace with its slash, names below it)], then ("", [whole names]) of those without a camera_info.

    :param topics: (name, type) as the master lists them
    """
    images = sorted(name for name, kind in topics if kind == "sensor_msgs/Image")
    found: list[tuple[str, list[str]]] = []
    cameras = (name for name, kind in sorted(topics) if kind == "sensor_msgs/CameraInfo" and name.endswith("/" + _INFO))
    for camera in cameras:
        base = camera[: -len(_INFO)]
        found.append((base, [name[len(base) :] for name in images if name.startswith(base)]))
        images = [name for name in images if not name.startswith(base)]
    return found + [("", images)]


def topics_page(topics: Iterable[tuple[str, str]]) -> str:
    """HTML that lists ``topics``, (name, type)."""
    parts = ["<!DOCTYPE html><html><head><title>ROS Image Topic List</title></head><body><h1>Available ROS Image Topics:</h1>"]
    for base, names in groups(list(topics)):
        entries = "".join(_entry(base, name) for name in names)
        parts.append(f"<ul><li>{escape(base)}<ul>{entries}</ul></li></ul>" if base else f"<ul>{entries}</ul>")
    return "".join(parts) + "</body></html>"


def _entry(base: str, name: str) -> str:
    topic = quote(base + name)
    return (
        f'<li><a href="/stream_viewer?topic={topic}">{escape(name)}</a> (<a href="/stream?topic={topic}">Stream</a>) '
        f'(<a href="/snapshot?topic={topic}">Snapshot</a>)</li>'
    )


def viewer_page(topic: str, query: str) -> str:
    """HTML that shows the stream of ``topic``.

    :param query: of the address, which the picture's address repeats
    """
    name = escape(topic)
    return f'<!DOCTYPE html><html><head><title>{name}</title></head><body><h1>{name}</h1><img src="/stream?{escape(query)}"></body></html>'

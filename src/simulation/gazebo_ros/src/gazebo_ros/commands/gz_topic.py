"""``gz topic``: what goes over Gazebo's own transport, in lines like those of the original. What it says itself: gz_publish."""

from __future__ import annotations

import argparse
import sys
import threading
import time
from collections.abc import Callable

from gazebo_ros.commands import gz_publish
from gazebo_ros.commands.command_line import Failure

try:
    from gazebo_cpp import _core
except ImportError:  # built without compiled plugins, or on a system that lacks what they need
    _core = None  # type: ignore[assignment]  # the usual form for a module that may not be there


def topic(options: argparse.Namespace) -> None:
    """List, show, measure or publish the topics of Gazebo's own transport; those of ROS: rostopic."""
    if options.view:
        raise Failure("there is no window for topics of Gazebo here; -e shows messages as text, and rqt_plot and RViz show those of ROS")
    name = options.info or options.echo or options.hz or options.bw or options.publish
    if not (options.list or name or options.request):
        raise Failure(
            "say what: -l lists, -e TOPIC shows messages, -i TOPIC who sends them, -z TOPIC how often, -b TOPIC how much; "
            "-p TOPIC -m MESSAGE publishes one, -r WHAT asks"
        )
    if _core is None:
        raise Failure("Gazebo's transport is not built; it needs libprotobuf-dev and protobuf-compiler (scripts/setup installs them)")
    problem = _core.join(1)
    if problem:
        raise Failure(f"{problem}; start the simulator first. Topics of ROS: rostopic")
    if options.list:
        print("\n".join(_core.topic_names()))
        return
    node = _core.Node(options.world_name)
    full = node.full_name(name or "~/request")
    if options.info:
        _info(full)
    elif options.echo:
        _echo(node, full, options)
    elif options.hz or options.bw:
        _run(node, full, Rate() if options.hz else Bandwidth(), options.duration)
    elif options.publish:
        gz_publish.publish(_core, full, options)
    else:
        gz_publish.request(_core, full, node.full_name("~/response"), options)


def _known(name: str):
    described = _core.describe_topic(name)
    if not described.publishers and not described.subscribers:
        raise Failure(f"there is no topic {name} of Gazebo; gz topic -l lists them, rostopic list those of ROS")
    return described


def _info(name: str) -> None:
    described = _known(name)
    print(f"Type: {described.type}\n\nPublishers:")
    print("".join(f"\t{each}\n" for each in described.publishers))
    print("Subscribers:")
    print("".join(f"\t{each}\n" for each in described.subscribers))


def _echo(node, name: str, options: argparse.Namespace) -> None:
    kind = _known(name).type
    end = "" if options.unformatted else "\n"
    _run(node, name, lambda now, data: _core.message_text(kind, data, options.unformatted) + end, options.duration)


def _run(node, name: str, line: Callable[[float, bytes], str], duration: float | None) -> None:
    """Print what ``line`` makes of each message, until the time is over, nobody reads it, or Ctrl-C.

    :param line: of the time it came (s) and the message; "" for nothing
    :param duration: s
    """
    over = threading.Event()

    def came(data: bytes) -> None:
        try:
            sys.stdout.write(line(time.monotonic(), data))
            sys.stdout.flush()
        except (BrokenPipeError, ValueError):
            over.set()

    subscriber = node.subscribe(name, came)
    end = None if duration is None else time.monotonic() + duration
    while not over.is_set() and (end is None or time.monotonic() < end):
        over.wait(0.1 if end is None else max(0.0, min(0.1, end - time.monotonic())))
    subscriber.unsubscribe()


class Rate:
    """The rate of each message after the one before."""

    def __init__(self):
        self._last: float | None = None

    def __call__(self, now: float, data: bytes) -> str:
        last, self._last = self._last, now
        return "" if last is None or now <= last else f"Hz: {1.0 / (now - last):6.2f}\n"


class Bandwidth:
    """A line for each second with at least ten messages."""

    def __init__(self):
        self._sizes: list[int] = []
        self._times: list[float] = []
        self._said: float | None = None

    def __call__(self, now: float, data: bytes) -> str:
        if self._said is None:
            self._said = now
        self._sizes.append(len(data))
        self._times.append(now)
        if now - self._said <= 1.0:
            return ""
        self._said = now
        sizes, times = sorted(self._sizes), self._times
        if len(sizes) < 10:
            return ""
        self._sizes, self._times = [], []
        mean = sum(sizes) / len(sizes)
        words = [_size(value, mean) for value in (mean, sizes[0], sizes[-1])]
        total = sum(sizes) / (times[-1] - times[0])
        return f"Total[{_size(total, total)}/s] Mean[{words[0]}] Min[{words[1]}] Max[{words[2]}] Messages[{len(sizes)}]\n"


def _size(value: float, scale: float) -> str:
    """:param scale: the value whose size chooses the unit"""
    if scale < 1000:
        return f"{value:.2f} B"
    if scale < 1000000:
        return f"{value / 1024:.2f} KB"
    return f"{value / 1048576:.2f} MB"

"""``gz topic -p`` and ``-r``: a message of one's own on Gazebo's transport, and a question with its answer."""

from __future__ import annotations

import argparse
import glob
import os
import random
import shutil
import subprocess
import time

from gazebo_ros.commands.command_line import Failure
from gazebo_ros.commands.wire import field, fields, listen, publish_once

_ANSWER = 10.0  # s
_REQUEST = "gazebo.msgs.Request"
#: topics that Gazebo's own simulator hears, and what does their work here
_INSTEAD = {
    "light/modify": "rosservice call /gazebo/set_light_properties changes lights",
    "model/modify": "gz model -m NAME -x ... places models",
    "physics": "gz physics changes it",
    "wrench": "rosservice call /gazebo/apply_body_wrench pushes links",
}


def publish(core, name: str, options: argparse.Namespace) -> None:
    """Say the message of ``-m`` or ``-f`` once.

    :param core: the transport's module, which has joined
    :param name: the topic's full name
    :param options: those of gz topic
    """
    text = _text(options)
    if text is None:
        raise Failure(f"{name}: its message is needed: -m 'FIELD: VALUE ...' or -f FILE, in protobuf's text format, as in -m 'pause: true'")
    described = core.describe_topic(name)
    listeners = len(set(described.subscribers))
    if not listeners:
        instead = next(
            (words for end, words in _INSTEAD.items() if name.endswith("/" + end)), "gz topic -l lists the topics that there are"
        )
        raise Failure(f"nobody listens to {name}; {instead}")
    message = encode(described.type, text, options.file if options.msg is None else "-m")
    try:
        got = publish_once(name, described.type, message, listeners)
    except OSError as error:
        raise Failure(f"{name}: the simulator is gone ({error})") from error
    if not got:
        raise Failure(f"{name}: who listens to it did not come to fetch the message; if it runs on another machine, set GAZEBO_IP here")


def request(core, asked: str, answered: str, options: argparse.Namespace) -> None:
    """Ask what ``-r`` names, about ``-m`` or ``-f``, and print the answer.

    :param core: the transport's module, which has joined
    :param asked: full name of the topic of requests
    :param answered: that of their answers
    :param options: those of gz topic
    """
    data = (_text(options) or "").rstrip()
    number = random.randrange(1, 2**31)
    answers = core.describe_topic(answered)
    listeners = len(set(core.describe_topic(asked).subscribers))
    if not listeners or not answers.publishers:
        raise Failure(f"nobody answers requests on {asked}; is the name of the world right (-w)?")
    try:
        with listen(answered, answers.type, answers.publishers[0]) as wire:
            message = field(1, number) + field(2, options.request) + field(3, data)
            publish_once(asked, _REQUEST, message, listeners)
            answer = _answer(wire, number)
    except (OSError, ValueError) as error:
        raise Failure(
            f"no answer to {options.request} '{data}' within {_ANSWER:g} s; entity_list, entity_info and entity_delete are answered"
        ) from error
    if answer.get(3) == [b"nonexistent"]:
        raise Failure(f"{options.request}: there is no '{data}'; gz model lists the models")
    kind = answer.get(4, [b""])[0].decode()
    if kind:
        print(core.message_text(kind, answer.get(5, [b""])[0], False))


def _answer(wire, number: int) -> dict[int, list]:
    end = time.monotonic() + _ANSWER
    while True:
        answer = fields(wire.read(end - time.monotonic()))
        if answer.get(1) == [number]:
            return answer


def _text(options: argparse.Namespace) -> str | None:
    if options.msg is not None or options.file is None:
        return options.msg
    try:
        with open(options.file, encoding="utf-8") as stream:
            return stream.read()
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f"{options.file}: {error if isinstance(error, UnicodeDecodeError) else error.strerror}") from error


def encode(kind: str, text: str, where: str) -> bytes:
    """The bytes of a message of Gazebo's own types.

    :param kind: as gazebo.msgs.WorldControl
    :param text: in protobuf's text format
    :param where: what the text is of, for errors
    :raises Failure: the type is not known, or the text is no such message
    """
    compiler = shutil.which("protoc")
    if not compiler:
        raise Failure("protoc is needed to read messages: install the package protobuf-compiler (scripts/setup does)")
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        folder = os.path.join(prefix, "include", "gazebo", "msgs", "proto")
        files = sorted(glob.glob(os.path.join(folder, "*.proto")))
        if not prefix or not files:
            continue
        done = subprocess.run([compiler, "-I", folder, f"--encode={kind}", *files], input=text.encode(), capture_output=True)
        said = done.stderr.decode(errors="replace").strip().splitlines()
        if not done.returncode and not said:
            return done.stdout
        if "not defined" in said[0]:
            raise Failure(f"messages of type {kind} cannot be written here: it is none of Gazebo's own")
        line = said[0].strip().removeprefix("input:").removeprefix("warning:").strip()
        raise Failure(f"{where} is no {kind}: {line}")
    raise Failure("Gazebo's messages are not there: source the workspace's setup.bash, in which gazebo_cpp is built")

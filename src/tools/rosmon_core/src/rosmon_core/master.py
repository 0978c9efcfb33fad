"""The roscore: waiting for it, and setting parameters on it."""

from __future__ import annotations

import asyncio
import os
import xmlrpc.client
from collections.abc import Callable
from typing import Any

import rosgraph
import rospkg

from rosmon_core import RosmonError
from rosmon_core.launch_file import LaunchFile

_CALLER = "/rosmon"
_POLL = 0.2  # s


def _ask_run_id(uri: str) -> str | None:
    """The master's run id ('' before it is set); None when no master answers."""
    try:
        master: Any = xmlrpc.client.ServerProxy(uri)
        code, _, value = master.getParam(_CALLER, "/run_id")
    except (OSError, xmlrpc.client.Error):
        return None
    return value if code == 1 else ""


async def wait(uri: str, say: Callable[[str], None]) -> str:
    """Wait for a roscore at ``uri``; returns its run id. rosmon never starts one. ``say`` is told what is waited for."""
    loop = asyncio.get_running_loop()
    say(f"ROS_MASTER_URI: '{uri}'")
    run_id = await loop.run_in_executor(None, _ask_run_id, uri)
    if run_id is not None:
        say("roscore is already running.")
        return run_id
    say("roscore is not running. Waiting for it: type 'roscore' in another terminal, or Ctrl-C here to give up")
    while run_id is None:
        await asyncio.sleep(_POLL)
        run_id = await loop.run_in_executor(None, _ask_run_id, uri)
    say("roscore is running now.")
    return run_id


def log_directory(run_id: str) -> str | None:
    """Where nodes write their own logs; made if necessary, None if that is impossible."""
    directory = os.path.join(rospkg.get_log_dir(), run_id)
    try:
        os.makedirs(directory, exist_ok=True)
    except OSError:
        return None
    return directory


def _check(results, calls: tuple[str, ...]) -> None:
    for (code, message, _), name in zip(results, calls):
        if code != 1:
            raise RosmonError(f"roscore refuses parameter {name}: {message}")


def set_parameters(uri: str, launch_file: LaunchFile) -> None:
    """Delete what clear_params of ``launch_file`` names, then set its parameters, on the master at ``uri``.

    :raises RosmonError: the master fails.
    """
    master: Any = xmlrpc.client.ServerProxy(uri)
    try:
        names = [name.rstrip("/") or "/" for name in launch_file.clear_params]
        for name in names:
            if master.hasParam(_CALLER, name)[2]:
                _check([master.deleteParam(_CALLER, name)], (name,))
        multi = xmlrpc.client.MultiCall(master)
        for name, value in launch_file.params.items():
            multi.setParam(_CALLER, name, value)
        _check(multi(), tuple(launch_file.params))
    except (OSError, xmlrpc.client.Error) as error:
        raise RosmonError(f"cannot set parameters on the roscore at {uri}: {error}") from None
    except (TypeError, OverflowError) as error:
        raise RosmonError(f"a parameter cannot be sent to the roscore: {error}; integers have 32 bits there") from None


def master_uri() -> str:
    """:raises RosmonError: ROS_MASTER_URI is wrong."""
    try:
        uri = rosgraph.get_master_uri()
        rosgraph.network.parse_http_host_and_port(uri)
    except (ValueError, KeyError) as error:
        raise RosmonError(f"ROS_MASTER_URI is not usable ({error}): write http://HOST:11311") from None
    return uri

"""Whether a Ray cluster asks for a token. Who brings one to a cluster that has none is connected, but asks its nodes for it in turn: they
are refused, and nothing that is sent to them arrives."""

from __future__ import annotations

import os
import pathlib
import subprocess

from ..isolation import sandbox

_MODE = "RAY_AUTH_MODE"
# In a process of its own: Ray prints what it thinks of a refusal, and keeps the first mode.
_ASK = """
import os, sys
from ray._private import services
from ray._raylet import Config, GcsClient
from ray.exceptions import AuthenticationError
address = services.canonicalize_bootstrap_address(sys.argv[1])
for mode in ("disabled", "token"):
    os.environ["RAY_AUTH_MODE"] = mode
    Config.initialize("")
    try:
        GcsClient(address=address)
    except AuthenticationError:
        print("asks", flush=True)
    else:
        print(mode, flush=True)
        break
"""


def token_file() -> pathlib.Path:
    return pathlib.Path(os.environ.get("RAY_AUTH_TOKEN_PATH") or pathlib.Path.home() / ".ray" / "auth_token")


def bring_token() -> None:
    """Where this user has a token, ``ray start --head`` asks for it, but Ray's other commands do not bring it by themselves: here they
    do. Before Ray is imported; who has set RAY_AUTH_MODE is heard."""
    if token_file().exists():
        os.environ.setdefault(_MODE, "token")


def environment() -> dict[str, str]:
    """For a process that uses Ray."""
    return {**sandbox.own_environment(), **{name: value for name, value in os.environ.items() if name.startswith("RAY_")}}


def agree(address: str) -> bool:
    """Has Ray, which is not imported yet, bring a token to a cluster that asks for one, and none to another.

    :param address: HOST:PORT or ``auto``
    :returns: False when it asks for one, and ours is not it; a cluster that does not answer is for ``ray.init`` to tell
    """
    if _MODE in os.environ:
        return True
    try:
        said = subprocess.run(
            [*sandbox.isolated(), "-c", _ASK, address], capture_output=True, text=True, timeout=60.0, cwd="/", env=environment()
        ).stdout.split()
    except subprocess.TimeoutExpired:
        return True
    if said and said[-1] != "asks":
        os.environ[_MODE] = said[-1]
    return not said or said[-1] != "asks"

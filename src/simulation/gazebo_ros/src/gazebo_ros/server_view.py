"""The step loop as plugins see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazebo_ros.callbacks import Connection
from gazebo_ros.plugin_host import PluginInstance

if TYPE_CHECKING:
    from gazebo_ros.server import Server


class ServerView:
    """What a plugin sees of the :class:`Server`: step callbacks made through it end with the plugin."""

    def __init__(self, server: Server, owner: PluginInstance):
        self._server = server
        self._owner = owner
        self.world = server.world
        self.description = server.description
        self.finder = server.finder
        self.lockstep = server.lockstep
        self.now = server.now
        self.call = server.call

    @property
    def paused(self) -> bool:
        return self._server.paused

    def before_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f`` before each step, see :meth:`Server.before_step`."""
        return self._server._before.connect(f, self._owner)

    def after_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f`` after each step, see :meth:`Server.after_step`."""
        return self._server._after.connect(f, self._owner)

    def unpause(self) -> None:
        """From any thread."""
        self._server.call(self._server.unpause)

    def step(self) -> None:
        """One step though paused; returns when it is done. Not in the physics thread.

        :raises ValueError: not paused, or somebody else's steps are being taken
        """
        self._server.call(lambda: self._server.request_steps(1)).result()

    def drives(self, *joints: Any) -> None:
        """The plugin moves these joints from now on: a second plugin that says so of one of them is a warning."""
        self._server._drivers.drives(self._owner, joints)

"""Starting the ROS side of the clients, under the names of the compiled module."""

from __future__ import annotations

from moveit_commander.roscpp_initializer import roscpp_initialize, roscpp_shutdown

__all__ = ["roscpp_init", "roscpp_shutdown"]


def roscpp_init(name: str | list[str] = "", args: list[str] | None = None) -> None:
    """``roscpp_init()``, ``roscpp_init(args)`` or ``roscpp_init(name, args)``: the name is taken for a remapping of the
    node's, which the first client makes if the program makes none."""
    if not isinstance(name, str):
        roscpp_initialize(list(name))
        return
    roscpp_initialize([*(args or []), *([f"__name:={name}"] if name else [])])

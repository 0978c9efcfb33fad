"""What every service of the node shares: run in the physics thread, answer with success and one line."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

import rospy
from ode_sim.errors import Refused

from gazebo_ros.server import Server, Stopped


def worded(gazebo: str, more: str) -> Refused:
    """A refusal in the words that Gazebo's own service has for it, ``gazebo``, which scripts compare with, and what it leaves unsaid,
    ``more``.
    """
    return Refused(f"{gazebo}{' ' if gazebo[-1] in '.?!' else '; '}{more}")


class Answer(Refused):
    """A refusal whose text is the whole status line."""


def advertise(
    server: Server, name: str, service: Any, f: Callable[[Any, Any], str | None], in_physics_thread: bool = True, prefix: str = ""
) -> rospy.Service:
    """Offer ``~name``. ``f(request, response)`` fills the response and returns the status line, if there is one.

    A :class:`Refused`, or the ``ValueError`` by which ode_sim refuses a value, becomes ``success=false``; so does what
    nobody foresaw, with an ERROR line. Responses without a ``success`` field cannot say it, so it is logged instead.

    :param service: class of the service, as in ``std_srvs.srv.Empty``
    :param prefix: begins the status line of a failure; by default the service's name in camel case
    :param server: whose node offers it
    :param in_physics_thread: ``f`` is called between two steps; False calls it in a thread of rospy
    """
    prefix = prefix or "".join(word.capitalize() for word in name.split("_"))

    def handle(request: Any) -> Any:
        response = service._response_class()
        try:
            status = server.call(lambda: f(request, response)) if in_physics_thread else f(request, response)
            success = True
        except (ValueError, Stopped) as error:
            status, success = str(error) if isinstance(error, Answer) else f"{prefix}: {error}", False
        except Exception as error:  # the answer must reach the client, and the server must go on
            status, success = f"{prefix}: internal error, {type(error).__name__}: {error}", False
            rospy.logerr("%s", status)
        if hasattr(response, "success"):
            response.success, response.status_message = success, status
        elif not success:
            rospy.logwarn("%s", status)
        return response

    return rospy.Service(f"~{name}", service, handle)


def finite(what: str, *values: float) -> None:
    """:raises Refused: one of ``values`` is NaN or infinite; ``what`` holds it"""
    for value in values:
        if not math.isfinite(value):
            raise Refused(f"{what} holds {value}; give finite numbers")


def listing(names: Iterable[str], limit: int = 12) -> str:
    """``a, b, c`` of ``names`` for a message; of more than ``limit`` the rest is counted."""
    names = list(names)
    if not names:
        return "none"
    more = f" and {len(names) - limit} more" if len(names) > limit else ""
    return ", ".join(names[:limit]) + more

"""Services of a running simulator, for commands: of the one in the command's own namespace, else of the one at the root."""

from __future__ import annotations

import time
from typing import Any

import rosgraph
import rospy
from rosgraph.names import ns_join

from gazebo_ros.commands.command_line import Failure

_PATIENCE = 2.0  # wall s
_ASKED_BY = "/get_world_properties"  # every simulator has it


def _services() -> set[str]:
    """Names of all on the graph.

    :raises Failure: the master does not answer
    """
    try:
        return {name for name, _ in rosgraph.Master(rospy.get_caller_id()).getSystemState()[2]}
    except (rosgraph.MasterException, OSError) as error:
        raise Failure(f"the ROS master at {rosgraph.get_master_uri()} does not answer: {error}") from error


def simulator() -> str:
    """The name of the node that is asked: ``gazebo`` in the command's namespace (ROS_NAMESPACE, ``__ns:=``), or ``/gazebo``.

    :raises Failure: there is none; says which others there are
    """
    candidates = list(dict.fromkeys((ns_join(rospy.get_namespace(), "gazebo"), "/gazebo")))
    end = time.monotonic() + _PATIENCE
    while True:
        services = _services()
        for name in candidates:
            if name + _ASKED_BY in services:
                return name
        if time.monotonic() > end:
            break
        rospy.rostime.wallsleep(0.1)
    others = sorted(name.removesuffix("/gazebo" + _ASKED_BY) for name in services if name.endswith("/gazebo" + _ASKED_BY))
    raise Failure(
        f"no simulator answers at {rosgraph.get_master_uri()} as {' or '.join(candidates)}"
        + (f"; there is one in {' and in '.join(others)}: put ROS_NAMESPACE={others[0]} before the command" if others else "")
    )


def call(name: str, service: type, *arguments: Any) -> Any:
    """The answer of ``<simulator>/<name>``, a ``service`` of that class, to ``arguments``.

    :raises Failure: no simulator, or it refuses
    """
    full = f"{simulator()}/{name}"
    try:
        rospy.wait_for_service(full, _PATIENCE)
        response = rospy.ServiceProxy(full, service)(*arguments)
    except rospy.ROSInterruptException:
        raise
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise Failure(f"no simulator answers at {rosgraph.get_master_uri()} ({full}): {error}") from error
    if not getattr(response, "success", True):
        raise Failure(response.status_message)
    return response

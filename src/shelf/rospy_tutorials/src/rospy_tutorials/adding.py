"""The service ``add_two_ints`` and who asks it."""

import random
import sys

import node_signals
import rospy

from .srv import AddTwoInts, AddTwoIntsResponse

_USAGE = "usage: add_two_ints_client [X Y], two whole numbers; without them it takes two at random"


def serve() -> None:
    """The node add_two_ints_server."""

    def add(request):
        total = request.a + request.b
        print(f"Returning [{request.a} + {request.b} = {total}]", flush=True)
        return AddTwoIntsResponse(total)

    node_signals.init_node("add_two_ints_server")
    rospy.Service("add_two_ints", AddTwoInts, add)
    node_signals.spin()


def numbers(words: list[str]) -> tuple[int, int] | None:
    """What was typed, ``words``, two at random if nothing was, None if it is something else."""
    if not words:
        return random.randint(-50000, 50000), random.randint(-50000, 50000)
    try:
        x, y = (int(word) for word in words)
    except ValueError:
        return None
    return x, y


def ask() -> int:
    """add_two_ints_client: no node, as services can be asked without."""
    terms = numbers(sys.argv[1:])
    if terms is None:
        print(_USAGE, file=sys.stderr)
        return 1
    x, y = terms
    print(f"Requesting {x}+{y}", flush=True)
    rospy.wait_for_service("add_two_ints")
    try:
        total = rospy.ServiceProxy("add_two_ints", AddTwoInts)(x, y).sum
    except rospy.ServiceException as error:
        print(f"Service call failed: {error}", file=sys.stderr)
        return 1
    print(f"{x} + {y} = {total}")
    return 0

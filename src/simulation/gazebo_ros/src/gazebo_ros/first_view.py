"""``<gui><camera>`` of a world: where the window's eye, and that of a picture, stands at first."""

from __future__ import annotations

import math

import rospy
from ode_sim import math3
from ode_sim.description import DescriptionError, ResourceFinder
from ode_sim.description.model import FARTHEST, Pose
from ode_sim.description.sdf_document import parse_sdf
from ode_sim.description.xmlsource import leading_numbers, read_bytes


def first_view(world: str, finder: ResourceFinder) -> Pose | None:
    """X_WE of the eye, which looks along its x axis; None where the world does not say it, or not in numbers that can be used.

    :param world: as for ``load_world``
    :param finder: of files that worlds name
    """
    file = finder.find_world(world)
    try:
        element = parse_sdf(read_bytes(file) if file else world, file or "").find("world/gui/camera/pose")
    except DescriptionError:  # load_world has told
        return None
    if element is None:
        return None
    numbers = leading_numbers(element.text or "", 6)
    if len(numbers) not in (3, 6) or not all(map(math.isfinite, numbers)) or max(map(abs, numbers[:3])) > FARTHEST:
        rospy.logwarn(
            "%s: <gui><camera><pose>%s</pose> must be x y z roll pitch yaw, m and rad; the window chooses its own view",
            file or "world",
            (element.text or "").strip(),
        )
        return None
    return math3.from_rpy(*(*numbers, 0.0, 0.0, 0.0)[:6])

"""The colour of what is in a running world."""
from __future__ import annotations

from dataclasses import replace
from typing import Any

from ode_sim.description import model as d


def paint(link: Any, rgba: d.Rgba, visual: str = "") -> int:
    """Give ``visual`` of a link (all, if '') an even colour, also in the world that is saved; how many were painted.

    In the thread that steps the world.

    :param link: :class:`ode_sim.LinkHandle`. :param rgba: 0 to 1; parts outside are cut to it.
    """
    red, green, blue, alpha = (min(1.0, max(0.0, float(part))) for part in rgba)
    material = d.Material(ambient=(red, green, blue, 1.0), diffuse=(red, green, blue, 1.0))
    painted, visuals = 0, []
    for old in link.description.visuals:
        if visual in ("", old.name):
            old = replace(old, material=material, transparency=1.0 - alpha)
            painted += 1
        visuals.append(old)
    if painted:
        link.description = replace(link.description, visuals=tuple(visuals))
        model = link.model
        model.description = replace(model.description, links=tuple(
            replace(other, visuals=tuple(visuals)) if other.name == link.name else other
            for other in model.description.links))
    return painted

"""The colour of what is in a running world."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ode_sim.description import model as d

from ode_sim_viewer.simulation import Looks


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
        _show(link, tuple(visuals))
    return painted


def set_looks(model: Any, looks: Looks) -> int:
    """Give visuals back what they looked like, ``looks``; how many there were. In the thread that steps the world.

    :param model: :class:`ode_sim.ModelHandle`
    """
    count = 0
    for name, visuals in looks.items():
        link, wanted = model.links.get(name), {visual.name: visual for visual in visuals}
        if link is None:
            continue
        count += sum(visual.name in wanted for visual in link.description.visuals)
        _show(
            link,
            tuple(
                replace(visual, material=wanted[visual.name].material, transparency=wanted[visual.name].transparency)
                if visual.name in wanted
                else visual
                for visual in link.description.visuals
            ),
        )
    return count


def _show(link: Any, visuals: tuple[d.Visual, ...]) -> None:
    link.description = replace(link.description, visuals=visuals)
    model = link.model
    model.description = replace(
        model.description,
        links=tuple(replace(other, visuals=visuals) if other.name == link.name else other for other in model.description.links),
    )

"""Friction and colour of what is in the world, changed while it runs."""

from __future__ import annotations

from ode_sim import CollisionHandle, LinkHandle, ModelHandle
from ode_sim.description import model as d
from ode_sim.description.exchange import loads
from ode_sim_viewer.surfaces import paint, set_looks

from gazebo_ros.api.handlers import Refused, advertise, finite
from gazebo_ros.server import Server
from gazebo_ros.srv import CollisionSurface, SetVisual


class SurfaceServices:
    """``~collision_surface``, ``~set_visual``."""

    def __init__(self, server: Server):
        self._world = server.world
        advertise(server, "collision_surface", CollisionSurface, self._surface)
        advertise(server, "set_visual", SetVisual, self._paint)

    def _surface(self, request, response) -> str:
        found = self._collisions(request.name)
        if request.set:
            finite("the request", request.mu, request.mu2, request.restitution)
            if min(request.mu, request.mu2, request.restitution) < 0.0:
                raise Refused("friction and restitution are at least 0")
            for collision in found:
                for field in ("mu", "mu2", "restitution"):
                    setattr(collision.surface, field, getattr(request, field))
        surface = found[0].surface
        response.mu, response.mu2, response.restitution = surface.mu, surface.mu2, surface.restitution
        return f"CollisionSurface: {len(found)} collisions"

    def _collisions(self, name: str) -> list[CollisionHandle]:
        entity = self._world.find_entity(name)
        if isinstance(entity, CollisionHandle):
            return [entity]
        links = entity.links.values() if isinstance(entity, ModelHandle) else [entity] if entity else []
        found = [collision for link in links for collision in link.collisions.values()]
        if not found:
            raise Refused(f"[{name}] has no collision" if entity else f"there is no model, link or collision [{name}]")
        return found

    def _paint(self, request, response) -> str:
        if request.looks:
            return self._set_looks(request.name, request.looks)
        c = request.color
        finite("the colour", c.r, c.g, c.b, c.a)
        entity, visual = self._world.find_entity(request.name), ""
        if entity is None:
            scope, _, visual = request.name.rpartition("::")
            entity = self._world.find_link(scope) if scope else None
        if not isinstance(entity, (ModelHandle, LinkHandle)):
            raise Refused(f"there is no model, link or visual [{request.name}]")
        links = list(entity.links.values()) if isinstance(entity, ModelHandle) else [entity]
        painted = sum(paint(link, (c.r, c.g, c.b, c.a), visual) for link in links)
        if not painted:
            raise Refused(f"[{request.name}] has nothing to see" if not visual else f"{links[0].scoped_name} has no visual '{visual}'")
        return f"SetVisual: {painted} visuals"

    def _set_looks(self, name: str, text: str) -> str:
        model = self._world.models.get(name)
        if model is None:
            raise Refused(f"there is no model [{name}]")
        try:
            looks = loads(text)
        except ValueError as error:
            raise Refused(str(error)) from error
        if not isinstance(looks, dict) or not all(
            isinstance(visuals, tuple) and all(isinstance(visual, d.Visual) for visual in visuals) for visuals in looks.values()
        ):
            raise Refused("looks are {link: [visual]}, as describe_world tells of visuals")
        return f"SetVisual: {set_looks(model, looks)} visuals"

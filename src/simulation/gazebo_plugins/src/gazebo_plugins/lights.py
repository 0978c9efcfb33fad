"""Lights of Gazebo itself: libFlashLightPlugin.so, libLedPlugin.so and libAttachLightPlugin.so."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from ode_sim import math3
from ode_sim.description import model as d
from ode_sim.description.xmlsource import leading_numbers

from gazebo_plugins.ros_side import find_link, required

_DIM = 0.2  # transparency of a dark LED whose visual says nothing of it
_BLACK = (0.0, 0.0, 0.0, 1.0)
_WHITE = (1.0, 1.0, 1.0, 1.0)
_NS = 1_000_000_000


@dataclass(frozen=True)
class Block:
    """A phase: ``duration`` ns of light in ``color`` (None: that which it has), then ``interval`` ns of darkness."""

    duration: int
    interval: int
    color: d.Rgba | None

    @classmethod
    def read(cls, sdf, where: str) -> Block:
        """Of the element ``sdf``. :raises PluginError: a time is missing or negative, or both are 0; ``where`` begins the line"""
        seconds = []
        for tag in ("duration", "interval"):
            if not sdf.has(tag):
                raise PluginError(f"{where}: <{tag}> is missing; give seconds")
            value = sdf.get(tag, math.nan)
            if not 0.0 <= value < 1e9:
                raise PluginError(f"{where}: <{tag}>{sdf.child(tag).text}</{tag}> has to be a number of seconds, 0 or more")
            seconds.append(round(value * _NS))
        color = leading_numbers(sdf.get("color", ""), 4) if sdf.has("color") else ()
        if sdf.has("color") and len(color) < 3:
            raise PluginError(f"{where}: <color>{sdf.get('color', '')}</color> has to be three or four numbers from 0 to 1")
        rgba = (color[0], color[1], color[2], color[3] if len(color) > 3 else 1.0) if color else None
        return cls(seconds[0], seconds[1], None if rgba == _BLACK else rgba)


class Blinker:
    """One light that goes on and off. Dark is a range of 0 m, as upstream.

    The colour of a single block is first seen when the light comes back from its first darkness, that of several when the
    second one begins: upstream sends none before.
    """

    def __init__(self, server, model, sdf):
        self.server = server
        identity = required(sdf, "id")
        where = f"<light> '{identity}'"
        link_name, _, self.name = identity.rpartition("/")
        links = [link for name, link in model.links.items() if name == link_name or name.endswith("::" + link_name)]
        lights = [link for link in links if self.name in link.lights]
        if not lights:
            there = ", ".join(f"{link.name}/{name}" for link in model.links.values() for name in link.lights)
            raise PluginError(f"<id>{identity}</id> is no link/light of model {model.name}; it has {there or 'no lights'}")
        self.link = lights[0]
        blocks = sdf.children("block") or [sdf]
        self.blocks = [Block.read(block, where) for block in blocks]
        self.original: d.Light = self.link.lights[self.name]
        self.enabled = True
        self.restart()

    def restart(self) -> None:
        """From the beginning, in the light's own colour."""
        self.index, self.start_ns, self.shining = 0, self.server.world.time_ns, True
        if self.name in self.link.lights:
            self.link.lights[self.name] = self.original

    def step(self) -> None:
        now, block = self.server.world.time_ns, self.blocks[self.index]
        if now < self.start_ns or now >= self.start_ns + block.duration + block.interval:
            self.start_ns = now
            self.index = (self.index + 1) % len(self.blocks)
            block = self.blocks[self.index]
        lit = self.enabled and now - self.start_ns <= block.duration
        begins = len(self.blocks) > 1 and now == self.start_ns
        if lit and (begins or not self.shining):
            self.flash(block.color)
        elif self.shining and not lit:
            self.dim()
        self.shining = lit

    def flash(self, color: d.Rgba | None) -> None:
        """Shine, in ``color`` where there is one."""
        colors: dict[str, Any] = {"diffuse": color, "specular": color} if color else {}
        self._change(range=self.original.range, **colors)

    def dim(self) -> None:
        self._change(range=0.0)

    def _change(self, **values: Any) -> None:
        if self.name in self.link.lights:  # it may be deleted while the simulation runs
            self.link.lights[self.name] = replace(self.link.lights[self.name], **values)


class Led(Blinker):
    """A blinker whose visual of the same name shines, too: solid and emissive, or see-through and dark."""

    def __init__(self, server, model, sdf):
        super().__init__(server, model, sdf)
        own = [visual for visual in self.link.description.visuals if visual.name == self.name]
        self.transparency = own[0].transparency if own and own[0].transparency > 0.0 else _DIM
        self.looks = own[0] if own else None
        material = own[0].material if own else None
        self.emissive = material.emissive if material and material.emissive else _WHITE

    def restart(self) -> None:
        super().restart()
        looks = getattr(self, "looks", None)  # not yet, when the light is first put on
        if looks is not None:
            self._paint(looks.material, looks.transparency)

    def flash(self, color: d.Rgba | None) -> None:
        super().flash(color)
        everywhere = {"ambient": color, "diffuse": color, "specular": color, "emissive": color} if color else {"emissive": self.emissive}
        self._paint(replace(self._material(), **everywhere), 0.0)

    def dim(self) -> None:
        super().dim()
        self._paint(replace(self._material(), emissive=_BLACK), self.transparency)

    def _material(self) -> d.Material:
        for visual in self.link.description.visuals:
            if visual.name == self.name and visual.material:
                return visual.material
        return d.Material()

    def _paint(self, material: d.Material | None, transparency: float) -> None:
        """The same in the link's and in the model's description: the one is drawn, the other saved."""
        link = self.link
        visuals = tuple(
            replace(visual, material=material, transparency=transparency) if visual.name == self.name else visual
            for visual in link.description.visuals
        )
        link.description = replace(link.description, visuals=visuals)
        model = link.model
        links = tuple(replace(other, visuals=visuals) if other.name == link.name else other for other in model.description.links)
        model.description = replace(model.description, links=links)


class FlashLight(ModelPlugin):
    """``<light>`` elements with ``<id>`` link/light, ``<duration>`` and ``<interval>`` s, ``<color>``, or several ``<block>`` of these.
    ``<enable>`` of a light counts before that of the plugin; both are true unless they say otherwise."""

    kind: type[Blinker] = Blinker

    def load(self, server, model, sdf) -> None:
        lights = sdf.children("light")
        if not lights:
            raise PluginError("<light> is missing: give <id>link/light</id>, <duration> and <interval>")
        for_all = sdf.get("enable", True)
        self.blinkers: list[Blinker] = []
        for element in lights:
            blinker = self.kind(server, model, element)
            blinker.enabled = element.get("enable", for_all)
            self.blinkers.append(blinker)
        server.before_step(self.step)

    def step(self) -> None:
        for blinker in self.blinkers:
            blinker.step()

    def reset(self) -> None:
        for blinker in self.blinkers:
            blinker.restart()


class LedPlugin(FlashLight):
    """As :class:`FlashLight`, and the visuals that have the names of the lights."""

    kind = Led


class AttachLight(ModelPlugin):
    """``<link>`` elements with ``<link_name>`` and ``<light>`` elements: ``<light_name>`` of a light of the world, which is carried along
    at ``<pose>`` in the link."""

    def load(self, server, model, sdf) -> None:
        self.world = server.world
        self.held: list[tuple[Any, str, d.Pose]] = []
        if not sdf.has("link"):
            raise PluginError("<link> is missing: give <link_name> and <light> elements")
        for element in sdf.children("link"):
            link = find_link(model, server.world, element, "link_name")
            for light in element.children("light"):
                name = required(light, "light_name")
                if name in server.world.lights:
                    x, y, z, *rpy = light.get("pose", (0.0,) * 6)
                    self.held.append((link, name, d.Pose((x, y, z), math3.quat_from_rpy(*rpy))))
                else:
                    there = ", ".join(server.world.lights) or "none"
                    rospy.logwarn("AttachLightPlugin of model %s: the world has no light '%s'; it has %s", model.name, name, there)
        self.step()
        if self.held:
            server.before_step(self.step)

    def step(self) -> None:
        for link, name, pose in self.held:
            light = self.world.lights.get(name)
            if light is not None:  # it may be deleted while the simulation runs
                pose_W = math3.compose(link.pose, pose)
                if pose_W != light.pose:
                    self.world.lights[name] = replace(light, pose=pose_W)

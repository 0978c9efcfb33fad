"""Descriptions: URDF and SDF that are spawned, worlds that are loaded."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from random import Random

from fuzzing import seeds, worlds, xml_cases
from fuzzing.findings import Found, refused
from fuzzing.kinds import Kind

GROUND = (
    "<sdf version='1.6'><world name='w'><model name='ground'><static>1</static><link name='l'><collision name='c'>"
    "<geometry><plane/></geometry></collision></link></model></world></sdf>"
)


class _XmlKind(Kind):
    snippets = "snippets_sdf.xml"

    def seeds(self) -> list[bytes]:
        raise NotImplementedError

    def load(self, text: bytes):
        """A world with what the text describes in it, None where it was refused."""
        raise NotImplementedError

    def prepare(self) -> None:
        import ode_sim  # noqa: F401  (imported here, shared by all workers)
        import ode_sim_rendering.assets  # noqa: F401

        snippets = Path(__file__).parents[1] / self.snippets
        self._mutator = xml_cases.XmlMutator(self.seeds(), snippets.read_bytes())
        for text in self.seeds():
            self.load(text)  # reads the meshes once for all workers

    def generate(self, random: Random) -> bytes:
        return self._mutator.case(random)

    def smaller(self, case: bytes) -> Iterator[bytes]:
        return xml_cases.smaller(case)

    def run(self, case: bytes) -> None:
        world = self.load(case)
        if world is None:
            return
        worlds.check_messages(world, world.problems, "problems of a description")
        if not worlds.settle(world):
            return
        worlds.check_messages(world, world.messages, "messages of a world")
        worlds.check_replay(world)
        _draw(world)
        worlds.check_end(world)


class WorldKind(_XmlKind):
    """World files, as gzserver loads them."""

    name, suffix = "world", ".world"

    def seeds(self) -> list[bytes]:
        return [
            *seeds.worlds().values(),
            *(b"<sdf version='1.6'><world name='w'>" + _body(text) + b"</world></sdf>" for text in seeds.models().values()),
        ]

    def load(self, text: bytes):
        import ode_sim

        Path("case.world").write_bytes(text)
        file = os.path.abspath("case.world")
        world, _ = refused(lambda: ode_sim.World.load(file, finder=seeds.finder()), ode_sim.DescriptionError)
        return world


class SdfKind(_XmlKind):
    """Models of SDF, spawned beside others."""

    name, suffix = "sdf", ".sdf"
    call = "spawn_sdf"

    def seeds(self) -> list[bytes]:
        return list(seeds.models().values())

    def load(self, text: bytes):
        import ode_sim

        world = ode_sim.World.load(GROUND, finder=seeds.finder())
        world.step(1)
        before = world.save()
        spawn, pose = getattr(world, self.call), ode_sim.Pose((0.0, 0.0, 0.5))
        _, error = refused(lambda: spawn(as_text(text), name="fuzzed", pose=pose), ode_sim.DescriptionError)
        if error is None:
            return world
        if world.save() != before or list(world.models) != ["ground"] or len(world.link_poses) != 1:
            raise Found("left behind", "state differs after a spawn that failed", str(error))
        worlds.check_rays(world)
        worlds.settle(world, 2)
        return None


class UrdfKind(SdfKind):
    """Robots of URDF, spawned beside others."""

    name, suffix, call = "urdf", ".urdf", "spawn_urdf"
    snippets = "snippets_urdf.xml"

    def seeds(self) -> list[bytes]:
        return list(seeds.robots().values())


def as_text(case: bytes) -> str:
    """As the server gets it in a message."""
    return case.decode("utf-8", "surrogateescape")


def _body(text: bytes) -> bytes:
    """What stands in the <sdf> of a file."""
    return text[text.index(b">", text.index(b"<sdf")) + 1 : text.rindex(b"</sdf>")]


def _draw(world) -> None:
    """What a camera would be told to draw: meshes and textures are read, nothing is rendered."""
    from ode_sim_rendering.assets import Assets
    from ode_sim_rendering.scene import describe

    assets = Assets()
    for seen in describe(world).visuals:
        for part in assets.parts(seen.visual, seen.name):
            if part.look.texture:
                assets.texture(part.look.texture, seen.name)
    worlds.check_messages(world, assets.problems, "problems of drawing")

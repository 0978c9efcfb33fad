"""Mesh files, textures and height maps, damaged: read for collisions and for drawing, and put into a world."""

from __future__ import annotations

import base64
import io
import json
import struct
from collections.abc import Iterator
from pathlib import Path
from random import Random

from fuzzing import seeds, values, worlds, xml_cases
from fuzzing.findings import check_message, refused
from fuzzing.kinds import Kind
from fuzzing.kinds.descriptions import GROUND

_LARGEST = 60000  # bytes of a file that cases are made from
_WIDEST = 129  # pixels of a height map: ODE looks at each cell below a ray, and needs 0.4 s for those of 257 x 257
_OBJ = b"""mtllib cube.mtl
o cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
vt 0 0
vt 1 1
vn 0 0 1
usemtl red
f 4/1/1 3/1/1 2/1/1 1/2/1
f 5//1 6//1 7//1 8//1
f 1 2 6 5
f -8 -5 -1 -4
f 2 3 7 6
f 3 4 8 7
"""
_MTL = b"newmtl red\nKd 1 0 0\nKa 1 0 0\nd 0.5\nmap_Kd skin.png\n"


class MeshKind(Kind):
    """STL, DAE, OBJ with MTL, textures, height maps. A case is JSON: ``mesh``, the file to load, and ``files`` in base64."""

    name, suffix = "mesh", ".json"

    def prepare(self) -> None:
        import collada  # noqa: F401
        import ode_sim  # noqa: F401
        import ode_sim.mesh  # noqa: F401
        import ode_sim_rendering.assets  # noqa: F401
        from PIL import Image

        self._files: dict[str, list[bytes]] = {
            kind: [path.read_bytes() for path in seeds.files(kind) if path.stat().st_size < _LARGEST] for kind in (".stl", ".dae", ".png")
        }
        self._files[".obj"], self._files[".mtl"] = [_OBJ], [_MTL]
        self._files[".stl"] += [_ascii_stl(), _ascii_stl().upper(), b" ".join(_ascii_stl().split())]
        self._files[".stl"] += [_solid_binary_stl(), _solid_binary_stl() + b"made by a printer", _solid_binary_stl()[:-70]]
        self._collada = xml_cases.XmlMutator(self._files[".dae"])
        for mode, size, form in (
            ("L", 9, "PNG"),
            ("RGB", 5, "PNG"),
            ("I;16", 9, "PNG"),
            ("RGBA", 8, "PNG"),
            ("RGB", 16, "JPEG"),
            ("P", 8, "GIF"),
            ("L", 17, "TIFF"),
            ("RGB", 8, "BMP"),
        ):
            stream = io.BytesIO()
            Image.new(mode, (size, size)).save(stream, form)
            self._files[".png"].append(stream.getvalue())
        self._terrains = [data for data in self._files[".png"] if max(Image.open(io.BytesIO(data)).size) <= _WIDEST]

    def generate(self, random: Random) -> bytes:
        kind = random.choice((".stl", ".stl", ".dae", ".dae", ".obj", ".obj", ".png"))
        files = {"skin.png": random.choice(self._files[".png"]), "cube.mtl": _MTL}
        if kind == ".dae" and random.random() < 0.6:
            main = self._collada.case(random)
        elif kind == ".png":
            main = values.damaged(random, random.choice(self._terrains), random.choice((0, 1, 1, 2, 4)))
        else:
            main = random.choice(self._files[kind])
            main = self._text_changed(random, main) if kind == ".obj" or main[:5] == b"solid" else main
            if kind != ".obj" or random.random() < 0.2:
                main = values.damaged(random, main, random.choice((1, 1, 2, 5, 20)))
        if random.random() < 0.2:
            files["cube.mtl"] = self._text_changed(random, _MTL)
        elif random.random() < 0.2:
            files["skin.png"] = values.damaged(random, files["skin.png"], random.choice((1, 3)))
        scale = [1.0, 1.0, 1.0] if random.random() < 0.7 else [values.number(random) for _ in range(3)]
        files = {f"fuzzed{kind}": main, **(files if kind != ".png" else {})}
        return json.dumps(
            {
                "mesh": f"fuzzed{kind}",
                "scale": scale,
                "submesh": random.choice(("", "", "", "cube", "x")),
                "files": {name: base64.b64encode(data).decode() for name, data in files.items()},
            }
        ).encode()

    @staticmethod
    def _text_changed(random: Random, data: bytes) -> bytes:
        """Lines of a text format changed."""
        lines = data.decode("latin-1").splitlines()[:400]
        for _ in range(random.choice((1, 1, 2, 4, 10))):
            if not lines:
                break
            i = random.randrange(len(lines))
            change = random.randrange(6)
            if change <= 1:
                lines[i] = values.with_numbers_changed(random, lines[i])
            elif change == 2:
                lines[i] = values.with_tokens_changed(random, lines[i])
            elif change == 3:
                del lines[i]
            elif change == 4:
                lines.insert(random.randrange(len(lines)), lines[i])
            else:
                lines[i] = lines[i].split(" ")[0]
        return "\n".join(lines).encode("utf-8", "replace")

    def run(self, case: bytes) -> None:
        from ode_sim import mesh
        from ode_sim.description.model import DescriptionError

        told = json.loads(case)
        for name, data in told["files"].items():
            Path(Path(name).name).write_bytes(base64.b64decode(data))
        path = str(Path(told["mesh"]).resolve())
        if not path.endswith(".png"):
            surface, _ = refused(lambda: mesh.load_surface(path, tuple(told["scale"]), told["submesh"]), DescriptionError)
            refused(lambda: mesh.load_visual(path, tuple(told["scale"]), told["submesh"], True), DescriptionError)
            if surface is not None:
                refused(lambda: mesh.mass_properties(surface), DescriptionError)
        self._drawn(told, path)
        self._simulated(told, path)

    @staticmethod
    def _drawn(told: dict, path: str) -> None:
        from ode_sim.description import model as d
        from ode_sim_rendering.assets import Assets

        assets = Assets()
        shape = (
            d.Heightmap(path, path, (4.0, 4.0, 1.0)) if path.endswith(".png") else d.Mesh(path, path, tuple(told["scale"]), told["submesh"])
        )
        for part in assets.parts(d.Visual("v", d.Pose(), shape), "m::l::v"):
            if part.look.texture:
                assets.texture(part.look.texture, "m::l::v")
        if path.endswith(".png"):
            assets.texture(path, "m::l::v")
        for line in assets.problems:
            check_message(line, "problems of drawing")

    @staticmethod
    def _simulated(told: dict, path: str) -> None:
        import ode_sim

        scale = " ".join(map(repr, told["scale"]))
        shape = (
            f"<heightmap><uri>{path}</uri><size>4 4 1</size></heightmap>"
            if path.endswith(".png")
            else f"<mesh><uri>{path}</uri><scale>{scale}</scale></mesh>"
        )
        static = "<static>1</static>" if path.endswith(".png") else ""
        world = ode_sim.World.load(GROUND)
        text = (
            f"<sdf version='1.6'><model name='m'>{static}<link name='l'><pose>0 0 0.3 0 0 0</pose><inertial><mass>1</mass>"
            f"</inertial><collision name='c'><geometry>{shape}</geometry></collision></link></model></sdf>"
        )
        _, error = refused(lambda: world.spawn_sdf(text), ode_sim.DescriptionError)
        if error is None:
            worlds.check_messages(world, world.problems, "problems of a mesh")
            worlds.settle(world, 20)
            worlds.check_rays(world)

    def smaller(self, case: bytes) -> Iterator[bytes]:
        told = json.loads(case)
        for name in list(told["files"]):
            if name != told["mesh"]:
                yield _with(told, {key: value for key, value in told["files"].items() if key != name})
        for scale in ([1.0, 1.0, 1.0],):
            yield json.dumps({**told, "scale": scale}).encode()
        for name, data in told["files"].items():
            raw = base64.b64decode(data)
            for candidate in xml_cases.smaller(raw) if name.endswith(".dae") else xml_cases.smaller_bytes(raw):
                yield _with(told, {**told["files"], name: base64.b64encode(candidate).decode()})


def _with(told: dict, files: dict[str, str]) -> bytes:
    return json.dumps({**told, "files": files}).encode()


def _ascii_stl() -> bytes:
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {} 1 {}\nendloop\nendfacet\n"
    return ("solid s\n" + "".join(facet.format(i, i % 3) for i in range(8)) + "endsolid s\n").encode()


def _solid_binary_stl() -> bytes:
    """Binary, though it begins with the word of the text format."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in face for x in corners[corner]), 0) for face in faces)
    return b"solid cone".ljust(80) + struct.pack("<I", len(faces)) + facets

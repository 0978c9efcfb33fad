"""Looks: Gazebo's own material names, and OGRE ``.material`` scripts that a model brings along."""

from __future__ import annotations

import functools
import glob
import math
import os
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import Material, Rgba, TextureUnit

Rgb = tuple[float, float, float]
_BRIGHTEST = 1e6  # of colours, which are 0..1


@dataclass(frozen=True)
class _Look:
    diffuse: Rgb
    ambient: Rgb | None = None  # None: as diffuse
    alpha: float = 1.0
    glows: bool = False
    specular: Rgb = (0.0, 0.0, 0.0)
    shininess: float = 0.0
    texture: str = ""  # file below media/materials/textures; the colour stands in for it when it is not there


_DIM = (0.1, 0.1, 0.1)
_BASE: dict[str, _Look] = {
    "White": _Look((1, 1, 1), specular=_DIM, shininess=128.0),
    "Red": _Look((1, 0, 0), specular=_DIM, shininess=1.0),
    "Green": _Look((0, 1, 0), specular=_DIM, shininess=1.0),
    "Blue": _Look((0, 0, 1), specular=_DIM, shininess=1.0),
    "Yellow": _Look((1, 1, 0)),
    "Purple": _Look((1, 0, 1), specular=_DIM, shininess=1.0),
    "Turquoise": _Look((0, 1, 1), specular=_DIM, shininess=1.0),
}

_LOOKS: dict[str, _Look] = {
    **_BASE,
    **{name + "Glow": replace(look, glows=True) for name, look in _BASE.items() if name != "Red"},
    "RedGlow": _Look((1, 0, 0), glows=True),  # which does not shine beside
    **{name + "Transparent": _Look(_BASE[name].diffuse, alpha=0.5) for name in ("Red", "Green", "Blue", "Yellow")},
    "GreyTransparent": _Look((0.5, 0.5, 0.5), alpha=0.5),
    "BlackTransparent": _Look((0, 0, 0), alpha=0.5),
    "OrangeTransparent": _Look((1, 0.44, 0), alpha=0.4),
    "DarkMagentaTransparent": _Look((0.6, 0, 0.6), alpha=0.5),
    "BlueLaser": _Look((0, 0, 1), alpha=0.4),
    "LightBlueLaser": _Look((0.5, 0.5, 1), alpha=0.4),
    "Grey": _Look((0.7, 0.7, 0.7), ambient=(0.3, 0.3, 0.3), specular=(0.01, 0.01, 0.01), shininess=1.5),
    "DarkGrey": _Look((0.175, 0.175, 0.175), specular=(0.175, 0.175, 0.175), shininess=1.5),
    "Black": _Look((0, 0, 0), specular=_DIM, shininess=5.0),
    "FlatBlack": _Look((0.1, 0.1, 0.1), specular=(0.01, 0.01, 0.01), shininess=1.0),
    "RedBright": _Look((0.87, 0.26, 0.07), specular=(0.87, 0.26, 0.07), shininess=1.0),
    "SkyBlue": _Look((0, 0, 1), ambient=(0.13, 0.44, 0.70), specular=_DIM, shininess=1.0),
    "DarkYellow": _Look((0.7, 0.7, 0)),
    "ZincYellow": _Look((0.9725, 0.9529, 0.2078), specular=(0.9725, 0.9529, 0.2078), shininess=1.0),
    "Orange": _Look((1, 0.5088, 0.0468), specular=(0.5, 0.5, 0.5), shininess=128.0),
    "Indigo": _Look((0.33, 0, 0.5), specular=_DIM, shininess=1.0),
    "Gold": _Look((0.8, 0.6488, 0.1208), ambient=(0.4, 0.2487, 0.0208), specular=(0.4, 0.4, 0.4), shininess=12.5),
    "Pioneer2Body": _Look((0.6812, 0.0009, 0.0009), ambient=(0.4812, 0.0001, 0.0001), specular=(0.5, 0.5, 0.5), shininess=12.5),
    "LightOn": _Look((0, 1, 0), glows=True),
    "LightOff": _Look((1, 0, 0), glows=True),
    # textured ones; the colour is the mean of the texture
    "Wood": _Look((0.62, 0.43, 0.26), specular=(0.2, 0.2, 0.2), shininess=12.5, texture="wood.png"),
    "WoodFloor": _Look((0.55, 0.36, 0.20), texture="wood_floor.png"),
    "WoodPallet": _Look((0.70, 0.55, 0.36), texture="wood_pallet.png"),
    "Bricks": _Look((0.56, 0.30, 0.24), specular=(0.2, 0.2, 0.2), shininess=12.5, texture="bricks.png"),
    "CeilingTiled": _Look((0.82, 0.82, 0.79), texture="ceiling_tiled.png"),
    "PaintedWall": _Look((0.85, 0.83, 0.78), texture="painted_wall.png"),
    "Grass": _Look((0.28, 0.42, 0.18), texture="grass.png"),
    "Steps": _Look((0.55, 0.55, 0.55)),
    "BuildingFrame": _Look((0.5, 0.5, 0.5)),
    "PioneerBody": _Look((0.68, 0.05, 0.05)),
    "CloudySky": _Look((0.55, 0.70, 0.90)),
    "GreyGradientSky": _Look((0.60, 0.62, 0.65)),
    **{
        name: _Look((0.28, 0.28, 0.29), texture=f"{picture}.png")
        for picture, names in {
            "road": ("Road", "Residential", "Tertiary", "Secondary", "Lanes_2"),
            "road_1": ("Lane_1",),
            "road_4": ("Primary", "Lanes_4"),
            "road_6": ("Motorway", "Trunk", "Lanes_6"),
            "runway": ("Runway",),
        }.items()
        for name in names
    },
    **{name: _Look((0.60, 0.60, 0.58)) for name in ("Pedestrian", "Footway")},
}
_LOOKS["Gray"], _LOOKS["DarkGray"] = _LOOKS["Grey"], _LOOKS["DarkGrey"]

NAMES = tuple(sorted("Gazebo/" + name for name in _LOOKS))


def gazebo_material(name: str, finder: ResourceFinder | None = None) -> Material | None:
    """The material ``name``, ``Gazebo/<Colour>`` (case matters), or None if there is no such one. ``finder`` finds its texture."""
    look = _LOOKS.get(name[7:]) if name.startswith("Gazebo/") else None
    if look is None:
        return None
    texture = finder.find("file://media/materials/textures/" + look.texture) if finder and look.texture else None

    def rgba(rgb: Rgb) -> Rgba:
        return (float(rgb[0]), float(rgb[1]), float(rgb[2]), look.alpha)

    diffuse = (1.0, 1.0, 1.0) if texture else look.diffuse
    return Material(
        name,
        ambient=rgba(look.ambient or diffuse),
        diffuse=rgba(diffuse),
        specular=rgba(look.specular),
        emissive=rgba(look.diffuse) if look.glows else None,
        texture=texture or "",
        shininess=look.shininess,
    )


# ---------------------------------------------------------------------------------------------- OGRE scripts

_COMMENT_BEGIN = re.compile(r"//|/\*")
_PIECE = re.compile(r"[{}]|[^\n{}]+")
_FARTHEST_TEXTURE = 1e6  # a scroll or scale beyond it is no number of a texture
_LONGEST_SCRIPT = 4_000_000  # characters; what follows is not read
_MOST_SCRIPTS = 1000  # of a folder
_MOST_PARENTS = 20  # of a material
#: below each resource path, as Gazebo tells OGRE of them: what lies there is known by its name alone
_RESOURCES = ("media/materials/scripts", "", "media/materials/textures", "media/materials/programs", "media/models")


def script_material(name: str, locations: Iterable[str]) -> Material | None:
    """The material ``name`` of the OGRE scripts in ``locations`` (files, or directories to look through).

    The first pass counts, and its first texture unit, whose image is taken from the directories of ``locations``, a ``textures`` folder
    beside them, or the script's own directory. What a material does not say is as its parent has it (``material A : B``). What
    cannot be read as a script has no materials.
    """
    files, folders = _scripts(locations)
    statements: list[list[str]] = []
    known: Material | None = None
    found_in: list[str] = []
    wanted = name
    while wanted and len(found_in) < _MOST_PARENTS:
        found = _find(wanted, files)
        if found is None:
            known = gazebo_material(wanted)
            break
        lines, parent, file = found
        statements += [["material"], *lines]
        found_in.append(os.path.dirname(file))
        wanted = parent
    if not found_in:
        return None
    return _material_of(name, statements, [*dict.fromkeys(found_in), *folders], known)


def resource_material(name: str, finder: ResourceFinder) -> Material | None:
    """The material ``name`` of the scripts on ``finder``'s resource paths (GAZEBO_RESOURCE_PATH, ``gazebo_media_path`` exports)."""
    return script_material(name, [os.path.join(path, folder) for path in finder.resource_paths for folder in _RESOURCES])


def _find(name: str, files: Iterable[str]) -> tuple[list[list[str]], str, str] | None:
    """Statements, parent and file of a material."""
    for file in files:
        try:
            status = os.stat(file)
            text = _script(file, (status.st_mtime_ns, status.st_size))
        except OSError:
            continue
        found = _statements(text, name) if name in text else None
        if found is not None:
            return (*found, file)
    return None


@functools.lru_cache(maxsize=256)
def _script(file: str, stamp: tuple[int, int]) -> str:
    with open(file, encoding="utf-8", errors="replace") as stream:
        return stream.read(_LONGEST_SCRIPT)


def _scripts(locations: Iterable[str]) -> tuple[list[str], list[str]]:
    """(files, folders to find textures in)"""
    files: list[str] = []
    folders: list[str] = []
    for location in locations:
        if os.path.isdir(location):
            files += sorted(glob.glob(os.path.join(glob.escape(location), "*.material")))[:_MOST_SCRIPTS]
            folders += [location, os.path.join(os.path.dirname(location), "textures")]
        elif os.path.isfile(location):
            files.append(location)
            folder = os.path.dirname(location)
            folders += [folder, os.path.join(os.path.dirname(folder), "textures")]
    return files, folders


def _without_comments(text: str) -> str:
    pieces, at = [], 0
    unclosed = False
    for match in _COMMENT_BEGIN.finditer(text):
        line = match.group() == "//"
        if match.start() < at or (unclosed and not line):
            continue  # inside of the one before; or does not end either
        end = text.find("\n" if line else "*/", match.end())
        if end < 0 and not line:
            unclosed = True
            continue
        pieces.append(text[at : match.start()])
        at = len(text) if end < 0 else end if line else end + 2
    return "".join(pieces) + text[at:]


def _statements(text: str, name: str) -> tuple[list[list[str]], str] | None:
    """The lines inside ``material <name> { ... }``, each split into words, and the name of its parent; None if there is no such."""
    parent = ""
    depth = 0
    found: list[list[str]] | None = None
    header: list[str] = []  # words since the last statement outside of all braces
    for piece in _PIECE.findall(_without_comments(text)):
        if piece == "{":
            if depth == 0 and found is None and _begins(header, name):
                found, parent = [], " ".join(header[1:])[len(name) :].lstrip(" :")
            depth, header = depth + 1, []
        elif piece == "}":
            depth = max(0, depth - 1)
            if depth == 0 and found is not None:
                return found, parent
            header = []
        elif piece.strip():
            words = piece.replace('"', "").split()
            if found is not None:
                found.append(words)
            elif depth == 0:
                header = words
    return None if found is None else (found, parent)


def _begins(header: list[str], name: str) -> bool:
    """Whether this is ``material <name>``, which may be followed by ``: <parent>``."""
    rest = " ".join(header[1:])
    return header[:1] == ["material"] and rest.startswith(name) and rest[len(name) :].lstrip()[:1] in ("", ":")


def _material_of(name: str, statements: list[list[str]], folders: list[str], parent: Material | None) -> Material:
    """:param statements: its own, then those of its parents. :param parent: of the last of these, one that no script has."""
    variables: dict[str, list[str]] = {}
    for words in statements:
        if words[0] == "set" and len(words) > 2:
            variables.setdefault(words[1], words[2:])
    colours: dict[str, Rgba] = {}
    texture, shininess = "", 0.0
    unit, units, passes = _Unit(), 0, 0  # the first texture unit, and how many have begun in this material
    said: dict[str, list[str]] = {}  # by the first pass
    for words in statements:
        key, values = words[0], [value for word in words[1:] for value in variables.get(word, [word])]
        if key in ("ambient", "diffuse", "specular", "emissive") and key not in colours:
            try:
                numbers = [float(value) for value in values]
            except ValueError:
                continue  # 'vertexcolour' and the like
            if len(numbers) >= 3 and all(abs(value) <= _BRIGHTEST for value in numbers):
                alpha = numbers[3] if key == "diffuse" and len(numbers) > 3 else 1.0
                colours[key] = (numbers[0], numbers[1], numbers[2], alpha)
                if key == "specular" and len(numbers) > 3:  # the last one is the exponent
                    shininess = numbers[-1]
        elif key == "material":
            passes = units = 0
        elif key == "pass":
            passes += 1
        elif key == "texture_unit":
            units += 1
        elif key == "texture" and values and not texture:
            places = [os.path.join(folder, values[0]) for folder in folders]
            found = [place for place in places if os.path.isfile(place)]
            texture = os.path.abspath(found[0]) if found else ""
        elif passes == 1 and values and not (units == 1 and unit.take(key, values)):
            said.setdefault(key, values)
    own: dict[str, Any] = dict(colours)
    if unit.said:
        own["texture_unit"] = unit.made()
    if "lighting" in said:
        own["lighting"] = said["lighting"] != ["off"]
    if "alpha_rejection" in said:
        own["alpha_above"] = _alpha_above(said["alpha_rejection"])
    if parent is None or "scene_blend" in said:
        own["blend"] = _BLENDS.get(" ".join(said.get("scene_blend", [])), "replace")
    if parent is not None:
        shininess = shininess if "specular" in colours else parent.shininess
        return replace(parent, name=name, texture=texture or parent.texture, shininess=shininess, **own)
    return Material(name, texture=texture, shininess=shininess, **own)


#: OGRE's names of a scene_blend, the short and the long ones.
_BLENDS = {
    **{name: name for name in ("alpha_blend", "add", "modulate", "colour_blend")},
    "src_alpha one_minus_src_alpha": "alpha_blend",
    "one one": "add",
    "dest_colour zero": "modulate",
    "src_colour one_minus_src_colour": "colour_blend",
}


def _alpha_above(words: list[str]) -> float | None:
    """Of an ``alpha_rejection``: the alpha 0..1 that drawn pixels are above; None: all are drawn."""
    try:
        value = float(words[1]) / 255.0
    except (IndexError, ValueError):
        value = 0.0
    if not 0.0 <= value <= 1.0:
        return None
    return {"greater": value, "greater_equal": value - 0.5 / 255.0}.get(words[0])


class _Unit:
    """What a texture unit says of its image's place."""

    def __init__(self) -> None:
        self.said: dict[str, list[str]] = {}

    def take(self, key: str, values: list[str]) -> bool:
        """Whether a statement is one of a unit's; the first of a kind counts."""
        own = key in ("scale", "scroll", "rotate", "tex_address_mode", "filtering")
        if own:
            self.said.setdefault(key, values)
        return own

    def _numbers(self, key: str, default: tuple[float, ...]) -> tuple[float, ...]:
        try:
            numbers = tuple(float(word) for word in self.said.get(key, ())[: len(default)])
        except ValueError:
            return default
        return numbers if len(numbers) == len(default) and all(abs(value) <= _FARTHEST_TEXTURE for value in numbers) else default

    def made(self) -> TextureUnit:
        """As OGRE 1.9 does it: the coordinates are scaled about the middle of the image, moved, and turned about it (degrees)."""
        (wide, high), (along, down), (angle,) = (
            self._numbers("scale", (1.0, 1.0)),
            self._numbers("scroll", (0.0, 0.0)),
            self._numbers("rotate", (0.0,)),
        )
        scale_u, scale_v = 1.0 / (wide or 1.0), 1.0 / (high or 1.0)
        cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        left, top = 0.5 - 0.5 * scale_u + along - 0.5, 0.5 - 0.5 * scale_v + down - 0.5  # from the middle
        address = self.said.get("tex_address_mode", ["wrap"])[0]
        return TextureUnit(
            (cos * scale_u, -sin * scale_v, cos * left - sin * top + 0.5, sin * scale_u, cos * scale_v, sin * left + cos * top + 0.5),
            address if address in ("mirror", "clamp", "border") else "wrap",
            self.said.get("filtering", ["bilinear"])[0] not in ("none", "point"),
        )

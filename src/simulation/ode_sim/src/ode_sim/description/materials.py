"""Looks: Gazebo's own material names, and OGRE ``.material`` scripts that a model brings along."""
from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterable, List, Optional, Tuple

from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import Material, Rgba

Rgb = Tuple[float, float, float]


@dataclass(frozen=True)
class _Look:
    diffuse: Rgb
    ambient: Optional[Rgb] = None  # None: as diffuse
    alpha: float = 1.0
    glows: bool = False
    specular: Rgb = (0.0, 0.0, 0.0)
    texture: str = ""  # file below media/materials/textures; the colour stands in for it when it is not there


_BASE: Dict[str, Rgb] = {
    "White": (1, 1, 1), "Red": (1, 0, 0), "Green": (0, 1, 0), "Blue": (0, 0, 1), "Yellow": (1, 1, 0),
    "Purple": (1, 0, 1), "Turquoise": (0, 1, 1),
}

_LOOKS: Dict[str, _Look] = {
    **{name: _Look(rgb) for name, rgb in _BASE.items()},
    **{name + "Glow": _Look(rgb, glows=True) for name, rgb in _BASE.items()},
    **{name + "Transparent": _Look(_BASE[name], alpha=0.5) for name in ("Red", "Green", "Blue", "Yellow")},
    "GreyTransparent": _Look((0.5, 0.5, 0.5), alpha=0.5),
    "BlackTransparent": _Look((0, 0, 0), alpha=0.5),
    "OrangeTransparent": _Look((1, 0.44, 0), alpha=0.4),
    "DarkMagentaTransparent": _Look((0.6, 0, 0.6), alpha=0.5),
    "BlueLaser": _Look((0, 0, 1), alpha=0.4),
    "LightBlueLaser": _Look((0.5, 0.5, 1), alpha=0.4),
    "Grey": _Look((0.7, 0.7, 0.7), ambient=(0.3, 0.3, 0.3), specular=(0.01, 0.01, 0.01)),
    "DarkGrey": _Look((0.175, 0.175, 0.175), specular=(0.01, 0.01, 0.01)),
    "Black": _Look((0, 0, 0)),
    "FlatBlack": _Look((0.1, 0.1, 0.1), specular=(0.01, 0.01, 0.01)),
    "RedBright": _Look((0.87, 0.26, 0.07)),
    "SkyBlue": _Look((0, 0, 1), ambient=(0.13, 0.44, 0.70)),
    "DarkYellow": _Look((0.7, 0.7, 0)),
    "ZincYellow": _Look((0.9725, 0.9529, 0.2078)),
    "Orange": _Look((1, 0.5088, 0.0468)),
    "Indigo": _Look((0.33, 0, 0.5)),
    "Gold": _Look((0.8, 0.6488, 0.1208), ambient=(0.4, 0.2487, 0.0208)),
    "Pioneer2Body": _Look((0.6812, 0.0009, 0.0009)),
    "LightOn": _Look((0, 1, 0), glows=True),
    "LightOff": _Look((1, 0, 0), glows=True),
    # textured ones; the colour is the mean of the texture
    "Wood": _Look((0.62, 0.43, 0.26), texture="wood.png"),
    "WoodFloor": _Look((0.55, 0.36, 0.20), texture="wood_floor.png"),
    "WoodPallet": _Look((0.70, 0.55, 0.36), texture="wood_pallet.png"),
    "Bricks": _Look((0.56, 0.30, 0.24), texture="bricks.png"),
    "CeilingTiled": _Look((0.82, 0.82, 0.79), texture="ceiling_tiled.png"),
    "PaintedWall": _Look((0.85, 0.83, 0.78), texture="painted_wall.png"),
    "Grass": _Look((0.28, 0.42, 0.18), texture="grass.png"),
    "Steps": _Look((0.55, 0.55, 0.55)),
    "BuildingFrame": _Look((0.5, 0.5, 0.5)),
    "PioneerBody": _Look((0.68, 0.05, 0.05)),
    "CloudySky": _Look((0.55, 0.70, 0.90)),
    "GreyGradientSky": _Look((0.60, 0.62, 0.65)),
    **{name: _Look((0.28, 0.28, 0.29), texture="road.png") for name in (
        "Road", "Residential", "Tertiary", "Primary", "Secondary", "Motorway", "Trunk", "Lane_1", "Lanes_2",
        "Lanes_4", "Lanes_6", "Runway")},
    **{name: _Look((0.60, 0.60, 0.58)) for name in ("Pedestrian", "Footway")},
}
_LOOKS["Gray"], _LOOKS["DarkGray"] = _LOOKS["Grey"], _LOOKS["DarkGrey"]

NAMES = tuple(sorted("Gazebo/" + name for name in _LOOKS))


def gazebo_material(name: str, finder: Optional[ResourceFinder] = None) -> Optional[Material]:
    """The material ``Gazebo/<Colour>`` (case matters), or None if there is no such name."""
    look = _LOOKS.get(name[7:]) if name.startswith("Gazebo/") else None
    if look is None:
        return None
    texture = finder.find("file://media/materials/textures/" + look.texture) if finder and look.texture else None

    def rgba(rgb: Rgb) -> Rgba:
        return (float(rgb[0]), float(rgb[1]), float(rgb[2]), look.alpha)

    diffuse = (1.0, 1.0, 1.0) if texture else look.diffuse
    return Material(name, ambient=rgba(look.ambient or diffuse), diffuse=rgba(diffuse), specular=rgba(look.specular),
                    emissive=rgba(look.diffuse) if look.glows else None, texture=texture or "")


# ---------------------------------------------------------------------------------------------- OGRE scripts

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def script_material(name: str, locations: Iterable[str]) -> Optional[Material]:
    """The material ``name`` of the OGRE scripts in ``locations`` (files, or directories to look through).

    The first pass counts; of a texture unit only the image is taken, from the directories of ``locations``, a
    ``textures`` folder beside them, or the script's own directory.
    """
    files, folders = _scripts(locations)
    for file in files:
        statements = _statements(file.read_text(encoding="utf-8", errors="replace"), name)
        if statements is not None:
            return _material_of(name, statements, [file.parent] + folders)
    return None


def _scripts(locations: Iterable[str]) -> Tuple[List[Path], List[Path]]:
    files: List[Path] = []
    folders: List[Path] = []
    for location in locations:
        path = Path(location)
        if path.is_dir():
            files += sorted(path.glob("*.material"))
            folders += [path, path.parent / "textures"]
        elif path.is_file():
            files.append(path)
            folders += [path.parent, path.parent.parent / "textures"]
    return files, folders


def _statements(text: str, name: str) -> Optional[List[List[str]]]:
    """The lines inside ``material <name> { ... }``, each split into words; None if the script has no such material."""
    text = _COMMENT.sub("", text)
    start = re.search(rf'^\s*material\s+"?{re.escape(name)}"?\s*(?::[^\n{{]*)?\s*\{{', text, re.MULTILINE)
    if start is None:
        return None
    depth, end = 1, start.end()
    while depth and end < len(text):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
    lines = re.split(r"[\n{}]", text[start.end():end])
    return [words for words in (line.replace('"', "").split() for line in lines) if words]


def _material_of(name: str, statements: List[List[str]], folders: List[Path]) -> Material:
    colours: Dict[str, Rgba] = {}
    texture = ""
    for words in statements:
        key, values = words[0], words[1:]
        if key in ("ambient", "diffuse", "specular", "emissive") and key not in colours:
            try:
                numbers = [float(value) for value in values]
            except ValueError:
                continue  # 'vertexcolour' and the like
            if len(numbers) >= 3:
                alpha = numbers[3] if key == "diffuse" and len(numbers) > 3 else 1.0
                colours[key] = (numbers[0], numbers[1], numbers[2], alpha)
        elif key == "texture" and values and not texture:
            found = [folder / values[0] for folder in folders if (folder / values[0]).is_file()]
            texture = os.path.abspath(found[0]) if found else ""
    return Material(name, texture=texture, **colours)

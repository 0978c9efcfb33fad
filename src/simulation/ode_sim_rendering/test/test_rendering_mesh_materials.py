"""Materials that mesh files bring along, beside pictures of a real Gazebo 11.1 (Debian 11, software OpenGL) of the same balls."""

import re

import numpy as np
import pytest
from pictures import renderer  # noqa: F401
from test_rendering_gazebo import SUN, material, seen, visual

STEPS = 16
COLLADA = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/>
<up_axis>Z_UP</up_axis></asset><library_effects><effect id="e"><profile_COMMON><technique sid="c">{look}</technique></profile_COMMON>
</effect></library_effects><library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>{points}{normals}<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{count}" material="mm"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/>
<p>{triangles}</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="nd">
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="mm" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
SOURCE = """<source id="{0}"><float_array id="{0}a" count="{1}">{2}</float_array><technique_common>
<accessor source="#{0}a" count="{3}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>"""
PHONG = (
    "<{0}><emission><color>0 0 0 1</color></emission><ambient><color>0.1 0.1 0.3 1</color></ambient><diffuse><color>0.2 0.2 0.7 1</color>"
    "</diffuse><specular><color>0.8 0.8 0.8 1</color></specular><shininess><float>40</float></shininess></{0}>"
)
LAMBERT = (
    "<lambert><emission><color>0.1 0 0 1</color></emission><ambient><color>0.2 0.1 0 1</color></ambient>"
    "<diffuse><color>0.7 0.5 0.1 1</color></diffuse></lambert>"
)
MTL = """newmtl shiny\nKa 0.1 0.1 0.1\nKd 0.2 0.5 0.2\nKs 0.9 0.9 0.9\nNs 50
newmtl dull\nKa 0 0 0\nKd 0.6 0.2 0.2\nKs 0 0 0\nNs 10
newmtl noka\nKd 0.6 0.2 0.2
newmtl kaonly\nKa 0.3 0.3 0.6\nKd 0.2 0.2 0.2\nKs 0.5 0.5 0.5\n"""


def ball():
    """Unit vectors (n, 3) over a sphere, and its triangles (m, 3)."""
    theta, phi = np.meshgrid(np.pi * np.arange(STEPS + 1) / STEPS, np.pi * np.arange(2 * STEPS) / STEPS, indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1).reshape(-1, 3)

    def at(i, j):
        return i * 2 * STEPS + j % (2 * STEPS)

    i, j = (grid.ravel() for grid in np.mgrid[0:STEPS, 0 : 2 * STEPS])
    upper, lower = (at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))
    return points, np.stack([np.column_stack(upper), np.column_stack(lower)], axis=1).reshape(-1, 3)


def collada(look):
    points, corners = ball()

    def source(name, values):
        return SOURCE.format(name, values.size, " ".join(f"{v:f}" for v in values.ravel()), len(values))

    text = " ".join(f"{corner} {corner}" for corner in corners.ravel())
    return COLLADA.format(look=look, points=source("p", points / 2), normals=source("n", points), count=len(corners), triangles=text)


def wavefront(name):
    points, corners = ball()
    lines = [f"v {x:f} {y:f} {z:f}" for x, y, z in points / 2] + [f"vn {x:f} {y:f} {z:f}" for x, y, z in points]
    faces = ["f " + " ".join(f"{corner}//{corner}" for corner in three) for three in corners + 1]
    return "\n".join(["mtllib m.mtl", *lines, f"usemtl {name}", *faces]) + "\n"


def without(tag, look):
    return re.sub(f"<{tag}>.*?</{tag}>", "", look)


BLACK = "<ambient><color>0 0 0 1</color></ambient>"
FILES = {
    "shiny.obj": wavefront("shiny"),
    "dull.obj": wavefront("dull"),
    "noka.obj": wavefront("noka"),
    "kaonly.obj": wavefront("kaonly"),
    "m.mtl": MTL,
    "phong.dae": collada(PHONG.format("phong")),
    "blinn.dae": collada(PHONG.format("blinn")),
    "nosh.dae": collada(without("shininess", PHONG.format("phong"))),
    "lambert.dae": collada(LAMBERT),
    "noamb.dae": collada(without("ambient", LAMBERT)),
    "black.dae": collada(without("emission", LAMBERT).replace("<ambient><color>0.2 0.1 0 1</color></ambient>", BLACK)),
}
YELLOW = material(ambient="1 1 0", diffuse="1 1 0")
# file, material of the visual, place (0-7: from the left, then above), pixels of real Gazebo: row -> red, green, blue
REAL = (
    ("shiny.obj", "", 0, {132: (64, 102, 64), 138: (35, 53, 35), 150: (10, 10, 10)}),
    ("dull.obj", "", 1, {132: (73, 24, 24), 138: (33, 11, 11), 150: (0, 0, 0)}),
    ("phong.dae", "", 3, {132: (182, 182, 255), 138: (46, 46, 92), 150: (10, 10, 31)}),
    ("blinn.dae", "", 3, {132: (182, 182, 255), 150: (10, 10, 31)}),
    ("lambert.dae", "", 4, {58: (114, 59, 10), 64: (64, 23, 3), 76: (46, 10, 0)}),
    ("phong.dae", YELLOW, 5, {58: (188, 188, 0), 76: (102, 102, 0)}),
    ("lambert.dae", material(script="Gazebo/Red"), 7, {58: (215, 25, 25), 64: (137, 23, 23), 76: (102, 0, 0)}),
    ("noamb.dae", "", 0, {132: (155, 104, 54), 150: (66, 41, 41)}),
    ("black.dae", "", 2, {132: (124, 100, 53), 150: (41, 41, 41)}),
    ("noka.obj", "", 4, {58: (58, 19, 19), 64: (15, 5, 5), 76: (0, 0, 0)}),
    ("kaonly.obj", "", 5, {58: (173, 173, 204), 64: (150, 150, 180), 76: (31, 31, 61)}),
    ("nosh.dae", "", 6, {58: (27, 27, 88), 76: (10, 10, 31)}),
)
COLUMNS = (28, 116, 203, 291)  # of the picture, in the middle of each ball


@pytest.mark.parametrize("name, look, place, pixels", REAL)
def test_pixels_are_those_of_gazebo(renderer, tmp_path, name, look, place, pixels):  # noqa: F811
    for file in (name, "m.mtl"):
        (tmp_path / file).write_text(FILES[file])
    mesh = f"<mesh><uri>file://{tmp_path}/{name}</uri></mesh>"
    pose = f"6 {2.7 - 1.8 * (place % 4):.1f} {0.5 + 1.5 * (place // 4)} 0 0 0"
    picture = seen(renderer, SUN.format("1 1 1 1") + visual("ball", mesh, pose, look))["color"]
    for row, colour in pixels.items():
        assert picture[row, COLUMNS[place % 4]].tolist() == pytest.approx(colour, abs=2), row

"""Textures beside those of a real Gazebo 11.1 (Debian 11, its OGRE on software OpenGL), of the same worlds and scripts."""

import math

import numpy as np
import pytest
from pictures import renderer  # noqa: F401
from PIL import Image
from test_rendering_gazebo import BALL, BOX, seen, visual

CYLINDER = "<cylinder><radius>0.5</radius><length>1</length></cylinder>"
WALL = "<plane><normal>-1 0 0</normal><size>1 1</size></plane>"
SUN = (
    '<light name="sun" type="directional"><pose>0 0 10 0 0 0</pose><diffuse>0.8 0.8 0.8 1</diffuse><specular>{}</specular>'
    "<direction>{}</direction><cast_shadows>0</cast_shadows></light>"
)
HIGH, LOW = "-0.5 0.1 -0.9", "0.8 0.1 -0.4"  # the first leaves what is seen in the shade
LIT = "ambient 0.8 0.8 0.8 1\ndiffuse 1 1 1 1\nspecular 0 0 0 1 1"
IMAGE = "texture_unit\n{{\ntexture {}\n{}\n}}"
HALF = "tex_address_mode {}\nscale 0.5 0.5"
SCRIPTS = {
    "plain": f"{LIT}\n{IMAGE.format('tex.png', '')}",
    "scale": f"{LIT}\n{IMAGE.format('tex.png', 'scale 0.5 0.5')}",
    "scroll": f"{LIT}\n{IMAGE.format('tex.png', 'scroll 0.25 0.1')}",
    "rotate": f"{LIT}\n{IMAGE.format('tex.png', 'rotate 30')}",
    "clamp": f"{LIT}\n{IMAGE.format('tex.png', HALF.format('clamp'))}",
    "mirror": f"{LIT}\n{IMAGE.format('tex.png', HALF.format('mirror'))}",
    "near": f"{LIT}\n{IMAGE.format('tex.png', 'filtering none')}",
    "npot": f"{LIT}\n{IMAGE.format('tex_npot.png', '')}",
    "dark": "ambient 0.2 0.2 0.2 1\ndiffuse 0.5 0.3 0.3 1\n" + IMAGE.format("tex.png", ""),
    "nolight": f"lighting off\n{IMAGE.format('tex.png', '')}",
    "nolight_diffuse": f"lighting off\ndiffuse 0.5 0 0 1\n{IMAGE.format('tex.png', '')}",
    "off_red": "lighting off\nambient 0 0 0 1\ndiffuse 1 0 0 1",
    "off_glow": "lighting off\nambient 0 0 0 1\ndiffuse 1 0 0 1\nemissive 0 0 0.5 1",
    "glow": "ambient 0 0 0 1\ndiffuse 0.2 0.2 0.2 1\nemissive 0.5 0.5 0.5 1\n" + IMAGE.format("tex.png", ""),
    "opaque": f"{LIT}\n{IMAGE.format('tex_alpha.png', '')}",
    "alpha": f"{LIT}\nscene_blend alpha_blend\ndepth_write off\n{IMAGE.format('tex_alpha.png', '')}",
    "reject": f"{LIT}\nalpha_rejection greater 128\n{IMAGE.format('tex_alpha.png', '')}",
    "half": "ambient 0.8 0.8 0.8 0.5\ndiffuse 1 1 1 0.5\nscene_blend alpha_blend\ndepth_write off",
    "half_opaque": "ambient 0.8 0.8 0.8 0.5\ndiffuse 1 1 1 0.5",
    "add": f"{LIT}\nscene_blend add\ndepth_write off\n{IMAGE.format('tex.png', '')}",
    "late": IMAGE.format("tex.png", "") + "\nlighting off",  # after the unit, and of the first pass
    "passes": f"{LIT}\n{IMAGE.format('tex.png', '')}\n}}\npass\n{{\nscene_blend add\nlighting off\n"
    + IMAGE.format("tex.png", "scale 0.5 0.5"),
    "uv": f"lighting off\n{IMAGE.format('uv.png', 'filtering none')}",
}
UNLIT = "<material><lighting>0</lighting><ambient>0.3 0 0 1</ambient><diffuse>1 0.5 0 1</diffuse></material>"
MTL = "newmtl {0}\nKa 0 0 0\nKs 0 0 0\n{1}\n"
#: a square that faces -x, its image upright for who looks along x
OBJ = """mtllib q.mtl
v 0 -0.5 -0.5
v 0 0.5 -0.5
v 0 0.5 0.5
v 0 -0.5 0.5
vt 1 0
vt 0 0
vt 0 1
vt 1 1
vn -1 0 0
usemtl {}
f 1/1/1 4/4/1 3/3/1
f 1/1/1 3/3/1 2/2/1
"""
MATERIALS = {
    "white": "Kd 1 1 1\nmap_Kd tex.png",
    "dim": "Kd 0.5 0.5 0.2\nmap_Kd tex.png",
    "holes": "Kd 1 1 1\nmap_Kd tex_alpha.png",
    "thin": "Kd 1 1 1\nd 0.4\nmap_Kd tex.png",
    "glows": "Kd 0 0 0\nKe 0.5 0.2 0",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Pictures of four colours with a white corner at the upper left and a black mark at the middle of the lower edge."""
    made = tmp_path_factory.mktemp("media")
    pixels = np.zeros((64, 64, 4), np.uint8)
    pixels[:32, :32], pixels[:32, 32:] = (220, 40, 40, 255), (40, 200, 40, 255)
    pixels[32:, :32], pixels[32:, 32:] = (40, 60, 220, 255), (220, 210, 40, 255)
    pixels[:12, :12], pixels[52:, 26:38] = 255, (0, 0, 0, 255)
    image = Image.fromarray(pixels[..., :3])
    image.save(made / "tex.png")
    image.resize((50, 30)).save(made / "tex_npot.png")
    row, column = np.mgrid[:64, :64]
    pixels[(row - 32) ** 2 + (column - 32) ** 2 < 100] = (255, 0, 255, 0)
    Image.fromarray(pixels).save(made / "tex_alpha.png")
    row, column = np.mgrid[:256, :256]
    Image.fromarray(np.stack([column, row, 0 * row], -1).astype(np.uint8)).save(made / "uv.png")
    scripts = (f"material T/{name}\n{{\ntechnique\n{{\npass\n{{\n{body}\n}}\n}}\n}}\n" for name, body in SCRIPTS.items())
    (made / "t.material").write_text("".join(scripts))
    (made / "q.mtl").write_text("".join(MTL.format(*entry) for entry in MATERIALS.items()))
    for name in MATERIALS:
        (made / f"{name}.obj").write_text(OBJ.format(name))
    return made


def picture(renderer, models, sun=HIGH):  # noqa: F811
    drawn = seen(renderer, SUN.format("0.2 0.2 0.2 1", sun) + models)["color"]
    assert renderer.take_problems() == []
    return drawn


def script(folder, name):
    return f"<material><script><uri>file://{folder}</uri><name>T/{name}</name></script></material>"


def mesh(folder, name):
    return f"<mesh><uri>file://{folder}/{name}.obj</uri></mesh>"


#: what stands at place i of a row of four and another above it: (shape, look), and pixels (row, column) of the real picture
SHADED = {
    (BOX, "plain"): [(0, {(151, 10): (70, 13, 13), (141, 32): (13, 64, 13), (173, 32): (70, 67, 13), (175, 16): (0, 0, 0)})],
    (BALL, "plain"): [(1, {(151, 106): (13, 64, 13)})],
    (CYLINDER, "plain"): [(2, {(151, 202): (70, 67, 13), (167, 191): (13, 64, 13)})],
    (WALL, "plain"): [(3, {(141, 287): (178, 178, 178)})],  # its normal does not count
    (BOX, "scale"): [(0, {(151, 10): (70, 13, 13), (141, 32): (13, 19, 70), (173, 32): (82, 82, 82)})],
    (BOX, "scroll"): [(1, {(141, 96): (70, 13, 13), (173, 128): (13, 19, 70), (154, 109): (70, 67, 13)})],
    (BOX, "rotate"): [(2, {(151, 202): (70, 13, 13), (141, 223): (13, 64, 13), (175, 207): (13, 19, 70)})],
    (BOX, "clamp"): [(3, {(151, 298): (70, 13, 13), (141, 287): (82, 82, 82), (167, 287): (13, 19, 70), (175, 303): (0, 0, 0)})],
    (BOX, "near"): [(4, {(72, 10): (70, 13, 13), (61, 32): (13, 64, 13), (93, 32): (70, 67, 13), (96, 16): (0, 0, 0)})],
    (BOX, "npot"): [(5, {(72, 106): (70, 13, 13), (61, 128): (13, 64, 13), (88, 96): (13, 19, 70), (93, 128): (70, 67, 13)})],
    (BOX, "dark"): [(6, {(72, 202): (18, 3, 3), (61, 223): (3, 16, 3), (88, 191): (3, 5, 18), (93, 223): (18, 17, 3)})],
    (BOX, "nolight"): [(7, {(72, 298): (220, 40, 40), (88, 287): (40, 60, 220), (96, 303): (0, 0, 0)})],
    (BOX, "alpha"): [(0, {(141, 32): (13, 64, 13), (173, 32): (70, 67, 13), (154, 13): (178, 178, 178), (175, 16): (0, 0, 0)})],
    (BOX, "reject"): [(1, {(141, 128): (13, 64, 13), (167, 96): (13, 19, 70), (154, 109): (178, 178, 178)})],
    (BOX, "mirror"): [(2, {(151, 202): (70, 13, 13), (141, 191): (82, 82, 82), (141, 223): (13, 64, 13), (167, 191): (13, 19, 70)})],
    ("white", "plain"): [(6, {(72, 202): (70, 13, 13), (61, 223): (13, 64, 13), (88, 191): (13, 19, 70), (93, 223): (70, 67, 13)})],
}
LIGHTED = {
    (BOX, "off_red"): [(0, {(151, 10): (255, 255, 255)})],
    (BOX, "off_glow"): [(1, {(151, 106): (255, 255, 255)})],
    (BOX, "glow"): [(2, {(151, 202): (141, 26, 26), (141, 223): (26, 128, 26), (167, 191): (26, 39, 141)})],
    (BOX, "opaque"): [(4, {(61, 32): (41, 206, 41), (93, 32): (227, 217, 41), (74, 13): (255, 0, 255), (96, 16): (0, 0, 0)})],
    (BOX, "half"): [(6, {(72, 202): (217, 217, 217)})],
    (BOX, "half_opaque"): [(7, {(72, 298): (255, 255, 255)})],
    (BOX, "add"): [(0, {(151, 10): (255, 219, 219), (141, 32): (219, 255, 219), (175, 16): (178, 178, 178)})],
    (BOX, "nolight_diffuse"): [(1, {(151, 106): (220, 40, 40), (141, 128): (40, 200, 40), (167, 96): (40, 60, 220)})],
    (BOX, UNLIT): [(2, {(151, 202): (255, 255, 255)})],
    ("white", ""): [(0, {(151, 10): (156, 28, 28), (141, 32): (28, 142, 28)})],
    ("holes", ""): [(1, {(151, 106): (156, 28, 28), (141, 128): (28, 142, 28), (154, 109): (156, 6, 171)})],
    ("thin", ""): [(6, {(72, 202): (169, 118, 118), (61, 223): (118, 164, 118), (88, 191): (118, 124, 169)})],
    ("glows", ""): [(7, {(72, 298): (128, 51, 0)})],
    ("dim", ""): [(5, {(72, 106): (78, 14, 6), (61, 96): (91, 91, 36), (61, 128): (14, 71, 6), (88, 96): (14, 21, 31)})],
    ("white", UNLIT): [(6, {(72, 202): (255, 255, 255)})],
}
CASES = [(HIGH, *case, *place) for case, places in SHADED.items() for place in places] + [
    (LOW, *case, *place) for case, places in LIGHTED.items() for place in places
]


@pytest.mark.parametrize("sun, shape, look, place, wanted", CASES, ids=lambda value: "" if isinstance(value, dict) else str(value)[:12])
def test_colours_are_those_of_a_real_gazebo(renderer, folder, sun, shape, look, place, wanted):  # noqa: F811
    material = look if look.startswith("<") or not look else script(folder, look)
    solid = shape if shape.startswith("<") else mesh(folder, shape)
    at = f"6 {2.7 - 1.8 * (place % 4)} {0.5 + 1.5 * (place // 4)} 0 0 0"
    drawn = picture(renderer, visual("m", solid, at, material), sun)
    for pixel, colour in wanted.items():
        np.testing.assert_allclose(drawn[pixel].astype(int), colour, atol=3, err_msg=str(pixel))


H = math.pi / 2
#: each side in turn towards the camera: -x, +x, +y, -y, +z, -z
TURNS = ("0 0 0", f"0 0 {math.pi}", f"0 0 {H}", f"0 0 {-H}", f"0 {-H} 0", f"0 {H} 0")
AROUND = ((0, 0), (0.3, 0), (-0.3, 0), (0, 0.3), (0, -0.3))  # m to the left and upwards of the middle
#: texture coordinates, v downwards, of those places in the real pictures; None: on a seam
BOXES = [((0.5, 0.5), (0.2, 0.5), (0.8, 0.5), (0.5, 0.2), (0.5, 0.8))] * 6
BALLS = [
    ((0.75, 0.50), (0.75, 0.29), (0.75, 0.71), (0.85, 0.50), (0.65, 0.50)),
    ((0.25, 0.50), (0.25, 0.71), (0.25, 0.29), (0.15, 0.50), (0.35, 0.50)),
    (None, (0.25, 0.20), (0.75, 0.21), None, (0.50, 0.20)),
    (None, (0.75, 0.79), (0.25, 0.80), None, (0.50, 0.80)),
    (None, None, None, (0.10, 0.50), (0.90, 0.50)),
    ((0.50, 0.50), (0.50, 0.29), (0.50, 0.71), (0.60, 0.50), (0.40, 0.50)),
]
CYLINDERS = [
    ((0.75, 0.50), (0.85, 0.50), (0.65, 0.50), (0.75, 0.80), (0.75, 0.20)),
    ((0.25, 0.50), (0.35, 0.50), (0.15, 0.50), (0.25, 0.80), (0.25, 0.20)),
    (None, (0.10, 0.50), (0.90, 0.50), None, None),
    ((0.50, 0.50), (0.60, 0.50), (0.40, 0.50), (0.50, 0.80), (0.50, 0.20)),
    (None, None, (0.30, 0.60), (0.15, 0.60), (0.45, 0.60)),
    (None, None, (0.30, 0.00), (0.45, 0.00), (0.15, 0.00)),
]


def depth_of(shape, side, left, up):
    """How far from the middle towards the camera the surface is, m."""
    if shape == BALL:
        return math.sqrt(0.25 - left**2 - up**2)
    return math.sqrt(0.25 - left**2) if shape == CYLINDER and side < 4 else 0.5


@pytest.mark.parametrize("side", range(6), ids=("-x", "+x", "+y", "-y", "+z", "-z"))
@pytest.mark.parametrize("shape, sides", [(BOX, BOXES), (BALL, BALLS), (CYLINDER, CYLINDERS)], ids=("box", "ball", "cylinder"))
def test_an_image_lies_on_a_shape_as_in_a_real_gazebo(renderer, folder, shape, sides, side):  # noqa: F811
    drawn = picture(renderer, visual("m", shape, f"4 0 1.2 {TURNS[side]}", script(folder, "uv")))
    focal = 160 / math.tan(0.5)
    for (left, up), coordinates in zip(AROUND, sides[side]):
        if coordinates is None:
            continue
        far = 4 - depth_of(shape, side, left, up)
        pixel = drawn[int(120 - focal * up / far), int(160 - focal * left / far)] / 255
        np.testing.assert_allclose(pixel[:2], coordinates, atol=0.03, err_msg=f"{left} {up}")


def test_each_statement_counts_for_its_own_pass(renderer, folder):  # noqa: F811
    """By OGRE's grammar: statements of a pass may stand after its texture unit, those of another pass are not its own."""
    alike = {"late": "nolight", "passes": "plain"}
    for name, other in alike.items():
        here, there = (picture(renderer, visual("m", BOX, "6 0.9 2 0 0 0", script(folder, which))) for which in (name, other))
        np.testing.assert_array_equal(here, there, err_msg=name)


def test_a_mesh_without_coordinates_shows_the_corner_of_an_image(renderer, folder, tmp_path):  # noqa: F811
    """Of the real picture: the mean of the image's four corners, in the shade."""
    text = (
        OBJ.format("white").replace("vt", "#vt").replace("/1/1", "//1").replace("/4/1", "//1").replace("/3/1", "//1").replace("/2/1", "//1")
    )
    (folder / "bare.obj").write_text(text)
    drawn = picture(renderer, visual("m", mesh(folder, "bare"), "6 -2.7 2 0 0 0", script(folder, "plain")))
    np.testing.assert_allclose(drawn[72, 298].astype(int), (44, 58, 44), atol=3)

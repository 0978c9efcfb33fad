"""Pictures beside those of a real Gazebo 11.1 (Debian 11, its OGRE on software OpenGL), of the same worlds."""

import numpy as np
import pytest
from ode_sim.description import load_world
from ode_sim.description.model import Pose
from ode_sim_rendering import Camera, arrange
from ode_sim_rendering.image import encode
from pictures import renderer  # noqa: F401

CAMERA = Camera(width=320, height=240, hfov=1.0, near=0.1, far=50.0, pose=Pose((0.0, 0.0, 1.2)))
BOX = "<box><size>1 1 1</size></box>"
BALL = "<sphere><radius>0.5</radius></sphere>"
CYLINDER = "<cylinder><radius>0.4</radius><length>1</length></cylinder>"
PLANE = "<plane><normal>0 0 1</normal><size>20 20</size></plane>"
SUN = (
    '<light name="sun" type="directional"><pose>0 0 10 0 0 0</pose><diffuse>0.8 0.8 0.8 1</diffuse><specular>{}</specular>'
    "<direction>-0.5 0.1 -0.9</direction></light>"
)
POINT = (
    '<light name="p" type="point"><pose>3 1 3 0 0 0</pose><diffuse>1 0.8 0.6 1</diffuse><specular>0.1 0.1 0.1 1</specular>'
    "<attenuation><range>20</range><constant>0.5</constant><linear>0.1</linear><quadratic>0.02</quadratic></attenuation></light>"
)
SPOT = (
    '<light name="s" type="spot"><pose>2 -2 4 0 0 0</pose><diffuse>0.9 0.9 0.9 1</diffuse><specular>0.1 0.1 0.1 1</specular>'
    "<direction>0.6 0.2 -0.8</direction><attenuation><range>20</range><constant>0.3</constant><linear>0.05</linear>"
    "<quadratic>0.01</quadratic></attenuation><spot><inner_angle>0.4</inner_angle><outer_angle>0.8</outer_angle><falloff>1.5</falloff>"
    "</spot></light>"
)
FOG = "<fog><color>0.8 0.8 0.8 1</color><type>linear</type><start>3</start><end>12</end><density>1</density></fog>"


def material(**colours):
    script = colours.pop("script", None)
    words = f"<script><uri>file://media/materials/scripts/gazebo.material</uri><name>{script}</name></script>" if script else ""
    return f"<material>{words}{''.join(f'<{tag}>{rgb} 1</{tag}>' for tag, rgb in colours.items())}</material>"


def visual(name, shape, place, look, transparency=0):
    return (
        f"<model name='{name}'><static>1</static><pose>{place}</pose><link name='l'><visual name='v'>"
        f"<transparency>{transparency}</transparency><geometry>{shape}</geometry>{look}</visual></link></model>"
    )


COLOURS = SUN.format("0.2 0.2 0.2 1") + "".join(
    (
        visual("red", BOX, "5 2 0.5 0 0 0", material(ambient="0.5 0 0", diffuse="1 0 0")),
        visual("green", BOX, "5 0 0.5 0 0 0", material(ambient="0 1 0", diffuse="0 0.6 0")),
        visual("script", BOX, "5 -2 0.5 0 0 0", material(script="Gazebo/Blue")),
        visual("none", BOX, "5 2 2 0 0 0", ""),
        visual("emissive", BOX, "5 0 2 0 0 0", material(ambient="0 0 0", diffuse="0 0 0", emissive="0.2 0.4 0.6")),
        visual("glossy", BALL, "5 -2 2 0 0 0", material(ambient="0.3 0.3 0.3", diffuse="0.5 0.5 0.5", specular="1 1 1")),
    )
)
THINGS = (
    visual("white", BALL, "5 1 0.6 0 0 0", material(ambient="1 1 1", diffuse="1 1 1", specular="1 1 1"))
    + visual("behind", CYLINDER, "6 -1 0.6 0 0 0", material(ambient="1 1 0", diffuse="1 1 0"))
    + visual("front", BOX, "4 -0.6 0.6 0 0 0.4", material(ambient="0 0 1", diffuse="0 0 1"), 0.5)
    + visual("floor", PLANE, "0 0 0 0 0 0", material(script="Gazebo/Grey"))
)
SCRIPTS = SUN.format("1 1 1 1") + "".join(
    visual(name.replace("/", ""), shape, place, material(script=name))
    for name, shape, place in (
        ("Gazebo/Grey", BALL, "6 2.7 0.5 0 0 0.3"),
        ("Gazebo/Gold", BOX, "6 0.9 0.5 0 0 0.3"),
        ("Gazebo/RedGlow", CYLINDER, "6 0.9 2 0 0 0.3"),
        ("Gazebo/GreenTransparent", BALL, "6 -0.9 2 0 0 0.3"),
        ("Gazebo/Orange", BOX, "6 -2.7 2 0 0 0.3"),
    )
)


REAL_COLOURS = {
    (5, 5): (178, 178, 178),
    (60, 30): (102, 102, 102),
    (60, 72): (122, 122, 122),
    (60, 160): (51, 102, 153),
    (150, 30): (51, 0, 0),
    (150, 72): (71, 0, 0),
    (150, 160): (0, 102, 0),
    (150, 280): (0, 0, 102),
    (45, 278): (72, 72, 72),  # what is glossy has no highlight: there is no shininess in this SDF
    (49, 278): (49, 49, 49),
    (70, 278): (31, 31, 31),
}
REAL_POINT = {
    (130, 100): (255, 255, 255),
    (150, 100): (255, 255, 225),
    (170, 100): (141, 133, 125),
    (200, 60): (183, 153, 122),
    (220, 160): (194, 161, 129),
    (145, 215): (109, 97, 51),
    (230, 300): (144, 122, 99),
    (160, 180): (35, 31, 121),
}
REAL_SPOT = {
    (150, 100): (102, 102, 102),
    (200, 200): (100, 100, 175),
    (215, 260): (188, 188, 188),
    (230, 300): (57, 57, 57),
    (145, 215): (127, 127, 116),
    (160, 180): (16, 16, 67),
}
REAL_FOG = {  # of the ball; upstream the fog of a large face is that of its corners
    (130, 100): (255, 255, 255),
    (150, 100): (255, 255, 221),
    (170, 100): (152, 145, 139),
}
REAL_SCRIPTS = {
    (80, 115): (255, 0, 0),
    (80, 205): (89, 140, 89),
    (80, 290): (102, 52, 5),
    (155, 25): (31, 31, 31),
    (155, 115): (41, 25, 2),
    (140, 30): (67, 67, 67),
}
REAL_GREY = {(60, 160): 51, (150, 72): 71, (150, 160): 0, (60, 30): 102}
REAL_DEPTHS = {(60, 30): 4.5, (60, 160): 4.5, (150, 72): 5.020771, (150, 160): 4.5, (70, 278): 4.532399, (150, 300): 4.5}


def seen(renderer, contents, scene=""):  # noqa: F811
    world, _ = load_world(
        f"<sdf version='1.6'><world name='w'><scene><ambient>0.4 0.4 0.4 1</ambient><background>0.7 0.7 0.7 1</background>"
        f"<shadows>0</shadows>{scene}</scene>{contents}</world></sdf>"
    )
    arranged, poses = arrange(world.models, world.lights, world.scene)
    renderer.set_scene(arranged)
    return renderer.images(CAMERA, poses, ("color", "depth"))


@pytest.mark.parametrize(
    "contents, scene, pixels",
    (
        pytest.param(COLOURS, "", REAL_COLOURS, id="colours"),
        pytest.param(POINT + THINGS, "", REAL_POINT, id="point"),
        pytest.param(SPOT + THINGS, "", REAL_SPOT, id="spot"),
        pytest.param(SUN.format("1 1 1 1") + POINT + THINGS, FOG, REAL_FOG, id="fog"),
        pytest.param(SCRIPTS, "", REAL_SCRIPTS, id="scripts"),
    ),
)
def test_pixels_are_those_of_gazebo(renderer, contents, scene, pixels):  # noqa: F811
    picture = seen(renderer, contents, scene)["color"]
    for place, colour in pixels.items():
        assert picture[place].tolist() == pytest.approx(colour, abs=2), place


def test_depths_are_those_of_gazebo(renderer):  # noqa: F811
    depth = seen(renderer, COLOURS)["depth"]
    for place, metres in REAL_DEPTHS.items():
        assert depth[place] == pytest.approx(metres, abs=2e-3)


def test_a_grey_camera_sees_what_is_red(renderer):  # noqa: F811
    picture = encode(seen(renderer, COLOURS)["color"], "mono8")
    assert {place: int(picture[place]) for place in REAL_GREY} == REAL_GREY
    assert picture.dtype == np.uint8

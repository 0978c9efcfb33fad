"""A lidar's ranges from depth pictures, held beside geometry on paper and beside rays that are cast against the same shapes."""

import math

import numpy as np
import pytest
from ode_sim import World, _core
from ode_sim_rendering import NOTHING, Camera, CameraError, Renderer, describe
from ode_sim_rendering.camera import Fan
from ode_sim_rendering.lidar import LidarView

HEIGHT = 1.5  # m of the sensor above the ground
BOXES = [(4.0, 0.0, 0.0), (0.0, 6.0, 0.7), (-5.0, -1.0, 0.3), (1.0, -8.0, 1.1), (12.0, 9.0, 0.2)]


def shape(kind, words):
    """A link of that shape that is seen and felt."""
    geometry = f"<geometry>{words}</geometry>"
    visual = f"<visual name='v'><laser_retro>{kind}</laser_retro>{geometry}</visual>"
    return f"<link name='l'><collision name='c'>{geometry}</collision>{visual}</link>"


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    boxes = "".join(
        f"<model name='b{i}'><static>1</static><pose>{x} {y} 1 0 0 {yaw}</pose>{shape(7, '<box><size>1 2 2</size></box>')}</model>"
        for i, (x, y, yaw) in enumerate(BOXES)
    )
    ball = f"<model name='s'><static>1</static><pose>-3 4 1.5 0 0 0</pose>{shape(3, '<sphere><radius>1</radius></sphere>')}</model>"
    plane = "<plane><normal>0 0 1</normal><size>200 200</size></plane>"
    file = tmp_path_factory.mktemp("lidar") / "w.world"
    file.write_text(
        f"<sdf version='1.6'><world name='w'><model name='g'><static>1</static>{shape(1, plane)}</model>{boxes}{ball}</world></sdf>"
    )
    made = World.load(str(file))
    made.step(1)
    return made


@pytest.fixture(scope="module")
def renderer(world):
    with_scene = Renderer()
    with_scene.set_scene(describe(world))
    yield with_scene
    with_scene.close()


def pictured(renderer, world, yaws, pitches, pose=None):
    """Ranges and visuals of the rays at those angles from the sensor's place."""
    camera = Camera(near=0.3, far=60.0) if pose is None else Camera(near=0.3, far=60.0, pose=pose)
    view = LidarView(camera, Fan(tuple(yaws), tuple(pitches)))
    return view.ranges([renderer.images(side, world.link_poses, ("depth", "ident")) for side in view.cameras])


@pytest.fixture(scope="module")
def place():
    from ode_sim.math3 import from_rpy

    return from_rpy(0.0, 0.0, HEIGHT, 0.0, 0.0, 0.4)


def test_the_ground_is_where_trigonometry_has_it(renderer, world, place):
    pitches = np.radians(np.linspace(-60.0, -20.0, 11))
    yaws = np.linspace(-math.pi, math.pi, 91)
    ranges, seen = pictured(renderer, world, yaws, pitches, place)
    ground = renderer.visual_names.index("g::l::v")
    free = seen == ground
    for axis, by in ((0, 1), (0, -1), (1, 1), (1, -1)):  # not beside a box
        free &= np.roll(seen, by, axis) == ground
    assert free.mean() > 0.5
    expected = np.broadcast_to(HEIGHT / np.sin(-pitches)[:, None], ranges.shape)
    assert np.abs(ranges - expected)[free].max() < 2e-3  # most of it the 24 bits of the depth buffer


def test_the_sky_is_infinitely_far(renderer, world, place):
    ranges, seen = pictured(renderer, world, np.linspace(-1, 1, 21), np.radians([40.0, 50.0]), place)
    assert np.isinf(ranges).all() and (seen == NOTHING).all()


@pytest.mark.parametrize("rows, columns", [(16, 900), (64, 1024), (1, 720), (32, 60)])
def test_rays_that_are_cast_meet_the_same(renderer, world, place, rows, columns):
    """But where they pass an edge: there a pixel decides."""
    pitches = np.linspace(-0.4, 0.2, rows) if rows > 1 else np.zeros(1)
    yaws = np.linspace(-math.pi, math.pi, columns)
    ranges, seen = pictured(renderer, world, yaws, pitches, place)
    fan = _core.RayFan(_core.RayScan(columns, 1.0, -math.pi, math.pi), _core.RayScan(rows, 1.0, -0.4, 0.2), 0.3, 60.0)
    cast, hits = fan.cast(world.core, (*place.p, *place.q), [])
    cast = cast.reshape(rows, columns)
    off = np.abs(np.minimum(ranges, 60.0) - cast)
    ball = seen == renderer.visual_names.index("s::l::v")  # drawn of flat triangles
    plain = ~ball & (cast < 40.0)
    assert np.quantile(off[plain], 0.98) < 0.005
    edges = (off > 0.05) & (cast < 40.0)
    assert edges.mean() < 0.02


def test_a_ball_is_where_it_is(renderer, world, place):
    """Of radius 1 m at (-3, 4), as high as the sensor: its nearest point is 4 m away. It is drawn of flat triangles."""
    yaws = math.atan2(4, -3) - 0.4 + np.linspace(-0.1, 0.1, 61)
    ranges, seen = pictured(renderer, world, yaws, np.linspace(-0.06, 0.06, 21), place)
    assert (seen == renderer.visual_names.index("s::l::v")).all()
    aside = np.arccos(np.cos(np.linspace(-0.06, 0.06, 21))[:, None] * np.cos(np.linspace(-0.1, 0.1, 61))[None, :])
    np.testing.assert_allclose(ranges, 5 * np.cos(aside) - np.sqrt(1 - (5 * np.sin(aside)) ** 2), atol=0.01)


def test_a_sensor_that_lies_on_its_side(renderer, world):
    """Its rays up and down are the world's to both sides."""
    from ode_sim.math3 import from_rpy

    ranges, _ = pictured(renderer, world, [0.0], np.linspace(-0.1, 0.1, 5), from_rpy(0, 0, 1.0, math.pi / 2, 0, 0))
    assert ranges[:, 0] == pytest.approx(3.5 / np.cos(np.linspace(-0.1, 0.1, 5)), abs=2e-3)  # the front of the box at 4 m


def test_half_a_turn_and_more_has_no_seam(renderer, world, place):
    """The same rays from fans that are cut in other places."""
    pitches = np.radians([-30.0, -25.0])
    yaws = np.linspace(-1.0, 1.0, 101)
    whole = np.linspace(-1.0, 4.0, 251)
    few, many = pictured(renderer, world, yaws, pitches, place)[0], pictured(renderer, world, whole, pitches, place)[0]
    assert np.quantile(np.abs(few - many[:, :101]), 0.97) < 2e-3


@pytest.mark.parametrize(
    "yaws, pitches, word",
    [((0.0, 1.0), (1.5,), "80"), ((-4.0, 4.0), (0.0,), "458"), ((1.0, 0.0), (0.0,), "fall"), ((0.0, 1.0), (0.2, 0.1), "fall")],
)
def test_what_no_pictures_show_is_said(yaws, pitches, word):
    with pytest.raises(CameraError, match=word):
        Fan(yaws, pitches)

"""Height maps: what is drawn is where what collides is."""

import numpy as np
import ode_sim
import pytest
from ode_sim.description import load_world
from ode_sim.description.model import Collision, Heightmap, Link, Model, Pose, Visual
from ode_sim_rendering import Camera, arrange
from ode_sim_rendering.assets import Assets
from pictures import renderer  # noqa: F401
from PIL import Image
from test_rendering_gazebo_textures import folder  # noqa: F401

SIZE = (20.0, 10.0, 1200.0)


def hills(rows, columns, top):
    """Slopes and waves, from 0 to ``top``."""
    y, x = np.mgrid[0 : 1 : rows * 1j, 0 : 1 : columns * 1j]
    return np.round(top * (0.4 * x + 0.3 * y + 0.3 * np.sin(5 * x) ** 2 * np.cos(3 * y) ** 2))


@pytest.mark.parametrize("kind, top", ((np.uint8, 255), (np.uint16, 255), (np.uint16, 65535)))
@pytest.mark.parametrize("rows, columns", ((65, 65), (600, 515)))
def test_what_is_drawn_is_where_what_collides_is(tmp_path, kind, top, rows, columns):
    values = hills(rows, columns, top)
    Image.fromarray(values.astype(kind)).save(tmp_path / "hills.png")
    shape = Heightmap(str(tmp_path / "hills.png"), size=SIZE, pos=(1.0, 2.0, 3.0))
    most = SIZE[2]  # of the brightest pixel, in whatever kind of picture
    world = ode_sim.World()
    world.spawn(Model("hills", Pose(), (Link("l", collisions=(Collision("c", Pose(), shape),)),), static=True))
    assert not world.problems
    assets = Assets()
    (part,) = assets.parts(Visual("v", Pose(), shape), "v")
    drawn = assets.meshes[part.key].vertices
    assert np.ptp(drawn, axis=0)[:2] == pytest.approx(SIZE[:2]) and np.ptp(drawn[:, 2]) == pytest.approx(most, rel=0.01)
    inside = drawn[(np.abs(drawn[:, 0] - 1.0) < 9.99) & (np.abs(drawn[:, 1] - 2.0) < 4.99)][::97]
    above = inside + (0.0, 0.0, most + 1.0)
    ranges, _ = world.cast_rays(above, np.tile((0.0, 0.0, -1.0), (len(above), 1)), 3 * SIZE[2])
    grey = SIZE[2] / values.max()  # a large map is drawn with fewer points than it has: one step lies between two of them
    assert np.abs(above[:, 2] - ranges - inside[:, 2]).max() < grey + 2e-4 * most


DOWN = (
    "<light name='sun' type='directional'><diffuse>0.8 0.8 0.8 1</diffuse><specular>0 0 0 1</specular><direction>0 0 -1</direction></light>"
)
ABOVE = Camera(width=320, height=240, hfov=0.9, near=0.1, far=50.0, pose=Pose((0, 0, 40), (0, np.sqrt(0.5), 0, np.sqrt(0.5))))
BLEND = "<blend><min_height>{}</min_height><fade_dist>{}</fade_dist></blend>"


def ground(renderer, folder, heights, size, *parts):  # noqa: F811
    """The picture from 40 m above, +x upwards."""
    Image.fromarray(heights.astype(np.uint8)).save(folder / "heights.png")
    shape = f"<heightmap>{''.join(parts)}<uri>file://{folder}/heights.png</uri><size>32 32 {size}</size></heightmap>"
    world, _ = load_world(
        "<sdf version='1.6'><world name='w'><scene><ambient>0.4 0.4 0.4 1</ambient><background>0.7 0.7 0.7 1</background></scene>"
        f"{DOWN}<model name='h'><static>1</static><link name='l'><visual name='v'><geometry>{shape}</geometry></visual></link></model>"
        "</world></sdf>"
    )
    scene, poses = arrange(world.models, world.lights, world.scene)
    renderer.set_scene(scene)
    drawn = renderer.color(ABOVE, poses).astype(int)
    assert renderer.take_problems() == []
    return drawn


def layer(folder, name, size):  # noqa: F811
    return f"<texture><diffuse>file://{folder}/{name}</diffuse><normal>file://{folder}/{name}</normal><size>{size}</size></texture>"


def test_the_ground_is_tiled_as_in_a_real_gazebo(renderer, folder):  # noqa: F811
    """Pixels of a real Gazebo 11.1's picture of the same height map."""
    heights = np.full((129, 129), 128)
    heights[0, 0], heights[-1, -1] = 255, 0
    drawn = ground(renderer, folder, heights, 2, layer(folder, "tex.png", 8))
    real = {
        (60, 30): (48, 240, 48),
        (45, 29): (255, 255, 255),
        (68, 80): (255, 252, 48),
        (100, 40): (255, 48, 48),
        (86, 84): (0, 0, 0),
        (200, 250): (48, 240, 48),
        (120, 10): (178, 178, 178),
        (180, 30): (255, 255, 255),
        (18, 86): (0, 0, 0),
    }
    for pixel, colour in real.items():
        np.testing.assert_allclose(drawn[pixel], colour, atol=3, err_msg=str(pixel))


def test_layers_of_the_ground_begin_at_their_heights(renderer, folder):  # noqa: F811
    """SDF's words: a layer begins at min_height and is whole from fade_dist higher on. 32 m long, from 0 to 8 m high; light 1.2."""
    for name, colour in (("red", (200, 0, 0)), ("green", (0, 200, 0)), ("blue", (0, 0, 200))):
        Image.new("RGB", (16, 16), colour).save(folder / f"{name}.png")
    slope = np.tile(np.linspace(0, 255, 129), (129, 1))
    layers = [layer(folder, f"{name}.png", 4) for name in ("red", "green", "blue")]
    drawn = ground(renderer, folder, slope, 8, *layers, BLEND.format(2, 2), BLEND.format(6, 1))
    for height, colour in ((1, (240, 0, 0)), (3, (120, 120, 0)), (5, (0, 240, 0)), (6.5, (0, 120, 120)), (6.9, (0, 24, 216))):
        row, _ = ABOVE.project([[40 - height, 0, 4 * height - 16]])[0][::-1]
        shade = np.cos(np.arctan(0.25))  # of the slope: what the sun gives it
        np.testing.assert_allclose(drawn[int(row), 160], np.array(colour) / 1.2 * (0.4 + 0.8 * shade), atol=12, err_msg=str(height))


def test_tiles_smaller_than_a_pixel_of_the_ground_are_their_mean(renderer, folder):  # noqa: F811
    """5 mm wide on 32 m; black and grey halves, under light of 1.2."""
    halves = np.zeros((16, 16, 3), np.uint8)
    halves[:, 8:] = 200
    Image.fromarray(halves).save(folder / "halves.png")
    drawn = ground(renderer, folder, np.full((33, 33), 128), 1, layer(folder, "halves.png", 0.005))
    np.testing.assert_allclose(drawn[120, 160], 1.2 * 100, atol=3)


def test_gazebos_own_ground_has_its_colour(renderer, folder):  # noqa: F811
    text = "<texture><diffuse>file://media/materials/textures/{}</diffuse><size>1</size></texture>"
    drawn = ground(renderer, folder, np.full((33, 33), 128), 1, text.format("grass_diffusespecular.png"))
    np.testing.assert_allclose(drawn[120, 160], np.minimum(255, 1.2 * 255 * np.array((0.48, 0.56, 0.31))), atol=3)

"""Height maps: what is drawn is where what collides is."""

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Collision, Heightmap, Link, Model, Pose, Visual
from ode_sim_rendering.assets import Assets
from PIL import Image

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

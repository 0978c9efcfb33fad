"""Pictures that fill the frame: where the camera stands, and what is drawn."""

import cv2
import numpy as np
import ode_sim
import pytest
from ode_sim_rendering import describe
from ode_sim_rendering.portrait import VIEWS, Painter, Portrait, Refused, Studio, camera_for, extent

WORLD = """<sdf version="1.6"><world name="w"><scene><background>0 0 0 1</background><ambient>1 1 1 1</ambient></scene>
<model name="ground"><static>true</static><link name="l"><visual name="v"><geometry><plane><normal>0 0 1</normal>
<size>100 100</size></plane></geometry></visual></link></model>
<model name="red"><static>true</static><pose>3 1 0.2 0 0 0.5</pose><link name="l"><visual name="v">
<pose>0 0 0.1 0 0 0</pose><geometry><box><size>0.6 0.1 0.1</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>0 0 0 1</diffuse>
</material></visual></link></model>
<model name="far"><static>true</static><pose>-20 0 0.5 0 0 0</pose><link name="l"><visual name="v"><geometry><sphere>
<radius>0.5</radius></sphere></geometry></visual></link></model>
<model name="bare"><static>true</static><link name="l"/></model></world></sdf>"""


@pytest.fixture(scope="module")
def world():
    return ode_sim.World.load(WORLD)


@pytest.fixture(scope="module")
def painter():
    painter = Painter()
    yield painter
    painter.close()


def portrait(world, model, view="iso", size=(320, 200)):
    return Portrait(describe(world), np.array(world.link_poses), model, view, *size)


def seen(camera, points):
    rotation = np.array(ode_sim.math3.quat_to_matrix(camera.pose.q))
    return camera.project((points - camera.pose.p) @ rotation)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("size", [(320, 200), (200, 320)])
@pytest.mark.parametrize("stretch", [(1, 1, 1), (8, 1, 0.2), (0.1, 0.1, 3)])
@pytest.mark.parametrize("place", [(4, -3, 0), (-30, 20, 0), (30, -20, 3), (700, 900, 800), (-700, -900, -800)])
def test_all_of_it_is_in_the_frame_and_fills_it(view, size, stretch, place):
    """Wherever it is: towards the origin of the world or away from it."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * stretch + place
    camera = camera_for(corners, view, *size)
    ahead = (corners - camera.pose.p) @ np.array(ode_sim.math3.quat_to_matrix(camera.pose.q))[:, 0]
    assert camera.near < ahead.min() and ahead.max() < camera.far
    pixels = seen(camera, corners)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    assert (low >= 0).all() and (high <= np.array(size)).all()
    assert ((high - low) / size).max() > 0.75
    assert np.abs((low + high) / 2 - np.array(size) / 2).max() < 0.06 * max(size)


def test_the_ground_does_not_count_and_the_model_alone_does(world):
    low, high = extent(portrait(world, "")).min(axis=0), extent(portrait(world, "")).max(axis=0)
    assert low[0] == pytest.approx(-20.5) and 3 < high[0] < 3.4 and high[2] == pytest.approx(1.0)
    alone = extent(portrait(world, "red"))
    assert alone[:, 2].min() == pytest.approx(0.25)
    assert np.ptp(alone[:, 0]) == pytest.approx(0.6 * np.cos(0.5) + 0.1 * np.sin(0.5))


def test_what_is_drawn_is_the_model(world, painter):
    png, problems = painter.take(portrait(world, "red", "left"))
    picture = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    assert picture.shape == (200, 320, 3) and not problems
    columns = np.flatnonzero((picture[:, :, 2] > 200).any(axis=0) & (picture[:, :, 0] < 50).any(axis=0))
    assert np.ptp(columns) > 0.7 * 320


def test_a_model_in_a_room_is_seen_through_the_wall(world, painter):
    walls = "".join(
        f"""<visual name="{side}"><pose>{x} {y} 1 0 0 0</pose><geometry><box><size>{along} {across} 2</size></box></geometry>
        <material><ambient>0 0 1 1</ambient><diffuse>0 0 0 1</diffuse></material></visual>"""
        for side, x, y, along, across in (("n", 3, 3, 4, 0.1), ("s", 3, -1, 4, 0.1), ("e", 5, 1, 0.1, 4), ("w", 1, 1, 0.1, 4))
    )
    room = ode_sim.World.load(
        WORLD.replace(
            "</world>",
            f"""<model name="room"><static>true</static><link name="l">{walls}</link></model>
        </world>""",
        )
    )
    for view in ("left", "iso"):
        pictures = [
            cv2.imdecode(np.frombuffer(painter.take(portrait(here, "red", view))[0], np.uint8), cv2.IMREAD_COLOR) for here in (world, room)
        ]
        red = [(picture[:, :, 2] > 200) & (picture[:, :, 0] < 50) for picture in pictures]
        assert (red[0] == red[1]).all() and red[0].sum() > 1000
        assert ((pictures[1][:, :, 0] > 200) & (pictures[1][:, :, 2] < 50)).any()  # the wall behind it is there


def test_nothing_to_see_is_said_in_one_line(world, painter):
    with pytest.raises(Refused, match="^model 'bare' has nothing to see$"):
        painter.take(portrait(world, "bare"))


def test_a_picture_does_not_depend_on_those_before_it(world, painter):
    alone = Studio()
    png, _ = alone.draw(portrait(world, "red", "top"))
    alone.close()
    painter.take(portrait(world, "far", "left", (200, 320)))
    assert painter.take(portrait(world, "red", "top"))[0] == png
    other = ode_sim.World.load(WORLD.replace("<ambient>1 0 0 1</ambient>", "<ambient>0 1 0 1</ambient>"))
    assert painter.take(portrait(other, "red", "top"))[0] != png
    assert painter.take(portrait(world, "red", "top"))[0] == png


def test_a_process_that_ended_is_replaced(world, painter):
    png, _ = painter.take(portrait(world, "red"))
    painter._process.kill()
    assert painter.take(portrait(world, "red"))[0] == png
    painter._process.kill()
    painter._process.wait()
    assert painter.take(portrait(world, "red"))[0] == png


def test_what_takes_too_long_is_given_up(world):
    painter = Painter()
    with pytest.raises(Refused, match="not drawn within 0.001 s"):
        painter.take(portrait(world, "red"), 0.001)
    assert painter.take(portrait(world, "red"))[0]
    painter.close()

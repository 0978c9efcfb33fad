"""Wide-angle lenses: where what stands at a known angle is seen, beside and behind the camera too."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from ode_sim.description.model import Link, Material, Model, Scene, Sphere, Visual
from ode_sim.math3 import from_rpy
from ode_sim_rendering import NOTHING, Camera, CameraError, Renderer, WideLens, arrange, read_camera

BACKGROUND = (51, 102, 153)
ORIGIN = np.array([[0, 0, 0, 0, 0, 0, 1.0]])
FUNCTIONS = {"sin": math.sin, "tan": math.tan, "id": float}
XML = """<camera name="eye"><horizontal_fov>{hfov}</horizontal_fov><image><width>240</width><height>240</height></image>
<clip><near>0.05</near><far>50</far></clip>{lens}</camera>"""


@pytest.fixture(scope="module")
def renderer():
    made = Renderer(backend="egl", shadows="off")
    yield made
    made.close()


def camera(lens="", hfov=3.0, wide=True):
    return read_camera(ET.fromstring(XML.format(hfov=hfov, lens=lens)), wide=wide)


def lens(kind, cutoff=3.1, scaled="true", size=512, custom=""):
    return (
        f"<lens><type>{kind}</type><scale_to_hfov>{scaled}</scale_to_hfov><cutoff_angle>{cutoff}</cutoff_angle>"
        f"<env_texture_size>{size}</env_texture_size>{custom}</lens>"
    )


def ball(angle, around, distance=2.0):
    """The place of what stands at ``angle`` (rad) from the axis, ``around`` (rad) from the picture's right upwards."""
    return (distance * math.cos(angle), -distance * math.sin(angle) * math.cos(around), distance * math.sin(angle) * math.sin(around))


def scene_of(*places):
    visuals = tuple(
        Visual(f"v{i}", from_rpy(*place), Sphere(0.1), Material(ambient=(1, 0, 0, 1), diffuse=(1, 0, 0, 1)))
        for i, place in enumerate(places)
    )
    background = tuple(value / 255 for value in BACKGROUND)
    return arrange([Model("m", links=(Link("l", visuals=visuals),))], (), Scene(ambient=(1, 1, 1, 1), background=(*background, 1)))[0]


def middle(image):
    """Column and row of the middle of what is red, in pixels from the middle of the picture, and how much there is."""
    rows, columns = np.nonzero((image[:, :, 0] > 200) & (image[:, :, 1] < 50))
    return columns.mean() - (image.shape[1] - 1) / 2, rows.mean() - (image.shape[0] - 1) / 2, len(rows)


@pytest.mark.parametrize(
    "kind, hfov, custom",
    [
        ("gnomonical", 2.4, ""),
        ("stereographic", 4.6, ""),
        ("equidistant", 6.2, ""),
        ("equisolid_angle", 6.2, ""),
        ("orthographic", 3.0, ""),
        ("custom", 3.183, "<custom_function><c1>1.05</c1><c2>4</c2><f>1</f><fun>tan</fun></custom_function>"),
    ],
)
@pytest.mark.parametrize("fraction, around", [(0.15, 0.3), (0.4, math.pi), (0.5, 4.5), (0.65, -0.5), (0.8, 3.0)])
def test_what_stands_at_an_angle_is_where_the_lens_has_it(renderer, kind, hfov, custom, fraction, around):
    seen = camera(lens(kind, cutoff=6.28, custom=custom), hfov)
    angle = fraction * hfov / 2
    radius = 120 * seen.lens.c1 * seen.lens.f * FUNCTIONS[seen.lens.fun](angle / seen.lens.c2 + seen.lens.c3)
    renderer.set_scene(scene_of(ball(angle, around)))
    column, row, count = middle(renderer.color(seen, ORIGIN))
    assert count > 2 and (column, row) == pytest.approx((radius * math.cos(around), -radius * math.sin(around)), abs=1.5)


def test_the_field_of_view_ends_at_the_edge(renderer):
    seen = camera(lens("stereographic"), hfov=3.183)
    renderer.set_scene(scene_of(ball(1.5915, 0.0)))
    image = renderer.color(seen, ORIGIN)
    rows, columns = np.nonzero(image[:, :, 0] > 200)
    assert columns.max() == 239 and 2 < np.ptp(rows) < 16 and abs(rows.mean() - 119.5) < 1


def test_sides_join_without_a_seam_and_the_cut_off_is_black(renderer):
    renderer.set_scene(scene_of((40.0, 30.0, 20.0)))
    whole = renderer.color(camera(lens("equidistant", cutoff=6.0), hfov=6.2), ORIGIN)
    assert np.abs(whole.astype(int) - BACKGROUND).max() <= 1
    cut = renderer.color(camera(lens("equidistant", cutoff=1.0), hfov=3.0), ORIGIN)
    radius = np.hypot(*np.meshgrid(np.arange(240) - 119.5, np.arange(240) - 119.5)) / 120 * 1.5
    assert not cut[radius > 1.02].any() and np.abs(cut[radius < 0.96].astype(int) - BACKGROUND).max() <= 1


def test_depth_is_the_distance_and_visuals_are_named(renderer):
    seen = camera(lens("equidistant"), hfov=4.0)
    renderer.set_scene(scene_of(ball(1.7, 0.0)))
    images = renderer.images(seen, ORIGIN, ("depth", "ident"))
    found = images["ident"] != NOTHING
    assert found.any() and 1.89 < images["depth"][found].min() < 1.92 and np.isinf(images["depth"][~found]).all()


def test_it_is_carried_by_its_link_and_its_pose(renderer):
    seen = replace(camera(lens("stereographic"), hfov=4.0), link="m::l", pose=from_rpy(0, 0, 1, 0, 0, math.pi / 2))
    renderer.set_scene(scene_of((0.0, 2.0, 1.0)))
    for x in (0.0, 3.0):
        column, row, count = middle(renderer.color(seen, np.array([[x, 0, 0, 0, 0, 0, 1.0]])))
        assert count > 10 and (column, row) == pytest.approx((0.0, 0.0), abs=1.0)


def test_without_a_lens_it_is_stereographic_and_a_plain_camera_has_none():
    told = camera(hfov=math.pi / 2).lens
    assert (told.c1, told.c2, told.fun) == (2.0, 2.0, "tan")
    assert told.f == pytest.approx(1 / (2 * math.tan(math.pi / 8))) and told.texture == 256
    assert camera(lens("equidistant"), hfov=1.0, wide=False).lens is None
    assert camera(lens("equidistant", scaled="false")).lens.f == 1.0


@pytest.mark.parametrize(
    "written, hfov, message",
    [
        ("<lens><type>round</type></lens>", 2.0, "unknown <type> of lens 'round'; use one of gnomonical, "),
        (lens("custom", custom="<custom_function><fun>cos</fun></custom_function>"), 2.0, "<fun> of the lens is 'cos'; use one of sin, "),
        (lens("custom", custom="<custom_function><c1>0</c1></custom_function>"), 2.0, "all but c3 other than 0"),
        (lens("custom", custom="<custom_function><c2>nan</c2></custom_function>"), 2.0, "c2 nan"),
        (lens("custom", custom="<custom_function><c1>x</c1></custom_function>"), 2.0, "<c1> is 'x', not a number"),
        (lens("gnomonical"), 3.5, "cannot be scaled to a horizontal_fov of 3.5 rad"),
        (lens("equidistant", cutoff=-1), 2.0, "<cutoff_angle> of the lens is -1 rad"),
        (lens("equidistant"), 7.0, "horizontal_fov 7 rad; that of a wideanglecamera must be between 0.01 and 6.28"),
        (lens("equidistant", size="inf"), 2.0, "<env_texture_size> is inf"),
    ],
)
def test_an_impossible_lens_is_refused_in_one_line(written, hfov, message):
    with pytest.raises(CameraError) as caught:
        camera(written, hfov)
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_a_lens_of_one_s_own():
    assert Camera(hfov=4.0, lens=WideLens(1.0, 1.0, 0.0, 0.5, "id")).lens.f == 0.5

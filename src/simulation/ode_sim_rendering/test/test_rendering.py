"""Pictures of scenes whose pixels are known by geometry: empty, mirrored, upside-down or wrongly coloured ones fail."""

import gc
import math
from dataclasses import replace

import numpy as np
import pytest
from ode_sim.description.model import (
    Box,
    Cylinder,
    DescriptionError,
    Heightmap,
    Light,
    Link,
    Material,
    Mesh,
    Model,
    Plane,
    Polyline,
    Pose,
    Ribbon,
    Scene,
    Sphere,
    Visual,
)
from ode_sim.math3 import from_rpy
from ode_sim_rendering import NOTHING, Camera, CameraError, Renderer, arrange, look_at
from ode_sim_rendering.assets import Assets
from ode_sim_rendering.context import RenderingUnavailable
from ode_sim_rendering.geometry import ribbon
from pictures import BACKGROUND, BLUE, CAMERA, FULL_AMBIENT, GREEN, ORIGIN, RED, YELLOW, bytes_of, draw, renderer, scene_of, visual

CUBOID = Box((0.2, 0.4, 0.4))
FOUR = (
    visual("left", CUBOID, (2, 0.6, 0), RED),
    visual("right", CUBOID, (2, -0.6, 0), GREEN),
    visual("up", CUBOID, (2, 0, 0.6), BLUE),
    visual("down", CUBOID, (2, 0, -0.6), YELLOW),
)


def test_directions_and_colours(renderer):
    picture = draw(renderer, scene_of(*FOUR))
    assert picture.shape == (120, 160, 3) and picture.dtype == np.uint8
    middle_row, middle_column = 60, 80
    f = CAMERA.focal_length
    off = round(0.6 / 1.9 * f)
    assert tuple(picture[middle_row, middle_column - off]) == bytes_of(RED)
    assert tuple(picture[middle_row, middle_column + off]) == bytes_of(GREEN)
    assert tuple(picture[middle_row - off, middle_column]) == bytes_of(BLUE)
    assert tuple(picture[middle_row + off, middle_column]) == bytes_of(YELLOW)
    assert tuple(picture[middle_row, middle_column]) == bytes_of(BACKGROUND)


@pytest.mark.parametrize("size,hfov", [((160, 120), 1.2), ((121, 201), 0.6), ((64, 64), 2.2)])
def test_edges_are_where_projection_puts_them(renderer, size, hfov):
    camera = Camera(width=size[0], height=size[1], hfov=hfov, near=0.05)
    half = 0.4 * 2 * math.tan(hfov / 2) * min(1.0, size[1] / size[0])
    picture = draw(renderer, scene_of(visual("face", Box((0.2, 2 * half, half)), (2.1, 0, 0.25 * half), RED)), camera)
    mask = (picture == bytes_of(RED)).all(axis=2)
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    left_top, right_bottom = camera.project([[2, half, 0.75 * half], [2, -half, -0.25 * half]])
    assert abs(columns[0] - left_top[0]) <= 1 and abs(rows[0] - left_top[1]) <= 1
    assert abs(columns[-1] - right_bottom[0]) <= 1 and abs(rows[-1] - right_bottom[1]) <= 1
    assert mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1].all()


def test_focal_length_and_centre():
    camera = Camera(width=800, height=800, hfov=1.3962634)
    assert camera.focal_length == pytest.approx(476.7014, abs=1e-3)
    assert camera.project([[1, 0, 0]])[0] == pytest.approx([399.5, 399.5])


def test_depth_is_the_distance_along_the_axis(renderer):
    tilt = 0.5
    renderer.set_scene(
        scene_of(
            visual("wall", Box((0.2, 20, 20)), (3.1, 0, 0), RED, rpy=(0, 0, 0)),
            visual("tilted", Plane(size=(1, 1)), (2, 0, 0), BLUE, (0, -math.pi / 2, tilt)),
        )
    )
    depth = renderer.depth(CAMERA, ORIGIN)
    assert depth.dtype == np.float32 and depth.shape == (120, 160)
    assert np.abs(depth[:, :20] - 3.0).max() < 1e-4 and np.abs(depth[:, -20:] - 3.0).max() < 1e-4
    column, row = np.meshgrid(np.arange(160), np.arange(120))
    slope = -(column - 79.5) / CAMERA.focal_length  # y per x of the ray
    on_plane = 2 / (1 + np.tan(tilt) * slope)
    centre = (np.abs(column - 79.5) < 20) & (np.abs(row - 59.5) < 20)
    assert np.abs(depth - on_plane)[centre].max() < 1e-4


def test_depth_of_a_sphere_and_of_nothing(renderer):
    renderer.set_scene(scene_of(visual("ball", Sphere(0.5), (3, 0, 0), RED)))
    depth = renderer.depth(CAMERA, ORIGIN)
    assert depth[60, 80] == pytest.approx(2.5, abs=0.005)  # 32 facets around
    assert np.isinf(depth[0, 0]) and depth[0, 0] > 0
    disc = np.isfinite(depth)
    radius = CAMERA.focal_length * math.tan(math.asin(0.5 / 3))
    assert disc.sum() == pytest.approx(math.pi * radius**2, rel=0.03)


def test_segmentation_names_the_visual(renderer):
    scene = scene_of(*FOUR)
    renderer.set_scene(scene)
    ident = renderer.segmentation(CAMERA, ORIGIN)
    assert renderer.visual_names == ("m::l::left", "m::l::right", "m::l::up", "m::l::down")
    off = round(0.6 / 1.9 * CAMERA.focal_length)
    assert [ident[60, 80 - off], ident[60, 80 + off], ident[60 - off, 80], ident[60 + off, 80]] == [0, 1, 2, 3]
    assert ident[60, 80] == NOTHING == ident[0, 0]


def test_images_of_one_pass_agree_with_single_ones(renderer):
    renderer.set_scene(scene_of(*FOUR))
    together = renderer.images(CAMERA, ORIGIN, ("color", "depth", "ident"))
    assert np.array_equal(together["color"], renderer.color(CAMERA, ORIGIN))
    assert np.array_equal(together["depth"], renderer.depth(CAMERA, ORIGIN))
    assert np.array_equal(together["ident"], renderer.segmentation(CAMERA, ORIGIN))


def test_camera_on_a_moving_link(renderer):
    models = [
        Model("box", links=(Link("b", visuals=(visual("v", Box((0.5, 0.5, 0.5)), (0, 0, 0), RED),)),)),
        Model("robot", links=(Link("eye"),)),
    ]
    scene, poses = arrange(models, scene=FULL_AMBIENT)
    renderer.set_scene(scene)
    camera = Camera(width=80, height=80, hfov=1.0, link="robot::eye", pose=from_rpy(0, 0, 0.5))
    poses[1] = (0, 3, -0.5, 0, 0, -math.sqrt(0.5), math.sqrt(0.5))  # 3 m to the left of the box, looking along -y
    assert tuple(renderer.color(camera, poses)[40, 40]) == bytes_of(RED)
    poses[0, 0] = -0.75  # towards the camera's right, which is -x
    picture = renderer.color(camera, poses)
    assert tuple(picture[40, 40]) == bytes_of(BACKGROUND) and tuple(picture[40, 60]) == bytes_of(RED)
    with pytest.raises(ValueError, match="no::link"):
        renderer.color(Camera(link="no::link"), poses)


def test_lambert_light_and_ambient(renderer):
    light = Light("sun", "directional", diffuse=(0.5, 0.5, 0.5, 1), direction=(1, 0, -math.sqrt(3)))
    scene = Scene(ambient=(0.2, 0.2, 0.2, 1), background=BACKGROUND + (1,), shadows=False)
    floor = visual("floor", Plane(size=(50, 50)), (0, 0, -1), (1, 0.5, 0))
    picture = draw(renderer, scene_of(floor, lights=[light], scene=scene))
    shade = 0.2 + 0.5 * math.cos(math.pi / 6)
    assert np.abs(picture[110, 80].astype(int) - np.array(bytes_of((shade, shade / 2, 0)))).max() <= 1


def test_point_light_attenuation_and_range(renderer):
    scene = Scene(ambient=(0, 0, 0, 1), background=(0, 0, 0, 1), shadows=False)
    wall = visual("wall", Plane(size=(20, 20)), (3, 0, 0), (1, 1, 1), (0, -math.pi / 2, 0))
    lamp = Light("lamp", "point", Pose((1, 0, 0)), range=2.5, constant=0.5, linear=0.1, quadratic=0.2)
    picture = draw(renderer, scene_of(wall, lights=[lamp], scene=scene))
    on_axis = 1 / (0.5 + 0.1 * 2 + 0.2 * 4)
    assert abs(int(picture[60, 80, 0]) - 255 * on_axis) <= 2
    reach = math.sqrt(2.5**2 - 2**2)  # the light's range ends on a circle of the wall
    dark, lit = CAMERA.project([[3, reach + 0.15, 0], [3, reach - 0.15, 0]])
    assert picture[60, round(dark[0]), 0] == 0 and picture[60, round(lit[0]), 0] > 30


def test_spot_light_lights_its_cone_only(renderer):
    scene = Scene(ambient=(0, 0, 0, 1), background=(0, 0, 0, 1), shadows=False)
    wall = visual("wall", Plane(size=(20, 20)), (3, 0, 0), (1, 1, 1), (0, -math.pi / 2, 0))
    spot = Light("spot", "spot", direction=(1, 0, 0), range=20, constant=1, linear=0, spot=(0.2, 0.4, 1.0))
    picture = draw(renderer, scene_of(wall, lights=[spot], scene=scene))
    inside, outside = CAMERA.project([[3, 0.1, 0], [3, 3 * math.tan(0.25), 0]])
    assert picture[60, round(inside[0]), 0] > 245 and picture[60, round(outside[0]), 0] == 0


def test_light_carried_by_a_link(renderer):
    scene = Scene(ambient=(0, 0, 0, 1), background=(0, 0, 0, 1), shadows=False)
    lamp = Light("lamp", "spot", direction=(1, 0, 0), range=20, linear=0, spot=(0.2, 0.3, 1.0))
    models = [
        Model("wall", links=(Link("w", visuals=(visual("v", Plane(size=(9, 9)), (3, 0, 0), (1, 1, 1), (0, -math.pi / 2, 0)),)),)),
        Model("torch", links=(Link("t", lights=(lamp,)),)),
    ]
    described, poses = arrange(models, scene=scene)
    renderer.set_scene(described)
    half = math.radians(15) / 2
    poses[1] = (0, 0, 0, 0, 0, math.sin(half), math.cos(half))  # turned to the left by 15 degrees
    picture = renderer.color(CAMERA, poses)
    column = round(CAMERA.project([[3, 3 * math.tan(2 * half), 0]])[0][0])
    assert picture[60, column, 0] > 200 and picture[60, 80, 0] == 0


def test_shadow_of_the_sun(renderer):
    sun = Light("sun", "directional", diffuse=(0.6, 0.6, 0.6, 1), direction=(1, 0, -1), cast_shadows=True)
    scene = Scene(ambient=(0.4, 0.4, 0.4, 1), background=BACKGROUND + (1,), shadows=True)
    visuals = [visual("floor", Plane(size=(50, 50)), (0, 0, -1), (1, 1, 1)), visual("slab", Box((0.8, 0.8, 0.1)), (1.5, 0, 0.5), RED)]
    camera = Camera(width=160, height=120, hfov=1.2, pose=look_at((1, -3, 2), (3, 0, -1)))
    in_shadow = look_down(camera, (1.5 + 1.5, 0, -1))  # 1.5 m further along x, 1.5 m below
    in_sun = look_down(camera, (1.5 + 1.5, 0.8, -1))
    picture = draw(renderer, scene_of(*visuals, lights=[sun], scene=scene), camera)
    assert picture[in_shadow][0] == round(0.4 * 255)
    assert picture[in_sun][0] == pytest.approx(255 * (0.4 + 0.6 * math.sqrt(0.5)), abs=1.5)
    moved = scene_of(visuals[0], visual("slab", Box((0.8, 0.8, 0.1)), (1.5, 0.8, 0.5), RED), lights=[sun], scene=scene)
    picture = draw(renderer, moved, camera)
    assert picture[in_sun][0] == round(0.4 * 255) and picture[in_shadow][0] > 200


def look_down(camera, p_W):
    """(row, column) of a world point in a camera fixed in the world."""
    from ode_sim.math3 import inverse, transform

    column, row = camera.project([transform(inverse(camera.pose), p_W)])[0]
    return round(row), round(column)


def test_a_camera_inside_a_closed_shape_sees_out(renderer):
    shell = visual("shell", Box((1, 1, 1)), (0, 0, 0), RED)
    picture = draw(renderer, scene_of(shell, visual("far", Box((1, 1, 1)), (4, 0, 0), GREEN)))
    assert tuple(picture[60, 80]) == bytes_of(GREEN) and tuple(picture[0, 0]) == bytes_of(BACKGROUND)


@pytest.mark.parametrize(
    "geometry",
    [
        Box((0.6, 0.6, 0.6)),
        Sphere(0.4),
        Cylinder(0.4, 0.8),
        Polyline(((-0.4, -0.4), (0.4, -0.4), (0.4, 0.4), (0.0, 0.1), (-0.4, 0.4)), 0.6),
    ],
)
@pytest.mark.parametrize("eye", [(2, 0.3, 1), (-2, 0.5, 1.2), (0.3, 2, -1.5), (0.3, -2, 2)])
def test_shapes_are_closed_and_face_outwards(renderer, geometry, eye):
    """Seen from outside a convex hull's faces are all turned to the viewer: nothing shines through, depth is the near
    side."""
    camera = Camera(width=80, height=80, hfov=0.9, near=0.05, pose=look_at(eye, (0, 0, 0.1)))
    renderer.set_scene(scene_of(visual("shape", geometry, (0, 0, 0), RED)))
    depth = renderer.depth(camera, ORIGIN)
    distance = math.dist(eye, (0, 0, 0.1))
    seen = np.isfinite(depth)
    assert seen.sum() > 200
    assert depth[seen].min() < distance - 0.1
    row, column = np.argwhere(seen).mean(axis=0).round().astype(int)
    assert depth[row, column] < distance + 0.05


def test_transparency_blends_and_leaves_depth_alone(renderer):
    glass = visual("glass", Box((0.1, 0.5, 0.5)), (1, 0, 0), (0, 0, 0), transparency=0.75)
    wall = visual("wall", Box((0.2, 20, 20)), (3.1, 0, 0), (1, 1, 1))
    renderer.set_scene(scene_of(glass, wall))
    images = renderer.images(CAMERA, ORIGIN, ("color", "depth"))
    assert abs(int(images["color"][60, 80, 0]) - 0.75**2 * 255) <= 140  # at least one face of the pane was blended
    assert 100 < images["color"][60, 80, 0] < 220 and images["color"][5, 5, 0] == 255
    assert images["depth"][60, 80] == pytest.approx(3.0, abs=1e-4)


def test_texture_is_the_right_way_up(renderer, tmp_path):
    from PIL import Image

    quarters = np.zeros((64, 64, 3), np.uint8)
    quarters[:32, :32], quarters[:32, 32:], quarters[32:, :32], quarters[32:, 32:] = RED, GREEN, BLUE, YELLOW
    Image.fromarray(quarters * 255).save(tmp_path / "quarters.png")
    white = (1.0, 1.0, 1.0, 1.0)
    sign = Visual(
        "sign", from_rpy(0, 0, -1), Plane(size=(1, 1)), Material(ambient=white, diffuse=white, texture=str(tmp_path / "quarters.png"))
    )
    camera = Camera(width=80, height=80, hfov=1.2, pose=look_at((-0.001, 0, 0), (0, 0, -1)))  # from above, +x is up
    picture = draw(renderer, scene_of(sign), camera)
    # u runs along x and v along y: from above, with x up in the picture, the image is turned a quarter to the left
    at = {
        name: tuple(picture[look_down(camera, p)])
        for name, p in {"-x+y": (-0.25, 0.25, -1), "+x+y": (0.25, 0.25, -1), "-x-y": (-0.25, -0.25, -1), "+x-y": (0.25, -0.25, -1)}.items()
    }
    assert at == {"-x+y": bytes_of(RED), "+x+y": bytes_of(GREEN), "-x-y": bytes_of(BLUE), "+x-y": bytes_of(YELLOW)}


def test_a_sky_is_blue(renderer):
    picture = draw(renderer, scene_of(*FOUR, scene=Scene(background=(0.7, 0.7, 0.7, 1), sky=True)))
    red, green, blue = picture[0, 0].astype(int)
    assert blue > green + 30 > red + 60


def test_heights_of_a_terrain(renderer, tmp_path):
    from PIL import Image

    grey = np.zeros((65, 65), np.uint8)
    grey[:, 40:] = 255  # a step up towards +x
    Image.fromarray(grey).save(tmp_path / "step.png")
    terrain = Visual("t", Pose(), Heightmap(str(tmp_path / "step.png"), size=(10, 10, 2), pos=(0, 0, 0.5)))
    camera = Camera(width=81, height=81, hfov=1.2, pose=look_at((-0.001, 0, 8), (0, 0, 0)))  # from above, +x is up
    renderer.set_scene(scene_of(terrain))
    depth = renderer.depth(camera, ORIGIN)
    assert depth[60, 40] == pytest.approx(7.5, abs=0.01) and depth[20, 40] == pytest.approx(5.5, abs=0.01)


def test_a_road_has_its_width_in_bends_too_and_its_picture_runs_along_it(renderer, tmp_path):
    from PIL import Image

    picture = np.zeros((64, 64, 3), np.uint8)
    picture[:, :32], picture[:, 32:] = (255, 0, 0), (0, 255, 0)  # left, right
    Image.fromarray(picture).save(tmp_path / "half.png")
    way = ((0.0, -4.0, 0.0), (0.0, 2.0, 0.0), (6.0, 2.0, 0.0))  # up, then right
    road = Visual("street", Pose(), Ribbon(way, 2.0), Material(texture=str(tmp_path / "half.png")), cast_shadows=False)
    camera = Camera(width=200, height=200, hfov=1.0, near=0.1, far=50, pose=look_at((0.0, -0.001, 12.0), (0.0, 0.0, 0.0)))
    seen = draw(renderer, arrange([], scene=replace(FULL_AMBIENT, roads=(road,)))[0], camera, np.zeros((0, 7)))

    def at(x, y):
        return tuple(int(v) for v in seen[look_down(camera, (x, y, 0.0))])

    left, right, nothing = (255, 0, 0), (0, 255, 0), bytes_of(BACKGROUND)
    assert [at(x, -2.0) for x in (-1.1, -0.9, -0.1, 0.1, 0.9, 1.1)] == [nothing, left, left, right, right, nothing]
    assert [at(4.0, y) for y in (0.9, 1.1, 1.9, 2.1, 2.9, 3.1)] == [nothing, right, right, left, left, nothing]
    assert [at(x, y) for x, y in ((-0.9, 2.9), (-1.1, 3.1), (0.9, 1.1), (1.1, 0.9))] == [left, nothing, right, nothing]  # the corner
    assert renderer.visual_names == ("street",) and not renderer.take_problems()


@pytest.mark.parametrize(
    "way", [((0, 0, 0), (3, 0, 0), (0, 0.001, 0)), ((0, 0, 0), (1e-9, 0, 0), (5, 5, 1)), ((0, 0, 0), (0, 1, 0), (0, 0, 0))]
)
def test_a_road_that_turns_on_the_spot_stays_finite(way):
    mesh = ribbon(np.array(way, float), 2.0)
    assert np.isfinite(mesh.vertices).all() and np.isfinite(mesh.uv).all()
    assert np.abs(mesh.vertices - np.repeat(np.array(way, float), 2, axis=0)).max() < 9.0  # the mitre is as in Gazebo, 8.2 times at most


def test_missing_texture_is_one_line_and_drawn_plain(renderer):
    white = (1.0, 0.0, 0.0, 1.0)
    sign = Visual("sign", from_rpy(2, 0, 0), Box(), Material(ambient=white, diffuse=white, texture="/nowhere/x.png"))
    picture = draw(renderer, scene_of(sign))
    assert tuple(picture[60, 80]) == bytes_of(RED)
    (line,) = renderer.take_problems()
    assert "x.png" in line and "visual 'sign' of link 'l' of model 'm'" in line and "\n" not in line
    assert renderer.take_problems() == []


def test_unreadable_mesh_is_one_line_and_the_rest_is_drawn():
    def broken(path, *_):
        raise DescriptionError(f"{path}: not an STL file")

    made = Renderer(assets=Assets(broken))
    picture = draw(made, scene_of(visual("part", Mesh("/x/part.stl"), (1, 0, 0), GREEN), visual("ball", Sphere(0.5), (2, 0, 0), RED)))
    assert tuple(picture[60, 80]) == bytes_of(RED)
    (line,) = made.take_problems()
    assert "part.stl" in line and "model 'm'" in line and "\n" not in line
    made.close()


def test_mesh_material_is_used_where_the_visual_has_none():
    triangle = (
        np.array([[2, -1, -1], [2, 1, -1], [2, 0, 1]], np.float32),
        np.array([[0, 2, 1]]),
        np.array([[-1, 0, 0]] * 3, np.float32),
        None,
        Material(diffuse=(0, 0, 1, 1)),
    )
    loads = []
    made = Renderer(assets=Assets(lambda *arguments: loads.append(arguments) or [triangle]))
    plain = Visual("plain", Pose(), Mesh("/x/t.dae"))
    painted = visual("painted", Mesh("/x/t.dae", uri="model://x/t.dae"), (0, 0, 0), RED)
    assert tuple(draw(made, scene_of(plain))[60, 80]) == bytes_of(BLUE)
    assert tuple(draw(made, scene_of(painted))[60, 80]) == bytes_of(RED)
    assert len(loads) == 1  # one file is read once
    made.close()


def test_egl_and_osmesa_agree(renderer):
    scene = scene_of(
        *FOUR,
        visual("ball", Sphere(0.3), (1.5, 0, 0), (0.3, 0.7, 0.5)),
        lights=[Light("sun", "directional", direction=(0.5, 0.2, -1), cast_shadows=True)],
        scene=Scene(background=BACKGROUND + (1,)),
    )
    other = Renderer(backend="osmesa", shadows="on")
    other.set_scene(scene)
    renderer.set_scene(scene)
    a, b = (each.images(CAMERA, ORIGIN, ("color", "depth", "ident")) for each in (renderer, other))
    other.close()
    # the same Mesa draws both here; another EGL driver may put an edge pixel elsewhere
    assert (np.abs(a["color"].astype(int) - b["color"]).max(axis=2) > 2).mean() < 0.01
    assert (a["ident"] != b["ident"]).mean() < 0.01
    both = np.isfinite(a["depth"]) & np.isfinite(b["depth"])
    assert (np.abs(a["depth"][both] - b["depth"][both]) > 1e-3).mean() < 0.01


@pytest.mark.parametrize("backend", ["egl", "osmesa"])
def test_renderers_that_go_leave_the_others_alone(backend):
    kept = Renderer(backend=backend)
    kept.set_scene(scene_of(*FOUR))
    expected = kept.color(CAMERA, ORIGIN)
    for _ in range(3):
        other = Renderer(backend=backend)
        other.set_scene(scene_of(FOUR[0]))
        other.color(CAMERA, ORIGIN)
        other.set_scene(scene_of())
        other.close()
        del other
        gc.collect()
        assert np.array_equal(kept.color(CAMERA, ORIGIN), expected)
    kept.close()


def test_no_back_end_is_one_line(monkeypatch):
    with pytest.raises(RenderingUnavailable, match="vulkan"):
        Renderer(backend="vulkan")
    import glcontext

    def nothing(name):
        raise RuntimeError(f"{name}: no such library\nsecond line")

    monkeypatch.setattr(glcontext, "get_backend_by_name", nothing)
    with pytest.raises(RenderingUnavailable) as caught:
        Renderer(backend="egl")
    assert "libegl1" in str(caught.value) and "\n" not in str(caught.value)


def test_missing_egl_falls_back_to_osmesa(monkeypatch):
    import glcontext

    original = glcontext.get_backend_by_name

    def no_egl(name):
        if name == "egl":
            raise RuntimeError("libEGL.so not found")
        return original(name)

    monkeypatch.setattr(glcontext, "get_backend_by_name", no_egl)
    made = Renderer()
    assert tuple(draw(made, scene_of(*FOUR))[60, 80]) == bytes_of(BACKGROUND)
    made.close()


@pytest.mark.parametrize(
    "change",
    [
        dict(width=0),
        dict(height=-3),
        dict(width=10**6),
        dict(hfov=0.0),
        dict(hfov=4.0),
        dict(near=0.0),
        dict(near=5.0, far=1.0),
        dict(format="JPEG2000"),
        dict(noise_stddev=-1.0),
    ],
)
def test_impossible_cameras_are_refused_in_one_line(change):
    with pytest.raises(CameraError) as caught:
        Camera(**change)
    assert f"{next(iter(change.values()))}".removesuffix(".0") in str(caught.value) and "\n" not in str(caught.value)


def test_anti_aliasing_mixes_edges():
    made = Renderer(antialiasing="msaa")
    picture = draw(made, scene_of(visual("edge", Box((0.1, 1, 1)), (2, 0, 0), RED, rpy=(0.2, 0, 0))))
    made.close()
    red, blue = bytes_of(RED), bytes_of(BACKGROUND)
    mixed = ~((picture == red).all(axis=2) | (picture == blue).all(axis=2))
    assert 20 < mixed.sum() < 600

"""Things that lie askew beside each other: whether they touch, on paper and against their distance."""

import math

import motion
import numpy as np
import pytest


def turn(axis, angle):
    """Quaternion x y z w."""
    axis = np.array(axis, dtype=float) / np.linalg.norm(axis)
    return (*(axis * math.sin(angle / 2)), math.cos(angle / 2))


def robot(shape, origin=""):
    """A robot of one link that slides along x, at 0."""
    return motion.load_model(
        f'<robot name="r"><link name="base"/><link name="body"><collision>{origin}<geometry>{shape}</geometry></collision></link>'
        '<joint name="slide" type="prismatic"><parent link="base"/><child link="body"/><axis xyz="1 0 0"/>'
        '<limit lower="-5" upper="5" velocity="1" effort="1"/></joint></robot>'
    )


BOX = '<box size="0.4 0.2 0.1"/>'
CUBE = '<box size="0.2 0.2 0.2"/>'


def touches(scene, shape, pose):
    scene.add_object("thing", [shape], pose=pose)
    return bool(scene.check())


@pytest.mark.parametrize(
    "why, shape, way, turned, apart",
    [
        # The corner of a cube turned by 45 degrees about z reaches 0.1 sqrt 2 along x.
        ("corner to side", motion.Box(0.2, 0.2, 0.2), (1, 0, 0), turn((0, 0, 1), math.pi / 4), 0.1 + 0.1 * math.sqrt(2)),
        # Along the diagonal: an edge of the straight cube, a side of the turned one.
        ("side to edge", motion.Box(0.2, 0.2, 0.2), (1, 1, 0), turn((0, 0, 1), math.pi / 4), 0.1 + 0.1 * math.sqrt(2)),
        # An edge along y above a side.
        ("edge down", motion.Box(0.2, 0.2, 0.2), (0, 0, 1), turn((0, 1, 0), math.pi / 4), 0.1 + 0.1 * math.sqrt(2)),
        # A cube on its corner, whose diagonal stands upright.
        ("corner down", motion.Box(0.2, 0.2, 0.2), (0, 0, 1), turn((1, -1, 0), math.atan(math.sqrt(2))), 0.1 + 0.1 * math.sqrt(3)),
        ("ball beside", motion.Sphere(0.1), (0, 1, 0), (0, 0, 0, 1), 0.2),
        # Its axis along x: the shadow on x is its length.
        ("cylinder lying", motion.Cylinder(0.05, 0.6), (1, 0, 0), turn((0, 1, 0), math.pi / 2), 0.1 + 0.3),
    ],
)
def test_the_last_place_that_is_free(why, shape, way, turned, apart):
    way = np.array(way, dtype=float) / np.linalg.norm(way)
    scene = motion.PlanningScene(robot(CUBE))
    assert not touches(scene, shape, (tuple(way * (apart + 1e-4)), turned))
    assert touches(scene, shape, (tuple(way * (apart - 1e-4)), turned))


def after(p, q):
    """The turn of q, then that of p."""
    (x1, y1, z1, w1), (x2, y2, z2, w2) = p, q
    return (
        w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
        w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
        w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
        w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
    )


@pytest.mark.parametrize("slant", [0.2, 0.7, 1.3])
def test_edge_across_edge(slant):
    """Two roofs across each other, ridge on ridge: no side of either parts them."""
    quarter = math.pi / 4
    scene = motion.PlanningScene(robot('<box size="0.4 0.2 0.2"/>', f'<origin rpy="{quarter} 0 0"/>'))
    ridge = 0.1 * math.sqrt(2)
    turned = after(turn((0, 0, 1), slant), turn((1, 0, 0), quarter))
    for gap, wanted in ((1e-4, False), (-1e-4, True)):
        assert touches(scene, motion.Box(0.4, 0.2, 0.2), ((0, 0, 2 * ridge + gap), turned)) == wanted


def test_touching_is_where_the_distance_ends():
    """Random pairs: what distances, which look at nothing beforehand, call apart is free, and the other way round."""
    chance = np.random.default_rng(5)
    shapes = [
        motion.Box(0.4, 0.1, 0.2),
        motion.Cylinder(0.05, 0.5),
        motion.Sphere(0.15),
        motion.Mesh([[-0.3, 0, 0], [0.3, 0, 0], [0, 0.4, 0], [0, 0.1, 0.2]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
    ]
    scene = motion.PlanningScene(robot(BOX))
    free = 0
    for i in range(400):
        q = chance.normal(size=4)
        pose = (tuple(chance.uniform(-0.35, 0.35, 3)), tuple(q / np.linalg.norm(q)))
        touching = touches(scene, shapes[i % len(shapes)], pose)
        distance = scene.distance(scene.state).distance
        if abs(distance) > 1e-4 or not touching:
            assert touching == (distance <= 0), (i, pose, distance)
        free += not touching
    assert 100 < free < 300


def block(size, centre, cuts=3):
    """Corners and triangles of a box whose sides are cut into squares, as one of a mesh's parts."""
    corners, triangles = [], []
    grid = np.linspace(-0.5, 0.5, cuts + 1)
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (-0.5, 0.5):
            for i in range(cuts):
                for k in range(cuts):
                    first = len(corners)
                    for a, b in ((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)):
                        corner = np.zeros(3)
                        corner[axis], corner[u], corner[v] = side, grid[a], grid[b]
                        corners.append(corner * size + centre)
                    triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return corners, triangles


def joined(*blocks):
    corners, triangles = [], []
    for some, others in blocks:
        triangles += [[index + len(corners) for index in triangle] for triangle in others]
        corners += some
    return corners, triangles


#: three prongs of 0.04 m, 0.1 m from middle to middle, on a bar
FORK = joined(block((0.3, 0.04, 0.04), (0, 0, 0)), *(block((0.04, 0.04, 0.3), (x, 0, 0.16)) for x in (-0.1, 0, 0.1)))


def fork_robot(tmp_path):
    """A robot whose one link is a fork, in a file."""
    lines = ["solid fork"]
    for triangle in FORK[1]:
        lines += [
            "facet normal 0 0 0",
            "outer loop",
            *("vertex {:.9g} {:.9g} {:.9g}".format(*FORK[0][i]) for i in triangle),
            "endloop",
            "endfacet",
        ]
    file = tmp_path / "fork.stl"
    file.write_text("\n".join([*lines, "endsolid fork"]))
    return robot(f'<mesh filename="file://{file}"/>')


@pytest.mark.parametrize("thing", ["box", "cylinder", "ball", "fork"])
def test_between_the_prongs_of_a_fork_it_is_free(tmp_path, thing):
    """Between two prongs are 0.06 m; the hull of the fork fills them."""
    scene = motion.PlanningScene(fork_robot(tmp_path))
    half = 0.02
    shape, turned, shift = {
        "box": (motion.Box(2 * half, 1.0, 0.05), (0, 0, 0, 1), 0.0),
        "cylinder": (motion.Cylinder(half, 1.0), turn((1, 0, 0), math.pi / 2), 0.0),
        "ball": (motion.Sphere(half), (0, 0, 0, 1), 0.0),
        "fork": (motion.Mesh(*FORK), turn((1, 0, 0), math.pi), 0.3),  # upside down: its outer prongs beside the others
    }[thing]
    for side in (-1, 1):
        for off, wanted in ((0.0, False), (0.03 - half - 1e-4, False), (0.03 - half + 1e-4, True)):
            assert touches(scene, shape, ((0.05 + side * off, 0, 0.2 + shift), turned)) == wanted, (thing, side, off)


def test_a_triangle_passes_an_edge_of_a_box():
    """One triangle, far larger than the box, none of its corners near; the box's corner at (0.1, 0.1) is 0.1 sqrt 2 from the middle."""
    scene = motion.PlanningScene(robot(CUBE))
    diagonal = np.array([1, 1, 0]) / math.sqrt(2)
    along = np.array([1, -1, 0]) / math.sqrt(2)
    for upright in (np.array([0, 0, 1.0]), np.array([0.3, 0.3, 1.0])):  # its plane holds the box's edge, or leans out over it
        for gap, wanted in ((1e-4, False), (-1e-4, True)):
            foot = diagonal * (0.1 * math.sqrt(2) + gap) + (0, 0, 0.05)
            corners = [foot - 3 * along, foot + 3 * along, foot + 4 * upright]
            assert touches(scene, motion.Mesh(corners, [[0, 1, 2]]), ((0, 0, 0), (0, 0, 0, 1))) == wanted, (upright, gap)


def test_a_mesh_is_a_surface_and_a_box_is_solid(tmp_path):
    """What stands inside a mesh touches none of its triangles; what is around it touches all; a triangle without area is a line."""
    scene = motion.PlanningScene(fork_robot(tmp_path))
    assert not touches(scene, motion.Box(0.02, 0.02, 0.1), ((0, 0, 0.15), (0, 0, 0, 1)))
    assert touches(scene, motion.Box(0.02, 0.06, 0.1), ((0, 0, 0.15), (0, 0, 0, 1)))
    assert touches(scene, motion.Box(2, 2, 2), ((0, 0, 0.15), (0, 0, 0, 1)))
    scene = motion.PlanningScene(robot(CUBE))
    for x, wanted in ((0.0999, True), (0.1001, False)):
        line = motion.Mesh([[x, -5, 0.02], [x, 5, 0.02], [x, 1, 0.02]], [[0, 1, 2]])
        assert touches(scene, line, ((0, 0, 0), (0, 0, 0, 1))) == wanted


@pytest.mark.parametrize("pieces", [1, 4, 12])
def test_boxes_touch_meshes_of_the_world_where_their_distance_ends(pieces):
    """The mesh is the world's, coarse or fine, and stands anywhere beside the robot's box."""
    scene = motion.PlanningScene(robot(BOX))
    chance = np.random.default_rng(pieces)
    mesh = motion.Mesh(
        *joined(
            *(
                block(np.array(size), np.array(at), pieces)
                for size, at in (((0.3, 0.05, 0.05), (0, 0, 0)), ((0.02, 0.3, 0.1), (0.1, 0.1, 0)))
            )
        )
    )
    free = 0
    for i in range(300):
        q = chance.normal(size=4)
        pose = (tuple(chance.uniform(-0.3, 0.3, 3)), tuple(q / np.linalg.norm(q)))
        touching = touches(scene, mesh, pose)
        distance = scene.distance(scene.state).distance
        if abs(distance) > 1e-6 or not touching:
            assert touching == (distance <= 0), (i, pose, distance)
        assert not touching or scene.check(contacts=1).contacts
        free += not touching
    assert 60 < free < 240


def test_meshes_touch_where_their_distance_ends(tmp_path):
    """Forks in each other at random: distances, which FCL finds by itself, say the same."""
    scene = motion.PlanningScene(fork_robot(tmp_path))
    chance = np.random.default_rng(7)
    shapes = [motion.Mesh(*FORK), motion.Box(0.03, 0.3, 0.05), motion.Cylinder(0.02, 0.3), motion.Cone(0.03, 0.2), motion.Sphere(0.025)]
    free = 0
    for i in range(500):
        q = chance.normal(size=4)
        pose = (tuple(chance.uniform(-0.2, 0.2, 3) + (0, 0, 0.15)), tuple(q / np.linalg.norm(q)))
        touching = touches(scene, shapes[i % len(shapes)], pose)
        distance = scene.distance(scene.state).distance
        if abs(distance) > 1e-6 or not touching:
            assert touching == (distance <= 0), (i, pose, distance)
        free += not touching
    assert 100 < free < 400

"""Octomaps from what sensors see, and telling the robot from the rest of it."""

import motion
import numpy as np
import pytest

ORIGIN = (0.0, 0.0, 1.0)
NONE = np.zeros((0, 3))


def wall(x, count=21):
    """Points of a square metre at x."""
    y, z = np.meshgrid(np.linspace(-0.5, 0.5, count), np.linspace(0.5, 1.5, count))
    return np.stack([np.full(y.size, x), y.ravel(), z.ravel()], axis=1)


def touches(tree, point, radius=0.02):
    """Whether a ball at ``point`` touches the tree."""
    model = motion.load_model(
        '<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="%g"/></geometry>'
        '</collision></link><joint name="j" type="fixed"><parent link="a"/><child link="b"/>'
        '<origin xyz="%g %g %g"/></joint></robot>' % (radius, *point)
    )
    scene = motion.PlanningScene(model)
    scene.set_octomap(tree, motion.Pose.identity())
    return bool(scene.check())


def test_what_is_seen_is_there_and_goes_when_looked_through():
    space = motion.OccupancyMap(0.05)
    space.insert(ORIGIN, wall(1.0), NONE, NONE)
    tree = space.tree()
    assert touches(tree, (1.0, 0.2, 1.2)) and not touches(tree, (0.5, 0.0, 1.0))
    for _ in range(12):  # a cell that was seen often is not given up at the first glance beyond it
        space.insert(ORIGIN, wall(2.0, 61), NONE, NONE)
    later = space.tree()
    assert not touches(later, (1.0, 0.0, 1.0)) and touches(later, (2.0, 0.0, 1.0))
    assert touches(tree, (1.0, 0.2, 1.2)), "the copy changed"


def test_rays_that_end_on_nothing_make_free():
    space = motion.OccupancyMap(0.05)
    space.insert(ORIGIN, wall(1.0), NONE, NONE)
    for _ in range(12):
        space.insert(ORIGIN, NONE, NONE, wall(3.0, 121))
    assert not touches(space.tree(), (1.0, 0.0, 1.0)) if len(space) else True
    assert not touches(space.tree(), (1.0, 0.0, 1.0))


def test_known_points_are_never_occupied_and_leave_nothing_behind():
    space = motion.OccupancyMap(0.05)
    space.insert(ORIGIN, wall(1.0), NONE, NONE)
    space.insert(ORIGIN, wall(1.0), wall(1.0), NONE)
    assert len(space) == 0
    assert not touches(space.tree(), (1.0, 0.0, 1.0)) and not touches(space.tree(), (-5.0, 3.0, 0.0))


def test_memory_grows_with_surfaces_only():
    space = motion.OccupancyMap(0.02)
    for number in range(30):
        space.insert(ORIGIN, wall(4.0 + 0.001 * number, 101), NONE, NONE)
    assert len(space) < 20000


def test_what_is_not_finite_or_far_off_is_left_out():
    space = motion.OccupancyMap(0.05)
    space.insert(ORIGIN, [[np.nan, 0, 0], [np.inf, 0, 0], [1e9, 0, 0]], NONE, NONE)
    assert len(space) == 0
    with pytest.raises(motion.MotionError, match="not finite"):
        space.insert((np.nan, 0, 0), wall(1.0), NONE, NONE)
    with pytest.raises(motion.MotionError, match="resolution"):
        motion.OccupancyMap(0.0)
    with pytest.raises(motion.MotionError, match="three columns"):
        space.insert(ORIGIN, [[1.0, 2.0]], NONE, NONE)


def tetrahedron(size):
    corners = size * np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    return motion.Mesh(corners, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])


@pytest.mark.parametrize("shape", [motion.Box(0.2, 0.2, 0.2), motion.Sphere(0.1), motion.Cylinder(0.1, 0.2), tetrahedron(0.1)])
def test_labels_of_points(shape):
    at = ((1.0, 0.0, 1.0), (0, 0, 0, 1))
    points = [[1.0, 0.0, 1.0], [1.0, 0.0, 1.12], [1.17, 0.0, 1.0], [1.6, 0.0, 1.0], [1.0, 0.5, 1.0], [np.nan, 0, 0]]
    labels = motion.label_points([(shape, at, 0.05)], points, ORIGIN, shadow=0.3)
    inside = 1 if shape.__class__ is not motion.Mesh else labels[1]
    assert labels[0] == 1 and labels[1] == inside
    assert labels[2] == 2, "just behind it, seen from the sensor"
    assert list(labels[3:]) == [0, 0, 0]
    assert list(motion.label_points([(shape, at, 0.0)], points[2:4], ORIGIN)) == [0, 0]


def test_a_mesh_that_is_open_is_left_out_by_its_surface():
    sheet = motion.Mesh([[0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]], [[0, 1, 2], [0, 2, 3]])
    labels = motion.label_points([(sheet, ((1.0, 0, 1.0), (0, 0, 0, 1)), 0.03)], [[0.98, 0.3, 1.2], [1.02, -0.9, 0.2], [1.1, 0, 1]], ORIGIN)
    assert list(labels) == [1, 1, 0]

"""Scenes: objects, attached bodies, what may touch what, padding, frames, copies."""

import motion
import numpy as np
import pytest
import robots

HERE = ((0, 0, 0), (0, 0, 0, 1))


def at(x, y=0.0, z=0.0):
    return ((x, y, z), (0, 0, 0, 1))


@pytest.fixture(scope="module")
def model():
    """Balls of 0.1 m: one fixed at the origin, one on a rail along x, one bolted 1 m above the second."""
    ball = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    return motion.load_model(
        f'<robot name="rail"><link name="base">{ball}</link><link name="car">{ball}</link><link name="mast">{ball}</link>'
        '<link name="tool"/>'
        '<joint name="slide" type="prismatic"><parent link="base"/><child link="car"/><axis xyz="1 0 0"/>'
        '<limit lower="-5" upper="5" velocity="1" effort="1"/></joint>'
        '<joint name="bolt" type="fixed"><parent link="car"/><child link="mast"/><origin xyz="0 0 1"/></joint>'
        '<joint name="lift" type="prismatic"><parent link="mast"/><child link="tool"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>',
        '<robot name="rail"><group name="car"><joint name="slide"/></group><group name="lift"><joint name="lift"/></group></robot>',
    )


@pytest.fixture
def scene(model):
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set("slide", 2.0)
    scene.set_state(state)
    return scene


def moved(scene, x):
    state = scene.state
    state.set("slide", x)
    return state


def pairs(result):
    return {frozenset((c.body_1, c.body_2)) for c in result.contacts}


@pytest.mark.parametrize(
    "shape, edge",
    [
        (motion.Box(0.2, 0.2, 0.2), 0.2),
        (motion.Sphere(0.1), 0.2),
        (motion.Cylinder(0.1, 0.2), 0.2),
        (
            motion.Mesh([[-0.1, -0.1, -0.1], [0.1, -0.1, -0.1], [0, 0.2, -0.1], [0, 0, 0.2]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
            None,
        ),
        (motion.Plane(1, 0, 0, 0), 0.1),
        (motion.OcTree.from_points([[0.05, 0.05, 0.05], [-0.05, -0.05, -0.05]], 0.1), 0.2),
    ],
)
def test_every_shape_is_hit_where_it_is(scene, shape, edge):
    scene.add_object("thing", [shape], pose=at(3.0)) if not isinstance(shape, motion.OcTree) else scene.set_octomap(shape, at(3.0))
    assert scene.check(moved(scene, 3.0))
    assert not scene.check(moved(scene, 4.0)) and not scene.check(moved(scene, 2.0))
    if edge is not None:
        assert scene.check(moved(scene, 3 - edge + 0.01)) and not scene.check(moved(scene, 3 - edge - 0.02))


def test_cone_touches_with_its_tip(scene):
    scene.add_object("cone", [motion.Cone(0.1, 0.5)], pose=at(3.0, 0.0, -0.34))
    assert scene.check(moved(scene, 3.0))
    scene.move_object("cone", at(3.0, 0.0, -0.36))
    assert not scene.check(moved(scene, 3.0))


def test_plane_lies_where_its_equation_says(scene):
    scene.add_object("wall", [motion.Plane(2, 0, 0, -6)])  # 2 x - 6 = 0
    assert scene.check(moved(scene, 2.95)) and not scene.check(moved(scene, -3.0))


def test_contacts_have_names_types_and_geometry(scene):
    scene.add_object("box", [motion.Box(0.2, 1, 1)], pose=at(3.0))
    result = scene.check(moved(scene, 2.85), contacts=5)
    (contact,) = result.contacts
    assert result.collision and (contact.body_1, contact.type_1, contact.body_2, contact.type_2) == ("car", "robot_link", "box", "world")
    np.testing.assert_allclose(contact.normal, [1, 0, 0], atol=1e-6)
    assert contact.depth == pytest.approx(0.05, abs=1e-6) and 2.85 < contact.position[0] < 3.0


def test_self_collision_and_the_matrix(scene):
    near = moved(scene, 0.15)
    assert pairs(scene.check(near, contacts=9)) == {frozenset(("base", "car"))}
    acm = scene.acm
    assert acm.get("base", "car") is None and acm.get_default("base") is None
    acm.set("car", "base", True)
    assert scene.check(near)  # a copy until it is set
    scene.set_acm(acm)
    assert not scene.check(near)
    acm.set("base", "car", False)
    assert scene.check(near, acm=acm) and not scene.check(near)


@pytest.mark.parametrize(
    "one, two, allowed", [(None, None, False), (True, None, True), (True, True, True), (True, False, False), (None, False, False)]
)
def test_defaults_both_must_allow(one, two, allowed):
    acm = motion.AllowedCollisionMatrix()
    acm.set_default("a", one)
    acm.set_default("b", two)
    assert acm.allowed("a", "b") is allowed
    acm.set("a", "b", not allowed)
    assert acm.allowed("b", "a") is not allowed


def test_matrix_from_the_srdf_and_back():
    srdf = (
        '<robot name="panda"><disable_default_collisions link="link_1"/><enable_collisions link1="link_1" link2="link_3"/>'
        '<disable_collisions link1="link_2" link2="link_5" reason="Never"/></robot>'
    )
    acm = motion.AllowedCollisionMatrix.from_model(motion.load_model(robots.arm("panda")[0], srdf))
    assert acm.allowed("link_1", "link_7") and not acm.allowed("link_1", "link_3") and acm.allowed("link_5", "link_2")
    names, cells = acm.matrix()
    again = motion.AllowedCollisionMatrix.from_matrix(names, cells, acm.defaults)
    assert again.get("link_2", "link_5") is True and again.get("link_1", "link_3") is False
    with pytest.raises(motion.InvalidInputError, match="contradict"):
        motion.AllowedCollisionMatrix.from_matrix(["a", "b"], [[False, True], [False, False]])


def test_group_counts_pairs_of_which_one_moves(scene):
    scene.add_object("box", [motion.Box(0.2, 0.2, 0.2)], pose=at(2.0, 0, 1.0))
    assert scene.check(group="car") and not scene.check(group="lift")
    body = motion.AttachedBody("stick", "tool", [motion.Sphere(0.05)], pose=at(0.3))
    scene.attach(body)
    scene.add_object("ball", [motion.Sphere(0.05)], pose=at(2.3, 0, 1.0))
    assert pairs(scene.check(group="lift", contacts=9)) == {frozenset(("stick", "ball"))}


def test_padding_counts_against_the_world_only(scene):
    scene.add_object("box", [motion.Box(0.2, 0.2, 0.2)], pose=at(3.0))
    near = moved(scene, 2.75)
    assert not scene.check(near)
    scene.set_padding({"car": 0.06, "base": 0.5})
    assert scene.check(near) and not scene.check(near, padded=False)
    assert not scene.check(moved(scene, 0.3))  # of each other the links keep their own size
    scene.set_padding({"car": 0.0})
    scene.set_scale({"car": 1.6})
    assert scene.check(near) and scene.scale == {"car": 1.6}


# Upstream's CollisionEnvFCL::getAttachedBodyObjects: the padding and scale of the link that carries.
def test_what_a_link_carries_has_its_padding_and_scale(scene):
    scene.attach(motion.AttachedBody("stick", "car", [motion.Sphere(0.05)], pose=at(0.0, 0, 0.5), touch_links=["car", "base", "tool"]))
    near = moved(scene, 1.0)
    scene.add_object("wall", [motion.Box(0.2, 0.2, 0.2)], pose=at(1.2, 0.0, 0.5))
    assert not scene.check(near)  # 0.05 m are between them
    scene.set_padding({"car": 0.04})
    assert not scene.check(near)
    scene.set_padding({"car": 0.06})
    assert pairs(scene.check(near, contacts=9)) == {frozenset(("stick", "wall"))} and not scene.check(near, padded=False)
    scene.set_padding({"car": 0.0})
    scene.set_scale({"car": 2.2})
    assert pairs(scene.check(near, contacts=9)) >= {frozenset(("stick", "wall"))}


@pytest.mark.parametrize(
    "shape, bounds",
    [
        (motion.Box(1, 2, 3), (1.2, 2.2, 3.2)),
        (motion.Sphere(1), (2.2, 2.2, 2.2)),
        (motion.Cylinder(1, 2), (2.2, 2.2, 2.2)),
        (motion.Cone(1, 2), (2.2, 2.2, 2.2)),
    ],
)
def test_padding_grows_shapes_as_geometric_shapes_does(shape, bounds):
    lower, upper = shape.grown(1.0, 0.1).bounds()
    np.testing.assert_allclose(upper - lower, bounds)
    lower, upper = shape.grown(2.0, 0.1).bounds()
    np.testing.assert_allclose(upper - lower, 2 * (np.array(bounds) - 0.2) + 0.2)
    with pytest.raises(motion.InvalidInputError, match="negative"):
        shape.grown(1.0, -2.0)


def test_mesh_vertices_move_along_the_ray_from_their_middle():
    mesh = motion.Mesh([[1, 0, 0], [3, 0, 0], [2, 1, 0], [2, -1, 0]], [[0, 1, 2], [0, 1, 3]])
    np.testing.assert_allclose(mesh.grown(2.0, 0.5).vertices, [[-0.5, 0, 0], [4.5, 0, 0], [2, 2.5, 0], [2, -2.5, 0]])


def test_attached_bodies_move_touch_and_return(scene):
    scene.add_object("cup", [motion.Sphere(0.15)], pose=at(2.0, 0, 0.2), subframes={"rim": at(0, 0, 0.15)})
    assert pairs(scene.check(contacts=9)) == {frozenset(("cup", "car"))}
    scene.attach_object("cup", "car", ["car"])
    assert scene.objects == [] and not scene.check()
    there = moved(scene, 4.0)
    np.testing.assert_allclose(there.pose("cup/rim").position, [4, 0, 0.35])
    np.testing.assert_allclose(scene.frame_pose("cup/rim", there).position, [4, 0, 0.35])
    scene.add_object("lamp", [motion.Sphere(0.05)], pose=at(4.0, 0, 0.35))
    (contact,) = scene.check(there, contacts=9).contacts
    assert (contact.body_1, contact.type_1, contact.body_2) == ("cup", "attached", "lamp")
    scene.set_state(there)
    assert scene.detach_object("cup") and not scene.detach_object("cup")
    np.testing.assert_allclose(scene.object("cup").pose.position, [4, 0, 0.2])


def test_a_body_may_touch_only_the_links_named(scene):
    """Also the link that carries it, as upstream; bodies on one link never collide with each other."""
    touching = motion.AttachedBody("a", "car", [motion.Sphere(0.15)], pose=at(0, 0, 0.2))
    scene.attach(touching)
    assert pairs(scene.check(contacts=9)) == {frozenset(("a", "car"))}
    scene.attach(motion.AttachedBody("a", "car", [motion.Sphere(0.15)], pose=at(0, 0, 0.2), touch_links=["car"]))
    scene.attach(motion.AttachedBody("b", "car", [motion.Sphere(0.1)], pose=at(0, 0, 0.25)))
    assert not scene.check()
    scene.attach(motion.AttachedBody("c", "tool", [motion.Sphere(0.1)], pose=at(0, 0, -0.7)))
    assert pairs(scene.check(contacts=9)) == {frozenset(("a", "c")), frozenset(("b", "c"))}


def test_objects_are_added_replaced_appended_moved_removed(scene):
    scene.add_object("o", [motion.Sphere(0.1)], shape_poses=[at(1)], pose=at(2, 1))
    np.testing.assert_allclose(scene.object("o").pose.position, [2, 1, 0])
    scene.add_object("o", [motion.Sphere(0.1)], shape_poses=[at(1)])
    np.testing.assert_allclose([scene.object("o").pose.position, scene.object("o").shape_poses[0].position], [[0, 0, 0], [1, 0, 0]])
    scene.append_shapes("o", [motion.Box(1, 1, 1)], [at(0, 5)])
    assert len(scene.object("o").shapes) == 2
    scene.move_object("o", at(7))
    scene.move_shapes("o", [at(0, 1), at(0, 2)])
    assert scene.object("o").shape_poses[1].position[1] == 2 and scene.object("o").pose.position[0] == 7
    assert scene.remove_object("o") and not scene.remove_object("o")
    for call in (
        scene.object,
        lambda n: scene.move_object(n, HERE),
        lambda n: scene.append_shapes(n, [motion.Sphere(1)]),
        lambda n: scene.attach_object(n, "car"),
    ):
        with pytest.raises(motion.UnknownNameError, match="no object 'o'"):
            call("o")


def test_octomap_survives_clearing_and_its_name_is_reserved(scene):
    scene.set_octomap(motion.OcTree.from_points([[0, 0, 0]], 0.1), at(3))
    scene.add_object("o", [motion.Sphere(0.1)])
    scene.clear_objects()
    assert scene.objects == [] and len(scene.octomap) > 0
    with pytest.raises(motion.InvalidInputError, match="reserved"):
        scene.add_object("<octomap>", [motion.Sphere(1)])
    scene.set_octomap(None)
    assert scene.octomap is None


@pytest.mark.parametrize("binary", [True, False])
def test_octree_message_round_trip(binary, tmp_path):
    points = np.random.default_rng(1).uniform(-1, 1, (200, 3))
    tree = motion.OcTree.from_points(points, 0.05)
    again = motion.OcTree.from_message_data(tree.message_data(binary), 0.05, binary, "OcTree")
    assert all(again.contains(p) for p in points) and not again.contains((3, 3, 3))
    tree.save(str(tmp_path / "map.bt"))
    assert len(motion.OcTree.load(str(tmp_path / "map.bt"))) > 0
    with pytest.raises(motion.InvalidInputError, match="octomap"):
        motion.OcTree.from_message_data(b"", 0.05, True, "ColorOcTree")


def test_frames(scene):
    scene.set_transform("/camera", at(0, 0, 5))
    scene.add_object("table/top", [motion.Box(1, 1, 1)], pose=at(1), subframes={"edge": at(0.5)})
    for name, x in (("base", 0), ("/car", 2), ("table/top", 1), ("table/top/edge", 1.5), ("", 0)):
        assert scene.frame_pose(name).position[0] == pytest.approx(x), name
    assert scene.frame_pose("camera").position[2] == 5 and scene.knows_frame("camera") and not scene.knows_frame("table/top/none")
    with pytest.raises(motion.UnknownNameError, match="no frame 'nowhere'.*'camera'"):
        scene.frame_pose("nowhere")


def test_copies_share_nothing_that_is_written(scene):
    scene.add_object("o", [motion.Sphere(0.1)], pose=at(2))
    assert scene.check()
    child = scene.diff()
    child.remove_object("o")
    child.set_padding({"car": 0.1})
    acm = child.acm
    acm.set("base", "car", True)
    child.set_acm(acm)
    child.set_color("o", (1, 0, 0, 1))
    state = child.state
    state.set("slide", 0.0)
    child.set_state(state)
    assert scene.objects == ["o"] and scene.check() and scene.padding == {} and scene.colors == {}
    assert scene.state.get("slide") == 2.0 and not child.check() and scene.acm.get("base", "car") is None


def test_distance(scene):
    scene.add_object("box", [motion.Box(0.2, 0.2, 0.2)], pose=at(2.5))
    found = scene.distance()
    assert found.distance == pytest.approx(0.3, abs=1e-6) and (found.body_1, found.body_2) == ("car", "box")
    np.testing.assert_allclose(found.points, [[2.1, 0, 0], [2.4, 0, 0]], atol=1e-3)
    assert scene.distance(moved(scene, 2.4)).distance == 0.0


def test_many_states_at_once(scene):
    scene.add_object("box", [motion.Box(0.2, 0.2, 0.2)], pose=at(3.0))
    assert scene.check_states("car", [[2.0], [2.9], [0.1], [4.0]]).tolist() == [False, True, True, False]


@pytest.mark.parametrize(
    "call, said",
    [
        (lambda s: s.add_object("o", []), "object 'o' has no shapes"),
        (lambda s: s.add_object("", [motion.Sphere(1)]), "needs an id"),
        (lambda s: s.add_object("o", [motion.Sphere(1)], shape_poses=[HERE, HERE]), "2 shape poses for 1 shapes"),
        (lambda s: motion.Sphere(-1), "radius is -1"),
        (lambda s: motion.Box(1, float("nan"), 1), "an edge is nan"),
        (lambda s: motion.Mesh([[0, 0, 0]], [[0, 1, 2]]), "vertex 2 of 1"),
        (lambda s: motion.Plane(0, 0, 0, 1), "not all zero"),
        (lambda s: s.set_padding({"car": -0.5}), "negative"),
        (lambda s: s.move_object("o", ((0, 0, np.inf), (0, 0, 0, 1))), "not finite"),
    ],
)
def test_bad_input_is_refused_and_changes_nothing(scene, call, said):
    before = scene.objects, scene.padding
    with pytest.raises(motion.InvalidInputError, match=said):
        call(scene)
    assert (scene.objects, scene.padding) == before


def test_a_thousand_objects(scene):
    for i in range(1000):
        scene.add_object(f"o{i}", [motion.Sphere(0.01)], pose=at(-4 + i * 0.002, 1.0))
    assert not scene.check(moved(scene, -3))
    scene.add_object("last", [motion.Sphere(0.01)], pose=at(-3))
    (contact,) = scene.check(moved(scene, -3), contacts=1).contacts
    assert contact.body_2 == "last"

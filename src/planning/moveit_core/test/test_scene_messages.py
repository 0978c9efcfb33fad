"""Messages that change a planning scene, and the scene as a message."""

import math

import motion
import numpy as np
import pytest
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from moveit_core import convert
from moveit_core.scene_messages import SceneEditor, acm_from_message, acm_message, octomap_message, scene_message
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    LinkPadding,
    OrientationConstraint,
    PlanningScene,
    PlanningSceneComponents,
    PositionConstraint,
)
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive


def at(x=0.0, y=0.0, z=0.0, yaw=0.0):
    return Pose(Point(x, y, z), Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2)))


def box(name="box", x=0.0, **more):
    return CollisionObject(id=name, primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.2, 0.3])], pose=at(x), **more)


def attached(name, link, operation=CollisionObject.ADD, touch=()):
    message = AttachedCollisionObject(link_name=link, touch_links=list(touch))
    message.object.id, message.object.operation = name, operation
    return message


@pytest.mark.parametrize("w, frame", [(0.0, 0.5), (1.0, 0.0)])
def test_an_object_of_one_shape_is_where_its_shape_is_if_nobody_says_where_it_is(editor, scene, w, frame):
    """A pose is not set as long as all of it is 0; w = 1 is one without a turn, and stays."""
    message = CollisionObject(id="one", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.1, 0.1])], primitive_poses=[at(0.5)])
    message.header.frame_id, message.pose.orientation.w = scene.frame, w
    message.subframe_names, message.subframe_poses = ["lid"], [at(z=0.3)]
    assert editor.collision_object(message)
    assert scene.frame_pose("one").position[0] == frame and scene.frame_pose("one/lid").position[0] == frame
    move = CollisionObject(id="one", operation=CollisionObject.MOVE, pose=at(z=1.0), header=message.header)
    assert editor.collision_object(move)
    assert scene.frame_pose("one").position == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize("shapes, poses, taken", [(1, 2, 1), (2, 1, 1), (2, 2, 2)])
def test_regions_are_of_the_shapes_that_have_poses(scene, shapes, poses, taken):
    constraint = PositionConstraint(link_name="tip", weight=1.0)
    constraint.header.frame_id = scene.frame
    constraint.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [0.1])] * shapes
    constraint.constraint_region.primitive_poses = [at(0.1)] * poses
    (read,) = convert.constraints(Constraints(position_constraints=[constraint]), scene).position
    assert len(read.region) == taken


def test_a_region_without_a_pose_is_none(scene):
    constraint = PositionConstraint(link_name="tip", weight=1.0)
    constraint.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [0.1])]
    with pytest.raises(ValueError, match="has no region"):
        convert.constraints(Constraints(position_constraints=[constraint]), scene)


def test_a_fixed_frame_is_named_in_the_header_and_ends_at_the_planning_frame(editor, scene, said):
    """As upstream, and as moveit_core's C++ class has it: the other way round than TF."""
    camera = TransformStamped(child_frame_id="/" + scene.frame)
    camera.header.frame_id, camera.transform.translation.x, camera.transform.rotation.w = "camera", 1.5, 1.0
    as_tf = TransformStamped(child_frame_id="lamp")
    as_tf.header.frame_id, as_tf.transform.translation.x, as_tf.transform.rotation.w = scene.frame, 0.5, 1.0
    editor.planning_scene(PlanningScene(is_diff=True, fixed_frame_transforms=[camera, as_tf]))
    assert scene.frame_pose("camera").position[0] == 1.5 and set(scene.transforms) == {"camera"}
    assert [(message.header.frame_id, message.child_frame_id) for message in scene_message(scene).fixed_frame_transforms] == [
        ("camera", scene.frame)
    ]
    assert any("Given transform is to frame 'lamp'" in line for line in said)


def test_every_shape_goes_in_and_comes_out(editor, scene):
    message = box("all", 1.0)
    message.primitives += [
        SolidPrimitive(kind, size)
        for kind, size in ((SolidPrimitive.SPHERE, [0.5]), (SolidPrimitive.CYLINDER, [2.0, 0.25]), (SolidPrimitive.CONE, [1.0, 0.5]))
    ]
    message.primitive_poses = [at(0, 1), at(0, 2)]
    message.meshes = [Mesh([MeshTriangle((0, 1, 2))], [Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)])]
    message.mesh_poses = [at(z=3)]
    message.planes, message.plane_poses = [Plane([0, 0, 1, 0.5])], [at()]
    message.subframe_names, message.subframe_poses = ["top"], [at(z=0.15)]
    message.type.key = "crate"
    assert editor.collision_object(message)
    back = scene_message(scene).world.collision_objects[0]
    assert [list(shape.dimensions) for shape in back.primitives] == [[0.1, 0.2, 0.3], [0.5], [2.0, 0.25], [1.0, 0.5]]
    assert [pose.position.y for pose in back.primitive_poses] == [1, 2, 0, 0]  # missing poses are none at all
    assert len(back.meshes[0].vertices) == 3 and back.mesh_poses[0].position.z == 3
    assert list(back.planes[0].coef) == [0, 0, 1, 0.5]
    assert back.subframe_names == ["top"] and back.type.key == "crate" and back.pose.position.x == 1.0
    assert scene.frame_pose("all/top").position == pytest.approx([1, 0, 0.15])


def may_touch(scene, name, link):
    return scene.acm.get(name, link)


def allow_and_paint(editor, scene, *names):
    matrix = scene.acm
    for name in names:
        matrix.set(name, scene.model.links[-1], True)
        matrix.set_default(name, True)
        scene.set_color(name, (1, 0, 0, 1))
    scene.set_acm(matrix)


@pytest.mark.parametrize("how", ["by its name", "with all others", "detached and then removed", "by a scene that is no diff"])
def test_permissions_and_colours_end_with_their_object(editor, scene, how):
    link = scene.model.links[-1]
    for name in ("thing", "other"):
        assert editor.collision_object(box(name))
    allow_and_paint(editor, scene, "thing", "other", "<octomap>", link)
    if how == "detached and then removed":
        assert editor.attached_object(attached("thing", link))
        assert may_touch(scene, "thing", link) and "thing" in scene.colors  # it is still there
        assert editor.attached_object(attached("thing", "", CollisionObject.REMOVE))
    if how == "by a scene that is no diff":
        assert editor.planning_scene(PlanningScene(is_diff=False))
        assert not scene.colors and not scene.acm.names
        return
    assert editor.collision_object(CollisionObject(id="" if how == "with all others" else "thing", operation=CollisionObject.REMOVE))
    assert may_touch(scene, "thing", link) is None and scene.acm.get_default("thing") is None
    stay = {"<octomap>", link} if how == "with all others" else {"<octomap>", link, "other"}
    assert set(scene.colors) == stay and set(scene.acm.defaults) == stay
    assert editor.collision_object(box("thing")) and may_touch(scene, "thing", link) is None


def test_an_object_with_the_name_of_a_link_takes_nothing_of_the_links_with_it(editor, scene):
    link, other = scene.model.links[-1], scene.model.links[0]
    matrix = scene.acm
    matrix.set(link, other, True)
    scene.set_acm(matrix)
    assert editor.collision_object(box(link)) and editor.collision_object(CollisionObject(id=link, operation=CollisionObject.REMOVE))
    assert may_touch(scene, link, other) is True


def test_the_pose_of_a_single_shape_becomes_that_of_its_object(editor, scene):
    message = CollisionObject(id="old", primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [0.1])], primitive_poses=[at(2, 3)])
    assert editor.collision_object(message)
    assert scene.object("old").pose.position == pytest.approx([2, 3, 0])
    assert scene.object("old").shape_poses[0].position == pytest.approx([0, 0, 0])


def test_add_replaces_append_adds_move_moves_remove_removes(editor, scene):
    assert editor.collision_object(box())
    assert editor.collision_object(box(x=0.5)) and len(scene.object("box").shapes) == 1
    assert editor.collision_object(box(x=1.0, operation=CollisionObject.APPEND)) and len(scene.object("box").shapes) == 2
    assert scene.object("box").shape_poses[1].position == pytest.approx([0.5, 0, 0])
    assert editor.collision_object(CollisionObject(id="box", operation=CollisionObject.MOVE, pose=at(3)))
    assert scene.object("box").pose.position == pytest.approx([3, 0, 0]) and len(scene.object("box").shapes) == 2
    assert editor.collision_object(CollisionObject(id="box", operation=CollisionObject.REMOVE)) and not scene.objects
    assert editor.collision_object(box("a")) and editor.collision_object(box("b"))
    assert editor.collision_object(CollisionObject(operation=CollisionObject.REMOVE)) and not scene.objects


def test_objects_are_placed_in_any_known_frame(editor, scene):
    state = scene.state
    state.set({"slide": 0.25})
    scene.set_state(state)
    message = box(x=0.5)
    message.header.frame_id = "/tip"
    assert editor.collision_object(message)
    assert scene.object("box").pose.position == pytest.approx([0.5, 0, 1.25])


@pytest.mark.parametrize(
    "change, words",
    [
        (dict(primitives=[]), "no shape"),
        (dict(id=""), "needs a name"),
        (dict(id="<octomap>"), "kept for the octomap"),
        (dict(primitives=[SolidPrimitive(SolidPrimitive.BOX, [1, 1])]), "3 dimensions, not 2"),
        (dict(primitives=[SolidPrimitive(9, [1, 1])]), "primitive type 9"),
        (dict(primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [float("nan")])]), "not finite"),
        (dict(primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [-1.0])]), "negative"),
        (dict(primitives=[], meshes=[Mesh([MeshTriangle((0, 1, 5))], [Point()] * 3)]), "vertex 5"),
        (dict(primitives=[], planes=[Plane([0, 0, 0, 1])]), "normal 0 0 0"),
        (dict(pose=at(float("inf"))), "not finite"),
        (dict(operation=7), "operation 7"),
        (dict(operation=CollisionObject.MOVE), "cannot be moved"),
        (dict(operation=CollisionObject.REMOVE), "cannot be removed"),
        (dict(subframe_names=["a"]), "1 subframe_names and 0 subframe_poses"),
    ],
)
def test_bad_objects_are_refused_in_one_line_and_change_nothing(editor, scene, said, change, words):
    message = box("bad")
    for name, value in change.items():
        setattr(message, name, value)
    assert not editor.collision_object(message)
    assert len(said) == 1 and words in said[0] and "\n" not in said[0] and not scene.objects


def test_unknown_frames_are_named(editor, said):
    message = box()
    message.header.frame_id = "kitchen"
    assert not editor.collision_object(message) and "kitchen" in said[0]


def test_attach_takes_an_object_out_of_the_world_and_detach_puts_it_back(editor, scene):
    editor.collision_object(box(x=0.5))
    assert editor.attached_object(attached("box", "tip"))
    body = scene.state.attached[0]
    assert (body.id, body.link, list(body.touch_links)) == ("box", "tip", ["tip"]) and not scene.objects
    state = scene.state
    state.set({"slide": 0.5})
    scene.set_state(state)
    assert editor.attached_object(attached("box", "", CollisionObject.REMOVE))
    assert scene.object("box").pose.position == pytest.approx([0.5, 0, 0.5]) and not scene.state.attached


def test_attach_with_shapes_places_them_in_the_frame_of_the_message(editor, scene):
    message = attached("tool", "tip", touch=["arm"])
    message.object = box("tool", 0.5)
    message.object.header.frame_id = "tip"
    assert editor.attached_object(message)
    assert scene.state.pose("tool").position == pytest.approx([0.5, 0, 1.0])
    back = scene_message(scene).robot_state.attached_collision_objects[0]
    assert back.link_name == "tip" and sorted(back.touch_links) == ["arm", "tip"] and back.object.pose.position.x == 0.5


@pytest.mark.parametrize(
    "message, words",
    [
        (attached("box", "claw"), "no link 'claw'"),
        (attached("ghost", "tip"), "no such object; there are: box"),
        (attached("box", "tip", CollisionObject.REMOVE), "it is not attached"),
        (attached("box", "tip", 5), "operation 5"),
        (attached("held", "arm", CollisionObject.REMOVE), "attached to link 'tip', not to 'arm'"),
    ],
)
def test_bad_attachments_are_refused(editor, scene, said, message, words):
    editor.collision_object(box())
    editor.collision_object(box("held"))
    editor.attached_object(attached("held", "tip"))
    assert not editor.attached_object(message)
    assert words in said[-1] and scene.objects == ["box"] and [body.id for body in scene.state.attached] == ["held"]


def test_a_diff_changes_only_what_it_names(editor, scene):
    editor.collision_object(box("kept"))
    matrix = scene.acm
    diff = PlanningScene(is_diff=True, link_padding=[LinkPadding("tip", 0.02)])
    diff.robot_state.is_diff = True
    diff.world.collision_objects = [box("new")]
    assert editor.planning_scene(diff)
    assert sorted(scene.objects) == ["kept", "new"] and scene.padding["tip"] == pytest.approx(0.02)
    assert scene.acm.matrix()[0] == matrix.matrix()[0]


def test_a_whole_scene_replaces_everything(editor, scene):
    editor.collision_object(box("old"))
    editor.collision_object(box("held"))
    editor.attached_object(attached("held", "tip"))
    whole = PlanningScene(name="mine")
    whole.world.collision_objects = [box("new")]
    assert editor.planning_scene(whole)
    assert scene.objects == ["new"] and scene.name == "mine" and not scene.state.attached and scene.acm.names == []


def test_a_scene_survives_being_sent(editor, scene):
    editor.collision_object(box("box", 0.5))
    editor.collision_object(box("held"))
    editor.attached_object(attached("held", "tip"))
    state = scene.state
    state.set({"turn": 0.5, "base_joint/x": 1.0, "base_joint/theta": 0.25})
    scene.set_state(state)
    other = motion.PlanningScene(scene.model)
    assert SceneEditor(other).planning_scene(scene_message(scene))
    assert other.objects == ["box"] and [body.id for body in other.state.attached] == ["held"]
    assert np.allclose(other.state.positions, scene.state.positions)
    assert other.acm.matrix()[0] == scene.acm.matrix()[0]


def test_components_choose_what_is_sent(editor, scene):
    editor.collision_object(box())
    names = scene_message(scene, PlanningSceneComponents.WORLD_OBJECT_NAMES)
    assert [item.id for item in names.world.collision_objects] == ["box"] and not names.world.collision_objects[0].primitives
    assert not names.robot_state.joint_state.name and not names.link_padding
    state = scene_message(scene, PlanningSceneComponents.ROBOT_STATE)
    assert state.robot_state.joint_state.name == ["turn", "slide"] and not state.world.collision_objects
    assert state.robot_state.multi_dof_joint_state.joint_names == ["base_joint"]


def test_the_upper_half_of_a_matrix_counts():
    message = AllowedCollisionMatrix(
        entry_names=["a", "b"],
        entry_values=[AllowedCollisionEntry([False, True]), AllowedCollisionEntry([False, False])],
        default_entry_names=["c"],
        default_entry_values=[True],
    )
    matrix = acm_from_message(message)
    assert matrix.get("a", "b") is True and matrix.get_default("c") is True
    back = acm_message(matrix)
    assert back.entry_names == ["a", "b"] and back.default_entry_names == ["c"]
    assert back.entry_values[1].enabled == [True, False]
    message.entry_values.pop()
    with pytest.raises(ValueError, match="2 rows of 2"):
        acm_from_message(message)


def test_an_octomap_survives_being_sent(editor, scene, said):
    scene.set_octomap(motion.OcTree.from_points(np.array([[1.0, 0, 0], [1.0, 0.5, 0]]), 0.1), ((0, 0, 1), (0, 0, 0, 1)))
    message = octomap_message(scene)
    scene.set_octomap(None)
    assert editor.octomap(message) and scene.octomap.resolution == pytest.approx(0.1)
    assert scene.octomap_pose.position == pytest.approx([0, 0, 1])
    message.octomap.id = "ColorThing"
    assert not editor.octomap(message) and "ColorThing" in said[-1]


def test_a_diff_takes_the_octomap_away_when_it_names_one_without_data(editor, scene):
    tree = motion.OcTree.from_points(np.array([[1.0, 0, 0]]), 0.1)
    scene.set_octomap(tree, ((0, 0, 1), (0, 0, 0, 1)))
    diff = PlanningScene(is_diff=True)
    assert editor.planning_scene(diff) and scene.octomap is not None
    diff.world.octomap.octomap.id = "OcTree"
    assert editor.planning_scene(diff) and scene.octomap is None
    scene.set_octomap(tree, ((0, 0, 1), (0, 0, 0, 1)))
    assert editor.planning_scene(PlanningScene()) and scene.octomap is None


def test_pairs_in_a_message_have_what_their_defaults_say():
    """As disable_default_collisions and enable_collisions of an SRDF make them."""
    matrix = motion.AllowedCollisionMatrix()
    matrix.set("a", "b", False)
    matrix.set("c", "d", False)
    matrix.set_default("a", True)
    assert matrix.allowed("a", "c") and not matrix.allowed("a", "b")
    back = acm_from_message(acm_message(matrix))
    for one, other in (("a", "b"), ("a", "c"), ("b", "c"), ("c", "d")):
        assert back.allowed(one, other) == matrix.allowed(one, other), (one, other)


def test_path_constraints_without_a_link_are_left_out_and_said(scene, said):
    message = Constraints(orientation_constraints=[OrientationConstraint(orientation=Quaternion(0, 0, 0, 1))])
    assert convert.path_constraints(message, scene, said.append).empty()
    assert "orientation_constraints names no link" in said[-1]
    message.orientation_constraints[0].link_name = "no_such_link"
    with pytest.raises(ValueError, match="no link of that name"):
        convert.path_constraints(message, scene, said.append)

"""Text files of scenes and queries, and the file of the warehouse itself."""

import pytest
from geometry_msgs.msg import Point, Pose, Quaternion
from moveit_msgs.msg import CollisionObject, Constraints, MotionPlanRequest, ObjectColor, PlanningScene, RobotState, RobotTrajectory
from moveit_ros_planning import scene_text
from moveit_ros_warehouse import queries
from moveit_ros_warehouse.storage import StorageError, Warehouse
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive
from std_msgs.msg import ColorRGBA

# as RViz of Noetic and of Melodic export it
NEW = """kitchen
* a table
0.5 0 0.4
0 0 0 1
2
box
0.6 1.2 0.05
0 0 0.1
0 0 0 1
0.5 0.25 0 1
cylinder
0.05 0.8
0 0 -0.3
0 0 0 1
0.5 0.25 0 1
1
edge
0.3 0 0
0 0 0.70710678 0.70710678
.
"""
OLD = """(noname)
* Box_0
1
box
0.1 0.2 0.3
1 0 0.5
0 0 0 1
0 0 0 0
* Ball
1
sphere
0.25
0 1 0
0 0 0 1
0 0 0 0
.
"""


def test_scenes_of_noetic_and_melodic_are_read():
    scene = scene_text.read(NEW, "world")
    (table,) = scene.world.collision_objects
    assert (scene.name, table.id, table.header.frame_id, scene.is_diff) == ("kitchen", "a table", "world", True)
    assert table.pose.position.z == 0.4 and table.primitive_poses[1].position.z == -0.3
    assert list(table.primitives[0].dimensions) == [0.6, 1.2, 0.05]
    assert (table.primitives[1].type, list(table.primitives[1].dimensions)) == (SolidPrimitive.CYLINDER, [0.8, 0.05])
    assert table.subframe_names == ["edge"] and scene.object_colors[0].color.g == 0.25
    box, ball = scene_text.read(OLD).world.collision_objects
    assert box.primitive_poses[0].position.x == 1 and box.pose.orientation.w == 1
    assert list(ball.primitives[0].dimensions) == [0.25]


def test_what_is_written_is_read_again():
    item = CollisionObject(id="thing", pose=Pose(Point(1, 2, 3), Quaternion(0, 0, 0, 1)))
    item.primitives = [SolidPrimitive(SolidPrimitive.CONE, [0.4, 0.1])]
    item.meshes = [Mesh([MeshTriangle((0, 1, 2))], [Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)])]
    item.planes = [Plane([0, 0, 1, 0.25])]
    item.primitive_poses = item.mesh_poses = item.plane_poses = [Pose(Point(0.125, 0, 0), Quaternion(0, 0, 0, 1))]
    scene = PlanningScene(name="s", object_colors=[ObjectColor("thing", ColorRGBA(1, 0, 0, 0.5))])
    scene.world.collision_objects = [item]
    text = scene_text.write(scene)
    assert text.startswith(
        "s\n* thing\n1 2 3\n0 0 0 1\n3\ncone\n0.1 0.4\n0.125 0 0\n0 0 0 1\n1 0 0 0.5\nmesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 2\n"
    )
    assert text.endswith("plane\n0 0 1 0.25\n0.125 0 0\n0 0 0 1\n1 0 0 0.5\n0\n.\n")
    again = scene_text.read(text)
    item.operation, found = CollisionObject.ADD, again.world.collision_objects[0]
    assert found == item and again.object_colors == scene.object_colors


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("box", "pyramid", "line 6: shape 'pyramid' is unknown"),
        ("0.6 1.2", "0.6 wide", "line 7: a box is 3 numbers, not '0.6 wide 0.05'"),
        ("0.6 1.2", "nan 1.2", "a box is 3 numbers"),
        ("\n2\n", "\ntwo\n", "the number of shapes is 'two'"),
        ("\n.\n", "\n", "the text ends"),
        ("* a table", "- a table", "line 2: '-' stands where"),
    ],
)
def test_broken_scenes_are_refused_with_the_line(old, new, message):
    with pytest.raises(ValueError, match=message.replace("(", "\\(")):
        scene_text.read(NEW.replace(old, new, 1))


def test_queries():
    text = (
        "kitchen\nstart\n1\nhome\njoint_1 = 0.5\njoint_2 = -1\n.\n"
        "goal\n1\nlink_constraint\ngrasp\nhand\nxyz 0.3 0 0.5\nrpy 0.1 0.2 0.3\n.\n"
    )
    found = queries.read(text)
    assert found.scene == "kitchen" and found.starts == {"home": {"joint_1": 0.5, "joint_2": -1.0}}
    assert found.goals == {"grasp": ("hand", [0.3, 0, 0.5], [0.1, 0.2, 0.3])}
    assert queries.read(queries.write(found)) == found
    constraints = queries.goal_constraints("grasp", *found.goals["grasp"], frame="world")
    link, xyz, rpy = queries.goal_of(constraints)
    assert (link, xyz) == ("hand", (0.3, 0, 0.5)) and rpy == pytest.approx((0.1, 0.2, 0.3))
    with pytest.raises(ValueError, match="line 5: 'joint_1 = much'"):
        queries.read(text.replace("= 0.5", "= much"))
    with pytest.raises(ValueError, match="needs a line 'xyz x y z' and one 'rpy r p y'"):
        queries.read(text.replace("rpy 0.1 0.2 0.3\n", ""))
    with pytest.raises(ValueError, match="line 2: 'begin'"):
        queries.read(text.replace("start", "begin"))


def test_the_file_keeps_everything_apart(tmp_path):
    with pytest.raises(StorageError, match="cannot be used"):
        Warehouse("/proc/no/such.sqlite")
    (tmp_path / "text.sqlite").write_text("this is no database " * 100)
    with pytest.raises(StorageError, match="not a database"):
        Warehouse(str(tmp_path / "text.sqlite"))
    base, other = Warehouse(str(tmp_path / "a" / "w.sqlite")), Warehouse(str(tmp_path / "a" / "w.sqlite"))
    base.constraints.save("up", Constraints(name="x"), robot="arm", planning_group="left")
    base.constraints.save("up", Constraints(), robot="arm", planning_group="right")
    base.constraints.save("loose", Constraints())
    assert other.constraints.names(planning_group="left") == ["up"] and other.constraints.names() == ["loose", "up"]
    assert other.constraints.names_without_owner() == ["loose"]
    assert other.constraints.load("up", robot="arm").name == "up"
    other.constraints.rename("up", "upright", planning_group="left")
    assert base.constraints.names() == ["loose", "up", "upright"]
    base.constraints.remove("up")
    for call in (lambda: base.constraints.load("up"), lambda: base.constraints.remove("up"), lambda: base.constraints.rename("up", "a")):
        with pytest.raises(StorageError, match="no constraints 'up'"):
            call()
    with pytest.raises(StorageError, match="without a name"):
        base.states.save("", RobotState())


def test_requests_and_results_belong_to_scenes(tmp_path):
    base = Warehouse(str(tmp_path / "w.sqlite"))
    base.scenes.save("kitchen", PlanningScene())
    first, second = MotionPlanRequest(group_name="a"), MotionPlanRequest(group_name="b")
    assert base.add_request("kitchen", first) == base.add_request("kitchen", first) == "Motion Plan Request 0"
    assert base.add_request("kitchen", second) == "Motion Plan Request 1" and base.add_request("kitchen", second, "pick") == "pick"
    base.add_result("kitchen", first, RobotTrajectory())
    base.add_result("kitchen", first, RobotTrajectory())
    assert len(base.results_of("kitchen", "Motion Plan Request 0")) == 2 and not base.results_of("office", "Motion Plan Request 0")
    base.add_request("office", first)
    base.remove_scene("kitchen")
    assert base.requests.names() == ["Motion Plan Request 0"] and not base.results.names() and not base.scenes.names()

"""Texts of the small programs, in the layouts that upstream's RobotModel::printModelInfo and PlanningScene::printKnownObjects have."""

import motion
import pytest
from moveit_msgs.msg import AttachedCollisionObject, CollisionObject, PlanningScene
from moveit_ros_planning.model_text import model_text
from moveit_ros_planning.programs import known_objects, random_state

URDF = """<robot name="r"><link name="base"/>
<link name="arm"><collision><geometry><box size="1 1 1"/></geometry></collision>
  <collision><geometry><sphere radius="1"/></geometry></collision></link><link name="pad"/><link name="tip"/>
<joint name="turn" type="continuous"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
  <limit effort="1" velocity="2.5"/></joint>
<joint name="slide" type="prismatic"><parent link="arm"/><child link="pad"/><axis xyz="1 0 0"/>
  <limit effort="1" velocity="1" lower="-0.5" upper="0.25"/></joint>
<joint name="follow" type="prismatic"><parent link="arm"/><child link="tip"/><axis xyz="1 0 0"/>
  <limit effort="1" velocity="1" lower="-0.5" upper="0.25"/><mimic joint="slide" multiplier="-2" offset="0.1"/></joint></robot>"""
SRDF = """<robot name="r"><group name="pads"><joint name="follow"/><joint name="slide"/></group>
<group name="arm"><joint name="turn"/></group><passive_joint name="slide"/></robot>"""


@pytest.fixture(scope="module")
def lines():
    model = motion.load_model(URDF, SRDF, joint_limits={"slide": {"has_acceleration_limits": True, "max_acceleration": 3.0}})
    return model_text(model, ["arm"]).splitlines()


def below(lines, first, count):
    start = lines.index(first)
    return lines[start : start + count]


def test_a_model_begins_with_its_name(lines):
    assert lines[:2] == ["Model r in frame base, using 3 variables", "Joints: "]


def test_a_joint_tells_its_variable_and_limits_to_five_places(lines):
    slide = below(lines, " 'slide' (Prismatic)", 5)
    assert slide[2] == "  * 1 variable:"
    assert slide[3].endswith(" in full state, passive")
    assert slide[4] == "        P.bounded [-0.50000, 0.25000]; V.bounded [-1.00000, 1.00000]; A.bounded [-3.00000, 3.00000];"


def test_a_continuous_joint_is_revolute_and_unbounded(lines):
    turn = below(lines, " 'turn' (Revolute)", 5)
    assert turn[4].startswith("        P.unbounded [-3.14159, 3.14159]; V.bounded [-2.50000, 2.50000]; A.unbounded [0.00000, 0.00000];")


def test_a_joint_that_follows_names_its_leader(lines):
    assert below(lines, " 'follow' (Prismatic)", 4)[3].endswith(" in full state, mimic 'slide'")


def test_a_link_tells_its_shapes_and_its_joint(lines):
    assert below(lines, " 'base' with 0 geoms", 3)[1:] == ["   * parent joint is fixed", "   * joint origin transform is identity"]
    arm = below(lines, " 'arm' with 2 geoms", 2)
    assert arm[1].startswith(" '"), "neither fixed nor at its parent's origin"


def test_a_group_tells_places_in_the_full_state_and_in_its_own(lines):
    pads = lines[lines.index("Group 'pads' using 2 variables") :]
    assert "  * Local Mimic Updates:" in pads
    assert any(line.endswith(" = -2 * [0] + 0.1") or line.endswith(" = -2 * [1] + 0.1") for line in pads)
    assert any(line.endswith("(contiguous)") for line in pads)


def test_a_group_with_a_solver_tells_its_order(lines):
    solvers = [i for i, line in enumerate(lines) if line == "  * Kinematics solver bijection:"]
    assert [lines[i + 1] for i in solvers] == ["    0 "]


def test_known_objects_are_those_of_the_world_and_those_that_are_held():
    scene = PlanningScene()
    scene.world.collision_objects = [CollisionObject(id="table"), CollisionObject(id="box")]
    scene.robot_state.attached_collision_objects = [AttachedCollisionObject(object=CollisionObject(id="tool"))]
    assert known_objects(scene).splitlines() == [
        "-" * 41,
        "PlanningScene Known Objects:",
        "  - Collision World Objects:",
        "\t- box",
        "\t- table",
        "  - Attached Bodies:",
        "\t- tool",
        "-" * 41,
    ]


def test_random_states_are_valid_or_invalid_as_asked():
    scene = motion.PlanningScene(motion.load_model(URDF, SRDF))
    assert random_state(scene, "invalid") is None, "one link with shapes touches nothing"
    for wanted in ("", "valid"):
        state = random_state(scene, wanted)
        assert -0.5 <= state.get_joint("slide")[0] <= 0.25

"""Packages written, read back, changed by hand and written again; and everything that must be refused."""

import os
import time

import pytest
import yaml
from moveit_setup_assistant import AssistantError, headless, package_writer
from moveit_setup_assistant.configuration import Configuration, Controller, Kinematics
from moveit_setup_assistant.robot_scene import RobotScene
from moveit_setup_assistant.robot_source import RobotSource
from moveit_setup_assistant.semantics import Semantics
from moveit_setup_assistant.simulation import simulated_urdf
from robots import FIVE
from roslaunch import xmlloader
from roslaunch.config import ROSLaunchConfig

CONFIG = """
groups:
  arm: {chain: [base, inside], solver: kdl, timeout: 0.02, planner: RRTConnect}
  wing: {joints: [swinging]}
  all: {groups: [arm, wing]}
poses:
  - {name: home, group: arm, joints: {turn: 0.5, spin: -0.25}}
end_effectors:
  - {name: hand, group: wing, parent_link: far}
virtual_joints:
  - {name: stand_here, type: fixed, parent_frame: world, child_link: base}
collisions: {trials: 300}
simulation: true
author: {name: Ada <Example>, email: ada@example.org}
"""


@pytest.fixture
def described(tmp_path, monkeypatch):
    """A description package, found by its name; gives the URDF's path."""
    folder = tmp_path / "src" / "small_description"
    (folder / "urdf").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>small_description</name></package>")
    (folder / "urdf" / "small.urdf").write_text(FIVE)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / 'src'}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
    return folder / "urdf" / "small.urdf"


def made(described, text=CONFIG):
    file = described.parents[1] / "config.yaml"
    file.write_text(text)
    return headless.configuration(RobotSource.from_file(described), file)


@pytest.fixture
def package(described):
    folder = described.parents[2] / "small_moveit_config"
    package_writer.write(made(described), folder)
    return folder


def read(path):
    return yaml.safe_load(path.read_text())


@pytest.mark.parametrize(
    "joints, told",
    [
        ("{turn: 0.5, spin: -0.25}", []),
        ("{turn: 1.0}", []),
        ("{turn: 1.5}", ["Pose 'home' of group 'arm': joint 'turn' is at 1.5, beyond its limits -1 to 1; MoveIt does not plan to it."]),
        ("{spin: -1.01}", ["Pose 'home' of group 'arm': joint 'spin' is at -1.01, beyond its limits -1 to 1; MoveIt does not plan to it."]),
        (
            "{swinging: 0.1}",
            ["Pose 'home' of group 'arm' moves joint 'swinging', which is not in that group: it is left out when MoveIt plans to it."],
        ),
    ],
)
def test_a_pose_that_cannot_be_reached_is_told(described, joints, told):
    """The URDF's limits are -1 to 1 rad; MoveIt's planners refuse a goal beyond them."""
    config = made(described, CONFIG.replace("{turn: 0.5, spin: -0.25}", joints))
    assert [line for line in config.incomplete() if line.startswith("Pose")] == told


def test_every_launch_file_loads_and_names_what_it_loads(package, monkeypatch):
    monkeypatch.setenv("DISPLAY", "")
    for file in sorted((package / "launch").glob("*.launch")):
        config = ROSLaunchConfig()
        words = ["cfg:=x", "moveit_warehouse_database_path:=x"]
        xmlloader.XmlLoader(resolve_anon=True).load(str(file), config, argv=words, verbose=False)
    config = ROSLaunchConfig()
    xmlloader.XmlLoader().load(str(package / "launch" / "demo.launch"), config, argv=[], verbose=False)
    values = {name: param.value for name, param in config.params.items()}
    assert values["/robot_description"] == FIVE
    assert values["/robot_description_kinematics/arm/kinematics_solver_timeout"] == 0.02
    assert values["/robot_description_planning/joint_limits/turn/max_velocity"] == 2.0
    assert values["/move_group/planning_pipelines/ompl/arm/default_planner_config"] == "RRTConnect"
    assert values["/move_group/planning_pipelines/ompl/planner_configs/TRRT/min_temperature"] == 1e-9
    assert values["/move_group/controller_list"][0]["joints"] == ["turn", "spin"]
    assert [node.args for node in config.nodes if node.type == "static_transform_publisher"] == ["0 0 0 0 0 0 world base"]
    config = ROSLaunchConfig()
    xmlloader.XmlLoader().load(str(package / "launch" / "gazebo.launch"), config, argv=[], verbose=False)
    spawned = next(node for node in config.nodes if node.type == "spawn_model")
    assert "-J turn 0.5 -J spin -0.25" in spawned.args
    assert next(n for n in config.nodes if n.name == "controller_spawner").args.split() == ["arm_controller", "wing_controller"]
    simulated = config.params["/robot_description"].value
    assert simulated.count("<inertial>") == 5 and simulated.count("SimpleTransmission") == 3 and "libgazebo_ros_control" in simulated


def test_the_files_say_what_was_asked_for(package):
    config = package / "config"
    common = {"action_ns": "follow_joint_trajectory", "type": "FollowJointTrajectory", "default": True}
    assert read(config / "simple_moveit_controllers.yaml")["controller_list"] == [
        {"name": "arm_controller", **common, "joints": ["turn", "spin"]},
        {"name": "wing_controller", **common, "joints": ["swinging"]},
    ]  # as MoveItConfigData::outputSimpleControllersYAML of MoveIt 1.1.14
    controllers = read(config / "ros_controllers.yaml")
    assert controllers["wing_controller"] == {
        "type": "effort_controllers/JointTrajectoryController",
        "joints": ["swinging"],
        "gains": {"swinging": {"p": 100, "d": 1, "i": 1, "i_clamp": 1}},
    }
    assert read(config / "fake_controllers.yaml")["initial"] == [{"group": "arm", "pose": "home"}]
    limits = read(config / "joint_limits.yaml")["joint_limits"]["spin"]
    assert limits == {"has_velocity_limits": True, "max_velocity": 2.0, "has_acceleration_limits": False, "max_acceleration": 0}
    assert read(config / "ompl_planning.yaml")["arm"]["projection_evaluator"] == "joints(turn,spin)"
    assert "<name>small_moveit_config</name>" in (package / "package.xml").read_text()
    assert "Ada &lt;Example&gt;" in (package / "package.xml").read_text()
    assert "<run_depend>small_description</run_depend>" in (package / "package.xml").read_text()


def test_what_is_read_back_is_what_was_written(described, package):
    once, again = made(described), Configuration.load(package)
    assert again.semantics.to_text() == once.semantics.to_text()
    assert again.kinematics == once.kinematics and again.default_planners == once.default_planners
    assert again.controllers == once.controllers and again.source == once.source
    assert {file.state.value for file in package_writer.plan(again, package)} == {"unchanged"}


MIXED = """controllers:
  - {name: still, type: position_controllers/JointGroupPositionController, joints: [spin]}
  - {name: hand, type: GripperCommand, joints: [swinging]}
  - {name: turner, type: somebodys_controllers/JointTrajectoryController, joints: [turn]}
  - {name: driver, type: FollowJointTrajectory, joints: [swinging]}
  - {name: wing, type: velocity_controllers/JointTrajectoryController, joints: [swinging]}
author:"""


def test_controllers_of_all_kinds_are_listed_and_read_back_once(described, tmp_path):
    once, folder = made(described, CONFIG.replace("author:", MIXED)), tmp_path / "mixed_config"
    package_writer.write(once, folder)
    listed = read(folder / "config" / "simple_moveit_controllers.yaml")["controller_list"]
    assert [(c["name"], c["type"], c["action_ns"]) for c in listed] == [
        ("hand", "GripperCommand", "gripper_action"),
        ("turner", "FollowJointTrajectory", "follow_joint_trajectory"),
        ("driver", "FollowJointTrajectory", "follow_joint_trajectory"),
        ("wing", "FollowJointTrajectory", "follow_joint_trajectory"),
    ]
    assert list(read(folder / "config" / "ros_controllers.yaml")) == ["still", "turner", "wing"]
    again = Configuration.load(folder)
    assert again.controllers == once.controllers
    assert {file.state.value for file in package_writer.plan(again, folder)} == {"unchanged"}


def test_a_package_of_older_assistants_has_each_controller_once(package):
    config = package / "config"
    (config / "simple_moveit_controllers.yaml").unlink()  # Melodic's has controller_list in ros_controllers.yaml
    entry = {"name": "arm_controller", "action_ns": "follow_joint_trajectory", "type": "FollowJointTrajectory", "joints": ["turn", "spin"]}
    started = {"type": "effort_controllers/JointTrajectoryController"}
    values = {"controller_list": [entry], "arm_controller": {**started, "joints": ["turn", "spin"]}, "w": {**started, "joints": "swinging"}}
    (config / "ros_controllers.yaml").write_text(yaml.safe_dump(values))
    again = Configuration.load(package)
    assert [(c.name, c.type, c.joints) for c in again.controllers] == [
        ("arm_controller", started["type"], ["turn", "spin"]),
        ("w", started["type"], ["swinging"]),
    ]


def test_what_was_changed_by_hand_stays_until_somebody_asks(package):
    limits = package / "config" / "joint_limits.yaml"
    limits.write_text(limits.read_text().replace("factor: 0.1", "factor: 0.5"))
    os.utime(limits, (time.time() + 60,) * 2)
    config = Configuration.load(package)
    config.kinematics["arm"] = Kinematics(solver="kdl_kinematics_plugin/KDLKinematicsPlugin", timeout=0.3)
    files = {file.path: file for file in package_writer.plan(config, package)}
    assert files["config/joint_limits.yaml"].state is package_writer.State.HAND_MADE and not files["config/joint_limits.yaml"].write
    assert files["config/kinematics.yaml"].state is package_writer.State.CHANGED
    assert package_writer.write(config, package) == ["config/kinematics.yaml", ".setup_assistant"]
    assert "0.5" in limits.read_text() and "0.3" in (package / "config" / "kinematics.yaml").read_text()
    files["config/joint_limits.yaml"].write = True
    package_writer.write(config, package, list(files.values()))
    assert "0.5" not in limits.read_text()


def test_elements_of_a_hand_written_srdf_survive(package):
    srdf = package / "config" / "small.srdf"
    srdf.write_text(
        srdf.read_text().replace(
            "</robot>",
            '<joint_property joint_name="turn" property_name="angular_distance_weight" '
            'value="2"/><disable_default_collisions link="far"/><of_my_own colour="red"/></robot>',
        )
    )
    text = Configuration.load(package).semantics.to_text()
    for kept in ('property_name="angular_distance_weight"', '<disable_default_collisions link="far" />', '<of_my_own colour="red" />'):
        assert kept in text


def test_an_srdf_of_macros_is_read_and_kept(package):
    """As panda_moveit_config has it."""
    srdf, marker = package / "config" / "small.srdf", package / ".setup_assistant"
    text = (
        srdf.read_text()
        .replace('name="home"', 'name="$(arg pose)"')
        .replace(
            '<robot name="small">', '<robot name="small" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="pose" default="home"/>'
        )
    )
    (package / "config" / "small.srdf.xacro").write_text(text)
    srdf.unlink()
    marker.write_text(marker.read_text().replace("config/small.srdf", "config/small.srdf.xacro"))
    controllers = package / "config" / "ros_controllers.yaml"
    controllers.write_text(controllers.read_text().replace("- turn", "- $(arg prefix)turn"))  # filled in when it is launched
    config = Configuration.load(package)
    assert not config.problems()
    assert [group.name for group in config.semantics.groups] == ["arm", "wing", "all"]
    assert config.semantics.group_states[0].name == "home"
    file = next(file for file in package_writer.plan(config, package) if file.path == "config/small.srdf.xacro")
    assert file.state is package_writer.State.HAND_MADE and not file.write


@pytest.mark.parametrize(
    "change, says",
    [
        (("chain: [base, inside]", "chain: [base, nowhere]"), "group 'arm' names the link 'nowhere'"),
        (("joints: [swinging]", "joints: [swing ing]"), "names the joint 'swing ing'"),
        (("groups: [arm, wing]", "groups: [all]"), "group 'all' holds itself"),
        (("{turn: 0.5,", "{turn: fast,"), "poses: home: turn: 'fast' is no number"),
        (("planner: RRTConnect", "planner: Fastest"), "'Fastest' is not known"),
        (("simulation: true", "simulations: true"), "'simulations' is not known; there are: groups,"),
        (("{trials: 300}", "[300]"), "collisions: must be a mapping"),
        (("type: fixed", "type: bolted"), "type 'bolted' is none of fixed"),
        (("name: hand, ", ""), "end_effectors[0]: 'name' is missing"),
        (("poses:", "poses: {"), "is no YAML"),
    ],
)
def test_a_mistake_in_the_file_is_named_in_one_line(described, change, says):
    with pytest.raises(AssistantError) as caught:
        made(described, CONFIG.replace(*change, 1))
    assert says in str(caught.value) and "\n" not in str(caught.value)


def test_an_author_is_needed_and_nothing_is_half_written(described, tmp_path):
    config = made(described, CONFIG.replace("ada@example.org", ""))
    with pytest.raises(AssistantError, match="e-mail"):
        package_writer.write(config, tmp_path / "new_config")
    assert [p.name for p in tmp_path.iterdir()] == ["src"]


def test_a_folder_of_somebody_else_is_left_alone(described, tmp_path):
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter.tex").write_text("years of work")
    with pytest.raises(AssistantError, match="is not empty"):
        package_writer.write(made(described), tmp_path / "thesis")
    with pytest.raises(AssistantError, match="cannot be the name of a package"):
        package_writer.write(made(described), tmp_path / "two words")
    assert [p.name for p in (tmp_path / "thesis").iterdir()] == ["chapter.tex"]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written(described, tmp_path):
    (tmp_path / "locked").mkdir(mode=0o500)
    with pytest.raises(AssistantError, match="cannot be written"):
        package_writer.write(made(described), tmp_path / "locked" / "config")


def test_what_the_system_does_not_let_us_look_at_is_one_line(described, tmp_path):
    too_long = tmp_path / ("a" * 300)
    for refused in (
        lambda: package_writer.refuse_foreign(too_long),
        lambda: package_writer.plan(made(described), too_long),
        lambda: RobotSource.from_file(too_long),
        lambda: Configuration.load(too_long),
    ):
        with pytest.raises(AssistantError, match="cannot be read: File name too long"):
            refused()


def test_a_write_that_fails_in_the_middle_leaves_the_package_as_it_was(package, monkeypatch):
    config = Configuration.load(package)
    config.author_name = "Somebody Else"
    before = {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}

    def full(*_, **__):
        raise OSError(28, "No space left on device", "launch/demo.launch")

    monkeypatch.setattr(package_writer.Path, "write_text", full)
    with pytest.raises(AssistantError, match="No space left.*as it was"):
        package_writer.write(config, package)
    assert before == {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}
    assert not [path for path in package.parent.iterdir() if path.name.startswith(".small")]


def test_descriptions_that_cannot_be_used(described, tmp_path):
    with pytest.raises(AssistantError, match="there is no such file"):
        RobotSource.from_file(tmp_path / "none.urdf")
    (tmp_path / "broken.urdf").write_text("<robot name='x'><link></robot>")
    with pytest.raises(AssistantError, match="broken.urdf' is no robot description: .* line 1, column 24"):
        Configuration.new(RobotSource.from_file(tmp_path / "broken.urdf"))
    (tmp_path / "broken.xacro").write_text('<robot name="x" xmlns:xacro="http://ros.org/wiki/xacro"><link name="${nobody}"/></robot>')
    with pytest.raises(AssistantError, match="xacro cannot expand .*nobody"):
        Configuration.new(RobotSource.from_file(tmp_path / "broken.xacro"))
    (tmp_path / "far.xacro").write_text(
        '<robot name="x" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:include filename="$(find nobody_has)/a.xacro"/></robot>'
    )
    with pytest.raises(AssistantError, match="package 'nobody_has' not found") as caught:
        Configuration.new(RobotSource.from_file(tmp_path / "far.xacro"))
    said = str(caught.value)  # the substitution, as xacro names it, and once why
    assert "$(find nobody_has): " in said and said.count("not found") == 1 and "<class" not in said
    with pytest.raises(AssistantError, match="has no ':='"):
        Configuration.new(RobotSource.from_file(tmp_path / "broken.xacro", "hand=true"))
    with pytest.raises(AssistantError, match="package 'moved_away', which is not found"):
        RobotSource("moved_away", "urdf/robot.urdf").load()


def test_a_robot_that_tinyxml_takes_is_read_drawn_and_simulated(tmp_path):
    path = tmp_path / "odd.urdf"
    path.write_text(FIVE.replace("</robot>", "<gazebo>a & b<topic>x?a=1&b=2</topic></gazebo></robot>"))
    loaded = RobotSource.from_file(path).load()
    assert len(RobotScene(loaded).links) == len(loaded.model.links)
    assert "gazebo_ros_control" in simulated_urdf(loaded.urdf, [])


def test_a_missing_mesh_is_a_warning(tmp_path):
    (tmp_path / "robot.urdf").write_text(
        '<robot name="r"><link name="base"><collision><geometry><mesh '
        'filename="package://nobody_has/base.stl"/></geometry></collision></link></robot>'
    )
    config = Configuration.new(RobotSource.from_file(tmp_path / "robot.urdf"))
    assert any("nobody_has/base.stl" in line for line in config.warnings)
    (tmp_path / "robot.urdf").write_text(
        '<robot name="r"><link name="base"><visual><geometry><mesh '
        'filename="package://nobody_has/look.dae"/></geometry></visual></link></robot>'
    )
    config = Configuration.new(RobotSource.from_file(tmp_path / "robot.urdf"))
    assert config.warnings == ["link 'base': a <visual> is not drawn: mesh 'package://nobody_has/look.dae' is not found"]


def test_default_controllers_take_no_joint_twice(described):
    config = made(described, CONFIG.replace("author:", "controllers: []\nauthor:"))
    config.controllers = [Controller("mine", "position_controllers/JointTrajectoryController", ["turn"])]
    config.add_default_controllers()
    assert [c.name for c in config.controllers] == ["mine", "wing_controller"]


def test_problems_of_an_srdf(described):
    config = made(described)
    text = config.semantics.to_text().replace('name="wing"', 'name="arm"')
    assert any("group 'arm' is there 2 times" in line for line in Semantics.from_xml_string(text).problems(config.robot.model))

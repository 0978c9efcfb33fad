import io
import math
import sys
import xml.etree.ElementTree as ET

import pytest
from gazebo_ros.commands import spawn_model

ROBOT = (
    '<?xml version="1.0"?><robot name="r"><!-- note --><link name="l"><visual><geometry>'
    '<mesh filename="package://p/m.stl"/></geometry></visual></link></robot>'
)


def parse(text):
    return spawn_model.parse(text.split())


@pytest.fixture
def robot(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(ROBOT)
    return path


def test_defaults():
    options = parse("-urdf -param robot_description -model arm")
    assert (options.gazebo_namespace, options.robot_namespace, options.reference_frame) == ("/gazebo", "/", "")
    assert not options.unpause and not options.bond and options.joints == []
    pose = spawn_model.pose_of(options)
    assert (pose.position.z, pose.orientation.w) == (0.0, 1.0)


def test_negative_numbers_and_joints():
    options = parse("-urdf -stdin -model arm -x -1.5 -Y -0.001 -J j0 -0.5 -J j1 2")
    assert options.x == -1.5 and options.joints == [["j0", -0.5], ["j1", 2.0]]


@pytest.mark.parametrize("angle, axis", [("-R", "x"), ("-P", "y"), ("-Y", "z")])
def test_angles(angle, axis):
    q = spawn_model.pose_of(parse(f"-sdf -stdin -model m {angle} 1.0")).orientation
    assert getattr(q, axis) == pytest.approx(math.sin(0.5)) and q.w == pytest.approx(math.cos(0.5))


@pytest.mark.parametrize(
    "arguments",
    [
        "-urdf -stdin",
        "-stdin -model m",
        "-urdf -model m",
        "-urdf -sdf -stdin -model m",
        "-urdf -stdin -file f -model m",
        "-urdf -stdin -model m -J elbow half",
        "-urdf -stdin -model m -x far",
        "-urdf -stdin -model m -warp",
    ],
)
def test_wrong_options_exit_with_2(arguments):
    with pytest.raises(SystemExit) as end:
        parse(arguments)
    assert end.value.code == 2


@pytest.mark.parametrize("name, letter", [("-roll", "-R"), ("-pitch", "-P"), ("-yaw", "-Y"), ("--yaw", "-Y")])
def test_an_angle_by_its_whole_name_is_told_its_letter(name, letter, capsys):
    with pytest.raises(SystemExit) as end:
        parse(f"-sdf -file f -model kinect -x 1.0 -y 0.0 {name} 3.1415")
    assert end.value.code == 2 and capsys.readouterr().err.endswith(f"the angle is called {letter}\n")


def text_of(arguments):
    return spawn_model.model_text(parse(arguments))[0]


def test_text_of_a_file(robot):
    root = ET.fromstring(text_of(f"-urdf -file {robot} -model m"))
    assert root.find("link/visual/geometry/mesh").get("filename") == "package://p/m.stl"


@pytest.mark.parametrize("option, scheme", [("", "package"), ("-package_to_model", "model")])
def test_the_text_keeps_its_lines_and_comments(tmp_path, option, scheme):
    text = (
        "<?xml version='1.0' encoding='utf-8'?>\n<!-- two\nlines, Höhe -->\n<robot name='r'>\n<link name='l'/><mesh\n"
        "scale='1 1 1' filename = 'package://p/m.stl'/>\n<note filename='package://p/n'/></robot>\n"
    )
    (tmp_path / "r.urdf").write_text(text, encoding="utf-8")
    sent, where = spawn_model.model_text(parse(f"-urdf -file {tmp_path / 'r.urdf'} -model m {option}"))
    assert where == str(tmp_path / "r.urdf")
    assert sent == text.replace("package://p/m.stl", f"{scheme}://p/m.stl")


def test_package_to_model(robot):
    root = ET.fromstring(text_of(f"-urdf -file {robot} -model m -package_to_model"))
    assert root.find("link/visual/geometry/mesh").get("filename") == "model://p/m.stl"


def test_text_of_standard_input_and_the_database(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO(ROBOT))
    assert ET.fromstring(text_of("-urdf -stdin -model m")).tag == "robot"
    root = ET.fromstring(text_of("-sdf -database coke_can -model m"))
    assert root.find("world/include/uri").text == "model://coke_can"


@pytest.mark.parametrize("content, said", [("<robot>", "not well-formed"), ("", "not well-formed"), (None, "cannot read")])
def test_bad_files_are_one_line_that_names_them(tmp_path, content, said):
    path = tmp_path / "bad.urdf"
    if content is not None:
        path.write_text(content)
    with pytest.raises(spawn_model.Failure) as failure:
        spawn_model.model_text(parse(f"-urdf -file {path} -model m"))
    assert said in str(failure.value) and str(path) in str(failure.value) and "\n" not in str(failure.value)


def test_missing_parameter_says_how_to_set_it(monkeypatch):
    def get_param(name):
        raise KeyError(name)

    monkeypatch.setattr(spawn_model.rospy, "get_param", get_param)
    with pytest.raises(spawn_model.Failure, match="parameter /robot_description is not set; .*<param"):
        spawn_model.model_text(parse("-urdf -param robot_description -model m"))


def test_plugins_of_a_urdf_get_folders_for_packages():
    """gazebo_ros_api_plugin's spawnURDFModel puts the package's folder for package://NAME; of what is not there nothing is changed."""
    from gazebo_ros.api.spawning import with_package_folders

    known = {"package://lidar": "/ws/lidar"}.get
    plugin = "<plugin filename='l.so' file=\"{0}/a.csv\"><csv> {0}/b c.csv</csv></plugin>"
    mesh = "<mesh filename='package://lidar/m.dae'/>"  # the simulator's own reader finds these, and says where it looked
    text = f"<robot>{mesh}<gazebo>{plugin}{plugin}</gazebo></robot>"
    assert with_package_folders(text.format("package://lidar"), known) == text.format("/ws/lidar")
    assert with_package_folders(text.format("package://absent"), known) == text.format("package://absent")

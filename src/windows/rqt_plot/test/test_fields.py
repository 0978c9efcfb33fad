"""Names of curves: what a name stands for, why it stands for nothing, and the number that it takes out of a message."""

import genpy
import pytest
from geometry_msgs.msg import PoseWithCovariance, Twist
from rqt_plot.fields import FieldError, expand, getter, parse_path, split_arguments, split_topic
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, Header, String
from tf2_msgs.msg import TFMessage

TYPES = {
    "/pose": "geometry_msgs/PoseWithCovariance",
    "/pose/ground": "geometry_msgs/Twist",
    "/joints": "sensor_msgs/JointState",
    "/on": "std_msgs/Bool",
    "/speed": "std_msgs/Float64",
    "/name": "std_msgs/String",
    "/tf": "tf2_msgs/TFMessage",
    "/strange": "nowhere_msgs/Thing",
}


@pytest.mark.parametrize(
    "arguments, names",
    [
        (["/a/x:y:z"], ["/a/x", "/a/y", "/a/z"]),
        (["/a/x,/b/y", "c"], ["/a/x", "/b/y", "c"]),
        (["/turtle1/pose/x:y,/b"], ["/turtle1/pose/x", "/turtle1/pose/y", "/b"]),
        (["/j/position[0]:position[1]"], ["/j/position[0]", "/j/position[1]"]),
    ],
)
def test_names_of_a_command_line(arguments, names):
    assert split_arguments(arguments) == names


def test_colon_without_a_field():
    with pytest.raises(FieldError, match="x:y must contain a topic and field name"):
        split_arguments(["x:y"])


def test_the_longest_topic_is_meant():
    assert split_topic("/pose/ground/linear/x", TYPES) == ("/pose/ground", "/linear/x")
    assert split_topic("/pose/pose/position/x", TYPES) == ("/pose", "/pose/position/x")
    assert split_topic("/posed/x", TYPES) == (None, "")


@pytest.mark.parametrize(
    "name, curves",
    [
        ("/speed", ["/speed/data"]),
        ("/speed/data", ["/speed/data"]),
        ("/on", ["/on/data"]),
        ("/on/data", ["/on/data"]),
        ("/pose/ground/linear", ["/pose/ground/linear/x", "/pose/ground/linear/y", "/pose/ground/linear/z"]),
        ("/pose/covariance", [f"/pose/covariance[{i}]" for i in range(36)]),
        ("/joints/position[3]", ["/joints/position[3]"]),
        ("/joints/position/3", ["/joints/position/3"]),
        ("/joints/header/stamp", ["/joints/header/stamp"]),
        ("/joints/header", ["/joints/header/seq"]),
        ("/tf/transforms[0]/transform/translation/x", ["/tf/transforms[0]/transform/translation/x"]),
        ("/pose/ground", []),
        ("/nothing/x", None),
    ],
)
def test_what_a_name_stands_for(name, curves):
    assert expand(name, TYPES)[0] == curves


@pytest.mark.parametrize(
    "name, said",
    [
        ("/joints/position", "give an index"),
        ("/joints/velosity[0]", "no field velosity in sensor_msgs/JointState; it has header,"),
        ("/name/data", "is not numeric but string"),
        ("/strange/x", "build its package"),
        ("/pose/covariance[36]", "outside the 36"),
        ("/speed/data/x", "has no fields"),
        ("/speed/data[0]", "is no array"),
        ("/speed/__class__", "is no field"),
        ("/speed/a b", "'a b' is no field"),
        ("/tf/transforms/x", "is an array"),
        ("/nothing", "topic /nothing does not exist"),
    ],
)
def test_why_it_stands_for_nothing(name, said):
    curves, reason = expand(name, TYPES)
    assert not curves and said in reason and "\n" not in reason


def test_numbers_of_messages():
    joints = JointState(header=Header(stamp=genpy.Time(3, 500_000_000)), position=[1.0, 2.5])
    assert getter("/position[1]")(joints) == getter("position/1")(joints) == 2.5
    assert getter("/header/stamp")(joints) == 3.5
    assert getter("/data")(Bool(True)) == 1.0 and type(getter("/data")(Bool(True))) is float
    assert getter("/linear/x")(Twist()) == 0.0
    assert getter("/covariance[7]")(PoseWithCovariance(covariance=list(range(36)))) == 7.0
    with pytest.raises(IndexError):
        getter("/position[2]")(joints)
    with pytest.raises((TypeError, ValueError)):
        getter("/data")(String("text"))
    with pytest.raises(AttributeError):
        getter("/position")(Float64())


@pytest.mark.parametrize("path", ["a;b", "a[", "a[-1]", "(x)", "a[0]b", "1a"])
def test_a_path_is_never_code(path):
    with pytest.raises(FieldError):
        parse_path(path)


def test_empty_array_of_messages():
    with pytest.raises(IndexError):
        getter("/transforms[0]/transform/translation/x")(TFMessage())

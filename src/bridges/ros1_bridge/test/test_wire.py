"""Bytes of both sides against PyPI's rosbags, which writes CDR and ROS 1's form by itself, and upstream's rules of pairs."""

import io

import pytest
import roslib.message
from ros1_bridge.errors import MappingError
from ros1_bridge.pairs import types_of_ros1
from ros1_bridge.settings import entries, quality
from ros1_bridge.types import Field, candidates, candidates_of_ros1, fields_of_ros2, shared
from ros1_bridge.wire import Pair
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_KILTED)
NUMBERS = {"bool", "byte", "char", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"}


def described(name, found=None):
    """Fields of a type of ROS 2, as rclpy's classes give them, by rosbags' definitions."""
    found = {} if found is None else found
    package, _, short = name.partition("/")
    types = {}
    for field, (node, detail) in STORE.fielddefs[f"{package}/msg/{short}"][1]:
        many = {3: "[{}]", 4: "sequence"}.get(int(node))
        inner, extra = detail if many else ((node, detail), None)
        kind = inner[1] if int(inner[0]) == 2 else inner[1][0]
        kind = kind.replace("/msg/", "/") if "/" in kind else {"bool": "boolean", "float32": "float", "float64": "double"}.get(kind, kind)
        types[field] = kind if not many else f"sequence<{kind}>" if many == "sequence" else f"{kind}[{extra}]"
        if "/" in kind and kind not in found:
            described(kind, found)
    types.pop("structure_needs_at_least_one_member", None)
    found[name] = fields_of_ros2(types)
    return found


def pair(one, two=None):
    return Pair(one, types_of_ros1(roslib.message.get_message_class(one), one), two or one, described(two or one))


def filled(kind, number=1):
    """Bytes of a message of ROS 1 in which no two fields have one value."""
    message = roslib.message.get_message_class(kind)()

    def value(kind):
        nonlocal number
        number += 1
        base, _, many = kind.partition("[")
        if many:
            count = int(many[:-1] or 3)
            return bytes(range(count)) if base in ("uint8", "char") else [value(base) for _ in range(count)]
        if base in ("time", "duration"):
            return roslib.message.get_message_class("std_msgs/" + base.capitalize())().data.__class__(number, number + 1)
        if base in NUMBERS:
            return number % 2 == 0 if base == "bool" else number + 0.25 if base.startswith("float") else number % 120
        if base == "string":
            return "x" * (number % 7)
        part = roslib.message.get_message_class("std_msgs/Header" if base == "Header" else base)()
        for name, inner in zip(part.__slots__, part._slot_types):
            setattr(part, name, value(inner))
        if hasattr(part, "seq"):
            part.seq = 0  # ROS 2 has none
        return part

    for name, inner in zip(message.__slots__, message._slot_types):
        setattr(message, name, value(inner))
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


KINDS = """
    sensor_msgs/JointState sensor_msgs/CameraInfo sensor_msgs/Image sensor_msgs/PointCloud2
    sensor_msgs/BatteryState sensor_msgs/LaserScan nav_msgs/Odometry nav_msgs/OccupancyGrid
    nav_msgs/Path tf2_msgs/TFMessage geometry_msgs/PoseArray geometry_msgs/PolygonStamped
    trajectory_msgs/JointTrajectory trajectory_msgs/MultiDOFJointTrajectory rosgraph_msgs/Clock diagnostic_msgs/DiagnosticArray
    std_msgs/Float64MultiArray std_msgs/Int64 std_msgs/Empty std_msgs/ColorRGBA
""".split()


@pytest.mark.parametrize("kind", KINDS)
def test_bytes_are_those_of_an_independent_library(kind):
    name, data = kind.replace("/", "/msg/"), filled(kind)
    both = pair(kind)
    expected = STORE.ros1_to_cdr(data, name)
    assert bytes(both.to_ros2(data)) == bytes(expected)[: len(both.to_ros2(data))] and len(expected) - len(both.to_ros2(data)) in range(4)
    assert both.to_ros1(expected) == data


@pytest.mark.parametrize("cut", [1, 5, -1, -9])
def test_broken_bytes_are_one_line(cut):
    both, data = pair("sensor_msgs/JointState"), filled("sensor_msgs/JointState")
    for read, whole in ((both.to_ros2, data), (both.to_ros1, bytes(both.to_ros2(data)))):
        with pytest.raises(MappingError):
            read(whole[:cut])
    with pytest.raises(MappingError, match="JointState"):
        both.to_ros2(b"\xff" * 40)
    with pytest.raises(MappingError, match="little endian"):
        both.to_ros1(b"\0\0\0\0" + bytes(40))


def test_pairs_are_named_by_upstreams_rules():
    assert candidates("foo_msgs/Bar") == ["foo_msgs/Bar", "foo_interfaces/Bar"] and candidates("foo/Bar") == ["foo/Bar"]
    assert candidates("std_msgs/Time") == ["builtin_interfaces/Time"] and candidates_of_ros1("rcl_interfaces/Log") == ["rosgraph_msgs/Log"]
    assert candidates_of_ros1("foo_interfaces/Bar") == ["foo_msgs/Bar", "foo_interfaces/Bar"]


def test_fields_are_paired_by_upstreams_rules():
    one, two = (tuple(Field(name, "int32") for name in names) for names in (("A", "b", "more"), ("b", "a")))
    assert shared("x/X", one, two) == {"a": "A", "b": "b"}  # a field that one side alone has is ignored
    assert shared("x/X", one, (*two, Field("other", "int32"))) is None  # each has one that the other has not
    assert shared("std_msgs/Header", (Field("seq", "uint32"), Field("stamp", "time")), (Field("stamp", "time"), Field("x", "string")))


@pytest.mark.parametrize(
    "one, two, value", [("int32", "int64", -5), ("float32", "float64", 0.5), ("uint8", "bool", 1), ("int64", "float64", 7)]
)
def test_numbers_of_other_sizes_are_converted(one, two, value):
    both = Pair("x/X", {"x/X": (Field("a", "uint8"), Field("v", one))}, "x/X", {"x/X": (Field("v", two), Field("a", "uint8"))})
    import struct

    formats = {"int32": "i", "int64": "q", "float32": "f", "float64": "d", "uint8": "B", "bool": "?"}
    data = struct.pack("<B" + formats[one], 9, value)
    assert bytes(both.to_ros2(data)) == b"\0\1\0\0" + struct.pack("<" + formats[two] + "B", value, 9)
    assert both.to_ros1(both.to_ros2(data)) == data


def test_a_text_that_is_no_utf8_does_not_end_a_node_of_ros2():
    data = bytes(pair("std_msgs/String").to_ros2(b"\2\0\0\0\xe9a"))
    assert data[8:-1].decode() == "\ufffda"


def test_quality_of_service_is_read_as_upstream_does():
    said = []
    words = {
        "reliability": "best_effort",
        "durability": "transient_local",
        "history": "keep_last",
        "depth": 3,
        "lifespan": {"secs": 1, "nsecs": 5},
    }
    assert quality(words, said.append) == {**words, "lifespan": 1_000_000_005} and not said
    assert quality({"liveliness": "LIVELINESS_AUTOMATIC"}, said.append)["liveliness"] == 1 and not said
    quality({"reliability": "sometimes", "deadline": 3, "colour": 1}, said.append)
    assert len(said) == 3


def test_what_is_wrong_in_a_list_of_topics_is_said_and_the_rest_is_taken():
    said = []
    good = {"topic": "/a", "type": "std_msgs/msg/String", "queue_size": 1}
    assert [
        one["type"] for one in entries("topics", [good, {"topic": "/b"}, 5, {"topic": "/c", "type": "String"}], "topic", said.append)
    ] == ["std_msgs/String"]
    assert len(said) == 3 and all("topics[" in line for line in said)
    old = {"service": "/s", "package": "std_srvs", "type": "SetBool"}
    assert entries("services_1_to_2", [old], "service", said.append)[0]["type"] == "std_srvs/SetBool"

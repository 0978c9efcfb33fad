"""Messages as JSON and CBOR, and back, by what upstream's own tests ask and by RFC 8746."""

import base64
import io
import json
import math
import struct

import cbor2
import genpy
import pytest
from rosbridge_library.internal import pngcompression, ros_loader
from rosbridge_library.internal.cbor_conversion import extract_cbor_values
from rosbridge_library.internal.exceptions import RosbridgeError
from rosbridge_library.internal.message_conversion import (
    FieldTypeMismatchException,
    InvalidMessageException,
    NonexistentFieldException,
    extract_values,
    populate_instance,
)

BITS = [
    ("Int8", -(2**7), 2**7 - 1),
    ("Byte", -(2**7), 2**7 - 1),
    ("Int16", -(2**15), 2**15 - 1),
    ("Int32", -(2**31), 2**31 - 1),
    ("Int64", -(2**63), 2**63 - 1),
    ("UInt8", 0, 2**8 - 1),
    ("Char", 0, 2**8 - 1),
    ("UInt16", 0, 2**16 - 1),
    ("UInt32", 0, 2**32 - 1),
    ("UInt64", 0, 2**64 - 1),
]


def through(type_name, values):
    """As a client's words become bytes of ROS and go to another client."""
    message = populate_instance(json.loads(json.dumps(values)), ros_loader.get_message_instance(type_name))
    out = io.BytesIO()
    message.serialize(out)
    received = ros_loader.get_message_instance(type_name).deserialize(out.getvalue())
    return json.loads(json.dumps(extract_values(received), allow_nan=False))


@pytest.mark.parametrize("name, least, most", BITS)
def test_integers_to_their_bounds_and_not_beyond(name, least, most):
    for value in (least, 0, most):
        assert through(f"std_msgs/{name}", {"data": value}) == {"data": value}
    for value in (least - 1, most + 1):
        with pytest.raises(RosbridgeError, match=f"holds {least} to {most}"):
            through(f"std_msgs/{name}", {"data": value})


@pytest.mark.parametrize(
    "type_name, values",
    [
        ("std_msgs/Bool", {"data": True}),
        ("std_msgs/String", {"data": "grüße"}),
        ("std_msgs/Float64", {"data": 0.1}),
        ("std_msgs/Float64", {"data": 5}),
        ("std_msgs/Empty", {}),
        ("std_msgs/Time", {"data": {"secs": 3, "nsecs": 5}}),
        ("std_msgs/Duration", {"data": {"secs": -3, "nsecs": 5}}),
        ("rosbridge_library/TestTimeArray", {"times": [{"secs": n, "nsecs": 2 * n} for n in range(4)]}),
        ("rosbridge_library/TestDurationArray", {"durations": [{"secs": n, "nsecs": 2 * n} for n in range(4)]}),
        ("rosbridge_library/TestHeaderArray", {"header": [{"seq": 1, "stamp": {"secs": 12, "nsecs": 34}, "frame_id": "a"}] * 2}),
        (
            "geometry_msgs/PoseWithCovariance",
            {
                "pose": {"position": {"x": 1.0, "y": 2.0, "z": 3.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
                "covariance": [n / 4 for n in range(36)],
            },
        ),
        (
            "std_msgs/Float32MultiArray",
            {"layout": {"dim": [{"label": "x", "size": 2, "stride": 2}], "data_offset": 0}, "data": [0.5, -1.0]},
        ),
        ("std_msgs/ColorRGBA", {"r": 0.5, "g": 0.0, "b": 0.0, "a": 1.0}),
    ],
)
def test_what_is_said_arrives(type_name, values):
    assert through(type_name, values) == values


@pytest.mark.parametrize(
    "type_name", ["rosbridge_library/TestUInt8", "rosbridge_library/TestChar", "rosbridge_library/TestUInt8FixedSizeArray16"]
)
def test_bytes_are_base64_and_taken_as_lists_too(type_name):
    data = list(range(240, 256))
    text = base64.standard_b64encode(bytes(data)).decode()
    for said in (data, text):
        assert through(type_name, {"data": said}) == {"data": text}
    for said, why in (("no base64!", "no base64"), ("ü", "no base64"), ([256], "0 to 255"), ([1.5], "0 to 255"), (7, "base64 text or")):
        with pytest.raises(RosbridgeError, match=why):
            through(type_name, {"data": said})


def test_numbers_that_json_has_not_are_null():
    for kind in ("Float32", "Float64"):
        for value in (math.inf, -math.inf, math.nan):
            message = ros_loader.get_message_instance(f"std_msgs/{kind}")
            message.data = value
            assert extract_values(message) == {"data": None}
            assert extract_values(message, bson=True)["data"] is value
    many = ros_loader.get_message_instance("std_msgs/Float64MultiArray")
    many.data = [1.0, math.nan, math.inf]
    assert extract_values(many)["data"] == [1.0, None, None]


@pytest.mark.parametrize(
    "type_name, values, said",
    [
        ("geometry_msgs/Twist", {"linear": {"x": "fast"}}, "geometry_msgs/Twist.linear.x should be float64, not a text"),
        ("geometry_msgs/Twist", {"linear": {"x": None}}, "linear.x should be float64, not null"),
        ("geometry_msgs/Twist", {"linear": {"x": True}}, "linear.x should be float64, not true or false"),
        ("geometry_msgs/Twist", {"linear": 5}, r"linear should be geometry_msgs/Vector3 \(an object\), not a whole number"),
        ("geometry_msgs/Twist", {"linear": {"speed": 1}}, "geometry_msgs/Twist has no field linear.speed; there are x, y, z"),
        ("std_msgs/Empty", {"data": 1}, "std_msgs/Empty has no field data; it has none"),
        ("std_msgs/Int32", {"data": 1.0}, "data should be int32, not a number"),
        ("std_msgs/Int32", {"data": True}, "data should be int32"),
        ("std_msgs/Bool", {"data": 1}, "data should be bool"),
        ("std_msgs/String", {"data": 1}, "data should be string"),
        ("std_msgs/Time", {"data": 5}, "an object with secs and nsecs"),
        ("std_msgs/Time", {"data": {"secs": -1}}, "data.secs is -1"),
        ("std_msgs/Duration", {"data": "now"}, "an object with secs"),
        ("geometry_msgs/PoseWithCovariance", {"covariance": [1.0]}, r"covariance has 1 elements, and a float64\[36\] 36"),
        ("geometry_msgs/PoseArray", {"poses": {}}, r"poses should be list \(geometry_msgs/Pose\[\]\), not an object"),
        ("geometry_msgs/PoseArray", {"poses": [{"x": 1}]}, "no field poses.x"),
        ("std_msgs/String", [], "should be std_msgs/String"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(type_name, values, said):
    with pytest.raises(RosbridgeError, match=said) as error:
        through(type_name, values)
    assert "\n" not in str(error.value)


def test_upstreams_names_of_errors():
    with pytest.raises(NonexistentFieldException):
        through("std_msgs/String", {"dat": ""})
    with pytest.raises(FieldTypeMismatchException):
        through("std_msgs/String", {"data": 0})
    with pytest.raises(InvalidMessageException):
        extract_values("text")


@pytest.mark.parametrize(
    "name, said",
    [
        ("String", "is no type"),
        ("a/b/c", "is no type"),
        ("", "is no type"),
        (5, "is no type"),
        ("no_such_package/Thing", "no package here defines"),
        ("std_msgs/Spoon", "no package here defines"),
    ],
)
def test_types_that_are_not_here(name, said):
    for loader in (ros_loader.get_message_class, ros_loader.get_service_class, ros_loader.get_service_request_instance):
        with pytest.raises(RosbridgeError, match=said):
            loader(name)


def test_types_are_forgiven_their_slashes():
    assert ros_loader.get_message_class("/std_msgs//String") is ros_loader.get_message_class("std_msgs/String")
    assert ros_loader.get_service_response_instance("rosbridge_library/AddTwoInts").sum == 0


# ---------------------------------------------------------------------------------------------- CBOR

#: tags of RFC 8746, table 1 and 2, little-endian; letters of struct
RFC = {
    "UInt16": (69, "H"),
    "UInt32": (70, "I"),
    "UInt64": (71, "Q"),
    "Int8": (72, "b"),
    "Int16": (77, "h"),
    "Int32": (78, "i"),
    "Int64": (79, "q"),
    "Float32": (85, "f"),
    "Float64": (86, "d"),
}


@pytest.mark.parametrize("name", sorted(RFC))
def test_arrays_of_numbers_are_tagged(name):
    message = ros_loader.get_message_instance(f"std_msgs/{name}MultiArray")
    message.data = [0, 1, 100]
    tag, letter = RFC[name]
    found = cbor2.loads(cbor2.dumps(extract_cbor_values(message)))["data"]
    assert (found.tag, found.value) == (tag, struct.pack(f"<3{letter}", 0, 1, 100))


def test_bytes_texts_times_and_arrays_of_fixed_length():
    image = ros_loader.get_message_instance("rosbridge_library/TestUInt8FixedSizeArray16")
    image.data = bytes(range(16))
    assert cbor2.loads(cbor2.dumps(extract_cbor_values(image))) == {"data": bytes(range(16))}
    pose = ros_loader.get_message_instance("geometry_msgs/PoseWithCovariance")
    found = cbor2.loads(cbor2.dumps(extract_cbor_values(pose)))
    assert (found["covariance"].tag, len(found["covariance"].value)) == (86, 36 * 8)
    times = ros_loader.get_message_instance("rosbridge_library/TestTimeArray")
    times.times = [genpy.Time(1, 2)]
    assert extract_cbor_values(times) == {"times": [{"secs": 1, "nsecs": 2}]}
    response = ros_loader.get_service_response_instance("rosbridge_library/TestMultipleResponseFields")
    response.float = math.nan
    found = cbor2.loads(cbor2.dumps(extract_cbor_values(response)))
    assert math.isnan(found.pop("float")) and found == {"int": 0, "string": "", "bool": False}


@pytest.mark.parametrize("text", ["", "a", "{}", "grüße " * 1000, "x" * 123457])
def test_a_text_survives_as_a_picture(text):
    assert pngcompression.decode(pngcompression.encode(text)).rstrip("\n") == text

"""Messages made of expressions."""

import pytest
from geometry_msgs.msg import Point32, Twist
from rqt_py_common.installed_types import installed_types
from rqt_py_common.message_template import Field, TemplateError


def at(template, path):
    return next(field for field in template.walk() if field.path == path)


def test_defaults_make_the_empty_message():
    assert Field("", "geometry_msgs/Twist").value() == Twist()
    camera = Field("", "sensor_msgs/CameraInfo").value()
    assert camera.K == [0.0] * 9 and camera.D == [] and camera.header.stamp.is_zero()


def test_expressions_count():
    twist = Field("", "geometry_msgs/Twist")
    at(twist, "linear/x").expression = "sin(i / 10.) * 50"
    at(twist, "angular/z").expression = "i"
    assert twist.value(0) == Twist() and twist.value(3).angular.z == 3.0 and twist.value(3).linear.x == pytest.approx(14.776, abs=1e-3)


def test_arrays_of_messages_have_the_size_that_is_set():
    polygon = Field("", "geometry_msgs/Polygon")
    points = at(polygon, "points")
    assert points.resizable and points.shown_type() == "geometry_msgs/Point32[0]"
    points.resize(2)
    at(polygon, "points[1]/y").expression = "2.5"
    assert polygon.value().points == [Point32(), Point32(0, 2.5, 0)]
    other = Field("", "geometry_msgs/Polygon")
    other.restore(polygon.state())
    assert other.value() == polygon.value()
    with pytest.raises(TemplateError, match="0 to 1000 elements here, not 5000"):
        points.resize(5000)


def test_errors_name_the_field():
    twist = Field("", "geometry_msgs/Twist")
    at(twist, "linear/y").expression = "fast"
    with pytest.raises(TemplateError, match=r"^linear/y: name 'fast' is not defined \(wanted: float64\)$"):
        twist.value()
    with pytest.raises(TemplateError, match="cannot import the message type no_package/Odd"):
        Field("", "no_package/Odd")


def test_state_of_another_type_is_harmless():
    twist = Field("", "geometry_msgs/Twist")
    twist.restore({"points": "3", "linear/x": "2", "linear": "x", "angular/z": 5})
    assert twist.value().linear.x == 2.0 and twist.value().angular.z == 5.0


def test_installed():
    assert "Twist" in installed_types(".msg")["geometry_msgs"] and "Empty" in installed_types(".srv")["std_srvs"]
    assert "FollowJointTrajectory" in installed_types(".action")["control_msgs"]

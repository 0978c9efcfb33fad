"""Addresses, pages and pictures without a network."""

import cv2
import numpy as np
import pytest
from sensor_msgs.msg import Image
from web_video_server.pages import groups, topics_page, viewer_page
from web_video_server.pictures import NoPicture, encoded
from web_video_server.request import BadRequest, Request, read, shown


def test_what_an_address_asks_for():
    assert read("topic=/a") == Request("/a", "mjpeg", None, None, 95, False, "raw")
    assert read("topic=a/b&type=png&width=20&height=-1&invert") == Request("/a/b", "png", 20, None, 3, True)
    assert read("topic=/a&quality=30&default_transport=compressed", "mjpeg").quality == 30
    assert read("topic=/a", "ros_compressed").type == "ros_compressed"


@pytest.mark.parametrize(
    "query, sentence",
    [
        ("", "name a topic"),
        ("topic=/a&width=x", "width=x must be"),
        ("topic=/a&height=99999", "up to"),
        ("topic=/a&type=gif", "there is no type gif"),
        ("topic=/a&type=png&quality=50", "up to 9"),
        ("topic=/a&type=h264", "ask for type=mjpeg"),
    ],
)
def test_what_cannot_be_had_is_said(query, sentence):
    with pytest.raises(BadRequest, match=sentence):
        read(query)


def test_topics_stand_below_their_camera():
    topics = [
        ("/c/camera_info", "sensor_msgs/CameraInfo"),
        ("/c/image_raw", "sensor_msgs/Image"),
        ("/d/image", "sensor_msgs/Image"),
        ("/c/text", "std_msgs/String"),
    ]
    assert groups(topics) == [("/c/", ["image_raw"]), ("", ["/d/image"])]


def test_names_are_no_markup():
    evil = '/<script>"&'
    assert "<script>" not in topics_page([(evil, "sensor_msgs/Image")]) + viewer_page(evil, f"topic={evil}")


@pytest.mark.parametrize(
    "message, sentence",
    [
        (Image(), "cannot be shown"),
        (Image(height=2, width=2, encoding="rgb8", step=6, data=b"123"), "'rgb8' cannot be shown"),
        (Image(height=2, width=2, encoding="strange", step=2, data=b"1234"), "'strange'"),
    ],
)
def test_broken_pictures_are_told(message, sentence):
    with pytest.raises(NoPicture, match=sentence):
        encoded(message, read("topic=/a"))


def test_depth_of_16_bit_is_as_bright_as_its_largest_number():
    message = Image(height=1, width=2, encoding="16UC1", step=4, data=np.array([500, 2000], np.uint16).tobytes())
    shown = cv2.imdecode(np.frombuffer(encoded(message, read("topic=/a&type=png")), np.uint8), cv2.IMREAD_UNCHANGED)
    assert shown.tolist() == [[64, 255]]


@pytest.mark.parametrize(
    "query, sentence",
    [
        ("topic=/camera/%0a[ERROR]%20[1]:%20forged%20line", r"/camera/\\n[ERROR] [1]: forged line is no name"),
        ("topic=/x%1b]0;title%07%1b[2J", r"/x\\x1b]0;title\\x07\\x1b[2J is no name"),
        ("topic=/a&type=%1b[2J", r"no type \\x1b[2J;"),
        ("topic=/a&width=%0d%0a", r"width=\\r\\n must be"),
        ("topic=/a%c2%9b31m", r"/a\\x9b31m is"),
        ("topic=/a%e2%80%ae", r"/a\\u202e is"),
        ("topic=/a/../b", "/a/../b is no name"),
        ("topic=/%ff", "is no name"),
        ("topic=/" + "a" * 9999 + "!", "a[.]{3} is no name"),
    ],
)
def test_what_a_stranger_sends_is_one_line_of_printable_characters(query, sentence):
    with pytest.raises(BadRequest) as told:
        read(query)
    assert str(told.value).isprintable() and len(str(told.value)) < 300
    assert sentence.replace("\\\\", "\\").replace("[.]{3}", "...") in str(told.value)


def test_what_is_shown_of_it():
    assert shown("/camera/image_raw?a=\u00e9") == "/camera/image_raw?a=\u00e9" and shown("a\nb") == "a\\nb" and len(shown("a" * 999)) == 203


@pytest.mark.parametrize(
    "query, size",
    [
        ("width=8192&height=8192&type=png&quality=9", (40, 60)),
        ("width=8192", (40, 60)),
        ("height=20", (20, 60)),
        ("width=30&height=4000", (40, 30)),
    ],
)
def test_a_picture_is_not_made_larger_than_it_came(query, size):
    message = Image(height=40, width=60, encoding="mono8", step=60, data=bytes(2400))
    shape = cv2.imdecode(np.frombuffer(encoded(message, read("topic=/a&" + query)), np.uint8), cv2.IMREAD_UNCHANGED).shape
    assert shape[:2] == size

"""Addresses, pages and pictures without a network."""
import cv2
import numpy as np
import pytest
from sensor_msgs.msg import Image
from web_video_server.pages import groups, topics_page, viewer_page
from web_video_server.pictures import NoPicture, encoded
from web_video_server.request import BadRequest, Request, read


def test_what_an_address_asks_for():
    assert read("topic=/a") == Request("/a", "mjpeg", None, None, 95, False, "raw")
    assert read("topic=a/b&type=png&width=20&height=-1&invert") == Request("/a/b", "png", 20, None, 3, True)
    assert read("topic=/a&quality=30&default_transport=compressed", "mjpeg").quality == 30
    assert read("topic=/a", "ros_compressed").type == "ros_compressed"


@pytest.mark.parametrize("query, sentence", [
    ("", "name a topic"), ("topic=/a&width=x", "width=x must be"), ("topic=/a&height=99999", "up to"),
    ("topic=/a&type=gif", "there is no type gif"), ("topic=/a&type=png&quality=50", "up to 9"),
    ("topic=/a&type=h264", "ask for type=mjpeg")])
def test_what_cannot_be_had_is_said(query, sentence):
    with pytest.raises(BadRequest, match=sentence):
        read(query)


def test_topics_stand_below_their_camera():
    topics = [("/c/camera_info", "sensor_msgs/CameraInfo"), ("/c/image_raw", "sensor_msgs/Image"), ("/d/image", "sensor_msgs/Image"),
              ("/c/text", "std_msgs/String")]
    assert groups(topics) == [("/c/", ["image_raw"]), ("", ["/d/image"])]


def test_names_are_no_markup():
    evil = '/<script>"&'
    assert "<script>" not in topics_page([(evil, "sensor_msgs/Image")]) + viewer_page(evil, f"topic={evil}")


@pytest.mark.parametrize("message, sentence", [(Image(), "cannot be shown"),
                                               (Image(height=2, width=2, encoding="rgb8", step=6, data=b"123"), "'rgb8' cannot be shown"),
                                               (Image(height=2, width=2, encoding="strange", step=2, data=b"1234"), "'strange'")])
def test_broken_pictures_are_told(message, sentence):
    with pytest.raises(NoPicture, match=sentence):
        encoded(message, read("topic=/a"))


def test_depth_of_16_bit_is_as_bright_as_its_largest_number():
    message = Image(height=1, width=2, encoding="16UC1", step=4, data=np.array([500, 2000], np.uint16).tobytes())
    shown = cv2.imdecode(np.frombuffer(encoded(message, read("topic=/a&type=png")), np.uint8), cv2.IMREAD_UNCHANGED)
    assert shown.tolist() == [[64, 255]]

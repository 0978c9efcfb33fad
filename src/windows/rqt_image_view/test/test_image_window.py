"""The window in the container, without display and master; messages are put where rospy would put them."""

import numpy as np
import pytest

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import cv2
from python_qt_binding.QtCore import QPoint, Qt
from python_qt_binding.QtTest import QTest
from rqt_image_view import image_view, source
from sensor_msgs.msg import CompressedImage, Image

PICTURE = np.zeros((40, 60, 3), np.uint8)
PICTURE[:20, :30], PICTURE[20:, 30:] = (200, 30, 40), (10, 60, 220)


@pytest.fixture(autouse=True)
def topics(monkeypatch):
    rospy_without_master()
    names = ["/camera/image_raw", "/camera/image_raw/compressed"]
    monkeypatch.setattr(image_view, "image_topics", lambda: names)
    return names


def message(pixels=PICTURE, encoding="rgb8", **more):
    return Image(
        **{**dict(height=pixels.shape[0], width=pixels.shape[1], encoding=encoding, step=pixels.strides[0], data=pixels.tobytes()), **more}
    )


def receive(gui, sent):
    """What rospy does with a message of the topic that is shown."""
    give(gui.plugin._source, sent)
    process_events()


def give(origin, sent):
    from io import BytesIO

    buffer = BytesIO()
    sent.serialize(buffer)
    raw = source.rospy.AnyMsg()
    raw._buff, raw._connection_header = buffer.getvalue(), {"type": sent._type}
    origin._receive(raw)


def shown(gui):
    return gui.plugin._widget.canvas


def test_a_picture_from_the_command_line():
    with open_plugin("rqt_image_view", ["/not/there/yet"]) as gui:
        combo = find(gui, "topics_combo_box")
        assert combo.currentText() == "/not/there/yet" and combo.itemText(0) == "" and combo.count() == 4
        assert "waiting for /not/there/yet" in shown(gui).message
        receive(gui, message())
        assert (shown(gui).picture == PICTURE).all()
        image = shown(gui).grab().toImage()
        assert image.pixelColor(image.width() // 2 - 8, image.height() // 2 - 8).red() == 200
        assert image.pixelColor(image.width() // 2 + 8, image.height() // 2 + 8).blue() == 220
    assert errors == []


def test_topics_are_listed_again_by_the_button_only(topics):
    with open_plugin("rqt_image_view") as gui:
        combo = find(gui, "topics_combo_box")
        combo.setCurrentText("/camera/image_raw/compressed")
        topics.append("/depth/image")
        assert combo.findText("/depth/image") < 0
        find(gui, "refresh_topics_push_button").click()
        assert combo.findText("/depth/image") > 0 and combo.currentText() == "/camera/image_raw/compressed"
        receive(gui, CompressedImage(format="png", data=cv2.imencode(".png", PICTURE[..., ::-1])[1].tobytes()))
        assert (shown(gui).picture == PICTURE).all()


@pytest.mark.parametrize(
    "broken, said",
    [
        (message(step=3), "step is 3, but 60 pixels of rgb8 are 180 bytes"),
        (message(data=b"x"), "1 bytes of data"),
        (message(encoding="what"), "encoding 'what' cannot be shown"),
        (message(height=2**32 - 1, width=2**32 - 1, step=1), "cannot be shown"),
        (CompressedImage(format="jpeg", data=b"\xff\xd8\xff\xe0broken"), "cannot be decoded"),
    ],
)
def test_broken_images_are_told_and_the_next_is_shown(broken, said):
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        for _ in range(3):
            receive(gui, broken)
        assert said in shown(gui).message and shown(gui).picture is None
        assert len(errors) == 1 and said in errors[0]
        receive(gui, message())
        assert (shown(gui).picture == PICTURE).all()


def test_other_types_and_cut_messages_are_told():
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        raw = source.rospy.AnyMsg()
        raw._buff, raw._connection_header = b"\x05\x00", {"type": "std_msgs/String"}
        gui.plugin._source._receive(raw)
        raw._connection_header = {"type": "sensor_msgs/Image"}
        gui.plugin._source._receive(raw)
        process_events()
        assert "is of type std_msgs/String, which is no image" in errors[0] and "broken message" in errors[1]


def test_no_picture_is_made_while_the_last_is_not_on_the_screen(monkeypatch):
    made, came, told = [], [], []
    monkeypatch.setattr(source, "from_raw", lambda *_args: made.append(1) or PICTURE)
    origin = source.ImageSource("/camera/image_raw", came.append, told.append)
    give(origin, message())
    give(origin, message())
    assert len(made) == len(came) == 1
    origin.taken()
    give(origin, message())
    assert len(made) == len(came) == 2 and not told
    origin.close()


def test_clicks_are_pixels_of_the_unrotated_image(monkeypatch):
    published = []
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        assert find(gui, "publish_click_location_topic_line_edit").text() == "/camera/image_raw_mouse_left"
        receive(gui, message())
        find(gui, "publish_click_location_check_box").click()
        assert gui.plugin._publisher.name == "/camera/image_raw_mouse_left"
        monkeypatch.setattr(gui.plugin._publisher, "publish", published.append)
        find(gui, "rotate_right_push_button").click()
        process_events()
        left, top, width, height = shown(gui)._target()
        assert width < height
        QTest.mouseClick(shown(gui), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(left + width - 1, top + height - 1))
        assert (published[0].x, published[0].y, published[0].z) == (59.0, 0.0, 0.0)
        QTest.mouseClick(shown(gui), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(left - 5, top + 5))
        assert len(published) == 1  # beside the picture


def test_depth_is_shown_as_the_controls_say():
    depth = np.array([[1.0, 5.0], [9.0, np.nan]], np.float32)
    with open_plugin("rqt_image_view", ["/depth/image"]) as gui:
        receive(gui, message(depth, "32FC1"))
        assert shown(gui).picture.tolist() == [[25, 127], [229, 0]]
        find(gui, "max_range_double_spin_box").setValue(5.0)
        process_events()
        assert shown(gui).picture.tolist() == [[51, 255], [255, 0]]
        find(gui, "dynamic_range_check_box").click()
        process_events()
        assert shown(gui).picture.tolist() == [[0, 127], [255, 0]]
        find(gui, "color_scheme_combo_box").setCurrentText("Jet")
        process_events()
        assert shown(gui).picture.shape == (2, 2, 3) and shown(gui).picture[1, 0].argmax() == 0


def test_pictures_are_saved_with_all_their_pixels(tmp_path):
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        receive(gui, message())
        find(gui, "rotate_left_push_button").click()
        name = str(tmp_path / "image.png")
        assert gui.plugin.save_picture(name)
        assert (cv2.imread(name)[..., ::-1] == np.rot90(PICTURE)).all()
        assert not gui.plugin.save_picture(str(tmp_path / "absent/image.png"))
        assert "cannot write" in errors[0]


def test_original_size_scrolls():
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        big = np.zeros((1200, 1600), np.uint8)
        receive(gui, message(big, "mono8"))
        find(gui, "zoom_1_push_button").click()
        process_events()
        assert (shown(gui).width(), shown(gui).height()) == (1600, 1200)
        find(gui, "zoom_1_push_button").click()
        wait_until(lambda: shown(gui).width() < 1600)


def test_colour_schemes_have_noetics_numbers(tmp_path):
    """Its settings hold the place in a list by the alphabet, in which Gray, the first choice, is number 3."""
    with open_plugin("rqt_image_view", settings=str(tmp_path / "a.ini")) as gui:
        box = find(gui, "color_scheme_combo_box")
        assert (box.currentIndex(), box.currentText()) == (3, "Gray")
        names = [box.itemText(i) for i in range(box.count())]
        assert names == sorted(names) and len(names) == 13
    assert errors == []


def test_settings_come_back(tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_image_view", settings=settings) as gui:
        find(gui, "topics_combo_box").setCurrentText("/camera/image_raw")
        find(gui, "num_gridlines_spin_box").setValue(3)
        find(gui, "rotate_left_push_button").click()
        find(gui, "smooth_image_check_box").click()
        find(gui, "color_scheme_combo_box").setCurrentText("Hot")
        find(gui, "publish_click_location_topic_line_edit").setText("/clicks")
        gui.plugin._widget.hide_toolbar.trigger()
    with open_plugin("rqt_image_view", settings=settings) as gui:
        assert find(gui, "topics_combo_box").currentText() == "/camera/image_raw" and gui.plugin._source is not None
        assert find(gui, "num_gridlines_spin_box").value() == 3 and shown(gui).quarters == 3 and shown(gui).smooth
        assert find(gui, "color_scheme_combo_box").currentText() == "Hot" and gui.plugin._widget.toolbar.isHidden()
        assert find(gui, "publish_click_location_topic_line_edit").text() == "/clicks"
    assert errors == []


def received(subscriber, kind, messages):
    """Hands messages to a subscriber as rospy does that finds them all in one read of the socket; how many are left of them."""
    import io

    from rospy.msg import deserialize_messages, serialize_message

    buffer, kept = io.BytesIO(), []
    for number, message in enumerate(messages):
        serialize_message(buffer, number, message)
    deserialize_messages(buffer, kept, subscriber.data_class, queue_size=subscriber.impl.queue_size)
    for message in kept:
        message._connection_header = {"type": kind._type}
    subscriber.impl.receive_callback(kept, None)
    return len(kept)


def test_no_packet_of_a_stream_is_dropped():
    """The heads come once, in one burst with the first picture; of raw images the newest is enough."""
    from theora_image_transport.encoder import Encoder
    from theora_image_transport.msg import Packet

    scene = np.full((48, 64, 3), (200, 60, 30), np.uint8)
    encoder = Encoder(scene.shape[:2], "rgb8")
    packets = [
        Packet(data=packet.data, b_o_s=number == 0, packetno=number)
        for number, packet in enumerate([*encoder.headers, *encoder.encode(scene.tobytes())])
    ]
    with open_plugin("rqt_image_view", ["/camera/image_raw/theora"]) as gui:
        assert received(gui.plugin._source._subscriber, Packet, packets) == len(packets) >= 4
        wait_until(lambda: shown(gui).picture is not None)
        assert np.abs(shown(gui).picture[24, 32].astype(int) - (200, 60, 30)).max() < 16
    with open_plugin("rqt_image_view", ["/camera/image_raw"]) as gui:
        images = [Image(height=1, width=1, encoding="mono8", step=1, data=bytes([grey])) for grey in (10, 20, 30)]
        assert received(gui.plugin._source._subscriber, Image, images) == 1
        wait_until(lambda: shown(gui).picture is not None)
        assert shown(gui).picture[0, 0] == 30


def test_with_one_camera_on_the_graph_it_is_shown(topics):
    topics[:] = ["/camera/image_raw", "/camera/image_raw/compressed", "/camera/image_raw/theora"]
    with open_plugin("rqt_image_view") as gui:
        wait_until(lambda: find(gui, "topics_combo_box").currentText() == "/camera/image_raw")
        assert "waiting for /camera/image_raw" in shown(gui).message


@pytest.mark.parametrize("names, told", [([], "nobody publishes images"), (["/left/image", "/right/image"], "choose a topic")])
def test_without_a_topic_it_says_what_to_do(topics, names, told):
    topics[:] = names
    with open_plugin("rqt_image_view") as gui:
        gui.plugin._look_for_the_only_one()
        wait_until(lambda: told in shown(gui).message)
        topics[:] = ["/late/image"]  # a camera that comes later
        gui.plugin._look_for_the_only_one()
        wait_until(lambda: find(gui, "topics_combo_box").currentText() == "/late/image")


def test_a_choice_is_not_taken_away(topics, tmp_path):
    settings = str(tmp_path / "rqt.ini")
    topics[:] = ["/left/image", "/right/image"]
    with open_plugin("rqt_image_view", settings=settings) as gui:
        gui.plugin.select_topic("/right/image")
    topics[:] = ["/left/image"]
    with open_plugin("rqt_image_view", settings=settings) as gui:
        process_events()
        gui.plugin._choose_the_only_one(topics)
        assert find(gui, "topics_combo_box").currentText() == "/right/image"

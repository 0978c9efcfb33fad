"""Images and plots of a bag, in the container, without display and master."""

import genpy
import numpy as np
import pytest

from rqt_testing.in_process import errors, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import rosbag
from rqt_bag.timeline_menu import TimelinePopupMenu
from rqt_bag_plugins.image_helper import imgmsg_to_pil
from rqt_bag_plugins.image_view import ImageView
from rqt_bag_plugins.plot_view import PlotView
from sensor_msgs.msg import Image, JointState

BEGIN = 1_795_000_000.0


def image(red, step=None):
    pixels = np.full((30, 40, 3), (red, 20, 220), np.uint8)
    return Image(height=30, width=40, encoding="rgb8", step=step or 120, data=pixels.tobytes())


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    name = str(tmp_path / "a.bag")
    with rosbag.Bag(name, "w") as bag:
        for i in range(20):
            stamp = genpy.Time.from_sec(BEGIN + 0.5 * i)
            bag.write("/camera", image(10 * i), stamp)
            bag.write("/broken", image(0, step=7), stamp)
            bag.write("/joints", JointState(name=["a", "b"], position=[0.1 * i, -i]), stamp)
    with open_plugin("rqt_bag", [name]) as gui:
        gui.window.resize(1000, 600)
        gui.timeline, gui.frame = gui.plugin._widget._timeline, gui.plugin._widget.frame
        gui.menu = lambda topic: TimelinePopupMenu(gui.timeline, topic, gui.plugin._widget._popups)
        wait_until(lambda: gui.timeline.topics)
        yield gui


def test_views_are_offered_by_type(gui):
    names = {
        topic: [view.name for view in gui.frame.get_viewer_types(gui.timeline.get_datatype(topic))] for topic in ("/camera", "/joints")
    }
    assert names == {"/camera": ["Raw", "Plot", "Image"], "/joints": ["Raw", "Plot"]}
    assert [topic for topic, _ in gui.frame.get_renderers()] == ["/broken", "/camera"]


def test_thumbnails(gui):
    gui.frame.set_renderer_active("/camera", True)
    frame = gui.frame
    process_events()
    row = next(row for row in frame._rows if row[0] == "/camera")
    assert row[2] == 160

    def blues():
        image = frame.grab().toImage()
        y = row[1] + 40
        return [
            x
            for x in range(frame._history_left, frame._history_right)
            if image.pixelColor(x, y).blue() == 220 and image.pixelColor(x, y).green() == 20
        ]

    wait_until(lambda: len(blues()) > 300)
    assert errors == []


def test_thumbnails_of_broken_images_are_switched_off(gui):
    gui.frame.set_renderer_active("/broken", True)
    wait_until(lambda: gui.frame.grab() and not gui.frame.is_renderer_active("/broken"))
    wait_until(lambda: any("no thumbnails of /broken: step is 7" in text for text in errors))


def test_image_view(gui):
    gui.menu("/camera").view("/camera", ImageView)
    viewer = gui.plugin._widget._popups["/camera__Image"].viewer
    gui.frame.playhead = genpy.Time.from_sec(BEGIN + 5.1)
    wait_until(lambda: viewer._image is not None and viewer._image.pixelColor(5, 5).red() == 100)
    gui.menu("/broken").view("/broken", ImageView)
    broken = gui.plugin._widget._popups["/broken__Image"].viewer
    wait_until(lambda: any("step is 7" in getattr(item, "toPlainText", str)() for item in broken._scene.items()))
    assert errors == []


def test_plot_view(gui):
    gui.menu("/joints").view("/joints", PlotView)
    viewer = gui.plugin._widget._popups["/joints__Plot"].viewer
    wait_until(lambda: viewer.tree.topLevelItemCount())
    viewer.check("/position[1]")
    wait_until(lambda: "/position[1]" in viewer.plot._curves and len(viewer.plot._curves["/position[1]"]) == 20)
    curve = viewer.plot._curves["/position[1]"]
    assert curve.x[-1] == pytest.approx(9.5) and curve.y[-1] == -19.0
    gui.frame.select_region(BEGIN + 2, BEGIN + 4)
    wait_until(lambda: len(viewer.plot._curves["/position[1]"]) == 5)
    viewer.check("/position[1]", False)
    assert not viewer.plot._curves and errors == []


def test_helper_for_others():
    picture = imgmsg_to_pil(image(50))
    assert picture.mode == "RGBA" and picture.size == (40, 30) and picture.getpixel((3, 3)) == (50, 20, 220, 255)

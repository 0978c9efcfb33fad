"""The window in the container, without display and master."""

import genpy
import numpy as np
import pytest

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import rosbag
import rospy
from python_qt_binding.QtCore import QPoint, Qt
from python_qt_binding.QtTest import QTest
from qt_gui.errors import UsageError
from rqt_bag.plugins.raw_view import RawView
from rqt_bag.timeline_frame import elapsed_text
from rqt_bag.timeline_menu import TimelinePopupMenu
from std_msgs.msg import Float64, String

BEGIN = 1_795_000_000.0
LEFT = Qt.MouseButton.LeftButton
NONE = Qt.KeyboardModifier.NoModifier


@pytest.fixture(autouse=True)
def master():
    rospy_without_master()


@pytest.fixture
def bag(tmp_path):
    name = str(tmp_path / "a.bag")
    with rosbag.Bag(name, "w") as bag:
        for i in range(101):
            bag.write("/speed", Float64(i), genpy.Time.from_sec(BEGIN + 0.1 * i))
        for i in range(11):
            bag.write("/text", String(f"word {i}"), genpy.Time.from_sec(BEGIN + i))
    return name


@pytest.fixture
def gui(bag):
    with open_plugin("rqt_bag", [bag]) as gui:
        gui.window.resize(900, 400)
        gui.widget = gui.plugin._widget
        gui.timeline, gui.frame = gui.widget._timeline, gui.widget.frame
        wait_until(lambda: gui.timeline.topics)
        process_events()
        yield gui


def at(gui):
    """Playhead in s since the beginning."""
    return round(gui.frame.playhead.to_sec() - BEGIN, 6)


def place(gui, seconds, y=40):
    return QPoint(round(gui.frame.map_stamp_to_x(BEGIN + seconds)), y)


def test_a_bag_from_the_command_line(gui):
    assert gui.timeline.topics == ["/speed", "/text"] and at(gui) == 0
    assert find(gui, "stamp_label").text() == f"{BEGIN:.9f}s" and find(gui, "seconds_label").text() == "0.000s"
    assert find(gui, "size_label").text().endswith("KB") and find(gui, "play").isEnabled()
    image = gui.frame.grab().toImage()
    assert len({image.pixelColor(x, 36).name() for x in range(gui.frame._history_left, gui.frame._history_right)}) > 1
    assert errors == []


def test_a_missing_bag_is_an_error_of_the_command_line(capfd):
    with pytest.raises(UsageError):
        with open_plugin("rqt_bag", ["/nowhere/x.bag"]):
            pass
    assert "rqt_bag: error: Bag file /nowhere/x.bag does not exist" in capfd.readouterr().err


def test_bags_that_cannot_be_read_are_told(gui, tmp_path):
    (tmp_path / "bad.bag").write_bytes(b"rubbish")
    gui.widget.load_bag(str(tmp_path / "bad.bag"))
    wait_until(lambda: "bad.bag" in find(gui, "message").text())
    assert gui.timeline.topics == ["/speed", "/text"] and len(errors) == 1


def test_playing_runs_at_its_speed_and_begins_again(gui):
    gui.timeline.play_speed = 2.0
    gui.timeline._timer.stop()  # the test is the clock
    gui.timeline.step(1.5)
    assert at(gui) == 3.0 and find(gui, "speed_label").text() == "> 2x"
    gui.timeline.step(4.0)
    assert at(gui) == 0.0  # past the end
    gui.timeline.play_speed = -1.0
    gui.timeline._timer.stop()
    gui.timeline.step(0.5)
    assert at(gui) == 10.0
    gui.frame.select_region(BEGIN + 2, BEGIN + 4)
    gui.timeline.play_speed = 1.0
    gui.timeline._timer.stop()
    gui.timeline.navigate_start()
    gui.timeline.step(1.5)
    assert at(gui) == 3.5
    gui.timeline.step(1.0)
    assert at(gui) == 2.0


def test_keys_and_buttons(gui):
    key = Qt.Key
    for pressed, expected in ((key.Key_End, 10.0), (key.Key_Home, 0.0)):
        QTest.keyClick(gui.widget, pressed)
        assert at(gui) == expected
    find(gui, "next").click()
    find(gui, "next").click()
    assert at(gui) == 0.2
    find(gui, "previous").click()
    assert at(gui) == 0.1
    QTest.keyClick(gui.widget, key.Key_Space)
    assert gui.timeline.play_speed == 1.0
    QTest.keyClick(gui.widget, key.Key_Plus)
    assert gui.timeline.play_speed == 2.0
    QTest.keyClick(gui.widget, key.Key_Minus)
    QTest.keyClick(gui.widget, key.Key_Minus)
    assert gui.timeline.play_speed == 0.5 and find(gui, "speed_label").text() == "> 1/2x"
    QTest.keyClick(gui.widget, key.Key_Space)
    assert gui.timeline.play_speed == 0.0
    find(gui, "slower").click()
    assert gui.timeline.play_speed == -1.0
    gui.timeline.play_speed = 0.0
    width = gui.frame._right - gui.frame._left
    QTest.keyClick(gui.widget, key.Key_Up)
    assert gui.frame._right - gui.frame._left == pytest.approx(width / 2)
    left = gui.frame._left
    QTest.keyClick(gui.widget, key.Key_Right)
    assert gui.frame._left > left
    find(gui, "zoom_home").click()
    assert gui.frame._right - gui.frame._left == pytest.approx(width)


def test_the_mouse_moves_the_playhead_and_marks_a_region(gui):
    QTest.mouseClick(gui.frame, LEFT, NONE, place(gui, 5.0))
    assert at(gui) == pytest.approx(5.0, abs=0.05)
    QTest.mousePress(gui.frame, LEFT, NONE, place(gui, 2.0, 10))
    QTest.mouseMove(gui.frame, place(gui, 6.0, 10))
    QTest.mouseRelease(gui.frame, LEFT, NONE, place(gui, 6.0, 10))
    begin, end = (edge.to_sec() - BEGIN for edge in gui.frame.play_region)
    assert (begin, end) == (pytest.approx(2, abs=0.05), pytest.approx(6, abs=0.05)) and gui.frame.has_selected_region
    QTest.mousePress(gui.frame, LEFT, NONE, place(gui, 6.0, 10))  # its edge
    QTest.mouseMove(gui.frame, place(gui, 8.0, 10))
    QTest.mouseRelease(gui.frame, LEFT, NONE, place(gui, 8.0, 10))
    assert gui.frame.play_region[1].to_sec() - BEGIN == pytest.approx(8, abs=0.1)
    QTest.mousePress(gui.frame, LEFT, NONE, place(gui, 5.0, 10))  # its inside
    QTest.mouseMove(gui.frame, place(gui, 4.0, 10))
    QTest.mouseRelease(gui.frame, LEFT, NONE, place(gui, 4.0, 10))
    begin, end = (edge.to_sec() - BEGIN for edge in gui.frame.play_region)
    assert (begin, end) == (pytest.approx(1, abs=0.1), pytest.approx(7, abs=0.1))
    QTest.mouseClick(gui.frame, LEFT, NONE, place(gui, 9.0, 10))  # beside it
    assert not gui.frame.has_selected_region
    left = gui.frame._left
    QTest.mousePress(gui.frame, Qt.MouseButton.MiddleButton, NONE, place(gui, 5.0))
    there = place(gui, 6.0)  # asked once, as the move shifts the times below it
    QTest.mouseMove(gui.frame, there)
    QTest.mouseRelease(gui.frame, Qt.MouseButton.MiddleButton, NONE, there)
    assert gui.frame._left == pytest.approx(left - 1, abs=0.1)


def texts(menu):
    return [action.text() for action in menu.actions() if not action.isSeparator()]


def choose(menu, *path):
    action = next(action for action in menu.actions() if action.text() == path[0])
    return action.trigger() if len(path) == 1 else choose(action.menu(), *path[1:])


def test_menu_and_raw_view(gui):
    menu = TimelinePopupMenu(gui.timeline, None, gui.widget._popups)
    assert texts(menu)[:2] == ["Reset Timeline", "Play All Messages"]
    assert {"View (by Topic)", "View (by Type)", "Publish..."} <= set(texts(menu))
    choose(menu, "View (by Type)", "std_msgs/String", "/text", "Raw")
    popup = gui.widget._popups["/text__Raw"]
    tree = popup.viewer.message_tree
    wait_until(lambda: tree.topLevelItemCount() == 1 and tree.topLevelItem(0).text(0) == "data: word 0")
    gui.frame.playhead = genpy.Time.from_sec(BEGIN + 7.3)
    wait_until(lambda: tree.topLevelItem(0).text(0) == "data: word 7")
    for action, word in (
        (popup.viewer.navigate_next, 8),
        (popup.viewer.navigate_previous, 7),
        (popup.viewer.navigate_last, 10),
        (popup.viewer.navigate_first, 0),
    ):
        action()
        wait_until(lambda: tree.topLevelItem(0).text(0) == f"data: word {word}")
    assert isinstance(popup.viewer, RawView) and errors == []


def test_publishing_what_the_playhead_passes(gui, monkeypatch):
    sent = []

    class Publisher:
        def __init__(self, topic, *_arguments, **_options):
            self._topic = topic

        def publish(self, message):
            sent.append((self._topic, message.data))

        def unregister(self):
            pass

    monkeypatch.setattr(rospy, "Publisher", Publisher)
    choose(TimelinePopupMenu(gui.timeline, "/text", gui.widget._popups), "Publish")
    assert gui.timeline.is_publishing("/text") and not gui.timeline.is_publishing("/speed")
    gui.timeline.play_speed = 1.0
    gui.timeline._timer.stop()
    gui.timeline.step(3.5)
    wait_until(lambda: sent == [("/text", "word 1"), ("/text", "word 2"), ("/text", "word 3")])
    gui.frame.playhead = genpy.Time.from_sec(BEGIN + 9.5)  # a jump: the last message only
    wait_until(lambda: sent[3:] == [("/text", "word 9")])
    choose(TimelinePopupMenu(gui.timeline, None, gui.widget._popups), "Publish...", "Publish None")
    gui.timeline.step(0.5)
    wait_until(lambda: not gui.timeline._player.busy)
    assert len(sent) == 4


def test_region_is_saved(gui, tmp_path):
    gui.frame.select_region(BEGIN + 0.95, BEGIN + 2.05)
    name = str(tmp_path / "part.bag")
    gui.timeline.copy_region_to_bag(name)
    wait_until(lambda: "13 messages saved" in find(gui, "message").text())
    with rosbag.Bag(name) as part:
        assert part.get_message_count("/text") == 2 and part.get_message_count("/speed") == 11


def test_a_plugin_that_fails_is_left_out(gui):
    class Bad:
        msg_combine_px = 1.5

        def get_segment_height(self, topic):
            return 50

        def draw_timeline_segment(self, *_args):
            raise RuntimeError("broken")

    gui.frame._timeline_renderers["std_msgs/String"] = bad = Bad()
    bad.close = lambda: None
    gui.frame.set_renderer_active("/text", True)
    gui.frame.grab()
    assert not gui.frame.is_renderer_active("/text") and "thumbnails of /text are switched off: RuntimeError: broken" in errors[0]

    class BadView(RawView):
        name = "Bad"

        def __init__(self, *_args):
            raise RuntimeError("broken")

    TimelinePopupMenu(gui.timeline, "/text", gui.widget._popups).view("/text", BadView)
    assert "the view Bad of /text does not open" in errors[1]


def test_a_million_messages_are_drawn_as_columns(gui):
    gui.timeline._live["/speed"] = np.linspace(BEGIN, BEGIN + 10, 1_000_000)
    assert len(gui.frame._segments("/speed", 1.5)) == 1
    gui.timeline._live.clear()


def test_times_of_the_divisions():
    assert [elapsed_text(*pair) for pair in ((0, 1), (75, 5), (3725, 60), (-2, 1), (0.25, 0.05), (0.002, 0.001))] == [
        "0:00",
        "1:15",
        "1:02:05",
        "-0:02",
        "0.25s",
        "0.002s",
    ]


def test_threads_for_time_lines_of_other_packages():
    """As rqt_py_trees uses them."""
    import threading
    from types import SimpleNamespace

    from rqt_bag import MessageView
    from rqt_bag.bag_widget import BagGraphicsView
    from rqt_bag.index_cache_thread import IndexCacheThread
    from rqt_bag.message_listener_thread import MessageListenerThread
    from rqt_testing.in_process import application, wait_until

    application()
    seen = []

    class View(MessageView):
        def message_viewed(self, bag, msg_details):
            seen.append((bag, msg_details))

        def message_cleared(self):
            seen.append(None)

    timeline = SimpleNamespace(_messages={}, _messages_cvs={"/a": threading.Condition()})
    view = View(timeline, "/a")
    thread = MessageListenerThread(timeline, "/a", view)
    for message in (("bag", ("/a", "m1", 1)), ("bag", None), ("bag", ("/a", "m2", 2))):
        before = len(seen)
        with timeline._messages_cvs["/a"]:
            timeline._messages["/a"] = message
            timeline._messages_cvs["/a"].notify_all()
        wait_until(lambda: len(seen) > before)
    assert seen == [("bag", ("/a", "m1", 1)), None, ("bag", ("/a", "m2", 2))]
    thread.stop()
    thread.join(10)
    assert not thread.is_alive()

    updated, drawn = [], []

    def update(topic):
        updated.append(topic)
        frame.invalidated_caches.discard(topic)
        return 3

    frame = SimpleNamespace(
        index_cache_cv=threading.Condition(),
        invalidated_caches={"/a"},
        topics=["/a", "/b"],
        scene=lambda: SimpleNamespace(update=lambda: drawn.append(1)),
        _update_index_cache=update,
    )
    thread = IndexCacheThread(frame)
    wait_until(lambda: drawn)
    thread.stop()
    thread.join(10)
    assert updated == ["/a"] and not thread.is_alive()
    BagGraphicsView().close()

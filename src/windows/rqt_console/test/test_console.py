"""Rows, rules, files and settings of the console."""

import json
import time

import genpy
import pytest
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtWidgets import QDialog
from rosgraph_msgs.msg import Log
from rqt_console import saved_messages
from rqt_console.console_widget import ConsoleWidget
from rqt_console.message import Message
from rqt_testing.in_process import application, errors, find, open_gui, open_plugin, process_events, rospy_without_master
from std_msgs.msg import Header


def message(number, severity=Log.INFO, node="/talker", text=None, topics=("/chatter",)):
    return Message(text or f"hello {number}", severity, node, (1000 + number, 5), list(topics), f"talker.py:run:{number}")


@pytest.fixture
def widget():
    application()
    widget = ConsoleWidget(message_limit=100)
    yield widget
    widget.close()


def shown(widget, column=1):
    return [widget.model.index(row, column).data() for row in range(widget.model.rowCount())]


def test_newest_first_and_the_oldest_go(widget):
    widget.take([message(n) for n in range(60)])
    widget.take([message(n) for n in range(60, 130)])
    assert shown(widget) == [f"hello {n}" for n in range(129, 29, -1)]
    assert find(widget, "messages_label").text() == "Displaying 100 of 100 messages"
    assert shown(widget, 0)[0] == "#130" and shown(widget, 2)[0] == "Info"
    assert shown(widget, 4)[0].split(".")[1].startswith("000000005 (1970-01-01)")
    assert shown(widget, 6)[0] == "talker.py:run:129" and shown(widget, 5)[0] == "/chatter"


@pytest.mark.parametrize(
    "column, order", [(2, Qt.SortOrder.AscendingOrder), (2, Qt.SortOrder.DescendingOrder), (0, Qt.SortOrder.AscendingOrder)]
)
def test_sorted_and_selection_stays(widget, column, order):
    widget.take([message(n, severity=2 ** (n % 5)) for n in range(100)])
    widget.table_view.selectRow(3)
    chosen = widget.selected_messages()
    widget.table_view.sortByColumn(column, order)
    widget.take([message(n, severity=2 ** (n % 5)) for n in range(100, 110)])
    keys = [(m.severity if column else m.id) for m in map(widget.model.message_of_row, range(100))]
    assert keys == sorted(keys, reverse=order == Qt.SortOrder.DescendingOrder) and len(keys) == 100
    assert widget.selected_messages() == chosen


def test_any_rule_excludes(widget):
    widget.take([message(1), message(2, Log.WARN), message(3, node="/other"), message(4, text="noise 4"), message(5)])
    widget.exclude_box.add("severity", {"selected": [Log.WARN]})
    noise = widget.exclude_box.add("message", {"text": "^no.se", "regex": True})
    assert shown(widget) == ["hello 5", "hello 3", "hello 1"]
    widget.take([message(6, Log.WARN), message(7)])
    assert shown(widget)[0] == "hello 7" and widget.counts_label.text() == "Displaying 4 of 7 messages"
    noise.set_enabled(False)
    assert "noise 4" in shown(widget)
    noise.set_enabled(True)
    noise.set_text("(")  # a wrong expression hides nothing
    assert "noise 4" in shown(widget) and "not a regular expression" in noise.error


def test_custom_needs_all(widget):
    widget.take([message(1, Log.WARN), message(2, Log.WARN, "/other"), message(3)])
    widget.exclude_box.add("custom", {"severity": {"selected": [Log.WARN]}, "node": {"selected": ["/other"]}})
    assert shown(widget) == ["hello 3", "hello 1"]


def test_highlight_greys_the_others_and_can_hide_them(widget):
    widget.take([message(1), message(2, topics=["/x"])])
    widget.highlight_box.add("topic", {"selected": ["/x"]})
    colors = [widget.model.index(row, 1).data(Qt.ItemDataRole.ForegroundRole).name() for row in (0, 1)]
    assert colors == ["#00008b", "#808080"]
    find(widget, "show_highlighted_button").click()
    assert shown(widget) == ["hello 2"]


def test_row_menu(widget):
    widget.take([message(1), message(2, Log.ERROR, "/bad")])
    widget.table_view.selectRow(0)
    exclude = widget.row_menu().actions()[0].menu()
    next(action for action in exclude.actions() if action.text() == "Node").trigger()
    assert shown(widget) == ["hello 1"] and widget.exclude_box.state() == [["node", True, {"selected": ["/bad"]}]]


def test_file(widget, tmp_path):
    path = tmp_path / "log.csv"
    odd = message(3, text='say "yes"; \\n\nand no', topics=["/a", "/b"])
    saved_messages.save(str(path), [message(1), odd])
    assert path.read_text().splitlines()[:2] == [
        "message;severity;node;stamp;topics;location",
        '"hello 1";"2";"/talker";"1001.000000005";"/chatter";"talker.py:run:1"',
    ]
    assert [vars(m) for m in saved_messages.load(str(path))] == [vars(message(1)), vars(odd)]
    widget.load(str(path))
    assert widget.paused and widget.model.message_count == 2
    widget.take([message(9)])
    assert widget.model.message_count == 2


def test_a_file_of_noetic(tmp_path):
    """Which has a backslash before quotes, and before nothing else."""
    path = tmp_path / "noetic.csv"
    said = [r"regex \d+ in C:\temp", "ends with a backslash \\", 'a ";" in "quotes"', "two\nlines", '"']
    records = [f"""\"{text.replace('"', chr(92) + '"')}\";"2";"/talker";"1001.000000005";"/a,/b";"talker.py:run:1"\n""" for text in said]
    content = "message;severity;node;stamp;topics;location\n" + "".join(records)
    path.write_text(content)
    loaded = saved_messages.load(str(path))
    assert [m.message for m in loaded] == said
    saved_messages.save(str(path), loaded)
    assert path.read_text() == content


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"a;b;c\n",
        b'message;severity;node;stamp;topics;location\n"x";"2"\n',
        b"\xff\xfe\x00",
        b"message;severity;node;stamp;topics;location\nx;two;n;1.5;;l\n",
    ],
)
def test_other_files_are_refused(tmp_path, content):
    path = tmp_path / "x.csv"
    path.write_bytes(content)
    with pytest.raises(saved_messages.SavedMessagesError, match="x.csv"):
        saved_messages.load(str(path))
    with pytest.raises(saved_messages.SavedMessagesError, match="No such file"):
        saved_messages.load(str(tmp_path / "none"))


def test_thousands_do_not_block(widget):
    """The window's thread is free again within 50 ms after each look into the queue, at 2 000 messages a second."""
    widget.model.set_message_limit(10000)
    widget.resize(1000, 700)
    widget.show()
    widget.exclude_box.add("message", {"text": "x[yz]+", "regex": True})
    times = []
    for turn in range(70):
        batch = [message(200 * turn + n, severity=2 ** (n % 5)) for n in range(200)]
        begin = time.thread_time()
        widget.take(batch)
        process_events()
        times.append(time.thread_time() - begin)
    assert widget.model.message_count == 10000
    assert sorted(times)[-4] < 0.05  # of processor time: the machine does other things too


def test_in_the_window(tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "rqt.ini")
    with open_plugin("rqt_console", settings=settings) as gui:
        log = Log(header=Header(stamp=genpy.Time(1, 2)), level=Log.ERROR, name="/n", msg="broken", topics=["/b", "/a"])
        gui.plugin.queue_message(log)
        gui.plugin._flush()
        assert shown(gui.plugin.widget) == ["broken"] and shown(gui.plugin.widget, 5) == ["/a, /b"]
        gui.plugin.widget.exclude_box.add("node", {"selected": ["/n"]})
        gui.plugin._configure("/rosout", 500)
    with open_plugin("rqt_console", settings=settings) as gui:
        assert [rule for rule in gui.plugin.widget.exclude_box.state() if rule[0] != "severity"] == [["node", True, {"selected": ["/n"]}]]
        assert (gui.plugin._topic, gui.plugin._limit) == ("/rosout", 500)
    assert errors == []


def group(**keys):
    """A group of a perspective file, values as Noetic's window writes them."""
    return {"keys": {name: {"type": "repr", "repr": repr(value)} for name, value in keys.items()}, "groups": {}}


RULES = [
    ["severity", True, {"selected": [Log.DEBUG, Log.WARN]}],
    ["message", False, {"text": "a.*b", "regex": True}],
    ["node", True, {"selected": ["/one"]}],
    ["topic", True, {"selected": []}],
    ["location", True, {"text": "x.py", "regex": False}],
    ["time", True, {"start": 1500000000.25, "stop": 1500000009.0, "stop_enabled": False}],
    [
        "custom",
        True,
        {
            "message": {"text": "t", "regex": False},
            "severity": {"selected": [Log.FATAL]},
            "node": {"selected": ["/a", "/b"]},
            "topic": {"selected": []},
        },
    ],
]


def test_rules_of_a_perspective_file_of_noetic_are_kept(tmp_path):
    from python_qt_binding.QtCore import QDateTime
    from qt_gui.application import perspective_file

    def stamp(seconds):
        return QDateTime.fromMSecsSinceEpoch(round(seconds * 1000)).toString("hh:mm:ss.zzz (yyyy-MM-dd)")

    rospy_without_master()
    plugin = group(
        settings_exist="true",
        exclude_filters=[rule[0] for rule in RULES] + ["of_tomorrow"],
        highlight_filters="message",
        show_highlighted_only="false",
        paused="true",
        message_limit="777",
    )
    plugin["groups"] = {
        f"exclude_filter_{i}": made
        for i, made in enumerate(
            (
                group(enabled="true", itemlist=["Debug", "Warn"]),
                group(enabled="false", text="a.*b", regex="true"),
                group(enabled="true", itemlist="/one"),
                group(enabled="true", itemlist=""),
                group(enabled="true", text="x.py", regex="false"),
                group(enabled="true", start_time=stamp(1500000000.25), stop_time=stamp(1500000009.0), stop_time_enabled="false"),
                group(enabled="true", text="t", regex="false", severityitemlist="Fatal", topicitemlist="", nodeitemlist=["/a", "/b"]),
            )
        )
    }
    plugin["groups"]["highlight_filter_0"] = group(enabled="true", text="hello", regex="false")
    manager = group(**{"running-plugins": {"rqt_console/Console": [1]}})
    manager["groups"] = {"plugin__rqt_console__Console__1": {"keys": {}, "groups": {"plugin": plugin}}}
    path, saved = str(tmp_path / "noetic.perspective"), str(tmp_path / "ours.perspective")
    with open(path, "w") as file:
        json.dump({"keys": {}, "groups": {"pluginmanager": manager}}, file)
    with open_gui(["--perspective-file", path]) as gui:
        widget = gui.plugins.running()[0].plugin().widget
        assert widget.exclude_box.state() == RULES
        assert widget.highlight_box.state() == [["message", True, {"text": "hello", "regex": False}]]
        assert widget.paused and widget.model._limit == 777
        gui.perspectives.export_perspective_to_file(saved)
    assert errors == []
    kept = perspective_file.read(saved)["groups"]["pluginmanager"]["groups"]["plugin__rqt_console__Console__1"]["groups"]["plugin"]
    assert kept["keys"]["exclude_filters"] == [rule[0] for rule in RULES]
    assert kept["groups"]["exclude_filter_5"]["keys"]["start_time"] == stamp(1500000000.25)
    assert kept["groups"]["exclude_filter_6"]["keys"]["nodeitemlist"] == ["/a", "/b"]


def test_dashboards_show_messages_of_their_own():
    """As rqt_robot_dashboard does."""
    import rospkg
    import rospy
    from rqt_console.console import Console
    from rqt_console.message_data_model import MessageDataModel
    from rqt_console.message_proxy_model import MessageProxyModel

    rospy_without_master()
    application()
    model, proxy = MessageDataModel(), MessageProxyModel()
    proxy.setSourceModel(model)
    console = ConsoleWidget(proxy, rospkg.RosPack(), minimal=True)
    now = rospy.Time.now()
    for age, level in ((200, Log.FATAL), (20, Log.ERROR), (5, Log.WARN), (5, Log.WARN), (1, Log.INFO)):
        log = Log(header=Header(stamp=now - rospy.Duration(age)), level=level, name="/n", msg=f"{age} s ago")
        model.insert_rows([Console.convert_rosgraph_log_message(log)])
    assert shown(console)[0] == "1 s ago" and not console._paused
    console.exclude_box.add("severity", {"selected": [Log.INFO]})
    assert shown(console)[0] == "5 s ago"
    summary = console.get_message_summary(30.0)
    assert (summary.fatal, summary.error, summary.warn, summary.info, summary.debug) == (0, 1, 2, 1, 0)
    assert console.get_message_summary().fatal == 1
    console.browse(model.messages())
    console.cleanup_browsers_on_close()
    process_events()
    assert not any(dialog.isVisible() for dialog in console.findChildren(QDialog))
    console.close()

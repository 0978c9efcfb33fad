"""The browser shows what is installed."""

from rqt_testing.in_process import find
from rqt_testing.types_browser import open_browser, shows


def test_definition(tmp_path):
    with open_browser("rqt_msg.messages", str(tmp_path / "rqt.ini")) as gui:
        shows(
            gui, "geometry_msgs", "PoseStamped", ["geometry_msgs/PoseStamped"], ["header", "pose"], "geometry_msgs/Quaternion orientation"
        )


def test_types_that_are_not_built(tmp_path):
    with open_browser("rqt_msg.messages", str(tmp_path / "rqt.ini")) as gui:
        gui.plugin.widget._types["no_package"] = ["Odd"]
        find(gui, "package_combo").addItem("no_package")
        find(gui, "package_combo").setCurrentText("no_package")
        find(gui, "add_button").click()
        assert "cannot import no_package/Odd" in find(gui, "error_label").text()

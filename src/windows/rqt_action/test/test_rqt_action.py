"""The browser shows what is installed."""

from rqt_testing.types_browser import open_browser, shows


def test_definition(tmp_path):
    with open_browser("rqt_action.action_plugin", str(tmp_path / "rqt.ini")) as gui:
        shows(
            gui,
            "control_msgs",
            "GripperCommand",
            [f"control_msgs/GripperCommand {part}" for part in ("Goal", "Result", "Feedback")],
            ["command"],
            "bool stalled",
        )

"""The browser shows what is installed."""

from rqt_testing.types_browser import open_browser, shows


def test_definition(tmp_path):
    with open_browser("rqt_srv.services", str(tmp_path / "rqt.ini")) as gui:
        shows(
            gui,
            "nav_msgs",
            "GetPlan",
            ["nav_msgs/GetPlan Request", "nav_msgs/GetPlan Response"],
            ["start", "goal", "tolerance"],
            "float32 tolerance",
        )

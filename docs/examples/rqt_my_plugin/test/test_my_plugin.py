"""The plugin in the container, in this process, without display and master."""

import pytest
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master


@pytest.fixture(autouse=True)
def master():
    rospy_without_master()


def test_topic_is_kept(tmp_path):
    settings = str(tmp_path / "rqt.ini")
    with open_plugin("rqt_my_plugin", settings=settings) as gui:
        find(gui, "topic_edit").setText("/other")
    with open_plugin("rqt_my_plugin", settings=settings) as gui:
        assert find(gui, "topic_edit").text() == "/other"
    assert errors == []

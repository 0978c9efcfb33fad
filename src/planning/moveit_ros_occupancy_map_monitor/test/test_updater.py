"""What updaters keep of messages."""

import gc
import inspect
import weakref

import numpy as np
import pytest
import rospy
from moveit_ros_occupancy_map_monitor.updater import OccupancyMapUpdater, UpdaterError


class Message:
    pass


class Updater(OccupancyMapUpdater):
    topic = "/clouds"

    def __init__(self, error):
        super().__init__(None, {})
        self.error, self.held = error, None

    def work(self, message):
        points = np.zeros((1000, 3))
        self.held = weakref.ref(points)
        raise self.error(f"{len(points)} points of {type(message).__name__} cannot be used")


@pytest.mark.parametrize("error", (UpdaterError, ZeroDivisionError))
def test_a_message_that_cannot_be_used_is_gone_at_once(error, monkeypatch):
    """Clouds are large, and the collector of cycles comes seldom."""
    said = []

    def log(_period, text):
        said.append(text)
        frame = inspect.currentframe().f_back
        while frame.f_code.co_filename != __file__:
            assert frame.f_locals["self"] is updater  # rospy looks at them, for the names of classes
            frame = frame.f_back

    monkeypatch.setattr(rospy, "logerr_throttle", log)
    updater, message = Updater(error), Message()
    gc.disable()
    try:
        updater._try(message)
        seen = weakref.ref(message)
        del message
        assert seen() is None and updater.held() is None
    finally:
        gc.enable()
    assert len(said) == 1 and "1000 points of Message cannot be used" in said[0] and "/clouds" in said[0]

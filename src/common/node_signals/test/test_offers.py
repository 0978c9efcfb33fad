"""Names that two parts of a node choose."""

import pytest
import rospy
from node_signals import offers
from rospy.impl.registration import Registration
from std_msgs.msg import Bool, String


class Taken:
    data_class = Bool


@pytest.fixture
def said(monkeypatch):
    lines = []
    monkeypatch.setattr(rospy, "logerr", lambda text, *args: lines.append(text % args))
    monkeypatch.setattr(rospy, "Publisher", lambda name, kind, **more: ("publisher", name, kind, more))
    monkeypatch.setattr(rospy, "Subscriber", lambda name, kind, callback, **more: ("subscriber", name, kind, more))
    return lines


def test_a_second_service_of_a_name_is_a_stand_in_with_one_line(said, monkeypatch):
    def taken(name, kind, handler):
        raise rospy.ServiceException(f"service [{name}] already registered")

    monkeypatch.setattr(rospy, "Service", taken)
    service = offers.service("/cam/set_camera_info", object, print)
    service.shutdown("done")
    assert len(said) == 1 and "[/cam/set_camera_info]" in said[0] and "\n" not in said[0]


def test_another_trouble_of_a_service_is_not_hidden(said, monkeypatch):
    def broken(name, kind, handler):
        raise rospy.ServiceException("no master")

    monkeypatch.setattr(rospy, "Service", broken)
    with pytest.raises(rospy.ServiceException):
        offers.service("/s", object, print)
    assert not said


def test_a_second_type_on_a_topic_is_left_out_and_a_second_part_of_the_same_type_is_not(said, monkeypatch):
    there = {(Registration.PUB, "/scan"): Taken, (Registration.SUB, "/go"): Taken}
    monkeypatch.setattr(offers, "get_topic_manager", lambda: type("M", (), {"get_impl": staticmethod(lambda *key: there.get(key))}))
    assert offers.publisher("/scan", Bool, queue_size=1) == ("publisher", "/scan", Bool, {"queue_size": 1})
    assert offers.publisher("/new", String, latch=True)[0] == "publisher"
    assert offers.subscriber("/go", Bool, print)[0] == "subscriber" and not said
    left_out = offers.publisher("/scan", String, queue_size=1)
    left_out.publish(String("x"))
    left_out.unregister()
    assert left_out.get_num_connections() == 0
    offers.subscriber("/go", String, print).unregister()
    assert len(said) == 2 and all("std_msgs/Bool" in line and "std_msgs/String" in line for line in said)

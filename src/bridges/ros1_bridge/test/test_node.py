"""What ROS 2's process says at the worst moment: while a bridge is being made, or of one that has gone."""

import pytest
from ros1_bridge import node
from ros1_bridge.settings import Options

TYPES = {
    "std_msgs/String": {"std_msgs/String": {"data": "string"}},
    "std_srvs/SetBool": {
        "std_srvs/SetBoolRequest": {"data": "boolean"},
        "std_srvs/SetBoolResponse": {"success": "boolean", "message": "string"},
    },
}


class Process:
    """ROS 2's, which answers before the order has been given."""

    def __init__(self, heard, lost):
        self.heard, self.told, self.answers = heard, [], []

    def question(self, word, name, form):
        return TYPES[name]

    def tell(self, *words, data=None):
        self.told.append(words)
        if words[0] == "advertise" and words[3].get("durability") != "transient_local":
            self.heard("to_ros2", words[1], "unequal", "DURABILITY", words[3], None)

    def answer(self, number, said, data=None):
        self.answers.append((number, said))


@pytest.fixture
def bridge(monkeypatch):
    monkeypatch.setattr(node, "Link", Process)
    return node.Bridge()


def topics(bridge, published, types):
    bridge._topics(Options(all_1to2=True), published, {}, types)


def test_a_subscriber_that_wants_what_is_latched_is_heard_while_its_topic_is_being_bridged(bridge):
    topics(bridge, {"/note": ["/talker"]}, {"/note": "std_msgs/String"})
    assert [words[3].get("durability") for words in bridge.link.told] == [None, "transient_local"]


def test_a_topic_that_is_there_no_more_is_given_up(bridge):
    for published in ({"/note": ["/talker"]}, {}):
        topics(bridge, published, {"/note": "std_msgs/String"})
    assert bridge.link.told[-1] == ("forget", "publisher", "/note")


@pytest.mark.parametrize("kind", ["services_of_ros1", "actions_of_ros1"])
def test_a_call_for_what_has_just_gone_is_answered_with_an_error(bridge, kind):
    bridge.link.heard(kind, "/gone", "call", 3, b"")
    assert bridge.link.answers == [(3, "/gone of ROS 1 has gone")]


def test_a_service_is_offered_while_it_is_there(bridge):
    find = lambda name: bridge.pairs.find("srv", "std_srvs/SetBool")
    for here in ({"/one", "/of_both"}, {"/one"}, set()):
        bridge._offer("services_of_ros1", here, {"/of_both"}, (".*",), find)
    assert bridge.link.told == [("serve", "/one", "std_srvs/SetBool"), ("forget", "server", "/one")]


def test_only_new_services_are_asked_for_their_types_and_all_together(bridge, monkeypatch):
    asked = []

    def types_of(names):
        asked.append(sorted(names))
        return {"/answers": "std_srvs/SetBool"}

    monkeypatch.setattr(node, "types_of", types_of)
    services = ["/answers", "/hung", "/of_ros2", "/a/get_loggers", "/forbidden"]
    find = bridge._of_services(services, ["/of_ros2"], ("/[^f].*",))
    assert asked == [["/answers", "/hung"]]
    assert find("/answers").ros1 == "std_srvs/SetBool"
    assert find("/hung") is None

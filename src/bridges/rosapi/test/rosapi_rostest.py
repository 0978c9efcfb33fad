#!/usr/bin/env python3
"""What rosapi's services answer, and that they are upstream's by name and definition."""

import json
import socket
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import rosapi.msg
import rosapi.srv
import rosgraph
import rospy
import rostest
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool
from test_support.waiting import wait_until

#: of rosbridge_suite 0.11.17's definitions
SUMS = {
    "DeleteParam": "c1f3d28f1b044c871e6eff2e9fc3c667",
    "GetActionServers": "46807ba271844ac5ba4730a47556b236",
    "GetParam": "e36fd90759dbac1c5159140a7fa8c644",
    "GetParamNames": "dc7ae3609524b18034e49294a4ce670e",
    "GetTime": "556a4fb76023a469987922359d08a844",
    "HasParam": "ed3df286bd6dff9b961770f577454ea9",
    "MessageDetails": "f9c88144f6f6bd888dd99d4e0411905d",
    "NodeDetails": "e1d0ced5ab8d5edb5fc09c98eb1d46f6",
    "Nodes": "3d07bfda1268b4f76b16b7ba8a82665d",
    "Publishers": "cb37f09944e7ba1fc08ee38f7a94291d",
    "SearchParam": "dfadc39f113c1cc6d7759508d8461d5a",
    "ServiceHost": "a1b60006f8ee69637c856c94dd192f5a",
    "ServiceNode": "bd2a0a45fd7a73a86c8d6051d5a6db8a",
    "ServiceProviders": "f30b41d5e347454ae5483ee95eef5cc6",
    "ServiceRequestDetails": "f9c88144f6f6bd888dd99d4e0411905d",
    "ServiceResponseDetails": "f9c88144f6f6bd888dd99d4e0411905d",
    "ServiceType": "0e24a2dcdf70e483afc092a35a1f15f7",
    "Services": "e44a7e7bcb900acadbcc28b132378f0c",
    "ServicesForType": "93e9fe8ae5a9136008e260fe510bd2b0",
    "SetParam": "bc6ccc4a57f61779c8eaae61e9f422e0",
    "Subscribers": "cb387b68f5b29bc1456398ee8476b973",
    "TopicType": "0d30b3f53a0fd5036523a7141e524ddf",
    "Topics": "d966d98fc333fa1f3135af765eac1ba8",
    "TopicsAndRawTypes": "e1432466c8f64316723276ba07c59d12",
    "TopicsForType": "56f77ff6da756dd27c1ed16ec721072a",
}


def ask(which, type_name, **fields):
    rospy.wait_for_service(f"/rosapi/{which}", 30)
    return rospy.ServiceProxy(f"/rosapi/{which}", getattr(rosapi.srv, type_name))(**fields)


class RosApi(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.publisher = rospy.Publisher("/seen", String, queue_size=1)
        cls.hidden = rospy.Publisher("/hidden", String, queue_size=1)
        cls.subscriber = rospy.Subscriber("/seen_only_read", Float64, lambda message: None)
        cls.service = rospy.Service("/switch", SetBool, lambda request: (True, ""))

    def test_definitions(self):
        self.assertEqual({name: getattr(rosapi.srv, name)._md5sum for name in SUMS}, SUMS)
        self.assertEqual(rosapi.msg.TypeDef._md5sum, "80597571d79bbeef6c9c4d98f30116a0")

    def test_topics(self):
        found = ask("topics", "Topics")
        types = dict(zip(found.topics, found.types))
        self.assertEqual((types["/seen"], types["/seen_only_read"]), ("std_msgs/String", "std_msgs/Float64"))
        self.assertNotIn("/hidden", types)
        self.assertEqual(ask("topics_for_type", "TopicsForType", type="std_msgs/Float64").topics, ["/seen_only_read"])
        self.assertEqual(ask("topic_type", "TopicType", topic="/seen").type, "std_msgs/String")
        self.assertEqual([ask("topic_type", "TopicType", topic=name).type for name in ("/hidden", "/no_such")], ["", ""])
        self.assertEqual(ask("publishers", "Publishers", topic="/seen").publishers, [rospy.get_name()])
        self.assertEqual(ask("subscribers", "Subscribers", topic="/seen_only_read").subscribers, [rospy.get_name()])
        self.assertEqual(ask("publishers", "Publishers", topic="/hidden").publishers, [])
        raw = ask("topics_and_raw_types", "TopicsAndRawTypes")
        self.assertEqual(dict(zip(raw.topics, raw.typedefs_full_text))["/seen_only_read"].strip(), "float64 data")

    def test_services_and_nodes(self):
        self.assertIn("/switch", ask("services", "Services").services)
        self.assertEqual(ask("services_for_type", "ServicesForType", type="std_srvs/SetBool").services, ["/switch"])
        self.assertEqual(ask("service_type", "ServiceType", service="/switch").type, "std_srvs/SetBool")
        self.assertEqual(ask("service_type", "ServiceType", service="/no_such").type, "")
        self.assertEqual(ask("service_providers", "ServiceProviders", service="std_srvs/SetBool").providers, [rospy.get_name()])
        self.assertEqual(ask("service_node", "ServiceNode", service="/switch").node, rospy.get_name())
        self.assertEqual(ask("service_node", "ServiceNode", service="/no_such").node, "")
        self.assertTrue(ask("service_host", "ServiceHost", service="/switch").host)
        self.assertEqual(ask("service_host", "ServiceHost", service="/no_such").host, "")
        self.assertIn(rospy.get_name(), ask("nodes", "Nodes").nodes)
        details = ask("node_details", "NodeDetails", node=rospy.get_name())
        self.assertIn("/seen", details.publishing)
        self.assertIn("/seen_only_read", details.subscribing)
        self.assertIn("/switch", details.services)

    def test_services_that_hang_are_left_out(self):
        """A stopped node's socket takes connections and nothing answers; rosservice waits 5 s for each."""
        with socket.create_server(("127.0.0.1", 0), backlog=50) as listening:
            master, uri = rosgraph.Master("/hung"), f"rosrpc://127.0.0.1:{listening.getsockname()[1]}"
            for number in range(4):
                master.registerService(f"/hung/{number}", uri, "http://127.0.0.1:9")
                self.addCleanup(master.unregisterService, f"/hung/{number}", uri)
            begin = time.monotonic()
            self.assertEqual(ask("services_for_type", "ServicesForType", type="std_srvs/SetBool").services, ["/switch"])
            self.assertEqual(ask("service_providers", "ServiceProviders", service="std_srvs/SetBool").providers, [rospy.get_name()])
            self.assertEqual(ask("service_type", "ServiceType", service="/hung/0").type, "")
            self.assertLess(time.monotonic() - begin, 5.0)

    def test_action_servers(self):
        wait_until(lambda: ask("action_servers", "GetActionServers").action_servers == ["/fibonacci"], "the action server", 30)

    def test_types(self):
        first, *rest = ask("message_details", "MessageDetails", type="geometry_msgs/PoseWithCovarianceStamped").typedefs
        self.assertEqual(
            (first.type, first.fieldnames, first.fieldtypes, list(first.fieldarraylen), first.examples),
            (
                "geometry_msgs/PoseWithCovarianceStamped",
                ["header", "pose"],
                ["std_msgs/Header", "geometry_msgs/PoseWithCovariance"],
                [-1, -1],
                ["{}", "{}"],
            ),
        )
        types = {part.type: part for part in rest}
        self.assertEqual(
            set(types),
            {
                "std_msgs/Header",
                "time",
                "geometry_msgs/PoseWithCovariance",
                "geometry_msgs/Pose",
                "geometry_msgs/Point",
                "geometry_msgs/Quaternion",
            },
        )
        self.assertEqual(
            dict(zip(types["geometry_msgs/PoseWithCovariance"].fieldnames, types["geometry_msgs/PoseWithCovariance"].fieldarraylen)),
            {"pose": -1, "covariance": 36},
        )
        status = ask("message_details", "MessageDetails", type="actionlib_msgs/GoalStatus").typedefs[0]
        constants = dict(zip(status.constnames, status.constvalues))
        self.assertEqual((constants["PENDING"], constants["LOST"], len(constants)), ("0", "9", 10))
        (request,) = ask("service_request_details", "ServiceRequestDetails", type="std_srvs/SetBool").typedefs
        self.assertEqual(
            (request.type, request.fieldnames, request.fieldtypes, request.examples),
            ("std_srvs/SetBoolRequest", ["data"], ["bool"], ["False"]),
        )
        (response,) = ask("service_response_details", "ServiceResponseDetails", type="std_srvs/SetBool").typedefs
        self.assertEqual(response.fieldnames, ["success", "message"])
        self.assertEqual(ask("message_details", "MessageDetails", type="float64").typedefs, [])
        with self.assertRaisesRegex(rospy.ServiceException, "no package here defines the message no_such/Type"):
            ask("message_details", "MessageDetails", type="no_such/Type")

    def test_parameters(self):
        self.assertEqual(ask("get_param", "GetParam", name="/bridged/number", default="").value, "3")
        self.assertEqual(json.loads(ask("get_param", "GetParam", name="/bridged/list", default="").value), [1.5, None, {"deep": None}])
        self.assertEqual(
            [ask("get_param", "GetParam", name="/bridged/none", default=word).value for word in ("", "5", "word")], ["null", "5", '"word"']
        )
        ask("set_param", "SetParam", name="/made", value='{"a": [1, true, "x"]}')
        self.assertEqual(rospy.get_param("/made"), {"a": [1, True, "x"]})
        self.assertTrue(ask("has_param", "HasParam", name="/made").exists)
        ask("delete_param", "DeleteParam", name="/made")
        ask("delete_param", "DeleteParam", name="/made")  # again does no harm
        self.assertFalse(rospy.has_param("/made") or ask("has_param", "HasParam", name="/made").exists)
        self.assertEqual(ask("search_param", "SearchParam", name="bridged").global_name, "/bridged")
        names = ask("get_param_names", "GetParamNames").names
        self.assertIn("/bridged/number", names)
        self.assertFalse([name for name in names if not name.startswith("/bridged")])
        for name, type_name, fields, said in (
            ("get_param", "GetParam", {"default": ""}, "params_glob"),
            ("set_param", "SetParam", {"value": "1"}, "params_glob"),
            ("delete_param", "DeleteParam", {}, "params_glob"),
        ):
            with self.assertRaisesRegex(rospy.ServiceException, said):
                ask(name, type_name, name="/secret", **fields)
        self.assertFalse(ask("has_param", "HasParam", name="/secret").exists)
        with self.assertRaisesRegex(rospy.ServiceException, "is no JSON"):
            ask("set_param", "SetParam", name="/made", value="plain words")
        self.assertEqual(rospy.get_param("/secret"), "hidden")

    def test_many_at_the_same_time(self):
        """As a page asks when it begins."""
        calls = [
            ("topics", "Topics"),
            ("services", "Services"),
            ("nodes", "Nodes"),
            ("action_servers", "GetActionServers"),
            ("get_param_names", "GetParamNames"),
            ("topics_and_raw_types", "TopicsAndRawTypes"),
        ] * 10
        with ThreadPoolExecutor(len(calls)) as pool:
            for answer in [pool.submit(ask, *call) for call in calls]:
                answer.result()

    def test_time(self):
        self.assertLess(abs((ask("get_time", "GetTime").time - rospy.Time.now()).to_sec()), 30)


if __name__ == "__main__":
    rospy.init_node("rosapi_rostest")
    rostest.rosrun("rosapi", "rosapi_test", RosApi)

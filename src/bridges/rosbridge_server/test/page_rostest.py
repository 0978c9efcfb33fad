#!/usr/bin/env python3
"""A page with roslibjs in Debian's Chromium, as courses write them. The library comes from npm, where there is one."""

import base64
import hashlib
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import threading
import unittest
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import rospkg
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped, Twist
from sensor_msgs.msg import Image, LaserScan
from std_srvs.srv import SetBool, SetBoolResponse
from test_support.waiting import wait_until

sys.path.insert(0, rospkg.RosPack().get_path("gzclient") + "/test")
from browser import Browser, missing  # noqa: E402

VERSION = "1.4.1"  # the last that runs in a page as a plain script
SUM = "l3BOHqG99RHb73XROykj8o2rRaUqqYwN0E6C1EkH+R1GIfDjMaUGPaCNEoKKmsXT0Vu0EOyL1BudQtdVlMsgjA=="  # SHA-512 of npm's archive
PAGE = """<!DOCTYPE html><html><head><script src="roslib.min.js"></script></head><body><script>
window.ros = new ROSLIB.Ros({url: "ws://localhost:29093"});
window.seen = {errors: []};
ros.on("connection", () => { seen.connected = true; });
ros.on("error", e => seen.errors.push(String(e)));
ros.on("status", s => seen.errors.push(s.msg));
function topic(name, type, options) { return new ROSLIB.Topic(Object.assign({ros: ros, name: name, messageType: type}, options)); }
function service(name, type) { return new ROSLIB.Service({ros: ros, name: name, serviceType: type}); }
</script></body></html>"""


def library(folder):
    """roslibjs in ``folder``; why not, where it cannot be had."""
    if shutil.which("npm") is None:
        return "npm is not installed"
    packed = subprocess.run(["npm", "pack", f"roslib@{VERSION}", "--silent"], cwd=folder, capture_output=True, text=True, timeout=120)
    archive = os.path.join(folder, f"roslib-{VERSION}.tgz")
    if packed.returncode or not os.path.exists(archive):
        return f"npm does not bring roslib: {packed.stderr.strip()[-200:]}"
    with open(archive, "rb") as file:
        found = base64.b64encode(hashlib.sha512(file.read()).digest()).decode()
    if found != SUM:
        raise AssertionError(f"roslib {VERSION} of npm is another file: sha512-{found}")
    with tarfile.open(archive) as files, open(os.path.join(folder, "roslib.min.js"), "wb") as out:
        shutil.copyfileobj(files.extractfile("package/build/roslib.min.js"), out)
    return ""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        rospy.wait_for_service("/rosapi/get_time", 60)  # the last of them
        cls.why = missing() and f"{missing()} not installed" or library(folder.name)
        if cls.why:
            return
        with open(os.path.join(folder.name, "index.html"), "w") as file:
            file.write(PAGE)
        quiet = type("Quiet", (SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
        server = ThreadingHTTPServer(("127.0.0.1", 0), partial(quiet, directory=folder.name))
        cls.addClassCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        cls.page = Browser(f"http://127.0.0.1:{server.server_port}/index.html", frames=0)
        cls.addClassCleanup(cls.page.close)
        wait_until(lambda: cls.do("return seen.connected"), "the page's connection")

    def setUp(self):
        if self.why:  # each test by itself, so that it is counted
            self.skipTest(self.why)

    @classmethod
    def do(cls, script, *values):
        return cls.page.driver.execute_script(script, *values)

    def seen(self, name, condition=lambda value: value is not None):
        """What the page put under that name."""
        wait_until(lambda: condition(self.do("return seen[arguments[0]] ?? null", name)), f"{name} on the page", 30)
        return self.do("return seen[arguments[0]]", name)

    def test_subscribe(self):
        publisher = rospy.Publisher("/scan", LaserScan, queue_size=1, latch=True)
        publisher.publish(LaserScan(ranges=[1.5, float("inf")]))
        self.do("topic('/scan', 'sensor_msgs/LaserScan').subscribe(m => { seen.scan = m; });")
        self.assertEqual(self.seen("scan")["ranges"], [1.5, None])

    def test_subscribe_packed(self):
        """As PNG and as CBOR, which roslibjs unpacks."""
        publisher = rospy.Publisher("/picture", Image, queue_size=1, latch=True)
        publisher.publish(Image(width=2, data=bytes(range(250, 256))))
        self.do("topic('/picture', 'sensor_msgs/Image', {compression: 'png'}).subscribe(m => { seen.png = m; });")
        self.assertEqual((self.seen("png")["width"], base64.b64decode(self.seen("png")["data"])), (2, bytes(range(250, 256))))
        self.do("""topic('/picture', 'sensor_msgs/Image').unsubscribe();
                   const scan = topic('/cbor_scan', 'sensor_msgs/LaserScan', {compression: 'cbor'});
                   scan.subscribe(m => { seen.cbor = {ranges: Array.from(m.ranges), kind: m.ranges.constructor.name}; });""")
        other = rospy.Publisher("/cbor_scan", LaserScan, queue_size=1, latch=True)
        other.publish(LaserScan(ranges=[0.5, 0.25]))
        self.assertEqual(self.seen("cbor"), {"ranges": [0.5, 0.25], "kind": "Float32Array"})

    def test_publish(self):
        got = []
        subscriber = rospy.Subscriber("/cmd_vel", Twist, got.append)
        self.do("""window.velocity = topic('/cmd_vel', 'geometry_msgs/Twist');
                   velocity.publish(new ROSLIB.Message({linear: {x: 0.1}, angular: {z: -0.3}}));""")
        wait_until(lambda: got, "the first command of a page, which does not wait")
        self.assertEqual((got[0].linear.x, got[0].angular.z), (0.1, -0.3))
        subscriber.unregister()

    def test_call_a_service(self):
        server = rospy.Service("/switch", SetBool, lambda request: SetBoolResponse(request.data, "done"))
        self.addCleanup(server.shutdown)
        self.do("""service('/switch', 'std_srvs/SetBool').callService(new ROSLIB.ServiceRequest({data: true}),
                       answer => { seen.answer = answer; }, failure => { seen.answer = failure; });
                   service('/switch', 'std_srvs/SetBool').callService(new ROSLIB.ServiceRequest({date: true}),
                       answer => { seen.failure = answer; }, failure => { seen.failure = failure; });""")
        self.assertEqual(self.seen("answer"), {"success": True, "message": "done"})
        self.assertIn("has no field date", self.seen("failure"))

    def test_offer_a_service(self):
        self.do("""service('/page_switch', 'std_srvs/SetBool').advertise((request, response) => {
                       response.success = !request.data; response.message = 'from the page'; return true; });""")
        rospy.wait_for_service("/page_switch", 20)
        self.assertEqual(rospy.ServiceProxy("/page_switch", SetBool)(False), SetBoolResponse(True, "from the page"))

    def test_parameters(self):
        self.do("""const param = new ROSLIB.Param({ros: ros, name: '/of_page/number'});
                   param.get(value => { seen.number = value; param.set(value + 1); });
                   ros.getParams(names => { seen.names = names; });""")
        self.assertEqual(self.seen("number"), 3)
        wait_until(lambda: rospy.get_param("/of_page/number") == 4, "the new value")
        self.assertIn("/of_page/number", self.seen("names"))

    def test_what_is_there(self):
        self.do("""ros.getTopics(found => { seen.topics = found.topics; });
                   ros.getServices(found => { seen.services = found; });
                   ros.getNodes(found => { seen.nodes = found; });
                   ros.getActionServers(found => { seen.actions = found; });
                   ros.getTopicType('/rosout', found => { seen.type = found; });
                   ros.getMessageDetails('geometry_msgs/Twist', found => { seen.twist = ros.decodeTypeDefs(found); });""")
        self.assertIn("/rosout", self.seen("topics"))
        self.assertIn("/rosapi/topics", self.seen("services"))
        self.assertIn("/rosbridge_websocket", self.seen("nodes"))
        self.assertEqual((self.seen("actions"), self.seen("type")), (["/fibonacci"], "rosgraph_msgs/Log"))
        self.assertEqual(self.seen("twist")["linear"], {"x": "float64", "y": "float64", "z": "float64"})

    def test_an_action(self):
        self.do("""const client = new ROSLIB.ActionClient({ros: ros, serverName: '/fibonacci',
                                                           actionName: 'actionlib_tutorials/FibonacciAction'});
                   const goal = new ROSLIB.Goal({actionClient: client, goalMessage: {order: 3}});
                   goal.on('feedback', feedback => { seen.feedback = feedback.sequence; });
                   goal.on('result', result => { seen.result = result.sequence; });
                   goal.send();""")
        self.assertEqual(self.seen("result"), [0, 1, 1, 2])
        self.assertEqual(self.seen("feedback")[:2], [0, 1])

    def test_frames(self):
        """By the topics of tf: roslibjs' TFClient needs the node tf2_web_republisher, a package of its own."""
        sender = tf2_ros.StaticTransformBroadcaster()
        transform = TransformStamped(child_frame_id="tool")
        transform.header.frame_id, transform.transform.translation.z, transform.transform.rotation.w = "base", 0.75, 1.0
        sender.sendTransform(transform)
        self.do("topic('/tf_static', 'tf2_msgs/TFMessage').subscribe(m => { seen.tf = m.transforms[0]; });")
        found = self.seen("tf")
        self.assertEqual((found["child_frame_id"], found["transform"]["translation"]["z"]), ("tool", 0.75))


if __name__ == "__main__":
    rospy.init_node("page_rostest")
    rostest.rosrun("rosbridge_server", "page", Page)

"""Marks for what comes late, or seldom: waited for, in simulated and in wall time, as long as the spec says, and no longer."""

import pytest
from lab_check.checks.graph import rate_of
from test_absent import namespaces, verdicts  # noqa: F401  (a fixture)

LATE = """#!/usr/bin/env python3
import sys, time
import rospy, tf2_ros
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool
from sensor_msgs.msg import Image
rospy.init_node("late")
def frame(child):
    found = TransformStamped(child_frame_id=child)
    found.header.frame_id, found.header.stamp = "map", rospy.Time.now()
    found.transform.translation.x, found.transform.rotation.w = 1.0, 1.0
    return found
if "static" in sys.argv:
    static = tf2_ros.StaticTransformBroadcaster()
    static.sendTransform(frame("fixed"))
    rospy.spin()
rospy.sleep(0.01)  # until the clock has come
keep, tf = [], tf2_ros.TransformBroadcaster()
later = lambda seconds, do: keep.append(rospy.Timer(rospy.Duration(seconds), lambda event: do(), oneshot=True))
every = lambda seconds, do: keep.append(rospy.Timer(rospy.Duration(seconds), lambda event: do()))
every(1.0, lambda: tf.sendTransform(frame("each_second")))
every(5.0, lambda: tf.sendTransform(frame("each_five")))
slow = rospy.Publisher("slow", Float64, queue_size=1)
every(5.0, lambda: slow.publish(1.0))
picture = rospy.Publisher("picture", Image, queue_size=1)
every(4.0, lambda: picture.publish(Image(height=2, width=2, encoding="rgb8", step=6, data=bytes([255, 0, 0, 0, 0, 0] * 2))))
later(1.5, lambda: keep.append(rospy.Publisher("news", String, latch=True, queue_size=1)) or keep[-1].publish("here"))
later(2.0, lambda: keep.append(rospy.Service("allow", SetBool, lambda request: None)))
later(2.0, lambda: rospy.set_param("/gain", 2.5))
later(1.0, lambda: print("it is done", flush=True))
time.sleep(2.5)  # of the wall clock, as students do
keep.append(rospy.Service("slept", SetBool, lambda request: None))
keep.append(rospy.Publisher("woken", String, queue_size=1))
rospy.spin()
"""
DUE = [
    "tf: {from: map, to: each_second, xyz: [1, 0, 0]}",
    "tf: {from: map, to: each_five}",
    "tf: {from: map, to: fixed, xyz: [1, 0, 0]}",
    "topic: {name: /slow, rate: [0.19, 0.21]}",
    "topic: {name: /news, latched: true}",
    "topic: {name: /woken}",
    "service: {name: /allow, type: std_srvs/SetBool}",
    "service: {name: /slept}",
    "param: {name: /gain, value: 2.5}",
    "image: {topic: /picture, size: [2, 2]}",
    "exit: {run: late, says: it is done}",
    "still: {joints: [j0], for: 1}",
]
EARLY = [
    "tf: {from: map, to: each_second, within: 0.3}",
    "service: {name: /allow, within: 0.5}",
    "param: {name: /gain, value: 2.5, within: 0.5}",
    "topic: {name: /news, latched: true, within: 0.5}",
    "node: {name: /later, within: 0.5}",
    "exit: {run: late, says: it is done, within: 0.5}",
    "image: {topic: /picture, within: 1}",
]


@pytest.mark.slow
def test_what_comes_late_is_waited_for_and_only_as_long_as_the_spec_says(tmp_path):
    late, static = "run: {command: my_robot late.py, name: late}", "run: {command: my_robot late.py static __name:=static, name: static}"
    found, _ = verdicts(
        tmp_path,
        {"too early": ([late], EARLY), "due": ([static, late], DUE), "at once": ([static], ["tf: {from: map, to: fixed, within: 0.05}"])},
        {"late.py": LATE},
    )
    assert not [(line, said) for line, (passed, said) in zip(EARLY, found["too early"]) if passed]
    assert not [(line, said) for line, (passed, said) in zip(DUE, found["due"]) if not passed]
    assert found["at once"][0][0], found["at once"]


@pytest.mark.parametrize(
    "arrivals, begin, end, quantum, rate",
    [
        ([2.0, 7.0, 12.0, 17.0], 0.0, 21.05, 0.05, 0.2),  # 4 / 21.05 is 0.19
        ([4.9, 9.9, 14.9, 19.9], 0.0, 21.05, 0.05, 0.2),
        ([0.1 * k for k in range(20)], 0.0, 2.0, 0.05, 10.0),
        ([0.0, 5.0, 10.0], 0.0, 30.0, 0.05, 0.1),  # then it stopped
        ([20.0, 25.0, 30.0], 0.0, 30.0, 0.05, 0.1),  # it began late
        ([1.0], 0.0, 20.0, 0.05, 0.05),
        ([], 0.0, 2.0, 0.05, 0.0),
        ([], 2.0, 2.0, 0.05, 0.0),
    ],
)
def test_a_rate_is_told_by_pauses_where_few_come(arrivals, begin, end, quantum, rate):
    assert rate_of(arrivals, begin, end, quantum) == pytest.approx(rate)

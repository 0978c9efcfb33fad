#!/usr/bin/env python3
"""turtle_tf_sensor.launch: turtle2 comes to turtle1, turtle3 goes round; the carrot leads where it says."""

import math
import queue
import subprocess
import unittest

import rospy
import rostest
import tf
from geometry_msgs.msg import PointStamped
from turtlesim.msg import Pose


class TurtleTf(unittest.TestCase):
    def poses(self, turtle):
        seen = queue.Queue()
        self.addCleanup(rospy.Subscriber(f"/{turtle}/pose", Pose, seen.put).unregister)
        return seen

    def test_turtle2_comes_to_turtle1(self):
        seen = self.poses("turtle2")
        for _ in range(5000):
            pose = seen.get(timeout=60)
            if math.dist((pose.x, pose.y), (5.544445, 5.544445)) < 0.2:
                return
        self.fail(f"turtle2 is still at {pose.x}, {pose.y}")

    def test_points_are_in_the_frame_world(self):
        point = rospy.wait_for_message("/turtle_point_stamped", PointStamped, timeout=60)
        self.assertEqual(point.header.frame_id, "world")

    def test_carrots(self):
        listener = tf.TransformListener()
        for node, distance in (("fixed_tf_broadcaster.py", 2.0), ("dynamic_tf_broadcaster.py", 10.0)):
            carrot = subprocess.Popen(["rosrun", "turtle_tf", node])
            start = rospy.Time.now()
            try:
                for _ in range(100):
                    try:
                        when = rospy.Time.now()
                        listener.waitForTransform("turtle1", "carrot1", when, rospy.Duration(1.0))
                        place, _ = listener.lookupTransform("turtle1", "carrot1", when)
                    except tf.Exception:
                        continue
                    if when > start and abs(math.hypot(*place) - distance) < distance / 10:  # chords lie within the circle
                        break
                else:
                    self.fail(f"{node}: carrot1 is not seen {distance} m away")
            finally:
                carrot.terminate()
                carrot.wait()


if __name__ == "__main__":
    rospy.init_node("turtle_tf_rostest")
    rostest.rosrun("turtle_tf", "turtle_tf", TurtleTf)

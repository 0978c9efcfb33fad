#!/usr/bin/env python3
"""A camera plugin in C++ that stands on gazebo_ros_camera_utils.h: its topics, while somebody listens."""

import importlib.util
import math
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
import test_support
from gazebo_msgs.srv import DeleteModel, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Pose
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image
from std_srvs.srv import Empty
from test_support.hearing import heard

MODEL = """<sdf version="1.6"><model name="cart"><static>1</static><pose>0 0 1 0 0 0</pose>
<link name="box"><pose>2.1 0.5 0 0 0 0</pose><visual name="v"><geometry><box><size>0.2 0.4 0.4</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link>
<link name="l"><sensor name="eye" type="camera"><update_rate>20</update_rate>
<camera name="c"><horizontal_fov>1.2</horizontal_fov><image><width>160</width><height>120</height><format>{format}</format></image>
<clip><near>0.05</near><far>50</far></clip>
<distortion><k1>-0.1</k1><k2>0</k2><k3>0</k3><p1>0</p1><p2>0</p2><center>0.5 0.5</center></distortion></camera>
<plugin name="user" filename="libgazebo_plugins_test_{user}.so"><cameraName>front</cameraName><frameName>optical</frameName>
<robotNamespace>fleet</robotNamespace><autoDistortion>true</autoDistortion>{more}</plugin></sensor></link></model></sdf>"""


def call(name, kind, *arguments):
    rospy.wait_for_service(name, 60)
    return rospy.ServiceProxy(name, kind)(*arguments)


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class CameraUtilsTest(test_support.TestCase):
    def setUp(self):
        self.log, self.images, self.infos = [], [], []
        self.logs = rospy.Subscriber("/rosout", Log, lambda m: self.log.append(m.msg))
        self.wait(lambda: heard([self.logs]))
        call("/gazebo/reset_simulation", Empty)

    def tearDown(self):
        call("/gazebo/delete_model", DeleteModel, "cart")
        self.wait(lambda: not [name for name, _ in rospy.get_published_topics() if name.startswith("/fleet")])

    def wait(self, condition):
        test_support.wait_until(condition, "the topics", 30)

    def spawned(self, image_format="R8G8B8", more="", user="camera_user"):
        model = MODEL.format(format=image_format, more=more, user=user)
        done = call("/gazebo/spawn_sdf_model", SpawnModel, "cart", model, "", Pose(), "")
        self.assertTrue(done.success, done.status_message)
        self.wait(lambda: any("camera user: /fleet/front has a node" in line for line in self.log))

    def listened(self):
        image = rospy.Subscriber("/fleet/front/image_raw", Image, self.images.append)
        info = rospy.Subscriber("/fleet/front/camera_info", CameraInfo, self.infos.append)
        self.wait(lambda: heard([image, info]))
        return image, info

    def step(self, steps, count):
        call("/gazebo/step", StepWorld, steps)
        self.wait(lambda: len(self.images) >= count and len(self.infos) >= count)
        self.assertEqual(len(self.images), count)

    def test_image_and_info(self):
        self.spawned()
        subscribers = self.listened()
        self.step(100, 2)
        image, info = self.images[-1], self.infos[-1]
        self.assertEqual([message.header.stamp.to_sec() for message in self.images], [0.05, 0.1])
        self.assertEqual(
            (image.header.frame_id, image.encoding, image.width, image.height, image.step), ("fleet/optical", "rgb8", 160, 120, 480)
        )
        pixels = np.frombuffer(image.data, np.uint8).reshape(120, 160, 3).astype(int)
        red = np.argwhere(pixels[..., 0] > 2 * np.maximum(pixels[..., 1:].max(axis=-1), 20))
        f = 80 / math.tan(0.6)
        self.assertAlmostEqual(red[:, 1].mean(), 79.5 - f * 0.25, delta=3)  # to the left, and drawn in by the lens
        self.assertAlmostEqual(red[:, 0].mean(), 59.5, delta=1)
        self.assertEqual((info.header.frame_id, info.header.stamp, info.width), ("fleet/optical", image.header.stamp, 160))
        self.assertAlmostEqual(info.K[0], f, delta=1e-6)
        self.assertEqual(list(info.D), [-0.1, 0, 0, 0, 0])
        for subscriber in subscribers:
            subscriber.unregister()

    def test_nothing_is_taken_while_nobody_listens_and_the_rate_can_be_set(self):
        self.spawned("L8", "<updateRate>0</updateRate>")
        call("/gazebo/step", StepWorld, 70)
        subscribers = self.listened()
        self.step(60, 1)
        self.assertEqual((self.images[0].header.stamp.to_sec(), self.images[0].encoding, self.images[0].step), (0.1, "mono8", 160))
        client = dynamic_reconfigure.client.Client("/fleet/front", timeout=30)
        client.update_configuration({"imager_rate": 50.0})
        for taken in range(3, 13):  # one at a time: the plugin keeps no more than two that are not sent yet, as upstream's
            self.step(20, taken)
        for subscriber in subscribers:
            subscriber.unregister()

    def test_the_whole_camera_plugin_can_be_derived_from(self):
        """Pictures of a sensor at 20 Hz, of which <updateRate> lets 10 Hz through."""
        self.spawned(more="<updateRate>10</updateRate>", user="ros_camera_user")
        subscribers = self.listened()
        self.step(200, 2)
        self.assertEqual([message.header.stamp.to_sec() for message in self.images], [0.1, 0.2])
        self.assertEqual((self.images[0].encoding, self.images[0].width, self.infos[0].width), ("rgb8", 160, 160))
        for subscriber in subscribers:
            subscriber.unregister()

    def test_it_goes_while_somebody_listens(self):
        self.spawned()
        subscribers = self.listened()
        call("/gazebo/unpause_physics", Empty)
        self.wait(lambda: len(self.images) > 3)
        call("/gazebo/delete_model", DeleteModel, "cart")
        call("/gazebo/pause_physics", Empty)
        for subscriber in subscribers:
            subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("camera_utils_rostest")
    rostest.rosrun("gazebo_plugins", "camera_utils", CameraUtilsTest)

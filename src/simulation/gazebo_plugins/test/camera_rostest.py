#!/usr/bin/env python3
"""Topics, rates, encodings, numbers and pixels of the camera plugins. The world cameras.world stands still and in
lock-step: time passes only through the step service, so every frame and every stamp is known."""

import hashlib
import unittest

import av
import cv2
import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
from dynamic_reconfigure.msg import ConfigDescription
from gazebo_msgs.srv import DeleteModel, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Pose
from listening import Ear, until
from polled_camera.srv import GetPolledImage
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2
from sensor_msgs.srv import SetCameraInfo
from std_msgs.msg import Bool, Empty
from std_srvs.srv import Empty as EmptyService
from theora_image_transport.msg import Packet

RED, GREEN, BLUE, YELLOW, BACKGROUND = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0), (51, 102, 153)
F = 80 / np.tan(0.6)  # focal length of the 160x120 cameras, pixels
OFF = round(0.6 / 2 * F)  # pixels from the middle to the middle of a box's face
MS = 1_000_000
BAD = """<sdf version="1.6"><model name="bad"><static>true</static><link name="l">
<sensor name="{name}" type="camera"><update_rate>10</update_rate>
<camera><image><width>{width}</width><height>48</height></image></camera>
<plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>{name}</cameraName></plugin></sensor></link></model>
</sdf>"""


def picture(message):
    dtype = np.uint16 if message.encoding.endswith("16") else np.uint8
    array = np.frombuffer(message.data, dtype)
    return array.reshape(message.height, message.width, -1).squeeze()


def stamp_ns(message):
    return message.header.stamp.to_nsec()


class Cameras(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_message("/gazebo/ready", Bool, 60)
        cls.step = staticmethod(rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True))
        cls.reset = staticmethod(rospy.ServiceProxy("/gazebo/reset_simulation", EmptyService))

    def setUp(self):
        self.reset()

    def take(self, topic, kind=Image, steps=100, count=1):
        """Step; the ``count`` messages that this brought, exactly."""
        with Ear(topic, kind) as ear:
            self.assertTrue(self.step(steps).success)
            return ear.wait(count)

    def assertBoxes(self, rgb, tolerance=0):
        for (row, column), colour in {
            (60, 80 - OFF): RED,
            (60, 80 + OFF): GREEN,
            (60 - OFF, 80): BLUE,
            (60 + OFF, 80): YELLOW,
            (60, 80): BACKGROUND,
        }.items():
            self.assertLessEqual(
                np.abs(rgb[row, column].astype(int) - colour).max(), tolerance, f"pixel {row}, {column} is {rgb[row, column]}, not {colour}"
            )

    def test_topics_and_types(self):
        types = dict(rospy.get_published_topics())
        config, description = "dynamic_reconfigure/Config", "dynamic_reconfigure/ConfigDescription"
        for topic, kind in {
            "/eye/image_raw": "sensor_msgs/Image",
            "/eye/camera_info": "sensor_msgs/CameraInfo",
            "/eye/image_raw/compressed": "sensor_msgs/CompressedImage",
            "/eye/image_raw/compressed/parameter_descriptions": description,
            "/eye/image_raw/compressed/parameter_updates": config,
            "/eye/image_raw/compressedDepth": "sensor_msgs/CompressedImage",
            "/eye/image_raw/compressedDepth/parameter_descriptions": description,
            "/eye/image_raw/compressedDepth/parameter_updates": config,
            "/eye/image_raw/theora": "theora_image_transport/Packet",
            "/eye/image_raw/theora/parameter_descriptions": description,
            "/eye/image_raw/theora/parameter_updates": config,
            "/eye/parameter_descriptions": description,
            "/eye/parameter_updates": config,
            "/robot/camera/image": "sensor_msgs/Image",
            "/robot/camera/info": "sensor_msgs/CameraInfo",
            "/rig_ns/grey/image_raw": "sensor_msgs/Image",
            "/stereo/left/image_raw": "sensor_msgs/Image",
            "/stereo/right/camera_info": "sensor_msgs/CameraInfo",
            "/kinect/depth/image_raw": "sensor_msgs/Image",
            "/kinect/depth/camera_info": "sensor_msgs/CameraInfo",
            "/kinect/points": "sensor_msgs/PointCloud2",
            "/depth_cam/points": "sensor_msgs/PointCloud2",
        }.items():
            self.assertEqual(types.get(topic), kind, topic)
        self.assertNotIn("/plain/image_raw", types)
        rate = rospy.wait_for_message("/eye/parameter_descriptions", ConfigDescription, 60)
        self.assertEqual([part.doubles[0].value for part in (rate.min, rate.dflt, rate.max)], [1.0, 2.0, 50.0])
        self.assertEqual(rate.dflt.doubles[0].name, "imager_rate")

    def test_thirty_hertz_of_sim_time_none_missing(self):
        frames = self.take("/eye/image_raw", steps=1000, count=30)
        stamps = [stamp_ns(frame) for frame in frames]
        self.assertEqual(len(stamps), 30)
        self.assertEqual(stamps, sorted(set(stamps)))
        self.assertEqual({b - a for a, b in zip(stamps, stamps[1:])}, {33 * MS, 34 * MS})
        self.assertEqual(stamps[0], 34 * MS)

    def test_pixels(self):
        frame = self.take("/eye/image_raw")[0]
        self.assertEqual(
            (frame.width, frame.height, frame.step, frame.encoding, frame.is_bigendian, len(frame.data)),
            (160, 120, 480, "rgb8", 0, 160 * 120 * 3),
        )
        self.assertEqual(frame.header.frame_id, "eye_optical")
        self.assertBoxes(picture(frame))

    def test_image_and_info_share_the_stamp(self):
        with Ear("/eye/camera_info", CameraInfo) as infos:
            frames = self.take("/eye/image_raw", steps=200, count=6)
            self.assertEqual([stamp_ns(m) for m in infos.wait(6)], [stamp_ns(m) for m in frames])

    def test_info_of_the_arms_camera(self):
        info = self.take("/robot/camera/info", CameraInfo, steps=200)[0]
        f = 476.7014378
        self.assertEqual((info.width, info.height, info.distortion_model), (800, 800, "plumb_bob"))
        for got, expected in (
            (info.K, [f, 0, 400.5, 0, f, 400.5, 0, 0, 1]),
            (info.R, [1, 0, 0, 0, 1, 0, 0, 0, 1]),
            (info.P, [f, 0, 400.5, -33.3691006, 0, f, 400.5, 0, 0, 0, 1, 0]),
            (info.D, [0.1, 0.2, 0.4, 0.5, 0.3]),
        ):
            np.testing.assert_allclose(got, expected, atol=1e-6)
        self.assertEqual(info.header.frame_id, "camera_link")

    def test_centre_and_focal_length_of_the_plugin(self):
        info = self.take("/rig_ns/grey/camera_info", CameraInfo)[0]
        np.testing.assert_allclose(info.K, [100, 0, 70, 0, 100, 50, 0, 0, 1])

    def test_a_lens_bends_the_picture_as_camera_info_says(self):
        with Ear("/lens/camera_info", CameraInfo) as infos:
            bent = picture(self.take("/lens/image_raw")[0])
            info = infos.wait(1)[0]
        np.testing.assert_allclose(info.D, [-0.25, 0.05, 0.002, -0.003, 0.01])  # the sensor's, not the plugin's
        straight = cv2.undistort(bent, np.reshape(info.K, (3, 3)), np.array(info.D))
        self.assertBoxes(straight)

        def middle(rgb):  # of the green box
            return np.mean(np.argwhere((rgb == GREEN).all(axis=2)), axis=0)

        self.assertGreater(80 + OFF - middle(bent)[1], 2)  # a barrel draws towards the middle
        # from the inner edge of its back to the outer edge of its face
        np.testing.assert_allclose(middle(straight), (59.5, 79.5 + (0.4 / 2.2 + 0.8 / 2) / 2 * F), atol=0.5)

    def test_the_plugins_update_rate_throttles(self):
        stamps = [stamp_ns(m) for m in self.take("/robot/camera/info", CameraInfo, steps=1000, count=8)]
        self.assertTrue(all(b - a >= 100 * MS for a, b in zip(stamps, stamps[1:])), stamps)
        self.assertTrue(7 <= len(stamps) <= 10, stamps)

    def test_encodings(self):
        grey = self.take("/rig_ns/grey/image_raw")[0]
        self.assertEqual((grey.encoding, grey.step), ("mono8", 160))
        self.assertEqual(picture(grey)[60, 80 - OFF], 255)  # what is red, as in Gazebo: test_rendering_gazebo.py of ode_sim_rendering
        bayer = self.take("/bayer/image_raw")[0]
        self.assertEqual((bayer.encoding, bayer.step), ("bayer_grbg8", 160))
        # OpenCV names a cell by its second row
        self.assertBoxes(cv2.cvtColor(picture(bayer), cv2.COLOR_BayerGB2RGB), 2)
        odd = self.take("/odd/image_raw")[0]
        self.assertEqual(odd.encoding, "bgr8")
        self.assertBoxes(picture(odd)[..., ::-1])

    def test_jpeg_then_png(self):
        def decode(message):
            return cv2.imdecode(np.frombuffer(message.data, np.uint8), cv2.IMREAD_UNCHANGED)[..., ::-1]

        with Ear("/eye/image_raw", Image) as raw:
            jpeg = self.take("/eye/image_raw/compressed", CompressedImage)[0]
            self.assertEqual(jpeg.format, "rgb8; jpeg compressed bgr8")
            self.assertBoxes(decode(jpeg), 40)  # colour is stored at half the resolution
            raw.wait(1)
            self.assertEqual(stamp_ns(jpeg), stamp_ns(raw.messages[0]))
            client = dynamic_reconfigure.client.Client("/eye/image_raw/compressed", timeout=60)
            client.update_configuration({"jpeg_quality": 5})
            worse = self.take("/eye/image_raw/compressed", CompressedImage)[0]
            self.assertLess(len(worse.data), len(jpeg.data))
            client.update_configuration({"format": "png"})
            png = self.take("/eye/image_raw/compressed", CompressedImage)[0]
            self.assertEqual(png.format, "rgb8; png compressed bgr8")
            np.testing.assert_array_equal(decode(png), picture(raw.messages[0]))
            client.update_configuration({"format": "jpeg", "jpeg_quality": 80})
            client.close()

    def assertStream(self, packets, pictures):
        """Three headers, then ``pictures`` packets: what ffmpeg decodes shows the boxes. An empty packet says that
        nothing has changed, which ffmpeg would take for the end."""
        self.assertEqual([packet.data[:7] for packet in packets[:3]], [b"\x80theora", b"\x81theora", b"\x82theora"])
        self.assertEqual([packet.b_o_s for packet in packets], [1] + [0] * (len(packets) - 1))
        self.assertEqual([packet.packetno for packet in packets], list(range(3 + pictures)))
        decoder = av.CodecContext.create("theora", "r")
        decoder.extradata = b"".join(len(packet.data).to_bytes(2, "big") + packet.data for packet in packets[:3])
        coded = [packet.data for packet in packets[3:] if packet.data]
        frames = [frame for data in coded for frame in decoder.decode(av.Packet(data))] + decoder.decode(None)
        self.assertTrue(packets[3].data)
        self.assertEqual(len(frames), len(coded))
        for frame in frames:
            full = av.VideoFrame.from_ndarray(frame.to_ndarray(), format="yuvj420p")
            self.assertBoxes(full.to_ndarray(format="rgb24"), 40)  # colour is stored at half the resolution

    def test_theora(self):
        first = self.take("/eye/image_raw/theora", Packet, steps=200, count=3 + 6)
        self.assertStream(first, 6)
        with Ear("/eye/image_raw/theora", Packet) as late:
            self.step(100)
            self.assertStream(late.wait(3 + 3), 3)
            client = dynamic_reconfigure.client.Client("/eye/image_raw/theora", timeout=60)
            client.update_configuration({"quality": 5})
            self.step(100)
            worse = late.wait(6 + 3 + 3)[6:]
            self.assertStream(worse, 3)
            self.assertLess(len(worse[3].data), len(first[3].data))
            client.update_configuration({"quality": 31})
            client.close()

    def test_theora_of_grey_and_of_what_it_cannot_carry(self):
        grey = self.take("/rig_ns/grey/image_raw/theora", Packet, count=3 + 1)
        self.assertEqual([packet.b_o_s for packet in grey], [1, 0, 0, 0])
        with Ear("/rosout", Log) as log, Ear("/bayer/image_raw/theora", Packet) as bayer:
            until(lambda: any("/bayer/image_raw/theora stays empty" in m.msg for m in log.messages), "line on bayer")
            self.take("/bayer/image_raw")
            self.assertFalse(bayer.messages)

    def test_imager_rate(self):
        client = dynamic_reconfigure.client.Client("/eye", timeout=60)
        client.update_configuration({"imager_rate": 5.0})
        stamps = [stamp_ns(m) for m in self.take("/eye/image_raw", steps=1000, count=5)]
        client.update_configuration({"imager_rate": 30.0})
        client.close()
        self.assertEqual(stamps, [200 * MS * i for i in range(1, 6)])

    def test_set_camera_info(self):
        service = rospy.ServiceProxy("/bayer/set_camera_info", SetCameraInfo)
        info = self.take("/bayer/camera_info", CameraInfo)[0]
        changed = CameraInfo(**{name: getattr(info, name) for name in info.__slots__})
        changed.K = [123.0] + list(info.K[1:])
        self.assertTrue(service(changed).success)
        self.assertEqual(self.take("/bayer/camera_info", CameraInfo)[0].K[0], 123.0)
        self.assertTrue(service(info).success)
        info.width = 7
        answer = service(info)
        self.assertFalse(answer.success)
        self.assertIn("7x120", answer.status_message)

    def test_noise_and_two_runs_byte_by_byte(self):
        runs = []
        for _ in range(2):
            self.reset()
            frames = self.take("/robot/camera/image", steps=250, count=3)
            runs.append([(stamp_ns(frame), hashlib.sha1(frame.data).hexdigest()) for frame in frames])
        self.assertEqual(runs[0], runs[1])
        sky = picture(frames[0])[350:450, 350:450, 0].astype(float)
        self.assertAlmostEqual(sky.std(), 0.007 * 255, delta=0.15)
        self.assertAlmostEqual(sky.mean(), 51, delta=0.2)

    def test_stereo(self):
        with (
            Ear("/stereo/right/image_raw", Image) as rights,
            Ear("/stereo/left/camera_info", CameraInfo) as left_infos,
            Ear("/stereo/right/camera_info", CameraInfo) as right_infos,
        ):
            left, right = self.take("/stereo/left/image_raw")[0], rights.wait(1)[0]
            self.assertEqual(stamp_ns(left), stamp_ns(right))
            self.assertEqual(left_infos.wait(1)[0].P[3], 0)
            self.assertAlmostEqual(right_infos.wait(1)[0].P[3], -F * 0.1, places=6)
        columns = [np.flatnonzero((picture(m) == RED).all(axis=2).any(axis=0)).mean() for m in (left, right)]
        self.assertAlmostEqual(columns[0] - columns[1], F * 0.1 / 2, delta=0.6)  # disparity at 2 m

    def test_one_picture_per_trigger(self):
        trigger = rospy.Publisher("/triggered/image_trigger", Empty, queue_size=10)
        until(lambda: trigger.get_num_connections() == 1, "subscriber of image_trigger")
        with Ear("/triggered/image_raw", Image) as ear:
            self.step(50)
            for count in (1, 2, 3):
                trigger.publish(Empty())
                until(lambda: (self.step(20), len(ear.messages))[1] >= count, "triggered picture")
            self.step(100)
            marker = self.take("/eye/camera_info", CameraInfo)  # what was sent before it has arrived
            self.assertTrue(marker)
            self.assertEqual(len(ear.messages), 3)
            self.assertBoxes(picture(ear.messages[0]))

    def test_a_pair_is_triggered_by_the_topic_it_names(self):
        trigger = rospy.Publisher("/pair/shoot", Empty, queue_size=10)
        until(lambda: trigger.get_num_connections() == 1, "subscriber of /pair/shoot")
        with Ear("/pair/left/image_raw", Image) as left, Ear("/pair/right/image_raw", Image) as right:
            self.step(50)
            trigger.publish(Empty())
            until(lambda: (self.step(20), left.messages and right.messages)[1], "pair of pictures")
            self.assertEqual(stamp_ns(left.messages[0]), stamp_ns(right.messages[0]))
            self.take("/eye/camera_info", CameraInfo)  # what was sent before it has arrived
            self.assertEqual((len(left.messages), len(right.messages)), (1, 1))

    def test_polled(self):
        poll = rospy.ServiceProxy("/prosilica/request_image", GetPolledImage)
        answer = poll(response_namespace="answers")
        self.assertTrue(answer.success, answer.status_message)
        frame = rospy.wait_for_message("/prosilica/answers/image_raw", Image, 60)
        self.assertEqual(frame.header.stamp, answer.stamp)
        self.assertBoxes(picture(frame))
        self.assertFalse(poll(response_namespace="answers", binning_x=2).success)

    def test_kinect(self):
        with (
            Ear("/kinect/points", PointCloud2) as clouds,
            Ear("/kinect/depth/camera_info", CameraInfo) as infos,
            Ear("/kinect/image_raw", Image) as images,
        ):
            depth = self.take("/kinect/depth/image_raw")[0]
            cloud, info, image = clouds.wait(1)[0], infos.wait(1)[0], images.wait(1)[0]
        self.assertEqual(len({stamp_ns(m) for m in (depth, cloud, info, image)}), 1)
        self.assertEqual((depth.encoding, depth.step, depth.header.frame_id), ("32FC1", 640, "kinect_optical"))
        self.assertEqual(image.encoding, "bgr8")
        self.assertBoxes(picture(image)[..., ::-1])
        metres = np.frombuffer(depth.data, np.float32).reshape(120, 160)
        self.assertAlmostEqual(float(metres[60, 80 - OFF]), 2.0, places=4)
        self.assertTrue(np.isnan(metres[60, 80]))  # nothing within 3 m
        self.assertEqual((cloud.height, cloud.width, cloud.point_step, cloud.row_step, cloud.is_dense), (120, 160, 32, 5120, False))
        self.assertEqual([(f.name, f.offset, f.datatype) for f in cloud.fields], [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("rgb", 16, 7)])
        points = np.frombuffer(cloud.data, np.float32).reshape(120, 160, 8)
        np.testing.assert_allclose(points[60, 80 - OFF, :3], [2 * (0.5 - OFF) / F, 2 * 0.5 / F, 2], atol=1e-3)
        self.assertEqual(points[60, 80 - OFF, 4:5].view(np.uint8)[:3].tolist(), [0, 0, 255])  # b g r
        self.assertTrue(np.isnan(points[60, 80, :3]).all())
        self.assertAlmostEqual(info.K[0], F, places=6)

    def test_depth_in_millimetres(self):
        depth = self.take("/mm/depth/image_raw")[0]
        self.assertEqual((depth.encoding, depth.step), ("16UC1", 320))
        values = np.frombuffer(depth.data, np.uint16).reshape(120, 160)
        self.assertIn(values[60, 80 - OFF], (1999, 2000))
        self.assertEqual(values[60, 80], 0)

    def test_what_a_depth_camera_does_not_publish_is_told(self):
        tags = "<normalsTopicName>n</normalsTopicName><reduceNormals>50</reduceNormals>"
        text = BAD.format(name="blunt", width=64).replace('type="camera"', 'type="depth"').replace("ros_camera.so", "ros_depth_camera.so")
        with Ear("/rosout", Log) as log:
            spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
            self.assertTrue(spawn("blunt", text.replace("</cameraName>", "</cameraName>" + tags), "", Pose(), "").success)
            until(
                lambda: any("<normalsTopicName>, <reduceNormals> are without effect" in m.msg for m in log.messages), "line about normals"
            )
        rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("blunt")

    def test_depth_camera(self):
        cloud = self.take("/depth_cam/points", PointCloud2)[0]
        self.assertEqual((cloud.height, cloud.width), (1, 160 * 120))
        depth = np.frombuffer(self.take("/depth_cam/depth/image_raw")[0].data, np.float32).reshape(120, 160)
        self.assertAlmostEqual(float(depth[60, 80]), 8.0, places=4)  # the far clip
        self.assertAlmostEqual(float(depth[60, 80 - OFF]), 2.0, places=4)

    def test_impossible_cameras_are_one_line_and_everything_goes_on(self):
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        delete = rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)
        with Ear("/rosout", Log) as log:
            for name, width in (("flat", 0), ("huge", 10**7), ("words", "wide")):
                self.assertTrue(spawn("bad", BAD.format(name=name, width=width), "/", Pose(), "world").success)
                until(lambda: any(f"sensor '{name}'" in m.msg for m in log.messages), f"line about {name}")
                self.assertTrue(delete("bad").success)
            lines = [m.msg for m in log.messages if "sensor '" in m.msg and "model bad" in m.msg]
        self.assertEqual(len(lines), 3, lines)
        for line in lines:
            self.assertNotIn("\n", line)
        self.take("/eye/image_raw")

    def test_two_cameras_of_one_name_both_send_and_the_first_one_is_served(self):
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        delete = rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)
        sensor = """<sensor name="{name}" type="camera"><update_rate>10</update_rate>
            <camera><image><width>{width}</width><height>24</height></image></camera>
            <plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>twin</cameraName></plugin></sensor>"""
        twins = (
            '<sdf version="1.6"><model name="twins"><static>true</static><link name="l">'
            + sensor.format(name="a", width=32)
            + sensor.format(name="b", width=48)
            + "</link></model></sdf>"
        )
        with Ear("/rosout", Log) as log:
            self.assertTrue(spawn("twins", twins, "/", Pose(), "world").success)
            until(lambda: any("[/twin/set_camera_info]" in m.msg for m in log.messages), "line about the second camera")
        said = [m.msg for m in log.messages if "already advertised" in m.msg]
        self.assertFalse([line for line in said if "\n" in line], said)
        self.assertFalse([m.msg for m in log.messages if "model twins" in m.msg], "neither plugin may be inactive")
        self.assertEqual(sorted(m.width for m in self.take("/twin/image_raw", count=2)), [32, 48])
        info = CameraInfo(width=32, height=24)
        self.assertTrue(rospy.ServiceProxy("/twin/set_camera_info", SetCameraInfo)(info).success)
        self.assertEqual(dynamic_reconfigure.client.Client("/twin", timeout=20).get_configuration()["imager_rate"], 2.0)
        self.assertTrue(delete("twins").success)
        self.assertNotIn("/twin/image_raw", dict(rospy.get_published_topics()))

    def test_a_model_that_comes_is_seen_and_its_camera_goes_with_it(self):
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        delete = rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)
        wall = """<sdf version="1.6"><model name="wall"><static>true</static><link name="l"><visual name="v">
            <pose>1.5 0 0 0 0 0</pose><geometry><box><size>0.1 9 9</size></box></geometry>
            <material><ambient>1 0 1 1</ambient></material></visual>
            <sensor name="back" type="camera"><update_rate>10</update_rate>
            <camera><image><width>32</width><height>24</height></image></camera>
            <plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>back</cameraName></plugin>
            </sensor></link></model></sdf>"""
        for _ in range(2):
            self.assertTrue(spawn("wall", wall, "/", Pose(), "world").success)
            self.assertEqual(tuple(picture(self.take("/eye/image_raw")[0])[60, 80]), (255, 0, 255))
            self.assertEqual(self.take("/back/image_raw")[0].width, 32)
            self.assertTrue(delete("wall").success)
            self.assertNotIn("/back/image_raw", dict(rospy.get_published_topics()))
            self.assertBoxes(picture(self.take("/eye/image_raw")[0]))


if __name__ == "__main__":
    rospy.init_node("camera_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "camera", Cameras)

#!/usr/bin/env python3
"""Point clouds and depth images become an octomap that is planned round."""

import threading
import time
import unittest

import motion
import moveit_commander
import numpy as np
import rospy
import rostest
import tf2_ros
from moveit_msgs.msg import PlanningSceneComponents
from moveit_msgs.srv import ApplyPlanningScene, GetPlanningScene, GetStateValidity, GetStateValidityRequest
from octomap_msgs.msg import OctomapWithPose
from sensor_msgs.msg import CameraInfo, Image, PointCloud2, PointField
from std_srvs.srv import Empty
from test_support.hearing import deliver

PATIENCE = 30.0  # wall s
HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]
LEFT = [1.2, -0.6, 1.6, 0.0, 1.0, 0.0]
WIDTH, HEIGHT, FOCUS = 160, 120, 120.0


def wall(x, y, z, width=0.4, height=0.8, count=60):
    """(n, 3) points in the world of a piece of wall across x."""
    v, w = np.meshgrid(np.linspace(-width / 2, width / 2, count), np.linspace(-height / 2, height / 2, count))
    return np.stack([np.full(v.size, x), y + v.ravel(), z + w.ravel()], axis=1)


class Octomap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        cls.scene = moveit_commander.PlanningSceneInterface()
        cls.cloud = rospy.Publisher("/cloud", PointCloud2, queue_size=1)
        cls.image = rospy.Publisher("/depth/image_raw", Image, queue_size=1)
        cls.info = rospy.Publisher("/depth/camera_info", CameraInfo, queue_size=1, latch=True)
        cls.info.publish(CameraInfo(width=WIDTH, height=HEIGHT, K=[FOCUS, 0, WIDTH / 2, 0, FOCUS, HEIGHT / 2, 0, 0, 1]))
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        found = cls.buffer.lookup_transform("world", "sensor", rospy.Time(0), rospy.Duration(PATIENCE)).transform
        p, q = found.translation, found.rotation
        cls.sensor = motion.Pose((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))
        cls.arm.set_max_velocity_scaling_factor(1.0)

    def setUp(self):
        self.scene.clear()
        self.clear()
        self.assertTrue(self.arm.go(HOME))

    def clear(self):
        rospy.wait_for_service("clear_octomap", PATIENCE)
        rospy.ServiceProxy("clear_octomap", Empty)()

    def tree(self):
        """The octree of the planning scene; None if it has none."""
        wanted = PlanningSceneComponents(components=PlanningSceneComponents.OCTOMAP)
        octomap = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)(wanted).scene.world.octomap.octomap
        if not octomap.data:
            return None
        data = np.array(octomap.data, np.int8).tobytes()
        return motion.OcTree.from_message_data(data, octomap.resolution, octomap.binary, octomap.id)

    def touches(self, point, radius=0.03):
        """Whether a ball at a point of the world touches the octomap."""
        tree = self.tree()
        if tree is None:
            return False
        ball = motion.load_model(
            '<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="%g"/>'
            '</geometry></collision></link><joint name="j" type="fixed"><parent link="a"/>'
            '<child link="b"/><origin xyz="%g %g %g"/></joint></robot>' % (radius, *point)
        )
        scene = motion.PlanningScene(ball)
        scene.set_octomap(tree, motion.Pose.identity())
        return bool(scene.check())

    def message(self, points):
        """A cloud in the sensor's frame from points of the world."""
        inverse = self.sensor.inverse().matrix()
        local = (np.asarray(points) @ inverse[:3, :3].T + inverse[:3, 3]).astype("<f4")
        message = PointCloud2(height=1, width=len(local), point_step=16, row_step=16 * len(local), is_dense=False)
        message.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
        message.header.frame_id, message.header.stamp = "sensor", rospy.Time.now()
        message.data = np.hstack([local, np.zeros((len(local), 1), "<f4")]).tobytes()
        return message

    def until(self, condition, send, text):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, text)
            send()
            time.sleep(0.05)

    def see(self, points, place):
        self.until(lambda: self.touches(place), lambda: self.cloud.publish(self.message(points)), "what was seen is not in the octomap")

    def valid(self, positions=()):
        """Of the arm where it is, or with its joints at other positions."""
        request = GetStateValidityRequest()
        request.robot_state.is_diff = True
        if len(positions):
            request.robot_state.joint_state.name = self.arm.get_active_joints()
            request.robot_state.joint_state.position = positions
        return rospy.ServiceProxy("check_state_validity", GetStateValidity)(request).valid

    def robot_points(self):
        """Points of the world inside the robot's hand and forearm, as a sensor would see them."""
        links = ("link_2", "link_3", "link_5", "hand")
        places = [self.buffer.lookup_transform("world", name, rospy.Time(0)).transform.translation for name in links]
        return np.array([(p.x, p.y, p.z) for p in places])

    def test_a_wall_is_seen_the_robot_is_not_and_clear_forgets(self):
        kept = []
        subscriber = rospy.Subscriber("/move_group/filtered_cloud", PointCloud2, kept.append)
        points = np.vstack([wall(0.6, 0.5, 0.5), np.repeat(self.robot_points(), 20, axis=0), [[np.nan] * 3]])
        self.see(points, (0.6, 0.5, 0.5))
        self.assertTrue(self.valid(), "the robot stands in what was seen of itself")
        for place in self.robot_points():
            self.assertFalse(self.touches(place, 0.01))
        self.until(lambda: kept, lambda: self.cloud.publish(self.message(points)), "no filtered cloud came")
        self.assertEqual(kept[-1].width, 3600)
        subscriber.unregister()
        self.clear()
        self.assertIsNone(self.tree())

    def test_a_whole_scene_without_an_octomap_forgets_what_was_seen(self):
        self.see(wall(0.6, 0.5, 0.5), (0.6, 0.5, 0.5))
        change = rospy.ServiceProxy("apply_planning_scene", ApplyPlanningScene)
        whole = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)().scene
        whole.world.octomap = OctomapWithPose()
        self.assertTrue(change(whole).success)
        self.assertIsNone(self.tree())
        self.see(wall(0.6, -0.5, 0.5), (0.6, -0.5, 0.5))
        self.assertFalse(self.touches((0.6, 0.5, 0.5)), "the wall of before is back")

    def test_a_plan_goes_round_what_was_seen(self):
        state = self.arm.get_current_state()
        self.assertEqual(len(state.joint_state.name), 8)
        self.arm.set_joint_value_target(LEFT)
        tip = self.arm.get_current_pose().pose.position
        radius = np.hypot(tip.x, tip.y)
        x, y = radius * np.cos(0.6), radius * np.sin(0.6)
        self.see(wall(x, y, tip.z, 0.12, 0.3), (x, y, tip.z))
        good, plan, _, _ = self.arm.plan()
        self.assertTrue(good)
        straight = np.linspace(HOME, LEFT, 40)
        self.assertFalse(all(map(self.valid, straight)), "nothing is in the way")
        columns = [plan.joint_trajectory.joint_names.index(name) for name in self.arm.get_active_joints()]
        for point in plan.joint_trajectory.points:
            self.assertTrue(self.valid([point.positions[column] for column in columns]), "the plan goes through the wall")
        self.assertTrue(self.arm.execute(plan))

    def test_known_objects_are_no_part_of_the_octomap(self):
        box = self.arm.get_current_pose()
        box.pose.position.x, box.pose.position.y, box.pose.position.z = 0.6, 0.5, 0.5
        box.pose.orientation.x = box.pose.orientation.y = box.pose.orientation.z = 0.0
        box.pose.orientation.w = 1.0
        self.scene.add_box("box", box, (0.1, 0.4, 0.8))
        self.see(np.vstack([wall(0.6, 0.5, 0.5, 0.38, 0.7), wall(0.6, -0.5, 0.5)]), (0.6, -0.5, 0.5))
        self.assertFalse(self.touches((0.6, 0.5, 0.5)))

    def test_a_wall_that_appears_ends_a_motion(self):
        self.arm.set_max_velocity_scaling_factor(0.1)
        self.arm.set_joint_value_target(LEFT)
        tip = self.arm.get_current_pose().pose.position
        radius, done = np.hypot(tip.x, tip.y), []
        mover = threading.Thread(target=lambda: done.append(self.arm.go(wait=True)))
        mover.start()
        self.until(lambda: self.arm.get_current_joint_values()[0] > 0.1, lambda: None, "the arm does not move")
        x, y = radius * np.cos(1.0), radius * np.sin(1.0)
        self.see(wall(x, y, tip.z, 0.2, 0.4), (x, y, tip.z))
        mover.join(PATIENCE)
        self.arm.set_max_velocity_scaling_factor(1.0)
        self.assertEqual(done, [False])
        self.assertLess(self.arm.get_current_joint_values()[0], 1.0)

    def depth(self, value, encoding="32FC1", patch=None):
        """An image of one depth; ``patch``: (rows, columns, depth) of another."""
        pixels = np.full((HEIGHT, WIDTH), value, float)
        if patch is not None:
            pixels[patch[0], patch[1]] = patch[2]
        data = pixels.astype("<f4") if encoding == "32FC1" else (pixels * 1000).astype("<u2")
        message = Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=WIDTH * data.itemsize, data=data.tobytes())
        message.header.frame_id, message.header.stamp = "sensor", rospy.Time.now()
        return message

    def test_depth_images_fill_and_free(self):
        for encoding in ("32FC1", "16UC1"):
            self.clear()
            # 0.5 m before the camera is x = 1.5
            self.until(
                lambda: self.touches((1.5, 0.0, 0.5)),
                lambda: self.image.publish(self.depth(0.5, encoding)),
                f"{encoding}: the octomap stays empty",
            )
            self.assertFalse(self.touches((1.0, 0.0, 0.5)))
            self.until(
                lambda: not self.touches((1.5, 0.0, 0.5)),
                lambda: self.image.publish(self.depth(6.0, encoding)),
                f"{encoding}: what is looked through stays",
            )

    def test_what_is_broken_does_no_harm(self):
        bad = self.message(wall(0.6, 0.5, 0.5))
        bad.data = bad.data[:100]
        no_fields = self.message(wall(0.6, 0.5, 0.5))
        no_fields.fields = no_fields.fields[:1]
        overhang = self.message(wall(0.6, 0.5, 0.5))
        overhang.fields[2].offset = 14
        lost = self.message(wall(0.6, 0.5, 0.5))
        lost.header.frame_id = "nowhere"
        half, unknown = self.depth(0.5), self.depth(0.5)
        half.data, unknown.encoding = half.data[:1000], "rgb8"
        for message in (bad, no_fields, overhang, lost, PointCloud2()):
            deliver(self.cloud, message)
        for message in (half, unknown, Image()):
            deliver(self.image, message)
        self.see(wall(0.6, 0.5, 0.5), (0.6, 0.5, 0.5))
        self.assertTrue(self.valid())

    def test_a_flood_is_survived(self):
        """Large clouds as fast as they can be sent: requests are still answered, and the octomap is right after it."""
        rng, stop = np.random.default_rng(1), threading.Event()
        clouds = [self.message(np.vstack([wall(0.8, -0.4, 0.5, 1.0, 1.0, 400), rng.uniform(-20, 20, (100000, 3))])) for _ in range(3)]

        def flood():
            while not stop.is_set():
                for cloud in clouds:
                    cloud.header.stamp = rospy.Time.now()
                    self.cloud.publish(cloud)

        thread = threading.Thread(target=flood)
        thread.start()
        try:
            answers = 0
            end = time.monotonic() + 5.0
            while time.monotonic() < end:
                rospy.ServiceProxy("get_planning_scene", GetPlanningScene)(PlanningSceneComponents(components=2))
                answers += 1
            self.assertGreater(answers, 5)
        finally:
            stop.set()
            thread.join()
        self.clear()
        self.see(wall(0.6, 0.5, 0.5), (0.6, 0.5, 0.5))


if __name__ == "__main__":
    rospy.init_node("octomap_rostest")
    rostest.rosrun("moveit_ros_perception", "octomap", Octomap)

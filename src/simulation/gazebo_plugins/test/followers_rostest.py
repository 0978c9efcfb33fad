#!/usr/bin/env python3
"""roboticsgroup's plugins: joints that follow others, links that are disabled. Expected values are physics on paper, and what the
plugins' README says of their elements. Time passes only through the step service.

With ~after_reset all of it is tested on plugins that have run for a while and were then reset with the simulation."""

import rospy
import rostest
from gazebo_msgs.msg import ODEJointProperties
from gazebo_msgs.srv import SetJointProperties, SetModelConfiguration
from listening import Ear, until
from models import box, joint, link, plugin, sdf
from plugin_world import PluginWorld
from rosgraph_msgs.msg import Log

TURN = 0.01  # kg m^2, of the follower about its axis
STRONG = {"p": 2.0, "d": 0.2}


class Followers(PluginWorld):
    def pair(self, name, x, gains=None, where="", **tags):
        """Two bodies that turn about upright axes; the second follows the first, which nothing moves."""
        space = f"/{name}"
        if gains is not None:
            rospy.set_param(f"{space}/{where or 'gazebo_ros_control/pid_gains/follower'}", gains)
            tags["hasPID"] = where
        parts = [link("base", (0, 0, 1), mass=5), joint("bolt", "fixed", "world", "base")]
        for part, z in (("leader", 1.0), ("follower", 1.5)):
            parts += [link(f"{part}_link", (0, 0, z), inertia=TURN), joint(part, "revolute", "base", f"{part}_link", lower=-3, upper=3)]
        library = "roboticsgroup_upatras_gazebo_mimic_joint_plugin"
        self.spawn(name, sdf(*parts, plugin(library, joint="leader", mimicJoint="follower", robotNamespace=space, **tags)), x, 200)
        self.addCleanup(self._delete_model, name)

    def turn(self, name, angle):
        """Put the leader at an angle."""
        turn = rospy.ServiceProxy("/gazebo/set_model_configuration", SetModelConfiguration)
        self.assertTrue(turn(name, "", ["leader"], [angle]).success)

    def angle(self, name):
        return self.joint(f"{name}::follower")

    def speed(self, name):
        return self._get_joint_properties(f"{name}::follower").rate[0]

    def test_a_pid_drives_by_no_more_than_the_effort(self):
        """0.05 N m turn 0.01 kg m^2 by 5 rad/s^2: 0.1 rad and 1 rad/s after 0.2 s."""
        self.pair("weak", 0, {"p": 2.0}, maxEffort=0.05)
        self.turn("weak", 0.5)
        self.step(0.2)
        self.assertAlmostEqual(self.angle("weak"), 0.1, delta=0.004)
        self.assertAlmostEqual(self.speed("weak"), 1.0, delta=0.02)

    def test_a_pid_arrives(self):
        """Gains in the usual place and in one that is named; multiplier and offset count."""
        for x, where in ((2, ""), (4, "my_gains")):
            name = f"strong{x}"
            self.pair(name, x, STRONG, where, multiplier=-2, offset=0.1)
            self.turn(name, 0.3)
            self.step(0.01)
            self.assertGreater(self.angle(name), -0.3)  # not put there
            self.step(2.0)
            self.assertAlmostEqual(self.angle(name), -0.5, delta=1e-3)

    def test_a_pid_leaves_small_differences(self):
        self.pair("patient", 6, STRONG, sensitiveness=0.1)
        self.turn("patient", 0.09)
        self.step(0.5)
        self.assertAlmostEqual(self.angle("patient"), 0.0, places=9)
        self.turn("patient", 0.4)
        self.step(0.05)
        self.assertGreater(self.angle("patient"), 0.01)

    def test_without_a_pid_it_is_put_there_where_the_difference_counts(self):
        self.pair("exact", 8)
        self.pair("coarse", 10, sensitiveness=0.1)
        for leader, exact, coarse in ((0.05, 0.05, 0.0), (0.3, 0.3, 0.3), (0.36, 0.36, 0.3), (-0.2, -0.2, -0.2)):
            for name, wanted in (("exact", exact), ("coarse", coarse)):
                self.turn(name, leader)
                self.step(0.05)
                self.assertAlmostEqual(self.angle(name), wanted, delta=1e-6, msg=f"{name} at {leader}")

    def test_without_gains_it_is_told_and_follows(self):
        with Ear("/rosout", Log) as log:
            self.pair("bare", 12, hasPID="")
            until(lambda: any("No p gain specified for pid.  Namespace: /bare/gazebo" in m.msg for m in log.messages), "line about gains")
        self.turn("bare", 0.4)
        self.step(0.05)
        self.assertAlmostEqual(self.angle("bare"), 0.4, delta=1e-6)

    def test_what_is_in_the_way_is_pushed_by_no_more_than_the_effort(self):
        """A block of 10 kg with friction 1 stands against 98 N."""
        motor = rospy.ServiceProxy("/gazebo/set_joint_properties", SetJointProperties)
        for x, effort, moves in ((20, 50, False), (24, 200, True)):
            name = f"push{effort}"
            parts = [link("base", (0, 0, 1), mass=5), joint("bolt", "fixed", "world", "base"), link("leader_link", (0, 0, 2))]
            parts += [joint("leader", "prismatic", "base", "leader_link", (1, 0, 0), -1, 1)]
            parts += [link("pad", (0, 0, 0.2), shape=box(0.1, 0.1, 0.1)), joint("follower", "prismatic", "base", "pad", (1, 0, 0), -1, 1)]
            mimic = plugin("roboticsgroup_gazebo_mimic_joint_plugin", joint="leader", mimicJoint="follower", maxEffort=effort)
            self.spawn(name, sdf(*parts, mimic), x, 205)
            self.addCleanup(self._delete_model, name)
            block = f"block{effort}"
            self.spawn(block, sdf(link("l", mass=10, inertia=0.3, shape=box(0.4, 0.4, 0.4))), x + 0.26, 205, 0.2)
            self.addCleanup(self._delete_model, block)
            self.step(0.2)
            self.assertTrue(motor(f"{name}::leader", ODEJointProperties(vel=[0.1], fmax=[100])).success)
            self.step(1.0)
            self.assertAlmostEqual(self.pose(block).position.x - x - 0.26, 0.09 if moves else 0.0, delta=0.005)

    def test_disabled_links(self):
        library = "roboticsgroup_upatras_gazebo_disable_link_plugin"
        self.spawn("still", sdf(link("l"), plugin(library, link="l")), 30, 200, 2)
        self.spawn("falls", sdf(link("l")), 32, 200, 2)
        with Ear("/rosout", Log) as log:
            hung = sdf(link("l"), link("m", (0, 0, 1)), joint("j", "revolute", "l", "m"), plugin(library, link="m"))
            self.spawn("hung", hung, 34, 200, 2)
            self.spawn("lost", sdf(link("l"), plugin(library, link="n")), 36, 200, 2)
            for words in ("link hung::m: it hangs on j", "the link 'n', which model lost does not have; it has l"):
                until(lambda: any(words in m.msg for m in log.messages), words)  # noqa: B023
        for name in ("still", "falls", "hung", "lost"):
            self.addCleanup(self._delete_model, name)
        before = {name: self.pose(name).position.z for name in ("still", "falls", "hung")}
        self.step(0.3)
        fallen = 9.8 * 0.3**2 / 2
        self.assertAlmostEqual(self.pose("still").position.z, 2.0, places=9)
        self.assertGreater(before["falls"] - self.pose("falls").position.z, 0.9 * fallen)
        self.assertGreater(before["hung"] - self.pose("hung").position.z, 0.9 * fallen)


if __name__ == "__main__":
    rospy.init_node("followers_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "followers", Followers)

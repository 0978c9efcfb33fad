#!/usr/bin/env python3
"""Plugins that come with Gazebo itself. Expected values are physics on paper, and what the headers of Gazebo 11 say of them."""

import math
import os
import tempfile

import rospy
import rostest
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import ApplyJointEffort, SetModelConfiguration
from gazebo_ros.srv import DescribeWorld
from geometry_msgs.msg import Point, Pose, Quaternion
from listening import Ear, Mouth, until
from models import box, elements, joint, link, plugin, sdf
from ode_sim.description import exchange
from ode_sim_viewer import simulation  # noqa: F401 its records are read
from plugin_world import PluginWorld, yaw_of
from rosgraph_msgs.msg import Log
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool

BALL = sdf(link("l", gravity=False))
SEEN = """<light name="{0}" type="point"><diffuse>1 1 1 1</diffuse><attenuation><range>7</range></attenuation></light>
<visual name="{0}"><geometry><sphere><radius>0.1</radius></sphere></geometry>{1}</visual>"""
ARM = sdf(
    link("base"),
    link("upper", (0.3, 0, 2), 2.0),
    link("lower", (0.3, 0, 1.5), 1.5),
    link("swung", (0, 1, 2), 0.7).replace("<inertial>", "<inertial><pose>0.2 0.1 -0.3 0 0 0</pose>"),
    joint("hold", "fixed", "world", "base"),
    joint("shoulder", "revolute", "base", "upper", (0, 1, 0)).replace("<parent>", "<pose>-0.3 0 0 0 0 0</pose><parent>", 1),
    joint("slide", "prismatic", "upper", "lower", (0, 0, 1)),
    joint("cross", "universal", "base", "swung", (1, 0, 0), extra="<axis2><xyz>0 1 0</xyz></axis2>"),
)
POSE = {"shoulder": 0.0, "slide": 0.0, "cross": 0.0}


def car():
    """40 kg on four wheels of 4 kg, 0.2 m and 0.08 kg m2 about their axles; pedals and a steering wheel of 0.1 kg."""
    parts = [link("chassis", (0, 0, 0.4), 40, 3, box(1.2, 0.6, 0.2))]
    for name, x, y in (("front_left", 0.5, 0.4), ("front_right", 0.5, -0.4), ("back_left", -0.5, 0.4), ("back_right", -0.5, -0.4)):
        wheel = link(name, (x, y, 0.2), 4, 0.08, "<cylinder><radius>0.2</radius><length>0.1</length></cylinder>")
        parts.append(wheel.replace("0 0 0</pose>", "-1.5707963 0 0</pose>", 1))
        most = 0.6 if name.startswith("front") else 0
        roll = "<axis2><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis2>"
        turn = joint(f"{name}_joint", "revolute2", "chassis", name, lower=-most, upper=most, extra=roll)
        parts.append(turn.replace("</xyz>", "</xyz><use_parent_model_frame>1</use_parent_model_frame>", 1))
    for name, axis, lower, upper in (("gas", (0, 1, 0), 0, 0.4), ("brake", (0, 1, 0), 0, 0.4), ("steering", (0, 0, 1), -3.14, 3.14)):
        parts += [link(name, (0.3, 0, 0.55), 0.1, 0.001), joint(f"{name}_joint", "revolute", "chassis", name, axis, lower, upper)]
        parts[-1] = parts[-1].replace("</limit>", "</limit><dynamics><damping>0.1</damping></dynamics>")
    return parts


JOINTS = {name: f"{name}_joint" for name in ("front_left", "front_right", "back_left", "back_right", "gas", "brake", "steering")}
DRIVE = {"max_speed": 10, "aero_load": 0.1, "tire_angle_range": 1.0, "front_power": 1.5, "rear_power": 0.5}


class Stock(PluginWorld):
    def place(self, name, x, y, z=0.5, yaw=0.0):
        turned = Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2))
        self.assertTrue(self._set_model_state(ModelState(model_name=name, pose=Pose(Point(x, y, z), turned))).success)
        self.step(0.001)

    def world(self):
        """What a window draws: models and lights by name."""
        answer = rospy.ServiceProxy("/gazebo/describe_world", DescribeWorld)()
        return exchange.loads(answer.world)

    def made(self, name):
        """(lights, visuals) of a model's first link, by name."""
        (found,) = (model.description for model in self.world().models if model.name == name)
        return ({light.name: light for light in found.links[0].lights}, {visual.name: visual for visual in found.links[0].visuals})

    def spawned(self, name, text, x, y, z=0.5):
        self.spawn(name, text, x, y, z)
        self.addCleanup(self._delete_model, name)

    # ---------------------------------------------------------------------------------------------------- places

    def test_who_is_in_a_box_that_is_turned(self):
        with Ear("/watch/turned/contain", Bool) as ear:
            self.step(0.01)
            ear.wait(1)
            self.spawned("ball", BALL, 10, 10)
            for x, y, inside in ((10.6, 10, True), (10.418, 10.43, False), (10, 10, True)):  # the box unturned would have it the other way
                self.place("ball", 0, 0)
                until(lambda: not ear.messages[-1].data, "news that it is out")
                count = len(ear.messages)
                self.place("ball", x, y)
                self.step(0.01)
                if inside:
                    until(lambda: len(ear.messages) > count, "news that it is in")  # noqa: B023
                    self.assertTrue(ear.messages[-1].data)
                else:
                    self.assertEqual(len(ear.messages), count)
            before = len(ear.messages)
            self._delete_model("ball")
            self.step(0.01)
            until(lambda: len(ear.messages) > before, "news that it is gone")
            self.assertFalse(ear.messages[-1].data)

    def test_who_is_in_a_box_that_is_carried_and_switched(self):
        enable = rospy.ServiceProxy("/watch/carried/enable", SetBool)
        self.spawned("cart", BALL, 20, 0, 0)
        self.spawned("ball", BALL, 20, 1, 0.5)
        with Ear("/watch/carried/contain", Bool) as ear:
            self.place("cart", 20, 0, 0, math.pi / 2)  # its box is at (20, 1) now
            self.step(0.05)
            self.assertEqual(ear.messages, [])
            self.assertTrue(enable(True).success)
            again = enable(True)
            self.assertEqual((again.success, again.message), (False, "it is enabled already"))
            self.step(0.01)
            self.assertTrue(ear.wait(1)[-1].data)
            self.place("cart", 20, 0, 0, -math.pi / 2)
            self.assertFalse(ear.wait(2)[-1].data)
            self.assertTrue(enable(False).success)
            self.assertFalse(enable(False).success)
            self.place("cart", 20, 0, 0, math.pi / 2)
            self.step(0.05)
            self.assertEqual(len(ear.messages), 2)

    def test_pads(self):
        self.spawned("parcel", BALL, 40, 0)
        self.spawned("stone", sdf(link("l"), static=True), 40, 3.5)
        self.step(0.1)
        self.assertAlmostEqual(self.pose("parcel").position.x, 40.0, places=6)  # pad1 waits to be told
        mouth = Mouth("/gazebo/transporter", String)
        with Ear("/rosout", Log) as log:
            mouth.say("pad9")
            until(lambda: [m for m in log.messages if "there is no pad 'pad9'; there are pad1, pad2" in m.msg], "warning")
        mouth.say("pad1")
        self.until_stepped(lambda: self.pose("parcel").position.x > 41, "journey")
        pose = self.pose("parcel")
        self.assertAlmostEqual(pose.position.x, 42.0, places=6)
        self.assertAlmostEqual(pose.position.y, 3.5, places=6)
        self.assertAlmostEqual(yaw_of(pose), 1.0, places=6)
        self.place("parcel", 40, 0)  # it was told once
        self.step(0.05)
        self.assertAlmostEqual(self.pose("parcel").position.x, 40.0, places=6)
        self.place("parcel", 40, 3.5)  # and pad2 needs not be told
        self.step(0.01)
        self.assertAlmostEqual(self.pose("parcel").position.y, 0.0, places=6)
        self.assertAlmostEqual(self.pose("parcel").position.x, 42.0, places=6)
        self.assertAlmostEqual(self.pose("stone").position.x, 40.0, places=6)

    # ---------------------------------------------------------------------------------------------------- lights

    def blinking(self, library, name, lights, visual="", static=True):
        where = SEEN.format("one", visual) + SEEN.format("two", "")
        text = sdf(link("l", extra=where), plugin(library).replace("</plugin>", lights + "</plugin>"), static=static)
        self.spawned(name, text, 60, 0)

    def test_a_light_flashes(self):
        """<duration> of light, <interval> of darkness; each <block> in its colour, which lasts until another has one."""
        blocks = "".join(
            f"<block>{elements(duration=0.2, interval=0.1, **more)}</block>" for more in ({"color": "1 0 0"}, {}, {"color": "0 0 1 0.5"})
        )
        one = f"<light>{elements(id='l/one', duration=0.1, interval=0.4, color='0 1 0')}</light>"
        self.blinking("FlashLightPlugin", "flasher", f"{one}<light><id>l/two</id>{blocks}</light>")
        white, green, red, blue = (1, 1, 1, 1), (0, 1, 0, 1), (1, 0, 0, 1), (0, 0, 1, 0.5)
        now = 0.0
        for time, first, second in (
            (0.05, (7, white), (7, white)),
            (0.15, (0, white), (7, white)),
            (0.25, (0, white), (0, white)),
            (0.35, (0, white), (7, white)),  # the second block has no colour
            (0.55, (7, green), (0, white)),
            (0.7, (0, green), (7, blue)),
            (1.0, (7, green), (7, red)),
            (1.25, (0, green), (7, red)),
        ):
            self.step(time - now)
            now = time
            lights, _ = self.made("flasher")
            self.assertEqual((lights["one"].range, lights["one"].diffuse), first, time)
            self.assertEqual((lights["two"].range, lights["two"].specular if second[1] != white else white), second, time)

    def test_lights_are_switched_off_one_by_one_or_all(self):
        lights = (
            f"<enable>false</enable><light>{elements(id='l/one', duration=1, interval=1)}</light>"
            f"<light>{elements(id='l/two', duration=1, interval=1, enable='true')}</light>"
        )
        self.blinking("FlashLightPlugin", "switched", lights)
        self.step(0.1)
        lights, _ = self.made("switched")
        self.assertEqual((lights["one"].range, lights["two"].range), (0, 7))

    def test_an_led_shines_and_is_see_through_when_it_is_dark(self):
        """As a real Gazebo 11.1 tells it on ~/visual."""
        red = "<transparency>0.4</transparency><material><diffuse>1 0 0 1</diffuse><emissive>0.5 0 0 1</emissive></material>"
        lights = (
            f"<light>{elements(id='l/one', duration=0.1, interval=0.1)}</light>"
            f"<light>{elements(id='l/two', duration=0.1, interval=0.1, color='0 1 0')}</light>"
        )
        self.blinking("LedPlugin", "led", lights, red)
        self.step(0.15)
        lights, visuals = self.made("led")
        one, two = visuals["one"], visuals["two"]
        self.assertEqual((lights["one"].range, one.transparency, one.material.emissive), (0, 0.4, (0, 0, 0, 1)))
        self.assertEqual((two.transparency, two.material.emissive), (0.2, (0, 0, 0, 1)))
        self.step(0.1)
        lights, visuals = self.made("led")
        one, two = visuals["one"], visuals["two"]
        self.assertEqual((lights["one"].range, one.transparency, one.material.emissive), (7, 0.0, (0.5, 0, 0, 1)))
        self.assertEqual(one.material.diffuse, (1, 0, 0, 1))
        green = (0, 1, 0, 1)
        self.assertEqual((two.transparency, two.material.ambient, two.material.emissive), (0.0, green, green))

    def test_a_light_of_the_world_is_carried(self):
        held = "<link><link_name>l</link_name><light><light_name>lamp</light_name><pose>1 0 0.5 0 0 0.2</pose></light></link>"
        self.spawned("bearer", sdf(link("l", gravity=False), plugin("AttachLightPlugin").replace("</plugin>", held + "</plugin>")), 70, 0)
        self.place("bearer", 70, 2, 1, math.pi / 2)
        self.step(0.01)
        (lamp,) = (light for light in self.world().lights if light.name == "lamp")
        for got, wanted in zip(lamp.pose.p, (70, 3, 1.5)):
            self.assertAlmostEqual(got, wanted, places=5)
        self.assertAlmostEqual(2 * math.atan2(lamp.pose.q[2], lamp.pose.q[3]), math.pi / 2 + 0.2, places=5)

    # ---------------------------------------------------------------------------------------------------- forces

    def test_joints_bear_what_the_description_knows_of(self):
        """The lower link has 1.5 kg; where 1.2 are known of, it goes down by 0.3 g / 1.5."""
        with tempfile.TemporaryDirectory() as folder:
            for name, known, slid in (("weightless", 1.5, 0.0), ("loaded", 1.2, -0.5 * 0.3 / 1.5 * 9.8 * 0.25)):
                path = os.path.join(folder, name + ".sdf")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(ARM.replace("<mass>1.5</mass>", f"<mass>{known}</mass>"))
                text = ARM.replace("</model>", plugin("GravityCompensationPlugin", uri=f"file://{path}") + "</model>")
                self.spawned(name, text, 80, 0)
                self.step(0.5)
                self.assertAlmostEqual(self.joint("slide"), slid, delta=2e-3)
                if not slid:
                    for held in POSE:
                        self.assertAlmostEqual(self.joint(held), 0.0, delta=1e-5)
                self._delete_model(name)

    def push(self, joint, effort, seconds):
        call = rospy.ServiceProxy("/gazebo/apply_joint_effort", ApplyJointEffort)
        self.assertTrue(call(joint, effort, rospy.Time(0), rospy.Duration(seconds)).success)

    def test_a_car_goes_by_its_pedals(self):
        """Wheels of 1.5 and 0.5 N m push 56.3 kg, and turn: 2 (1.5 + 0.5) / 0.2 N on 56.3 + 4 * 0.08 / 0.2^2 kg. The brake takes the push
        away and, as in a real Gazebo 11.1, nothing more."""
        self.spawned("car", sdf(*car(), plugin("VehiclePlugin", **JOINTS, **DRIVE)), 0, 30, 0)

        def speed():
            return self._get_model_state("car", "").twist.linear.x

        self.push("gas_joint", 0.3, 2.0)
        self.step(1.0)
        before = speed()
        self.step(1.0)
        self.assertAlmostEqual(speed() - before, 20 / (56.3 + 8), delta=3e-3)
        self.push("brake_joint", 0.3, 1.0)
        self.step(0.5)
        before = speed()
        self.step(0.4)
        self.assertAlmostEqual(speed(), before, delta=2e-3)
        self.assertGreater(before, 0.5)

    def test_a_car_goes_where_it_is_steered(self):
        """The front wheels turn by the steering wheel's part of its range: 2.0 of 6.28 rad of their 1.0. With 1 m between the axles the
        curve is of tan(angle) / 1 m."""
        self.spawned("car", sdf(*car(), plugin("VehiclePlugin", **JOINTS, **DRIVE)), 0, 30, 0)
        turn = rospy.ServiceProxy("/gazebo/set_model_configuration", SetModelConfiguration)
        self.assertTrue(turn("car", "", ["steering_joint"], [2.0]).success)
        self.push("gas_joint", 0.3, 3.0)
        self.step(3.0)
        angle = 2.0 / 6.28
        self.assertAlmostEqual(self.joint("front_left_joint"), angle, delta=3e-3)
        state = self._get_model_state("car", "")
        ahead = math.hypot(state.twist.linear.x, state.twist.linear.y)
        self.assertAlmostEqual(state.twist.angular.z / ahead, math.tan(angle), delta=0.1 * math.tan(angle))

    def test_a_car_without_a_greatest_speed_stands(self):
        self.spawned("car", sdf(*car(), plugin("VehiclePlugin", **JOINTS, **{**DRIVE, "max_speed": 0})), 0, 30, 0)
        self.push("gas_joint", 0.3, 1.0)
        self.step(1.0)
        self.assertAlmostEqual(self._get_model_state("car", "").twist.linear.x, 0.0, delta=2e-3)

    # ---------------------------------------------------------------------------------------------------- what is wrong

    def test_what_is_wrong_is_one_line(self):
        ear = Ear("/rosout", Log)
        light = f"<light>{elements(id='l/none', duration=1, interval=1)}</light>"
        wheels = {**JOINTS, "front_left": "gas_joint"}
        mute = f"<light>{elements(id='l/one', duration=1)}</light>"
        for library, inside, words in (
            ("FlashLightPlugin", "", "<light> is missing"),
            ("FlashLightPlugin", light, "<id>l/none</id> is no link/light of model wrong; it has l/one, l/two"),
            ("LedPlugin", mute, "<light> 'l/one': <interval> is missing"),
            ("AttachLightPlugin", "<link><link_name>x</link_name></link>", "<link_name> names the link 'x'"),
            ("GravityCompensationPlugin", "", "<uri> is missing"),
            ("GravityCompensationPlugin", "<uri>model://no_such_arm</uri>", "no such model; searched"),
            ("VehiclePlugin", elements(**wheels), "joint 'gas_joint' of a wheel has no second axis"),
            ("VehiclePlugin", "", "<front_left> is missing"),
            ("ContainPlugin", "", "is no ModelPlugin"),
            ("CessnaPlugin", "", "is not here: "),
            ("MudPlugin", "", "is not here: "),
        ):
            with self.subTest(library, words=words):
                where = SEEN.format("one", "") + SEEN.format("two", "")
                text = sdf(*car(), plugin(library).replace("</plugin>", inside + "</plugin>")).replace("</link>", where + "</link>", 1)
                text = text.replace('<link name="chassis">', '<link name="l">').replace("<parent>chassis</parent>", "<parent>l</parent>")
                ear.messages.clear()
                self.spawn("wrong", text, 90, 0)
                until(lambda: [m for m in ear.messages if words in m.msg and f"lib{library}.so" in m.msg], words)  # noqa: B023
                self.step(0.01)
                self._delete_model("wrong")


if __name__ == "__main__":
    rospy.init_node("stock_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "stock", Stock)

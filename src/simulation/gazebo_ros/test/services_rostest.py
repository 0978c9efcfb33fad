#!/usr/bin/env python3
"""The services of the node gazebo: what they do, and what they say when they cannot. The world bench.world is paused;
time passes only through the step service, so that every figure is exact."""

import math
import subprocess
import tempfile
import time

import rosgraph
import rospy
import rostest
from gazebo_msgs import srv
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_ros.msg import WorldContacts, WorldView
from gazebo_ros.srv import TakePicture
from geometry_msgs.msg import Pose, Vector3
from rosgraph_msgs.msg import Clock, Log
from simulator import Case, box, pose, twist, urdf, xyz
from std_msgs.msg import Bool, ColorRGBA

NAN = float("nan")


class Stepping(Case):
    def test_step_is_exact_and_answers_when_done(self):
        self.assertEqual(self.sim.world().sim_time, 0.0)
        response = self.done(self.sim.step(250))
        self.assertEqual((response.sim_time.to_nsec(), response.iterations), (250_000_000, 250))
        self.assertEqual(self.sim.world().sim_time, 0.25)

    def test_the_last_clock_value_is_that_of_the_last_step(self):
        self.sim.step(123)
        end = time.monotonic() + 60
        clock = 0
        while clock != 123_000_000 and time.monotonic() < end:  # the message may still be under way
            clock = rospy.wait_for_message("/clock", Clock, 60).clock.to_nsec()
        self.assertEqual(clock, 123_000_000)

    def test_a_picture_while_the_world_stands_still(self):
        with tempfile.TemporaryDirectory() as folder:
            file = f"{folder}/now.png"
            command = ["rosrun", "gazebo_ros", "picture", "crate", "-o", file, "--size", "160x100", "--view", "top"]
            self.assertEqual(subprocess.run(command, capture_output=True, text=True, timeout=60).stderr, "")
            with open(file, "rb") as png:
                self.assertEqual(png.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertEqual(self.sim.world().sim_time, 0.0)
        picture = self.sim.proxy("take_picture", TakePicture)
        self.refused(picture("nobody", "", 0, 0), "no model 'nobody'", "crate")
        self.refused(picture("", "below", 0, 0), "no view 'below'", "iso, front")
        self.refused(picture("", "", 5, 9000), "5x9000 pixels")

    def test_no_steps_and_running_are_refused(self):
        self.refused(self.sim.step(0), "at least 1")
        self.sim.empty("unpause_physics")
        self.refused(self.sim.step(1), "pause")

    def test_pause_and_unpause(self):
        self.assertTrue(self.sim.physics().pause)
        before = self.sim.world().sim_time
        self.sim.empty("unpause_physics")
        self.assertFalse(self.sim.physics().pause)
        times = []
        clock = rospy.Subscriber("/clock", Clock, lambda message: times.append(message.clock.to_nsec()), queue_size=100)

        def steps():
            return [b - a for a, b in zip(times[1:], times[2:])]  # the first message is the latched one

        # a message per step, of which a slow reader may miss some
        self.wait(lambda: len(times) >= 50 and 1_000_000 in steps())
        clock.unregister()
        self.sim.empty("pause_physics")
        after = self.sim.world().sim_time
        self.assertGreater(after, before)
        self.assertEqual(self.sim.world().sim_time, after)
        self.assertEqual(min(steps()), 1_000_000)


class Resets(Case):
    def test_reset_world_keeps_time_and_joint_angles(self):
        self.sim.set_joints("swing", ["hinge"], [0.7])
        self.sim.set_model("crate", pose(1, 2, 3), twist((1, 0, 0)))
        self.sim.step(10)
        self.sim.empty("reset_world")
        state = self.sim.model("crate")
        self.near(xyz(state.pose.position), (5, 0, 3))
        self.near(xyz(state.twist.linear), (0, 0, 0))
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], 0.7, 6)
        self.assertEqual(self.sim.world().sim_time, 0.01)

    def test_reset_simulation_resets_time_poses_and_joints_and_keeps_spawned_models(self):
        self.done(self.sim.spawn("extra", box(), pose(20, 0, 1)))
        self.sim.set_joints("swing", ["hinge"], [0.7])
        self.sim.set_model("extra", pose(1, 2, 3), twist((1, 0, 0)))
        self.sim.step(10)
        self.sim.empty("reset_simulation")
        world = self.sim.world()
        self.assertEqual(world.sim_time, 0.0)
        self.assertIn("extra", world.model_names)
        self.near(xyz(self.sim.model("extra").pose.position), (20, 0, 1))
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], 0.0, 9)
        self.assertEqual(self.sim.step(1).sim_time.to_nsec(), 1_000_000)
        self.done(self.sim.delete("extra"))

    def test_reset_time_leaves_all_else(self):
        self.sim.set_model("crate", pose(1, 2, 3), twist((1, 0, 0)))
        iterations = self.sim.step(10).iterations
        before = self.sim.model("crate").pose.position
        self.sim.empty("reset_time")
        self.assertEqual(self.sim.world().sim_time, 0.0)
        self.near(xyz(self.sim.model("crate").pose.position), xyz(before))
        after = self.sim.step(10)
        self.assertEqual((after.sim_time.to_nsec(), after.iterations), (10_000_000, iterations + 10))
        self.assertAlmostEqual(self.sim.model("crate").pose.position.x, before.x + 0.01, 4)


class Models(Case):
    def test_world_properties(self):
        world = self.done(self.sim.world())
        self.assertEqual(world.model_names, ["ground_plane", "crate", "swing"])
        self.assertTrue(world.rendering_enabled)

    def test_model_properties(self):
        get = self.sim.proxy("get_model_properties", srv.GetModelProperties)
        swing = self.done(get("swing"))
        self.assertEqual(swing.body_names, ["stand", "rod"])
        self.assertEqual(swing.joint_names, ["bolt", "hinge"])
        self.assertFalse(swing.is_static)
        self.assertEqual(get("crate").geom_names, ["shape"])
        self.assertTrue(get("ground_plane").is_static)
        self.refused(get("ghost"), "GetModelProperties: ", "ghost", "crate")

    def test_model_state_in_another_frame(self):
        half = math.sqrt(0.5)
        self.done(self.sim.set_model("crate", pose(4, 0, 3, qz=half, qw=half), twist((0, 1, 0))))  # turned left
        self.done(self.sim.spawn("other", box(), pose(4, 2, 3)))
        state = self.done(self.sim.model("other", "crate"))
        self.assertEqual(state.header.frame_id, "crate")
        self.near(xyz(state.pose.position), (2, 0, 0))
        self.near((state.pose.orientation.z, state.pose.orientation.w), (-half, half))
        self.near(xyz(state.twist.linear), (-1, 0, 0))
        self.sim.model("crate")  # counted on its own
        self.assertEqual([state.header.seq, self.sim.model("other").header.seq], [1, 2])
        self.refused(self.sim.model("other", "nowhere"), "GetModelState: ", "nowhere")
        self.refused(self.sim.model("ghost"), "ghost")
        self.done(self.sim.delete("other"))

    def test_set_model_state_moves_the_whole_model_and_its_reference_rotates(self):
        half = math.sqrt(0.5)
        self.done(self.sim.set_model("crate", pose(4, 0, 3, qz=half, qw=half)))
        self.done(self.sim.spawn("other", box()))
        self.done(self.sim.set_model("other", pose(1, 0, 0), twist((1, 0, 0), (0, 1, 0)), "crate"))
        state = self.sim.model("other")
        self.near(xyz(state.pose.position), (4, 1, 3))
        self.near(xyz(state.twist.linear), (0, 1, 0))
        self.near(xyz(state.twist.angular), (-1, 0, 0))
        self.done(self.sim.delete("other"))

    def test_set_model_state_normalizes_and_takes_zeros_for_no_rotation(self):
        self.done(self.sim.set_model("crate", pose(1, 1, 1, qw=5.0)))
        self.assertAlmostEqual(self.sim.model("crate").pose.orientation.w, 1.0)
        self.done(self.sim.set_model("crate", pose(1, 1, 1, qw=0.0)))
        self.assertAlmostEqual(self.sim.model("crate").pose.orientation.w, 1.0)

    def test_world_has_four_names(self):
        for name in ("", "world", "map", "/map"):
            self.done(self.sim.set_model("crate", pose(1, 2, 3), frame=name))

    def test_nonsense_is_refused_and_changes_nothing(self):
        before = self.sim.model("crate").pose
        self.refused(self.sim.set_model("crate", pose(NAN, 0, 0)), "SetModelState: ", "nan")
        self.refused(self.sim.set_model("crate", pose(1e12, 0, 0)), "SetModelState: ", "1e+12 m from the origin")
        self.refused(self.sim.set_model("crate", pose(1, 0, 0), twist((math.inf, 0, 0))), "inf")
        self.refused(self.sim.set_model("ghost", pose()), "ghost", "crate")
        self.refused(self.sim.set_model("crate", pose(), frame="nowhere"), "nowhere")
        self.assertEqual(self.sim.model("crate").pose, before)

    def test_configuration_clamps_skips_unknown_joints_and_leaves_the_pause(self):
        self.done(self.sim.set_joints("swing", ["hinge", "no_such_joint"], [9.0, 1.0]))
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], 1.5, 6)
        self.done(self.sim.set_joints("swing", ["swing::hinge"], [-0.4]))
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], -0.4, 9)
        self.assertTrue(self.sim.physics().pause)
        self.refused(self.sim.set_joints("swing", ["hinge"], []), "1 joint_names", "0 joint_positions")
        self.refused(self.sim.set_joints("swing", ["hinge"], [NAN]), "nan")
        self.refused(self.sim.set_joints("ghost", [], []), "ghost")
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], -0.4, 9)

    def test_topics_set_states_too(self):
        set_model = rospy.Publisher("/gazebo/set_model_state", ModelState, queue_size=1, latch=True)
        set_link = rospy.Publisher("/gazebo/set_link_state", LinkState, queue_size=1, latch=True)
        set_model.publish(ModelState("crate", pose(7, 0, 3), twist(), ""))
        self.wait(lambda: self.sim.model("crate").pose.position.x == 7)
        set_model.publish(ModelState("ghost", pose(8, 0, 3), twist(), ""))  # only a line in the log
        logged = []
        log = rospy.Subscriber("/rosout", Log, lambda message: logged.append(message.msg))
        self.wait(log.get_num_connections)
        for publisher, message in (
            (set_model, ModelState("crate", pose(1e7, 0, 3), twist(), "crate")),
            (set_link, LinkState("crate::box", pose(1e7, 0, 3), twist(), "crate::box")),
        ):
            logged.clear()
            publisher.publish(message)
            self.wait(lambda: any("1e+07 m away" in line for line in logged))
            self.assertFalse([line for line in logged if "Traceback" in line])
        log.unregister()
        set_link.publish(LinkState("crate::box", pose(9, 0, 3), twist(), ""))
        self.wait(lambda: self.sim.link("crate::box").link_state.pose.position.x == 9)
        set_model.unregister()
        set_link.unregister()


class Links(Case):
    def test_link_state_scoped_and_unscoped(self):
        scoped = self.done(self.sim.link("crate::box")).link_state
        unscoped = self.done(self.sim.link("box")).link_state
        self.assertEqual(scoped.pose, unscoped.pose)
        self.near(xyz(scoped.pose.position), (5, 0, 3))
        self.refused(self.sim.link("crate::lid"), "GetLinkState: ", "lid", "model::link")

    def test_link_in_the_frame_of_a_model(self):
        state = self.done(self.sim.link("crate::box", "swing")).link_state
        self.near(xyz(state.pose.position), (5, 0, 1))
        self.assertEqual(state.reference_frame, "swing")

    def test_set_link_state(self):
        self.done(self.sim.set_link("crate::box", pose(1, 1, 4), twist((0, 0, 2))))
        state = self.sim.link("crate::box").link_state
        self.near(xyz(state.pose.position), (1, 1, 4))
        self.near(xyz(state.twist.linear), (0, 0, 2))
        self.sim.step(100)
        self.near(xyz(self.sim.link("crate::box").link_state.pose.position), (1, 1, 4.2))
        self.refused(self.sim.set_link("crate::box", pose(), frame="swing"), "no link", "model::link")
        self.refused(self.sim.set_link("crate::box", pose(z=NAN)), "nan")
        self.refused(self.sim.set_link("ghost::box", pose()), "ghost::box")

    def test_properties_and_their_effect(self):
        get = self.sim.proxy("get_link_properties", srv.GetLinkProperties)
        change = self.sim.proxy("set_link_properties", srv.SetLinkProperties)
        box_ = self.done(get("crate::box"))
        self.assertEqual((box_.mass, box_.ixx, box_.iyy, box_.izz, box_.gravity_mode), (2.0, 0.1, 0.2, 0.4, False))
        self.done(self.sim.set_physics(gravity=(0, 0, -10)))
        self.done(change("crate::box", Pose(), True, 4.0, 0.1, 0, 0, 0.2, 0, 0.4))
        self.assertEqual(get("crate::box").mass, 4.0)
        self.sim.push("crate::box", (4.0, 0, 0), 0.1)
        self.sim.step(100)
        velocity = self.sim.link("crate::box").link_state.twist.linear
        self.near((velocity.x, velocity.z), (0.1, -1.0), 6)  # F t / m and g t
        self.refused(change("crate::box", Pose(), True, -1.0, 1, 0, 0, 1, 0, 1), "mass -1")
        self.refused(change("crate::box", Pose(), True, 1.0, 0, 0, 0, 1, 0, 1), "inertia")
        self.refused(change("crate::box", Pose(), True, NAN, 1, 0, 0, 1, 0, 1), "nan")
        self.done(change("crate::box", Pose(), False, 2.0, 0.1, 0, 0, 0.2, 0, 0.4))


class Joints(Case):
    def test_get(self):
        self.sim.set_joints("swing", ["hinge"], [0.25])
        hinge = self.done(self.sim.joint("swing::hinge"))
        self.assertEqual((hinge.type, list(hinge.damping), len(hinge.rate)), (0, [], 1))
        self.assertAlmostEqual(hinge.position[0], 0.25, 9)
        self.refused(self.sim.joint("knee"), "GetJointProperties: ", "knee")

    def test_a_screw_turns_and_goes(self):
        """0.1 N m on 1 kg, J = 0.01, at 100 rad/m, left-handed: (J + m/p^2) a = tau."""
        link = "<link name='nut'><inertial><mass>1</mass><inertia><ixx>.01</ixx><iyy>.01</iyy><izz>.01</izz></inertia></inertial></link>"
        thread = "<thread_pitch>100</thread_pitch><axis><xyz>0 0 1</xyz></axis>"
        self.done(
            self.sim.spawn(
                "press",
                f"<sdf version='1.6'><model name='press'>{link}<joint name='thread' type='screw'><parent>world"
                f"</parent><child>nut</child>{thread}</joint></model></sdf>",
                pose(5, 0, 2),
            )
        )
        self.addCleanup(self.sim.delete, "press")
        self.done(self.sim.drive("thread", 0.1, 0.2))
        self.sim.step(200)
        rate = 0.1 / (0.01 + 1.0 / 100.0**2) * 0.2
        thread = self.done(self.sim.joint("press::thread"))
        self.assertEqual((len(thread.position), len(thread.rate)), (1, 1))
        self.assertAlmostEqual(thread.rate[0], rate, delta=1e-3 * rate)
        nut = self.done(self.sim.link("press::nut")).link_state
        self.assertAlmostEqual(nut.twist.linear.z, -rate / 100, delta=1e-5)
        self.assertAlmostEqual(nut.pose.position.z, 2 - thread.position[0] / 100, 6)
        self.done(self.sim.set_joints("press", ["thread"], [-30.0]))
        self.assertAlmostEqual(self.done(self.sim.link("press::nut")).link_state.pose.position.z, 2.3, 6)

    def test_a_motor_drives_and_stops(self):
        self.done(self.sim.set_joint("hinge", fmax=[100.0], vel=[0.5]))
        self.sim.step(1000)
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], 0.5, 2)
        self.done(self.sim.set_joint("hinge", fmax=[0.0], vel=[0.0]))
        self.refused(self.sim.set_joint("hinge", fmax=[1.0, 1.0]), "2 elements", "1 axes")
        self.refused(self.sim.set_joint("hinge", hiStop=[NAN]), "nan")
        self.refused(self.sim.set_joint("knee"), "knee")

    def test_a_stop_is_moved(self):
        self.done(self.sim.set_joint("hinge", hiStop=[0.2]))
        self.sim.set_joints("swing", ["hinge"], [1.0])
        self.assertAlmostEqual(self.sim.joint("hinge").position[0], 0.2, 6)
        self.done(self.sim.set_joint("hinge", hiStop=[1.5]))


class Forces(Case):
    def speed(self):
        return xyz(self.sim.link("crate::box").link_state.twist.linear)

    def spin(self):
        return xyz(self.sim.link("crate::box").link_state.twist.angular)

    def test_a_push_lasts_as_long_as_it_should(self):
        self.done(self.sim.push("crate::box", (2.0, 0, 0), 0.05))
        self.sim.step(100)
        self.near(self.speed(), (0.05, 0, 0))

    def test_shorter_than_a_step_does_nothing(self):
        self.done(self.sim.push("crate::box", (2.0, 0, 0), 0.0005))
        self.sim.step(10)
        self.near(self.speed(), (0, 0, 0))

    def test_a_later_start_waits(self):
        self.done(self.sim.push("crate::box", (2.0, 0, 0), 0.01, start=0.05))
        self.sim.step(49)
        self.near(self.speed(), (0, 0, 0))
        self.sim.step(51)
        self.near(self.speed(), (0.011, 0, 0))  # the steps at 0.050 and at 0.060 both count

    def test_for_ever_until_cleared_by_the_scoped_name(self):
        clear = self.sim.proxy("clear_body_wrenches", srv.BodyRequest)
        self.done(self.sim.push("box", (2.0, 0, 0), -1))
        self.sim.step(10)
        clear("box")
        self.sim.step(10)
        self.near(self.speed(), (0.02, 0, 0))
        clear("crate::box")
        self.sim.step(10)
        self.near(self.speed(), (0.02, 0, 0))

    def test_pushes_on_one_link_replace_each_other(self):
        self.sim.push("crate::box", (2.0, 0, 0), 0.01)
        self.sim.push("crate::box", (0, 2.0, 0), 0.01)
        self.sim.step(10)
        self.near(self.speed(), (0, 0.01, 0))

    def test_a_lever_arm_turns(self):
        self.done(self.sim.push("crate::box", (0, 2.0, 0), 0.01, point=(0.1, 0, 0)))
        self.sim.step(10)
        self.near(self.spin(), (0, 0, 0.1 * 2.0 / 0.4 * 0.01), 6)

    def test_force_along_the_axes_of_a_turned_link(self):
        half = math.sqrt(0.5)
        self.sim.set_model("crate", pose(5, 0, 3, qz=half, qw=half))
        self.done(self.sim.push("crate::box", (2.0, 0, 0), 0.01, frame="crate::box"))
        self.sim.step(10)
        self.near(self.speed(), (0, 0.01, 0))

    def test_push_failures(self):
        self.refused(self.sim.push("ghost", (1, 0, 0), 1), "ApplyBodyWrench: ", "ghost")
        self.refused(self.sim.push("crate::box", (1, 0, 0), 1, frame="nowhere"), "nowhere")
        self.refused(self.sim.push("crate::box", (NAN, 0, 0), 1), "nan")
        self.sim.step(10)
        self.near(self.speed(), (0, 0, 0))

    def test_joint_efforts_add_up_and_are_cleared_by_the_plain_name(self):
        inertia = 0.5
        self.done(self.sim.drive("hinge", 1.0, 0.1))
        self.done(self.sim.drive("swing::hinge", 0.5, 0.1))
        self.sim.step(100)
        self.assertAlmostEqual(self.sim.joint("hinge").rate[0], 1.5 * 0.1 / inertia, 4)
        self.sim.empty("reset_simulation")
        self.sim.proxy("clear_joint_forces", srv.JointRequest)("hinge")
        self.sim.drive("hinge", 1.0, -1)
        self.sim.step(10)
        self.sim.proxy("clear_joint_forces", srv.JointRequest)("hinge")
        self.sim.step(10)
        self.assertAlmostEqual(self.sim.joint("hinge").rate[0], 0.01 / inertia, 5)
        self.refused(self.sim.drive("knee", 1.0, 1.0), "ApplyJointEffort: ", "knee")
        self.refused(self.sim.drive("hinge", NAN, 1.0), "nan")

    def test_effort_stops_at_the_limit_of_the_joint(self):
        self.sim.drive("hinge", 1000.0, 0.01)
        self.sim.step(10)
        self.assertAlmostEqual(self.sim.joint("hinge").rate[0], 10.0 * 0.01 / 0.5, 4)


class Lights(Case):
    def test_get_set_delete(self):
        get = self.sim.proxy("get_light_properties", srv.GetLightProperties)
        change = self.sim.proxy("set_light_properties", srv.SetLightProperties)
        delete = self.sim.proxy("delete_light", srv.DeleteLight)
        self.done(
            self.sim.spawn(
                "torch",
                """<sdf version="1.6"><light name="x" type="spot">
            <diffuse>0.5 0.25 0.125 1</diffuse></light></sdf>""",
                pose(1, 2, 3),
            )
        )
        torch = self.done(get("torch"))
        self.assertEqual((torch.diffuse.r, torch.diffuse.g, torch.diffuse.b), (0.5, 0.25, 0.125))
        self.refused(self.sim.spawn("torch", "<sdf version='1.6'><light name='x'/></sdf>"), "already exists")
        red, down = ColorRGBA(1, 0, 0, 1), Vector3(0, 0, -1)
        self.done(change("torch", True, red, ColorRGBA(), 0.5, 0.25, 0.125, down, pose()))
        torch = get("torch")
        self.assertEqual((torch.diffuse.r, torch.attenuation_constant, torch.attenuation_quadratic), (1, 0.5, 0.125))
        self.done(delete("torch"))
        self.refused(get("torch"), "torch", "lamp")
        self.refused(delete("torch"), "torch")
        self.done(
            self.sim.spawn(
                "car",
                """<sdf version="1.6"><model name="any"><static>1</static><link name="l">
            <light name="beam" type="spot"><pose>1 0 0 0 0 0</pose></light></link></model></sdf>""",
                pose(7, 0, 1),
            )
        )
        self.done(change("car::l::beam", True, red, ColorRGBA(), 0.5, 0.25, 0.125, down, pose(8, 0, 1)))
        self.assertEqual((get("beam").diffuse.g, get("beam").attenuation_constant), (0, 0.5))
        self.done(delete("beam"))
        self.refused(get("beam"), "beam", "lamp")
        self.done(self.sim.delete("car"))
        self.refused(change("lamp", True, ColorRGBA(NAN, 0, 0, 1), ColorRGBA(), 1, 0, 0, Vector3(), pose()), "nan")


class Physics(Case):
    def test_properties_act_at_once(self):
        self.done(self.sim.set_physics(time_step=0.002, rate=500.0, gravity=(0, 0, -1.0), sor_pgs_iters=33, max_contacts=11))
        physics = self.done(self.sim.physics())
        self.assertEqual((physics.time_step, physics.max_update_rate, physics.gravity.z), (0.002, 500.0, -1.0))
        self.assertEqual((physics.ode_config.sor_pgs_iters, physics.ode_config.max_contacts), (33, 11))
        self.assertEqual(self.sim.step(5).sim_time.to_nsec(), 10_000_000)
        self.done(self.sim.set_physics())

    def test_impossible_values_are_refused_and_change_nothing(self):
        before = self.sim.physics()
        wrong = [("time_step", step) for step in (0.0, -0.001, NAN, 1e300, 1e9, 1e-12)]
        wrong += [("max_update_rate", rate) for rate in (-1.0, NAN, 1e-300, 1e300)]
        wrong += [("sor_pgs_iters", 0), ("max_contacts", 0), ("max_contacts", 2**32 - 1), ("sor_pgs_w", 1e300)]
        for name, value in wrong:
            asked = {"time_step": 0.002, "gravity": (1.0, 2.0, 3.0), "cfm": 0.5, "rate" if name == "max_update_rate" else name: value}
            self.refused(self.sim.set_physics(**asked), "SetPhysicsProperties: ", name, f"{value:g}")
        self.refused(self.sim.set_physics(gravity=(0, NAN, 0), time_step=0.002), "nan")
        self.assertEqual(self.sim.physics(), before)
        self.assertEqual(self.sim.step(2).sim_time.to_nsec(), 2_000_000)

    def test_a_slow_rate_does_not_outlast_the_next_one(self):
        self.done(self.sim.set_physics(rate=0.001))
        self.sim.empty("unpause_physics")
        self.wait(lambda: self.sim.world().sim_time > 0.0)  # the next step is due in a quarter of an hour
        self.done(self.sim.set_physics(rate=1000.0))
        self.wait(lambda: self.sim.world().sim_time > 0.1)
        self.sim.empty("pause_physics")

    def test_dynamic_reconfigure(self):
        from dynamic_reconfigure.client import Client

        client = Client("/gazebo", timeout=60)
        names = {parameter["name"] for parameter in client.get_parameter_descriptions(60)}
        self.assertLessEqual({"time_step", "max_update_rate", "gravity_z", "sor_pgs_iters", "max_contacts"}, names)
        client.update_configuration({"gravity_x": 2.5, "sor_pgs_iters": 77})
        physics = self.sim.physics()
        self.assertEqual((physics.gravity.x, physics.ode_config.sor_pgs_iters), (2.5, 77))
        self.assertEqual(rospy.get_param("/gazebo/gravity_x"), 2.5)
        client.update_configuration({"gravity_x": 0.0, "sor_pgs_iters": 50})

    def test_dynamic_reconfigure_shows_and_starts_from_what_is(self):
        from dynamic_reconfigure.client import Client

        client = Client("/gazebo", timeout=60)
        self.done(self.sim.set_physics(time_step=0.002, rate=5000.0, gravity=(0.0, 0.0, -3.7)))
        self.wait(lambda: client.get_configuration(60)["max_update_rate"] == 5000.0)  # beyond what a client may ask for
        self.assertEqual([rospy.get_param(f"/gazebo/{name}") for name in ("time_step", "gravity_z")], [0.002, -3.7])
        client.update_configuration({"sor_pgs_w": 1.2})
        physics = self.sim.physics()
        self.assertEqual((physics.time_step, physics.max_update_rate, physics.gravity.z), (0.002, 5000.0, -3.7))
        for wrong in ({"sor_pgs_iters": 0}, {"time_step": 0.0}, {"time_step": 10.0, "gravity_z": 1.0}):
            answer = client.update_configuration(wrong)  # an answer, not an error
            self.assertEqual((answer["sor_pgs_iters"], answer["time_step"], answer["gravity_z"]), (50, 0.002, -3.7))
        self.assertEqual(self.sim.physics(), physics)
        self.done(self.sim.set_physics())


if __name__ == "__main__":
    rospy.init_node("services_rostest")
    rostest.rosrun("gazebo_ros", "services", "__main__")

#!/usr/bin/env python3
"""gzclient as a user starts it, and Debian's Chromium: real clicks, and what they did is asked by ROS."""

import json
import math
import os
import re
import subprocess
import sys
from urllib.parse import urlsplit

import numpy as np
import rospy
import rostest
from controller_manager_msgs.msg import ControllerState, HardwareInterfaceResources
from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerResponse
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Pose, Twist, Vector3
from ode_sim_viewer.porter import entitled
from std_msgs.msg import ColorRGBA, Float64
from visualization_msgs.msg import Marker

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, share, wait  # noqa: E402
from session import FIELD, HERE, Session, call, material, names, paused, position, sides, sim_time, streams, world, yaw  # noqa: E402

EVIL = "<img src=x onerror=document.title='owned'>"
OLD = (
    "<sdf version='1.6'><model name='old'><static>1</static>"
    + "".join(
        f"""<link name='{name}'><collision name='{name}_Collision'>
    <pose>0 0 1.25 0 -0 0</pose><geometry><box><size>4 0.15 2.5</size></box></geometry></collision></link>"""
        for name in ("Wall_0", "Roof_0")
    )
    + "</model></sdf>"
)
# of mbot_gazebo's room.world, between the middles of its walls; one stands askew
CORNERS = ((-2.75, -2.45), (5.6, -2.45), (5.6, 2.4), (-0.75, 2.4), (-0.75, 0.05), (-5.6, 0.05), (-5.6, -1.8), (-5.6, -2.4))


ASK = """
import http.client, json, sys
for path, words in json.loads(sys.argv[2]):
    near = http.client.HTTPConnection("127.0.0.1", int(sys.argv[1]), timeout=60)
    near.putrequest("GET", path, skip_host="Host" in words)
    for name, value in words.items():
        near.putheader(name, value)
    near.endheaders()
    answer = near.getresponse()
    print(json.dumps([answer.status, answer.getheader("Set-Cookie", "").partition(";")[0]]))
    near.close()
"""


def strangers(port, asked, cookies=False):
    """What another user of this machine, where root runs the test, is answered: status, with the cookie where that is wanted.

    :param asked: (path, headers)
    """
    other = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.geteuid() == 0 else []
    words = [*other, "/usr/bin/python3", "-I", "-c", ASK, str(port), json.dumps(asked)]
    done = subprocess.run(words, cwd="/", stdout=subprocess.PIPE, text=True, check=True, timeout=120)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    return [tuple(answer) if cookies else answer[0] for answer in answers]


def command_line(pid):
    try:
        with open(f"/proc/{pid}/cmdline", encoding="utf-8", errors="replace") as file:
            return file.read()
    except OSError:
        return ""


class Clicks(Session):
    def test_1_play_and_pause(self):
        page = self.page
        page.see("Iterations", "paused", EVIL)  # a name with markup in it, as text
        self.assertNotEqual(page.driver.title, "owned")
        self.assertTrue(streams())
        page.click("Play")
        wait(lambda: not paused(), "play")
        page.see("real-time factor")
        page.click("Pause")
        wait(paused, "pause")
        page.fill("Steps", 25)
        page.click("Reset world")  # time and models
        page.see("Iterations 0")
        page.click("Step")
        page.see("Iterations 25")

    def test_1b_a_body_is_pulled_and_filmed(self):
        from selenium.webdriver.common.keys import Keys

        page = self.page
        page.click("box")
        page.see("Mass (kg)")
        before = page.scene()
        page.click("Look at")
        page.settled(before)
        page.click("Record")
        page.click("Film")
        page.see("Stop and keep the film")
        page.click("Play")
        wait(lambda: not paused(), "play")
        begin, middle = position("box"), page.canvas(0.5, 0.5)
        page.mouse(middle, page.canvas(0.65, 0.5), page.canvas(0.65, 0.35), drag=True, keys=(Keys.CONTROL,), hold=1.5)
        wait(lambda: np.linalg.norm(position("box") - begin) > 0.02, "the box where it was pulled to")
        page.click("Pause")
        wait(paused, "pause")
        page.click("Stop and keep the film")
        film = page.downloaded(".mp4")
        self.assertEqual(film[4:8], b"ftyp")
        page.click("Reset world")
        page.see("Iterations 0")
        page.click("Step")
        page.see("Iterations 25")
        page.click("World")

    def test_1c_a_frame_that_is_over_may_be_called_off(self):
        """The browser counts its frames itself: what the page calls off by its own number is another frame."""
        script, _ = re.findall("<script>(.*?)</script>", entitled(b"<title>Viser</title>", "t").decode(), re.DOTALL)
        self.assertEqual(
            self.page.driver.execute_script(
                """
            const frames = [], told = [], ends = [];
            const browser = {requestAnimationFrame: f => frames.push(f), cancelAnimationFrame: key => { delete frames[key - 1]; },
                             Worker: class {}};
            const start = new Function("window", "document", "setTimeout", "clearTimeout", "setInterval", arguments[0]);
            start(browser, {querySelector: () => null}, f => ends.push(f), key => { delete ends[key - 1]; }, () => {});
            const request = word => browser.requestAnimationFrame(() => told.push(word));
            const turn = () => { ends.splice(0).forEach(f => f()); const f = frames[frames.length - 1]; if (f) f(0); };
            request("a"), request("b");
            browser.requestAnimationFrame(() => browser.cancelAnimationFrame(browser.late));
            browser.late = request("never");
            turn();
            request("c");
            ends.splice(0).forEach(f => f());
            browser.cancelAnimationFrame(frames.length);
            turn();
            return told;""",
                script,
            ),
            ["a", "b", "c"],
        )

    def test_1d_a_hand_moves_and_turns_a_body_by_the_gizmo(self):
        page, begin = self.page, position("box")
        page.click("World")
        page.click("box")
        page.see("Mass (kg)")
        page.check("Move and rotate by hand")
        page.fill("Snap to (m)", 0.25)
        page.fill("Snap to (deg)", 15)
        before = page.scene()
        page.click("Look at")
        page.click("Corner")
        page.settled(before)
        shown = page.scene()
        eye = begin + 2.5 * np.array((0.7, -0.7, 0.4))  # of Look at and Corner

        def drag(*offsets):
            page.mouse(*(page.pixel(begin + offset, eye, begin, FIELD) for offset in offsets), drag=True)

        drag((0.0, 0.62, 0.0), (0.0, 0.3, 0.0), (0.0, -0.1, 0.0))  # the arrow behind the box, seen and gripped through it
        wait(lambda: position("box")[1] < begin[1] - 0.1, "moved along y")
        np.testing.assert_allclose(position("box"), begin - (0.0, 0.75, 0.0), atol=1e-3)
        page.click("Undo")
        wait(lambda: np.abs(position("box") - begin).max() < 1e-4, "undo")
        page.click("Redo")
        wait(lambda: np.abs(position("box") - begin).max() > 0.1, "redo")
        page.settled(shown)
        moved = page.scene()
        page.click("Undo")
        wait(lambda: np.abs(position("box") - begin).max() < 1e-4, "undo")
        page.settled(moved)  # the handles are where they were, too
        drag(*(0.455 * np.array((math.cos(turn), math.sin(turn), 0.0)) for turn in (0.8, 0.5, 0.2)))  # the arc about z
        wait(lambda: abs(yaw("box")) > 0.1, "turned about z")
        self.assertAlmostEqual(math.degrees(yaw("box")) / 15, round(math.degrees(yaw("box")) / 15), places=3)
        page.click("Undo")
        wait(lambda: abs(yaw("box")) < 1e-6, "undo of the turn")
        page.check("Move and rotate by hand")
        page.fill("Snap to (m)", 0)

    def test_1e_a_button_that_is_pressed_at_once_does_not_lose_what_was_typed(self):
        """The sender of the program that this page runs, with a clock of the test's."""
        sent = self.page.driver.execute_script("""
            const program = [...document.scripts].map(s => s.textContent).sort((a, b) => b.length - a.length)[0];
            const end = program.search(/return\\{send:\\w,flush:\\w,cancel:\\w\\}\\}/), before = program.slice(end - 1500, end);
            const begin = [...before.matchAll(/function [\\w$]+\\(\\w,\\w\\)\\{let \\w=!0,/g)].pop().index;
            const text = before.slice(begin) + program.slice(end, program.indexOf("}}", end) + 2);
            const sent = [], ends = [], turn = () => ends.splice(0).forEach(f => f());
            const viewer = {mutable: {current: {sendMessage: message => sent.push(message.uuid + message.value)}}};
            const make = new Function("setTimeout", "clearTimeout", `return ${text}`);
            const sender = make(f => ends.push(f), () => ends.splice(0))(viewer, 50);
            const say = (uuid, value) => sender.send({type: "GuiUpdateMessage", uuid, value});
            say("mass", 2), say("mass", 20), say("mass", 200), say("step", true);
            turn();
            say("a", 1), say("a", 2), say("b", 3), say("b", 4), sender.flush();
            turn(), turn();
            say("undo", true), say("undo", true), say("undo", true);
            turn(), turn();
            return sent;""")
        self.assertEqual(sent, ["mass2", "mass200", "steptrue", "a2", "b4", *3 * ["undotrue"]])

    def test_1f_a_hand_resizes_a_body_by_its_knobs(self):
        page, begin = self.page, position("box")
        eye = begin + 2.5 * np.array((0.7, -0.7, 0.4))  # as test_1d left it

        def drag(*offsets):
            page.mouse(*(page.pixel(begin + offset, eye, begin, FIELD) for offset in offsets), drag=True)

        page.fill("Snap to (m)", 0.25)
        before = page.scene()
        page.check("Resize by hand")
        page.settled(before)
        drag((0.62, 0.0, 0.0), (0.8, 0.0, 0.0), (1.03, 0.0, 0.0))
        wait(lambda: sides("box") == (1.75, 1.0, 1.0), "2 x (1.03 - 0.12) m on a grid of 0.25 m")
        wait(lambda: page.value("Size (m)") == "1.75", "the field tells of it")
        np.testing.assert_allclose(position("box"), begin, atol=1e-6)
        page.click("Undo")
        wait(lambda: sides("box") == (1.0, 1.0, 1.0), "undo")
        wait(lambda: page.value("Size (m)") == "1", "the field tells of it")
        page.check("Resize by hand")
        page.fill("Snap to (m)", 0)

    def test_2_pick_copy_delete_undo(self):
        page = self.page
        page.click("box")
        page.see("Mass (kg)", "Friction")
        page.click("Copy")
        wait(lambda: "box_0" in names(), "a copy")
        page.click("Undo")
        wait(lambda: "box_0" not in names(), "undo")
        page.click("Redo")
        wait(lambda: "box_0" in names(), "redo")
        page.click("box_0")  # at once, while the tree is drawn anew
        wait(lambda: page.text().count("box_0") > 1, "properties of the copy")
        page.click("Delete")
        wait(lambda: "box_0" not in names(), "delete")
        page.click("Undo")
        wait(lambda: "box_0" in names(), "undo of delete")
        wait(lambda: page.text().count("box_0") > 1, "the page knows of it")
        page.click("Copy")
        page.click("Copy")
        page.see("box_2")
        place = page.place("Undo")
        for name in ("box_2", "box_1"):  # a hand that stays where it is, while the list gets shorter
            page.mouse(place)
            wait(lambda name=name: name not in names(), f"undo of {name}")
            wait(lambda name=name: name not in page.text(), f"a list without {name}")

    def test_2b_colours_are_typed_and_undone(self):
        page = self.page
        page.click("sun")
        page.see("Shines along")
        usual = world().lights[0].diffuse
        for text, wanted in (("rgb(10, 20, 30)", (10, 20, 30)), ("#fff000", (255, 240, 0))):
            page.fill("Colour", text)
            page.fill("Highlights", "#%02x4080" % wanted[0])  # at once, before the page knows of the first
            wait(lambda: round(255 * world().lights[0].specular[0]) == wanted[0], "the other colour")
            np.testing.assert_allclose(world().lights[0].diffuse[:3], np.array(wanted) / 255, atol=1e-6)
        for _ in range(4):
            page.click("Undo")
        wait(lambda: np.allclose(world().lights[0].diffuse, usual), "undo of both colours")
        page.click("box")
        page.see("Mass (kg)")
        page.fill("Colour", "rgba(0, 0, 255, 1)")
        wait(lambda: material("box").diffuse == (0.0, 0.0, 1.0, 1.0), "a blue box")
        page.click("Undo")
        wait(lambda: material("box").name == "Gazebo/Red", "the look that it had")
        wait(lambda: page.value("Colour").startswith("rgba(255, 0, 0"), "the field tells of it")

    def test_3_insert(self):
        page = self.page
        page.click("Insert")
        page.fill("Search", "cafe_ta")
        page.click("cafe_table")
        page.see("click where it shall stand")
        page.hover(page.canvas(0.4, 0.7))
        page.see("cafe_table at")  # under the pointer, before the click
        self.assertNotIn("cafe_table", names())
        page.mouse(page.canvas(0.5, 0.75))
        wait(lambda: "cafe_table" in names(), "a model of the model path")
        page.see("cafe_table is at")
        said = re.search(r"cafe_table is at (\S+), (\S+) m", page.text())
        np.testing.assert_allclose(position("cafe_table")[:2], [float(part) for part in said.groups()], atol=0.006)
        page.check("Put it down with the mouse")
        page.click("Cylinder")
        wait(lambda: "unit_cylinder" in names(), "a cylinder")
        np.testing.assert_allclose(position("unit_cylinder"), (0.0, 0.0, 0.5), atol=1e-6)

    def test_4_go_back_in_time(self):
        page = self.page
        page.click("Timeline")
        page.click("Keep this moment")
        page.see("1 moment,")
        page.fill("Steps", 200)
        page.click("Step")
        page.see("Iterations 225")
        page.click("First")
        page.see("Iterations 25")

    def test_5_overlays(self):
        page = self.page
        page.click("Scene")
        for kind in ("Collisions", "Centres of mass", "Inertias", "Joints", "Link frames", "Labels", "Contacts"):
            page.check(kind)
        wait(lambda: streams("/gazebo/view_contacts"), "contacts are asked for")
        page.check("Contacts")  # the arrows of forces need not be at rest
        wait(lambda: not streams("/gazebo/view_contacts"), "contacts are not asked for any more")
        page.click("Show all")
        page.click("TF")
        page.check("TF frames")
        cube = Marker(type=Marker.CUBE, ns="test", scale=Vector3(1.0, 1.0, 1.0), color=ColorRGBA(1.0, 1.0, 0.0, 1.0))
        cube.header.frame_id, cube.pose.position.z = "leaf", 1.0
        markers = rospy.Publisher("/test_marker", Marker, queue_size=1, latch=True)
        markers.publish(cube)
        page.click("Markers")
        page.click("Look for markers")
        page.see("/test_marker")
        before = share(page.scene(), (255, 255, 0))
        page.check("/test_marker")
        wait(lambda: share(page.scene(), (255, 255, 0)) > before + 200, "a yellow cube")
        wait(lambda: markers.get_num_connections(), "the page listens")
        page.check("/test_marker")
        wait(lambda: not markers.get_num_connections(), "the page does not listen any more")
        wait(lambda: share(page.scene(), (255, 255, 0)) < before + 50, "no cube")

    def test_5b_controllers_are_listed_stopped_and_commanded(self):
        """The controller manager is the test's; so are the names."""
        asked, told = [], []
        state = ControllerState(
            name="door_controller",
            type="position_controllers/JointPositionController",
            state="running",
            claimed_resources=[HardwareInterfaceResources("position", ["hinge"])],
        )
        other = ControllerState(name=EVIL, type="x/Y", state="stopped")

        def switch(request):
            asked.append((request.start_controllers, request.stop_controllers))
            state.state = "running" if request.start_controllers else "stopped"
            return SwitchControllerResponse(ok=True)

        services = [
            rospy.Service("/lab/controller_manager/list_controllers", ListControllers, lambda _: [[state, other]]),
            rospy.Service("/lab/controller_manager/switch_controller", SwitchController, switch),
        ]
        rospy.Subscriber("/lab/door_controller/command", Float64, lambda message: told.append(message.data))
        page = self.page
        page.click("Controllers")
        page.click("Look for controllers")
        page.see("/lab/door_controller", f"/lab/{EVIL}", "door_controller hinge")
        page.fill("door_controller hinge", 1.2)
        wait(lambda: told and abs(told[-1] - 1.2) < 0.003, "the command")
        page.check("/lab/door_controller")
        wait(lambda: asked == [([], ["door_controller"])], "a stop")
        wait(lambda: "door_controller hinge" not in page.text(), "no slider of a controller that is stopped")
        page.check("/lab/door_controller")
        page.see("door_controller hinge")
        self.assertEqual(asked[1:], [(["door_controller"], [])])
        self.assertNotEqual(page.driver.title, "owned")
        for service in services:
            service.shutdown()

    def test_6_the_room_of_the_mobile_robot_course_is_drawn_saved_and_put_into_the_world(self):
        page = self.page
        old = os.path.join(self.home.name, "building_editor_models", "old")  # as Gazebo's editor leaves it
        os.makedirs(old)
        with open(os.path.join(old, "model.sdf"), "w", encoding="utf-8") as stream:
            stream.write(OLD)
        page.click("Building")
        before = page.scene()
        page.check("Edit a building")
        page.fill("Name", "room")
        page.unfold("Snap")
        page.fill("Length (m)", 0.05)

        def at(x, y):  # seen from above; see BuildingPanel._look
            return page.pixel((x, y, 0.0), (0.0, -0.01, 13.0), (0.0, 0.0, 0.0), FIELD)

        page.settled(before)
        page.mouse(at(*CORNERS[0]), at(*CORNERS[1]), drag=True)
        page.see("1 wall on 1 level")
        before = page.scene()
        page.mouse(at(*CORNERS[1]))
        page.settled(before)  # a ball where the path begins
        for walls, corner in enumerate((*CORNERS[2:], CORNERS[0]), 2):
            page.mouse(at(*corner))
            page.see(f"{walls} walls on 1 level")  # a page takes no click while it draws what the one before it made
        page.choose("Tool", "Door")
        page.mouse(page.pixel((0.0, -2.45, 2.5), (0.0, -0.01, 13.0), (0.0, 0.0, 0.0), FIELD))
        page.see("Picked: door")
        page.click("Save")
        page.see("saved in")
        folder = os.path.join(self.home.name, "building_editor_models", "room")
        self.assertEqual(sorted(os.listdir(folder)), ["model.config", "model.sdf", "plan.yaml", "preview.png", "room.world"])
        from building_editor.building import read_plan

        (level,) = read_plan(os.path.join(folder, "plan.yaml")).levels
        np.testing.assert_allclose([wall.start for wall in level.walls], CORNERS, atol=1e-6)
        np.testing.assert_allclose([wall.end for wall in level.walls], [*CORNERS[1:], CORNERS[0]], atol=1e-6)
        np.testing.assert_allclose([wall.length for wall in level.walls], (8.35, 4.85, 6.35, 2.35, 4.85, 1.85, 0.6, 2.8504), atol=1e-4)
        self.assertEqual([opening.kind for wall in level.walls for opening in wall.openings], ["door"])
        page.click("Put into the world")
        wait(lambda: "room" in names(), "the building in the world")
        page.choose("Saved", "old")
        page.click("Open")
        page.see("1 wall on 1 level; not understood, and lost when it is saved under this name: Roof_0")
        page.check("Edit a building")
        page.click("World")
        page.see("room")

    def test_7_reconnects_and_another_page(self):
        page = self.page
        for _ in range(4):
            page.driver.refresh()
            page.see("Iterations", "unit_cylinder")
        with Browser(page.address, frames=2) as other:
            other.see("Iterations", "unit_cylinder")
            other.click("Play")
            wait(lambda: not paused(), "play from the other page")
            page.see("real-time factor")
            page.check("Hold the controls")
            other.click("Pause")
            other.see("Another page holds the controls")
            page.check("Hold the controls")
            page.click("Pause")
            wait(paused, "pause from the first page")

    def test_7b_whoever_does_not_show_the_token_stays_outside(self):
        """Another user of this machine, by http and by the websocket that all of the page goes through, and a browser of his."""
        address, token = self.page.address.split("?token=")
        place = urlsplit(address)
        upgrade = {
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        }
        asked = [
            (path, {**more, **words})
            for path in ("/", "/?token=", f"/?token={token[:-1]}", "/index.html", "//", "/x/../", "/link/Plots%20and%20topics")
            for more in ({}, upgrade)
            for words in ({}, {"Origin": address.rstrip("/")}, {"Cookie": "viewer_0=x"})
        ]
        asked += [(f"/?token={token}", {"Host": "evil.example"}), (f"/?token={token}", {**upgrade, "Origin": "http://evil.example"})]
        self.assertEqual(strangers(place.port, asked), [403] * len(asked))
        with Browser(address, frames=2) as other:
            other.see("open this page with the address that the terminal printed")
            self.assertNotIn("Iterations", other.text())
        ((status, cookie),) = strangers(place.port, [(f"/?token={token}", {})], cookies=True)
        self.assertEqual(status, 303)
        self.assertEqual(strangers(place.port, [("/", {"Cookie": cookie}), ("/", {"Cookie": cookie, **upgrade})]), [200, 101])
        shown = [words for words in map(command_line, filter(str.isdigit, os.listdir("/proc"))) if "gzclient" in words and token in words]
        self.assertEqual(shown, [], "everybody can read command lines")

    def test_8_the_server_ends_and_a_robot_drives_in_the_room_that_was_drawn(self):
        self.end(self.server)
        self.page.see("no simulator answers")
        file = os.path.join(self.home.name, "building_editor_models", "room", "room.world")
        type(self).server = self.start("roslaunch", "gazebo_ros", "empty_world.launch", f"world_name:={file}", "gui:=false")
        self.page.see("real-time factor", "room")
        wait(lambda: "unit_cylinder" not in self.page.text(), "the models of the new world only")
        with open(os.path.join(HERE, "cart.sdf"), encoding="utf-8") as stream:
            answer = call("spawn_sdf_model", SpawnModel, "cart", stream.read(), "/", Pose(), "world")
        self.assertTrue(answer.success, answer.status_message)
        self.page.see("cart")
        self.drive(-1.0)
        wait(lambda: position("cart")[1] < -3.0, "the cart behind the door")
        self.drive(1.0)
        wait(lambda: position("cart")[1] > 2.0, "the cart back in the room")
        until = sim_time() + 1.0
        wait(lambda: sim_time() > until, "a second more")
        self.assertLess(position("cart")[1], 2.2)  # half of it before the face of the wall at 2.325
        self.page.click("Pause")
        wait(paused, "pause of the new server")

    def drive(self, speed):
        if not hasattr(self, "commands"):
            type(self).commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        self.commands.publish(Twist(linear=Vector3(x=speed)))

    def test_9_closing_the_page_ends_the_stream(self):
        self.page.close()  # a page that is only left may be kept by the browser, to go back to
        wait(lambda: not streams(), "the end of the stream: nobody looks")
        self.assertIsNone(self.client.poll())


if __name__ == "__main__":
    rospy.init_node("browser_test", disable_rostime=True)
    rostest.rosrun("gzclient", "browser", "__main__")

#!/usr/bin/env python3
"""What a camera costs: the arm seen by an 800x800 camera, drawn, sent from the render process, and published at 30 Hz.

    scripts/benchmarks/camera.py                   a table
    scripts/benchmarks/camera.py --json out.json   the same, for programs

``frame`` is a colour picture of the renderer, ``bare draw`` the same triangles in one colour each, without light, drawn
and read back by the shortest program that does it: the floor that no renderer on this machine can go below.
"""

import argparse
import json
import math
import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

SIZE = 800
FRAMES = 60

SUBSCRIBER = """
import sys, threading, time, rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Image
rospy.init_node("camera_bench", disable_rostime=True)
stamps, clock = [], [0.0]
rospy.Subscriber("/camera/image_raw", Image, lambda m: stamps.append(m.header.stamp.to_sec()), buff_size=1 << 24)
rospy.Subscriber("/clock", Clock, lambda m: clock.__setitem__(0, m.clock.to_sec()), buff_size=1 << 20)
end = time.monotonic() + 60
while len(stamps) < 30 and time.monotonic() < end:
    time.sleep(0.1)
wall, sim, first = time.monotonic(), clock[0], len(stamps)
time.sleep(float(sys.argv[1]))
wall, sim = time.monotonic() - wall, clock[0] - sim
print(sim / wall if sim else 0.0, (len(stamps) - first) / sim if sim else 0.0)
"""


def arm_scene():
    """(scene, link poses, camera) of the arm on its floor under the sun."""
    import rospkg
    from ode_sim.description import ResourceFinder, read_urdf
    from ode_sim.description.model import Light, Link, Material, Model, Plane, Pose, Visual
    from ode_sim_rendering import Camera, arrange, look_at

    pack = rospkg.RosPack()
    file = os.path.join(pack.get_path("arm_description"), "urdf", "arm.urdf.xacro")
    text = subprocess.run(["xacro", file], check=True, capture_output=True, text=True).stdout
    arm, _ = read_urdf(text, finder=ResourceFinder([], [], pack.get_path))
    grey = Material(ambient=(0.3, 0.3, 0.3, 1.0), diffuse=(0.7, 0.7, 0.7, 1.0))
    floor = Model("ground_plane", links=(Link("link", visuals=(Visual("floor", Pose(), Plane(size=(100, 100)), grey),)),))
    sun = Light("sun", "directional", Pose((0, 0, 10)), diffuse=(0.8, 0.8, 0.8, 1.0), direction=(-0.5, 0.1, -0.9), cast_shadows=True)
    scene, poses = arrange([floor, arm], [sun])
    camera = Camera(width=SIZE, height=SIZE, hfov=0.5, near=0.02, far=300, pose=look_at((0.7, -0.6, 0.45), (0, 0, 0.2)))
    return scene, poses, camera


class BareDraw:
    """The scene's triangles at fixed places, one colour each, and the picture read back."""

    def __init__(self, scene, poses, camera):
        from ode_sim_rendering import create_context
        from ode_sim_rendering.assets import Assets
        from ode_sim_rendering.renderer import Renderer, pose_matrices

        self.ctx = create_context()
        program = self.ctx.program(
            vertex_shader="#version 330\nin vec3 p; uniform mat4 m; void main() { gl_Position = m * vec4(p, 1.0); }",
            fragment_shader="#version 330\nuniform vec4 c; out vec4 o; void main() { o = c; }",
        )
        clip = Renderer._projection(camera, SIZE, SIZE) @ np.linalg.inv(pose_matrices(np.array(camera.pose.p + camera.pose.q))[0])
        assets, self.draws = Assets(), []
        for seen in scene.visuals:
            for part in assets.parts(seen.visual, seen.name):
                local = pose_matrices(np.array(part.pose.p + part.pose.q))[0] @ np.diag([*part.scale, 1.0])
                matrix = clip @ pose_matrices(poses[seen.link])[0] @ local
                mesh = assets.meshes[part.key]
                vertices = self.ctx.buffer(mesh.vertices.astype("f4").tobytes())
                array = self.ctx.vertex_array(program, [(vertices, "3f", "p")], self.ctx.buffer(mesh.triangles.astype("u4").tobytes()))
                self.draws.append((array, matrix.T.astype("f4").tobytes(), (*part.look.diffuse, 1.0)))
        self.program = program
        self.triangles = sum(array.vertices // 3 for array, _, _ in self.draws)
        self.frame = self.ctx.framebuffer([self.ctx.renderbuffer((SIZE, SIZE))], self.ctx.depth_renderbuffer((SIZE, SIZE)))

    def __call__(self):
        with self.ctx:
            self.frame.use()
            self.frame.clear(0.7, 0.7, 0.7, 1.0)
            self.ctx.enable_only(self.ctx.DEPTH_TEST | self.ctx.CULL_FACE)
            self.ctx.front_face = "cw"
            for array, matrix, colour in self.draws:
                self.program["m"].write(matrix)
                self.program["c"].value = colour
                array.render()
            return self.frame.read(components=4)


def draw_costs():
    """Milliseconds of a frame, with and without shadows, and of a bare draw; taken in turns, medians."""
    from ode_sim_rendering import Renderer

    scene, poses, camera = arm_scene()
    renderers = {"frame": Renderer(shadows="off"), "frame with shadow": Renderer(shadows="on")}
    for renderer in renderers.values():
        renderer.set_scene(scene)
    bare = BareDraw(scene, poses, camera)
    times = {name: [] for name in (*renderers, "bare draw")}
    for number in range(FRAMES + 5):
        moved = poses.copy()
        moved[1:, 2] += 1e-4 * math.sin(number)  # or the shadow would be drawn only once
        for name, draw in (*((name, lambda r=r: r.color(camera, moved)) for name, r in renderers.items()), ("bare draw", bare)):
            start = time.perf_counter()
            draw()
            times[name].append(1e3 * (time.perf_counter() - start))
    result = {f"{name}, ms": statistics.median(values[5:]) for name, values in times.items()}
    result["frame / bare draw"] = statistics.median(a / b for a, b in zip(times["frame"][5:], times["bare draw"][5:]))
    result["triangles"] = bare.triangles
    result["device"] = renderers["frame"].device
    for renderer in renderers.values():
        renderer.close()
    return result


def process_rate():
    """Frames per second from the render process with noise, each waited for."""
    import ode_sim
    import rospkg
    from ode_sim.description import ResourceFinder
    from ode_sim_rendering import Camera, RenderProcess, look_at

    pack = rospkg.RosPack()
    file = os.path.join(pack.get_path("arm_description"), "urdf", "arm.urdf.xacro")
    text = subprocess.run(["xacro", file], check=True, capture_output=True, text=True).stdout
    world = ode_sim.World(finder=ResourceFinder([], [], pack.get_path))
    world.spawn_urdf(text, name="arm")
    camera = Camera(width=SIZE, height=SIZE, hfov=0.5, near=0.02, far=300, noise_stddev=0.007, pose=look_at((0.7, -0.6, 0.45), (0, 0, 0.2)))
    studio = RenderProcess(world, print)
    key = studio.add_camera(camera)
    studio.draw(key, ("image",), lambda frame: None, wait=True)
    start = time.perf_counter()
    for _ in range(FRAMES):
        world.step(1)
        studio.draw(key, ("image",), lambda frame: None, wait=True)
    rate = FRAMES / (time.perf_counter() - start)
    studio.close()
    return {"uncapped, frames/s": rate}


def real_time_factor(seconds):
    """Of arm_gazebo.launch with its camera subscribed, and the camera's rate in sim time."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        command = ["roslaunch", "-p", str(port), "arm_gazebo", "arm_gazebo.launch", "gui:=false", "rviz:=false"]
        launch = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            out = subprocess.run(
                [sys.executable, "-c", SUBSCRIBER, str(seconds)], env=environment, capture_output=True, text=True, timeout=90 + seconds
            )
            factor, rate = (float(word) for word in out.stdout.split()[-2:])
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(timeout=30)
    return {"real-time factor": factor, "camera rate, Hz of sim time": rate}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", metavar="FILE", help="write the figures there as well")
    parser.add_argument("--seconds", type=float, default=10.0, help="wall time of the real-time measurement")
    options = parser.parse_args()
    figures = {**draw_costs(), **process_rate(), **real_time_factor(options.seconds)}
    for name, value in figures.items():
        print(f"{name:32} {value if isinstance(value, str) else f'{value:10.4g}'}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(figures, out, indent=2)


if __name__ == "__main__":
    main()

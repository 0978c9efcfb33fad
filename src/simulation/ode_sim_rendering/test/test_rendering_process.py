"""The render process: same bytes as in-process drawing, no frame lost when waited for, no orphan, one line per
trouble."""

import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import zlib
from dataclasses import replace
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from ode_sim.description.model import Box, Heightmap, Light, Link, Material, Mesh, Model, Pose, Scene, Sphere, Visual
from ode_sim_rendering import Camera, Renderer, RenderProcess, arrange, render, segment_names
from ode_sim_rendering.image import add_noise, cloud, encode

WHITE = Scene(ambient=(1, 1, 1, 1), background=(0, 0, 1, 1), shadows=False)
CAMERA = Camera(width=64, height=48, hfov=1.0, near=0.05, far=20.0)


def shape(name, geometry, p, rgb):
    colour = tuple(float(c) for c in rgb) + (1.0,)
    return Visual(name, Pose(p), geometry, Material(ambient=colour, diffuse=colour))


class World:
    """As much of ode_sim.World as a camera looks at."""

    def __init__(self, *models, seed=0):
        self.scene, self.lights, self.seed = WHITE, {}, seed
        self.models, self.on_spawn, self.on_remove, self.messages = {}, [], [], []
        self.time_ns = 0
        self.link_poses = np.zeros((0, 7))
        for model in models:
            self.spawn(model)

    def spawn(self, model):
        first = len(self.link_poses)
        links = {
            link.name: SimpleNamespace(
                index=first + i,
                scoped_name=f"{model.name}::{link.name}",
                description=link,
                lights={light.name: light for light in link.lights},
            )
            for i, link in enumerate(model.links)
        }
        self.models[model.name] = SimpleNamespace(name=model.name, description=model, links=links)
        self.link_poses = np.concatenate([self.link_poses, arrange([model])[1]])
        for callback in self.on_spawn:
            callback(self.models[model.name])


def ball(name, p, rgb):
    return Model(name, links=(Link("link", visuals=(shape("ball", Sphere(0.3), p, rgb),)),))


@pytest.fixture
def studio_of():
    made = []

    def make(world):
        lines = []
        studio = RenderProcess(world, lines.append)
        made.append(studio)
        return studio, lines

    yield make
    for studio in made:
        studio.close()


def take(studio, key, outputs=("image",)):
    """One waited-for frame, copied out of shared memory."""
    taken = []
    assert studio.draw(
        key, outputs, lambda frame: taken.append((frame.error, {name: bytes(data) for name, data in frame.data.items()})), wait=True
    )
    ((error, data),) = taken
    assert error == ""
    return data


def test_the_same_bytes_as_in_this_process(studio_of):
    world = World(ball("a", (2, 0.3, 0), (1, 0, 0)), ball("b", (2, -0.4, 0.2), (0, 1, 0)))
    camera = Camera(width=64, height=48, hfov=1.0, noise_stddev=0.02, name="eye")
    studio, _ = studio_of(world)
    key = studio.add_camera(camera)
    for step in range(3):
        world.time_ns = step * 33_000_000
        world.link_poses[0, 0] += 0.01
        expected = render(world, camera)
        assert len(np.unique(expected.reshape(-1, 3), axis=0)) > 50  # the noise is there
        assert take(studio, key)["image"] == expected.tobytes()


@pytest.mark.slow
def test_two_processes_two_runs_same_bytes(studio_of):
    runs = []
    for _ in range(2):
        world = World(ball("a", (2, 0, 0), (1, 0, 0)), seed=7)
        studio, _ = studio_of(world)
        key = studio.add_camera(Camera(noise_stddev=0.01, name="eye"))
        frames = []
        for step in (5, 6, 9):
            world.time_ns = step
            frames.append(take(studio, key)["image"])
        runs.append(frames)
    assert runs[0] == runs[1]
    assert len(set(runs[0])) == 3  # noise differs from frame to frame
    other = World(ball("a", (2, 0, 0), (1, 0, 0)), seed=8)
    studio, _ = studio_of(other)
    other.time_ns = 5
    assert take(studio, studio.add_camera(Camera(noise_stddev=0.01, name="eye")))["image"] != runs[0][0]


def test_what_comes_later_is_seen(studio_of):
    world = World()
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)

    def centre():
        return tuple(np.frombuffer(take(studio, key)["image"], np.uint8).reshape(48, 64, 3)[24, 32])

    assert centre() == (0, 0, 255)
    world.spawn(ball("late", (2, 0, 0), (1, 0, 0)))
    assert centre() == (255, 0, 0)
    world.scene = Scene(ambient=(0, 0, 0, 1), shadows=False)
    assert centre() == (0, 0, 0)
    world.lights["sun"] = Light("sun", "directional", direction=(1, 0, 0))
    assert centre()[0] > 200
    world.lights["sun"] = Light("sun", "directional", direction=(1, 0, 0), diffuse=(0.2, 0.2, 0.2, 1))
    assert 40 < centre()[0] < 60
    del world.lights["sun"]
    beam = Light("beam", "directional", direction=(1, 0, 0))
    carrier = world.models["late"].links["link"]
    carrier.lights["beam"] = beam
    assert centre()[0] > 200
    carrier.lights["beam"] = replace(beam, diffuse=(0.2, 0.2, 0.2, 1))
    assert 40 < centre()[0] < 60


def test_cameras_of_any_size_added_and_removed(studio_of):
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    studio, _ = studio_of(world)
    keys = {}
    for size in (16, 640, 33):
        camera = Camera(width=size, height=size, name=f"c{size}")
        keys[size] = studio.add_camera(camera)
        assert take(studio, keys[size])["image"] == render(world, camera).tobytes()
    studio.remove_camera(keys.pop(640))
    again = Camera(width=640, height=640, hfov=0.5, name="again")
    assert take(studio, studio.add_camera(again))["image"] == render(world, again).tobytes()
    assert len(take(studio, keys[33])["image"]) == 33 * 33 * 3


@pytest.mark.slow
def test_a_camera_that_is_changed(studio_of):
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)
    before = take(studio, key)["image"]
    moved = replace(CAMERA, pose=Pose((0, 0.2, 0)), hfov=0.8)
    studio.change_camera(key, moved)
    assert take(studio, key)["image"] == render(world, moved).tobytes() != before
    os.kill(studio.pid, signal.SIGKILL)
    studio._thread.join(timeout=10)
    assert take(studio, key)["image"] == render(world, moved).tobytes()  # the next process knows of it


def test_fewer_frames_under_way_than_there_is_room_for(studio_of):
    world = World()
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)
    free, got = threading.Event(), []

    def slow(frame):
        assert free.wait(20)
        got.append(frame.time_ns)

    assert studio.draw(key, ("image",), slow, most=1)
    assert not studio.draw(key, ("image",), slow, most=1)
    free.set()
    assert take(studio, key)  # comes after the first one
    assert studio.draw(key, ("image",), slow, wait=True, most=1)
    assert len(got) == 2


@pytest.mark.slow
def test_waited_for_frames_come_in_order_and_none_is_missing(studio_of):
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)
    stamps = []
    for step in range(40):
        world.time_ns = step
        assert studio.draw(key, ("image",), lambda frame: stamps.append(frame.time_ns), wait=True)
        assert stamps[-1] == step
    assert stamps == list(range(40))


@pytest.mark.slow
def test_an_unwaited_frame_shows_its_own_moment(studio_of):
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)
    expected = render(world, CAMERA).tobytes()
    seen = []
    assert studio.draw(key, ("image",), lambda frame: seen.append((frame.time_ns, bytes(frame.data["image"]))))
    world.time_ns, world.link_poses[0, 1] = 10, 5.0  # the physics goes on at once
    take(studio, key)
    assert seen == [(0, expected)]


def test_more_than_eight_frames_under_way_are_left_out(studio_of):
    world = World()
    studio, _ = studio_of(world)
    key = studio.add_camera(CAMERA)
    taken = []
    accepted = [studio.draw(key, ("image",), lambda frame: taken.append(frame.time_ns)) for _ in range(20)]
    assert accepted[:8] == [True] * 8 and not all(accepted)
    other = studio.add_camera(Camera(name="other"))
    take(studio, other)  # answered in order: the others are done
    assert len(taken) == sum(accepted)


def test_compressed_images(studio_of):
    world = World(ball("a", (1, 0.2, 0), (1, 0.5, 0)))
    studio, _ = studio_of(world)
    camera = Camera(width=160, height=120)
    data = take(studio, studio.add_camera(camera), ("image", "jpeg:95", "jpeg:10", "png:3"))
    picture = np.frombuffer(data["image"], np.uint8).reshape(120, 160, 3)
    png = cv2.imdecode(np.frombuffer(data["png:3"], np.uint8), cv2.IMREAD_COLOR)
    jpeg = cv2.imdecode(np.frombuffer(data["jpeg:95"], np.uint8), cv2.IMREAD_COLOR)
    assert np.array_equal(png[..., ::-1], picture)
    assert np.abs(jpeg[..., ::-1].astype(int) - picture).mean() < 3
    assert len(data["jpeg:10"]) < len(data["jpeg:95"]) < len(data["image"]) / 4


@pytest.mark.slow
def test_depth_images_and_cloud(studio_of):
    wall = Model(
        "wall",
        links=(
            Link(
                "link",
                visuals=(
                    shape("wall", Box((0.2, 1.0, 1.0)), (2.1, 0, 0), (1, 0, 0)),
                    shape("near", Box((0.2, 0.1, 0.1)), (0.4, 0.15, 0), (0, 1, 0)),
                ),
            ),
        ),
    )
    studio, _ = studio_of(World(wall))
    key = studio.add_camera(CAMERA, depth_range=(0.4, 5.0))
    data = take(studio, key, ("depth", "depth16", "cloud"))
    metres = np.frombuffer(data["depth"], np.float32).reshape(48, 64)
    millimetres = np.frombuffer(data["depth16"], np.uint16).reshape(48, 64)
    points = np.frombuffer(data["cloud"], np.float32).reshape(48, 64, 8)
    near = tuple(int(round(v)) for v in CAMERA.project([[0.3, 0.15, 0.01]])[0][::-1])
    assert metres[24, 32] == pytest.approx(2.0, abs=1e-4) and millimetres[24, 32] in (1999, 2000)
    assert np.isnan(metres[0, 0]) and millimetres[0, 0] == 0  # the background lies at the far clip, beyond the range
    assert np.isnan(metres[near]) and millimetres[near] == 0 and np.isnan(points[near][:3]).all()
    row, column = 20, 40
    f = CAMERA.focal_length
    assert points[row, column, :3] == pytest.approx([2 * (column - 31.5) / f, 2 * (row - 23.5) / f, 2], abs=1e-3)
    assert points[row, column, 4:5].view(np.uint8)[:3].tolist() == [255, 0, 0]


@pytest.mark.parametrize(
    "name,shape_,dtype",
    [
        ("L8", (48, 64), np.uint8),
        ("L16", (48, 64), np.uint16),
        ("B8G8R8", (48, 64, 3), np.uint8),
        ("R16G16B16", (48, 64, 3), np.uint16),
        ("BAYER_RGGB8", (48, 64), np.uint8),
    ],
)
def test_formats(studio_of, name, shape_, dtype):
    world = World(ball("a", (1, 0, 0), (1.0, 0.5, 0.25)))
    image = render(world, Camera(width=64, height=48, format=name))
    assert image.shape == shape_ and image.dtype == dtype
    assert (
        image[24, 32].tolist()
        == {"L8": 255, "L16": 255 * 257, "B8G8R8": [64, 128, 255], "R16G16B16": [255 * 257, 128 * 257, 64 * 257], "BAYER_RGGB8": 255}[name]
    )


@pytest.mark.parametrize(
    "encoding,cell", [("bayer_rggb8", "RG GB"), ("bayer_bggr8", "BG GR"), ("bayer_gbrg8", "GB RG"), ("bayer_grbg8", "GR BG")]
)
def test_bayer_cells(encoding, cell):
    rgb = np.tile(np.array([10, 20, 30], np.uint8), (5, 7, 1))
    values = {"R": 10, "G": 20, "B": 30}
    mosaic = encode(rgb, encoding)
    assert mosaic[:2, :2].ravel().tolist() == [values[c] for c in cell.replace(" ", "")]
    assert np.array_equal(mosaic[2:4, 4:6], mosaic[:2, :2]) and mosaic.shape == (5, 7)


def test_noise_is_gaussian_saturates_and_repeats():
    camera = Camera(width=800, height=800, noise_mean=0.01, noise_stddev=0.05)
    grey = np.full((800, 800, 3), 100, np.uint8)
    noisy = add_noise(grey, camera, 3, 40)
    error = noisy[..., 0].astype(float) - 100
    assert error.mean() == pytest.approx(0.01 * 255, abs=0.1) and error.std() == pytest.approx(0.05 * 255, rel=0.01)
    assert (np.abs(error - error.mean()) < 0.05 * 255).mean() == pytest.approx(0.683, abs=0.03)
    assert np.array_equal(noisy[..., 0], noisy[..., 1])  # one value for the three channels, as Gazebo's shader
    assert np.array_equal(noisy, add_noise(grey, camera, 3, 40))
    assert (noisy != add_noise(grey, camera, 3, 41)).mean() > 0.8
    assert add_noise(np.full((8, 8, 3), 255, np.uint8), camera, 3, 40).min() > 180  # no wrap-around
    assert add_noise(np.zeros((8, 8, 3), np.uint8), camera, 3, 40).max() < 80
    assert (grey == 100).all()


def test_cloud_is_organised_and_optical():
    depth = np.full((3, 5), 2.0, np.float32)
    image = np.arange(45, dtype=np.uint8).reshape(3, 5, 3)
    camera = Camera(width=5, height=3, hfov=1.0)
    points = cloud(depth, image, camera, np.ones((3, 5), bool))
    assert points.shape == (3, 5, 8)
    assert points[1, 2, :3].tolist() == [0, 0, 2] and points[0, 0, 0] < 0 and points[0, 0, 1] < 0
    assert points[2, 4, 4:5].view(np.uint8)[:3].tolist() == [42, 43, 44]


def test_no_gl_is_said_and_nothing_else_breaks(studio_of, monkeypatch):
    monkeypatch.setenv("ODE_SIM_GL", "none")
    studio, _ = studio_of(World())
    errors = []
    for _ in range(2):
        studio.draw(studio.add_camera(CAMERA), ("image",), lambda frame: errors.append(frame.error), wait=True)
    assert len(errors) == 2 and "ODE_SIM_GL" in errors[0] and "\n" not in errors[0]


@pytest.mark.slow
def test_a_crashed_process_is_replaced(studio_of):
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    studio, lines = studio_of(world)
    key = studio.add_camera(CAMERA)
    picture = take(studio, key)["image"]
    os.kill(studio.pid, signal.SIGKILL)
    wait_for(lambda: lines)
    assert "signal 9" in lines[0] and "\n" not in lines[0]
    assert take(studio, key)["image"] == picture


def test_a_default_socket_timeout_does_not_end_it(studio_of):
    """rospy sets one on the first request for a topic, in every process it lives in."""
    before = socket.getdefaulttimeout()
    socket.setdefaulttimeout(60.0)
    try:
        studio, lines = studio_of(World(ball("a", (2, 0, 0), (1, 0, 0))))
        take(studio, studio.add_camera(CAMERA))
    finally:
        socket.setdefaulttimeout(before)
    assert not lines


def test_a_receiver_that_fails_disturbs_nobody(studio_of):
    studio, lines = studio_of(World())
    key = studio.add_camera(CAMERA)
    studio.draw(key, ("image",), lambda frame: 1 / 0, wait=True)
    assert len(lines) == 1 and "ZeroDivisionError" in lines[0]
    take(studio, key)


@pytest.mark.slow
def test_no_orphan_after_kill_9():
    code = (
        f"import sys, time; sys.path[:0] = {[os.path.dirname(__file__), *sys.path]!r}\n"
        "from test_rendering_process import World, CAMERA, take\nfrom ode_sim_rendering import RenderProcess\n"
        "studio = RenderProcess(World(), print)\ntake(studio, studio.add_camera(CAMERA))\n"
        "print(studio.pid, flush=True)\ntime.sleep(60)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    child = int(parent.stdout.readline())
    os.kill(child, 0)
    parent.kill()
    parent.wait()
    wait_for(lambda: not alive(child))


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_a_process_that_draws_nothing_loads_no_opencv():
    code = (
        "import sys\nfrom ode_sim_rendering import Camera, RenderProcess, describe\nassert 'cv2' not in sys.modules\n"
        "from ode_sim_rendering import NOTHING, Renderer, render, segment_names\nassert 'cv2' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})


def test_segment_names_in_process():
    world = World(ball("a", (2, 0, 0), (1, 0, 0)))
    ident = render(world, CAMERA, "segmentation")
    assert segment_names(world)[ident[24, 32]] == "a::link::ball" and ident[0, 0] == -1
    assert render(world, CAMERA, "depth")[24, 32] == pytest.approx(1.7, abs=0.01)
    with pytest.raises(ValueError, match="colour"):
        render(world, CAMERA, "colour")


def test_renderer_is_closed_without_noise():
    Renderer().close()


# ---------------------------------------------------------------------------------------------- bad assets


def png(width, height, body, kind=6):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
        + chunk(b"IDAT", body)
        + chunk(b"IEND", b"")
    )


GOOD = png(2, 2, zlib.compress(b"\0" + b"\0\xff\0\xff" * 2 + b"\0" + b"\0\xff\0\xff" * 2))
BAD_TEXTURES = {
    "empty.png": b"",
    "text.png": b"not an image",
    "cut.png": GOOD[:42],
    "header.png": GOOD[:20],
    "crc.png": GOOD[:20] + b"xxxx" + GOOD[24:],
    "deflate.png": png(2, 2, b"rubbish"),
    "no_size.png": png(0, 0, b""),
    "huge.png": png(60000, 60000, zlib.compress(b"")),
    "bomb.png": png(9500, 9500, zlib.compress(b"")),
    "kind.png": png(2, 2, zlib.compress(b"x" * 99), kind=5),
    "page.png": b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\nshowpage\n",
    "cut.jpg": b"\xff\xd8\xff\xe0\0\x10JFIF",
    "cut.tif": b"II*\0\x08\0\0\0\xff\xff" + b"\1" * 40,
    "cut.gif": b"GIF89a\1\0\1\0\x80",
    "cut.dds": b"DDS " + b"\x7c" * 200,
}


@pytest.mark.slow
def test_no_texture_or_mesh_ends_the_cameras(studio_of, tmp_path):
    visuals = []
    for name, content in BAD_TEXTURES.items():
        (tmp_path / name).write_bytes(content)
        visuals.append(Visual(name, Pose((0, 0, -5)), Sphere(0.1), Material(texture=str(tmp_path / name))))
    os.mkfifo(tmp_path / "pipe.png")
    (tmp_path / "wide.png").write_bytes(png(20000, 1, zlib.compress(b"\0" + b"\0\xff\0\xff" * 20000)))
    (tmp_path / "x.stl").write_bytes(b"solid x\nvertex 1 2\n")
    visuals += [
        Visual("folder", Pose((0, 0, -5)), Sphere(0.1), Material(texture=str(tmp_path))),
        Visual("pipe", Pose((0, 0, -5)), Sphere(0.1), Material(texture=str(tmp_path / "pipe.png"))),
        Visual("mesh", Pose((0, 0, -5)), Mesh(str(tmp_path / "x.stl"))),
        Visual("terrain", Pose((0, 0, -5)), Heightmap(str(tmp_path / "text.png"))),
        Visual("far", Pose((1e7, 0, -1e7)), Sphere(1e7), Material(diffuse=(1e6, 0, 0, 1))),
        Visual("wide", Pose((2, 0, 0)), Sphere(0.3), Material(texture=str(tmp_path / "wide.png"))),
        shape("ball", Sphere(0.3), (2, 0.7, 0), (1, 0, 0)),
    ]
    world = World(Model("m", links=(Link("link", visuals=tuple(visuals)),)))
    studio, lines = studio_of(world)
    image = np.frombuffer(take(studio, studio.add_camera(CAMERA))["image"], np.uint8).reshape(48, 64, 3)
    assert tuple(image[24, 32]) == (0, 255, 0) and (image == (255, 0, 0)).all(axis=-1).any()  # the wide one, and the ball
    for name in [*BAD_TEXTURES, "folder", "pipe", "mesh", "terrain"]:
        about = [line for line in lines if f"visual '{name}' of link 'link' of model 'm'" in line]
        assert len(about) == 1 and "\n" not in about[0], (name, about)
    assert len(lines) == len(BAD_TEXTURES) + 4


def test_a_scene_that_cannot_be_set_is_one_line_and_cameras_go_on(studio_of):
    world = World(ball("red", (2, 0, 0), (1, 0, 0)))
    world.lights["sun"] = Light("sun", "directional", specular=("bright",) * 4)
    studio, lines = studio_of(world)
    key = studio.add_camera(CAMERA)
    for _ in range(2):
        image = np.frombuffer(take(studio, key)["image"], np.uint8).reshape(48, 64, 3)
        assert tuple(image[24, 32]) == (255, 0, 0)
        assert len(lines) == 1 and lines[0].startswith("cameras do not see all of the world: ")
        world.lights.clear()

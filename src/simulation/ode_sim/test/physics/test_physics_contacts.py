"""Contacts by Gazebo's rules, wheels, piles, rays."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description import model as d
from ode_sim.description.model import Axis, Box, Capsule, Collision, Cylinder, Inertial, Joint, Link, Model, Plane, Pose, Sphere, Surface
from ode_sim.math3 import quat_from_rpy, to_rpy
from physics_models import arm, box, diff_drive, ground, sphere

G = 9.8


def on_slope(degrees, mu, **more):
    world = ode_sim.World()
    tilt = math.radians(degrees)
    world.spawn(ground(pitch=tilt))
    at = (0.05 * math.sin(tilt), 0, 0.05 * math.cos(tilt))
    return world, world.spawn(box(at=at, rpy=(0, tilt, 0), surface=Surface(mu=mu, mu2=mu), **more))


@pytest.mark.parametrize("degrees", [10, 20, 26])
def test_below_the_friction_angle_a_box_stays(degrees):
    world, model = on_slope(degrees, 0.5)
    world.step(200)
    start = model.pose.p
    world.step(800)
    assert np.linalg.norm(np.subtract(model.pose.p, start)) < 3e-5


@pytest.mark.parametrize("degrees", [30, 40])
def test_above_the_friction_angle_it_slides_as_coulomb_says(degrees):
    world, model = on_slope(degrees, 0.5)
    world.step(100)
    before = np.linalg.norm(model.twist().linear)
    world.step(1000)
    tilt = math.radians(degrees)
    assert np.linalg.norm(model.twist().linear) - before == pytest.approx(G * (math.sin(tilt) - 0.5 * math.cos(tilt)), rel=2e-3)


@pytest.mark.parametrize("heading", [0.0, 0.4, math.pi / 4])
def test_sliding_friction_is_the_same_in_every_direction(heading):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box(surface=Surface(mu=0.4, mu2=0.4)))
    world.step(100)
    model.set_twist((2 * math.cos(heading), 2 * math.sin(heading), 0), (0, 0, 0))
    world.step(300)
    assert np.linalg.norm(model.twist().linear) == pytest.approx(2 - 0.4 * G * 0.3, rel=0.01)


def test_a_heavy_model_on_soft_contacts_does_not_sink():
    """At kp 1e5, max_vel 0.01 m/s pushes back with less than the weight of 60 kg: what carries the weight is not cut."""
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box(mass=60.0, surface=Surface(kp=1e5, kd=1.0)))
    world.step(3000)
    assert 0.05 - model.pose.p[2] == pytest.approx(60 * G / 1e5 / 4, abs=1e-3)
    assert abs(model.twist().linear[2]) < 1e-5


def test_friction_is_the_smaller_of_the_two():
    world = ode_sim.World()
    world.spawn(ground(surface=Surface(mu=0.1, mu2=0.1)))
    model = world.spawn(box(surface=Surface(mu=5.0, mu2=5.0)))
    world.step(100)
    model.set_twist((1, 0, 0), (0, 0, 0))
    world.step(200)
    assert model.twist().linear[0] == pytest.approx(1 - 0.1 * G * 0.2, rel=0.01)


@pytest.mark.parametrize(
    "floor, thing",
    [
        (Surface(mu=1.0, mu2=0.0, fdir1=(0, 1, 0)), Surface()),
        (Surface(), Surface(mu=1.0, mu2=0.0, fdir1=(0, 1, 0))),  # also if the second of the pair asks for it
        (Surface(mu=1.5, mu2=1.5, fdir1=(1, 0, 0)), Surface(mu=1.0, mu2=0.0, fdir1=(0, 1, 0))),
    ],
)  # the slicker one has its way
def test_fdir1_of_either_collision(floor, thing):
    world = ode_sim.World()
    world.spawn(ground(surface=floor))
    model = world.spawn(box(surface=thing))
    world.step(100)
    model.set_twist((1, 1, 0), (0, 0, 0))
    world.step(50)
    v = model.twist().linear
    assert v[0] == pytest.approx(1.0, abs=0.02) and v[1] < 0.6


SKID_STEER = """<robot name="skid"><link name="base"><inertial><mass value="20"/>
  <inertia ixx="0.5" iyy="0.5" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>%s</robot>"""
WHEEL = """<link name="w%(n)d"><inertial><mass value="1"/><inertia ixx="0.005" iyy="0.005" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><cylinder radius="0.15" length="0.1"/></geometry></collision></link>
<joint name="w%(n)d" type="continuous"><parent link="base"/><child link="w%(n)d"/><axis xyz="0 0 1"/>
  <origin xyz="%(x)s %(y)s 0" rpy="-1.5707963 0 0"/></joint>
<gazebo reference="w%(n)d"><mu1>%(mu)s</mu1><mu2>%(mu)s</mu2>%(fdir1)s</gazebo>"""


@pytest.mark.parametrize("mu, fdir1", [(1.0, ""), (0.5, ""), (1.0, "<fdir1>1 0 0</fdir1>")])
def test_four_wheels_skid_round_as_coulomb_says(mu, fdir1):
    """Wheels at (+-b, +-a), rims at +-v: rolling resists along, turning across; they balance at v a / (a^2 + b^2)."""
    a, b, radius, speed = 0.28, 0.25, 0.15, 2.0
    wheels = [WHEEL % {"n": n, "x": b * (1 - 2 * (n // 2)), "y": a * (1 - 2 * (n % 2)), "mu": mu, "fdir1": fdir1} for n in range(4)]
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn_urdf(SKID_STEER % "".join(wheels), name="skid", pose=Pose((0, 0, radius)))
    world.step(500)
    for n in range(4):
        model.joints[f"w{n}"].set_motor(speed * (1 if n % 2 else -1), 1e3)
    world.step(2000)
    turned = model.twist().angular[2]
    assert turned == pytest.approx(speed * radius * a / (a * a + b * b), rel=0.05)
    for n in range(4):
        model.joints[f"w{n}"].set_motor(speed, 1e3)
    world.step(2000)
    assert math.hypot(*model.twist().linear[:2]) == pytest.approx(speed * radius, rel=0.01)
    assert model.twist().angular[2] == pytest.approx(0, abs=1e-3)


def test_the_pose_of_a_model_does_not_turn_or_move_its_plane():
    """Upstream's rule: a sticker saved on a wall (<state>) is the floor as which its file has put it."""
    floor = ground(surface=Surface())
    sticker = Model("sticker", Pose((5, 0, 0)), floor.links, static=True)
    state = d.WorldState(0, 0, (d.ModelState("sticker", Pose((0.02, 0, 1.25), quat_from_rpy(0, math.pi / 2, 0))),))
    world = ode_sim.World(d.World(models=(sticker, box(at=(0, 0, 0.3))), state=state))
    world.step(1000)
    assert world.models["box"].pose.p == pytest.approx((0, 0, 0.05), abs=1e-4)
    world.models["sticker"].pose = Pose((0, 0, -3))
    world.step(1000)
    assert world.models["box"].pose.p[2] == pytest.approx(0.05, abs=1e-4)
    assert world.cast_rays([(9, 9, 1)], [(0, 0, -1)], 10.0)[0] == pytest.approx([1.0])


def test_a_plane_stands_at_the_height_of_its_collision_along_its_own_normal():
    def raised(normal):
        plane = Collision("plane", Pose((0, 0, 0.1)), Plane(normal), Surface())
        return Model("m", Pose((7, 7, 0.4), quat_from_rpy(0.7, 0, 0)), (Link("l", Pose((0, 0, 0)), collisions=(plane,)),), static=True)

    for normal, direction in (((0, 0, 1), (0, 0, -1)), ((1, 0, 0), (-1, 0, 0))):
        world = ode_sim.World()
        world.spawn(raised(normal))
        assert world.cast_rays([(3, 3, 3)], [direction], 10.0)[0] == pytest.approx([3 - 0.4 - 0.1 * math.cos(0.7)])


def test_bounce_needs_both_sides():
    lively = Surface(restitution=0.8, bounce_threshold=0.1)
    for floor, rises in ((lively, True), (Surface(), False)):
        world = ode_sim.World()
        world.spawn(ground(surface=floor))
        ball = world.spawn(sphere(at=(0, 0, 0.6), surface=lively))
        world.step(300)
        top = 0.0
        for _ in range(500):
            world.step()
            top = max(top, ball.pose.p[2] - 0.1)
        assert (top > 0.28) == rises
        assert top < 0.34


def test_rest_is_quiet_and_sleeps():
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box(at=(0, 0, 0.06)))
    world.step(1500)
    assert model.asleep
    assert model.pose.p[2] == pytest.approx(0.05, abs=5e-5)
    ball = world.spawn(sphere(at=(0, 0, 0.25), radius=0.05))
    world.step(300)
    assert not model.asleep  # what falls on it wakes it
    assert ball.pose.p[2] > 0.1


@pytest.mark.parametrize(
    "push",
    [
        lambda link: link.add_force((50.0, 0.0, 0.0)),
        lambda link: link.set_force((50.0, 0.0, 0.0)),
        lambda link: link.add_torque((0.0, 0.0, 5.0)),
    ],
)
def test_a_force_wakes_what_sleeps(push):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box(at=(0, 0, 0.06)))
    world.step(1500)
    assert model.asleep
    link = next(iter(model.links.values()))
    for _ in range(50):
        push(link)
        world.step()
    assert not model.asleep
    assert np.linalg.norm(link.linear_velocity()) + np.linalg.norm(link.angular_velocity()) > 0.1


def test_models_with_joints_or_told_so_do_not_sleep():
    world = ode_sim.World()
    world.spawn(ground())
    plain = box()
    awake = world.spawn(Model("awake", plain.pose, plain.links, allow_auto_disable=False))
    robot = world.spawn(diff_drive(at=(2, 0, 0)))
    world.step(2500)
    assert not awake.asleep and not robot.asleep


def test_contact_count_is_the_least_of_the_three_limits():
    world = ode_sim.World()
    world.spawn(ground())
    world.spawn(box(at=(0, 0, 0.0499)))
    world.step()
    assert len(world.contacts()) == 4
    world.physics.max_contacts = 2
    world.step()
    assert len(world.contacts()) == 2


def test_bitmask_and_contact_free_collisions():
    world = ode_sim.World()
    world.spawn(ground(surface=Surface(collide_bitmask=1)))
    through = world.spawn(box("through", at=(0, 0, 0.1), surface=Surface(collide_bitmask=2)))
    ghost = world.spawn(box("ghost", at=(1, 0, 0.1), surface=Surface(collide_without_contact=True)))
    world.step(300)
    assert through.pose.p[2] < -0.2 and ghost.pose.p[2] < -0.2
    ghost.pose = Pose((1, 0, 0.0))
    world.step()
    names = {world.collision(c["collision2"]).scoped_name for c in world.contacts()}
    assert names == {"ghost::link::box"}  # felt, though it does not push


def test_links_of_a_model_collide_only_by_self_collide_and_never_across_a_joint():
    def overlapping(self_collide, joined):
        size = (0.1, 0.1, 0.1)
        links = tuple(Link(n, Pose((x, 0, 0)), Inertial(), (Collision("c", Pose(), Box(size)),)) for n, x in (("a", 0), ("b", 0.05)))
        joints = (Joint("j", "prismatic", "a", "b", axes=(Axis((1, 0, 0)),)),) if joined else ()
        world = ode_sim.World()
        world.gravity = (0, 0, 0)
        world.spawn(Model("m", Pose(), links, joints, self_collide=self_collide))
        world.step()
        return len(world.contacts()) > 0

    assert not overlapping(False, False)
    assert overlapping(True, False)
    assert not overlapping(True, True)


def test_contact_forces_carry_the_weight():
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box(mass=3.0))
    world.watch_contacts(model.links["link"].collisions["box"])
    world.step(500)
    contacts = world.contacts()
    assert contacts["force"].sum(axis=0) == pytest.approx((0, 0, -3 * G), abs=0.01)  # on the ground, the first of the pair
    assert {world.collision(c).scoped_name for c in contacts["collision1"]} == {"ground_plane::link::plane"}


@pytest.mark.parametrize("first", [Box((0.2, 0.2, 0.2)), Sphere(0.1), Cylinder(0.1, 0.2), Capsule(0.1, 0.1)])
@pytest.mark.parametrize("second", [Box((0.2, 0.2, 0.2)), Sphere(0.1), Cylinder(0.1, 0.2), Capsule(0.1, 0.1)])
def test_every_pair_of_shapes_collides(first, second):
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    for name, shape, z in (("a", first, 0.0), ("b", second, 0.18)):
        world.spawn(Model(name, Pose((0, 0, z)), (Link("l", inertial=Inertial(), collisions=(Collision("c", Pose(), shape),)),)))
    world.step()
    contacts = world.contacts()
    assert len(contacts) > 0
    deepest = contacts[np.argmax(contacts["depth"])]
    assert abs(deepest["normal"][2]) > 0.9
    world.step(500)
    low, high = world.models["a"].pose.p[2], world.models["b"].pose.p[2]
    assert high - low > 0.18


# ---------------------------------------------------------------------------------------------- rolling


def driven(mu=1.0, tilt=0.0):
    world = ode_sim.World()
    world.spawn(ground(pitch=tilt))
    robot = world.spawn(diff_drive(mu=mu), pose=Pose(q=quat_from_rpy(0, tilt, 0)))
    return world, robot, robot.joints["left"], robot.joints["right"]


@pytest.mark.parametrize("mu", [1.0, 100.0])
def test_driving_straight(mu):
    world, robot, left, right = driven(mu)
    world.step(200)
    start = robot.pose
    for _ in range(10000):
        for joint in (left, right):
            joint.set_motor(10.0, 5.0)
        world.step()
    assert robot.pose.p[0] - start.p[0] == pytest.approx(5.0, rel=0.01)
    assert abs(robot.pose.p[1]) < 0.01
    assert abs(math.degrees(to_rpy(robot.pose)[2])) < 0.5


@pytest.mark.parametrize("mu", [1.0, 100.0])
def test_spinning_ten_turns(mu):
    world, robot, left, right = driven(mu)
    left.set_motor(-6.0, 5.0)
    right.set_motor(6.0, 5.0)  # 0.3 m/s at 0.15 m: 2 rad/s
    turned, last = 0.0, 0.0
    for _ in range(round(20 * math.pi / 2.0 / 0.05)):
        world.step(50)
        yaw = to_rpy(robot.pose)[2]
        turned += (yaw - last + math.pi) % (2 * math.pi) - math.pi
        last = yaw
    assert turned == pytest.approx(20 * math.pi, rel=0.02)
    assert np.linalg.norm(robot.pose.p[:2]) < 0.01


@pytest.mark.parametrize("degrees, seconds", [(0, 60), (10, 10)])
def test_parked_it_stays(degrees, seconds):
    world, robot, left, right = driven(tilt=math.radians(degrees))
    for joint in (left, right):
        joint.set_motor(0.0, 5.0)
    world.step(500)
    start = robot.pose
    world.step(seconds * 1000)
    assert np.linalg.norm(np.subtract(robot.pose.p, start.p)) < 1e-4
    assert abs(to_rpy(robot.pose)[2]) < 1e-4


def test_ball_rolls_without_slipping_at_five_sevenths():
    tilt = math.radians(10)
    world = ode_sim.World()
    world.spawn(ground(pitch=tilt))
    ball = world.spawn(sphere(at=(0.1 * math.sin(tilt), 0, 0.1 * math.cos(tilt))))
    world.step(1000)
    speed = np.linalg.norm(ball.twist().linear)
    assert speed == pytest.approx(5 / 7 * G * math.sin(tilt), rel=2e-3)
    assert np.linalg.norm(ball.twist().angular) == pytest.approx(speed / 0.1, rel=2e-3)


def test_a_pile_falls_settles_and_sleeps():
    world = ode_sim.World(seed=3)
    world.spawn(ground())
    rng = world.rng("pile")
    for i in range(40):
        world.spawn(box(f"b{i}", (*rng.uniform(-0.15, 0.15, 2), 0.1 + 0.05 * i), rpy=tuple(rng.uniform(-1, 1, 3))))
    for _ in range(60):
        world.step(100)
        if all(m.asleep for m in world.models.values() if not m.static):
            break
    assert all(m.asleep for m in world.models.values() if not m.static)
    heights = [m.pose.p[2] for m in world.models.values() if not m.static]
    assert min(heights) > 0.045 and max(heights) < 1.0
    assert not world.messages


# ---------------------------------------------------------------------------------------------- rays


def test_rays_measure_every_shape():
    world = ode_sim.World()
    world.spawn(ground())
    shapes = {"box": Box((0.2, 0.2, 0.2)), "ball": Sphere(0.1), "tin": Cylinder(0.1, 0.2), "pill": Capsule(0.1, 0.2)}
    for i, (name, shape) in enumerate(shapes.items()):
        link = Link("l", collisions=(Collision("c", Pose(), shape, laser_retro=float(i)),))
        world.spawn(Model(name, Pose((2, i, 0.5)), (link,), static=True))
    origins = [(0, i, 0.5) for i in range(4)] + [(-5, 0, 3.0), (0, 0, 1), (0, 0, 1)]
    directions = [(2, 0, 0)] * 4 + [(0, 0, -1), (0, 0, 1), (1, 0, 0)]
    ranges, hits = world.cast_rays(origins, directions, 10.0)
    assert ranges[:5] == pytest.approx([1.9, 1.9, 1.9, 1.9, 3.0])
    assert np.isinf(ranges[5:]).all() and (hits[5:] == -1).all()
    assert [world.collision(h).link.model.name for h in hits[:5]] == ["box", "ball", "tin", "pill", "ground_plane"]
    assert world.collision(hits[3]).laser_retro == 3.0
    skipped = world.models["box"].links["l"].collisions["c"]
    assert np.isinf(world.cast_rays([(0, 0, 0.5)], [(1, 0, 0)], 10.0, ignore=[skipped])[0][0])
    assert np.isinf(world.cast_rays([(0, 0, 0.5)], [(1, 0, 0)], 1.5)[0][0])


@pytest.mark.parametrize("lies, rest", [(False, 0.15), (True, 0.05)])
@pytest.mark.parametrize("below", [False, True])
def test_a_wheel_that_falls_on_a_thin_floor_stays_on_its_side(lies, rest, below):
    """Within two steps it is deeper in the floor than the floor is thick, and ODE's collider sees nothing of it any more."""
    world = ode_sim.World()
    up = -1.0 if below else 1.0
    world.gravity = (0.0, 0.0, -G * up)
    world.spawn(box("floor", at=(0, 0, 0), size=(20, 20, 0.01), static=True))
    tyre = Collision("c", Pose(), Cylinder(0.15, 0.1), surface=Surface(kp=3e6, kd=1.0))
    link = Link("l", inertial=Inertial(10.0, ixx=0.1, iyy=0.1, izz=0.1), collisions=(tyre,))
    wheel = world.spawn(Model("wheel", Pose((0, 0, up * 0.3), quat_from_rpy(0 if lies else math.pi / 2, 0, 0)), (link,)))
    wheel.set_twist((0, 0, -9.0 * up), (0, 0, 0))
    world.step(1000)
    assert up * wheel.pose.p[2] == pytest.approx(rest + 0.005, abs=2e-3)


@pytest.mark.parametrize("depth", [0.02, 0.05, 0.2, 1.0])
@pytest.mark.parametrize("soft", [Surface(), Surface(kp=5e4, kd=100.0, max_vel=1.0)])
def test_what_is_spawned_inside_the_floor_comes_out_and_is_not_thrown(depth, soft):
    """Each of its many contacts could carry it all: together they must not shoot it up."""
    world = ode_sim.World()
    world.spawn(ground())
    feet = tuple(Collision(f"{x} {y}", Pose((0.1 * x, 0.1 * y, 0)), Sphere(0.05), surface=soft) for x in range(-2, 3) for y in range(-2, 3))
    robot = world.spawn(
        Model("robot", Pose((0, 0, 0.05 - depth)), (Link("base", inertial=Inertial(15.0, ixx=0.3, iyy=0.3, izz=0.5), collisions=feet),))
    )
    highest = -1.0
    for _ in range(300):
        world.step(10)
        highest = max(highest, robot.pose.p[2])
    assert highest < 0.05 + 0.012
    assert robot.pose.p[2] == pytest.approx(0.05, abs=1e-3) and np.linalg.norm(robot.twist().linear) < 1e-3


def test_rays_follow_what_moves_and_bad_rays_hit_nothing():
    world = ode_sim.World()
    wall = world.spawn(box("wall", at=(2, 0, 0.5), size=(0.2, 1, 1), static=True))
    wall.pose = Pose((3, 0, 0.5))
    ranges, _ = world.cast_rays([(0, 0, 0.5)] * 3, [(1, 0, 0), (0, 0, 0), (math.nan, 0, 0)], 10.0)
    assert ranges[0] == pytest.approx(2.9) and np.isinf(ranges[1:]).all()
    assert world.cast_rays(np.zeros((0, 3)), np.zeros((0, 3)), 1.0)[0].shape == (0,)
    with pytest.raises(ValueError, match="2 ray origins but 1"):
        world.cast_rays(np.zeros((2, 3)), np.zeros((1, 3)), 1.0)


def test_mesh_and_heightmap_carry_and_are_seen(tmp_path):
    from ode_sim.description.model import Heightmap, Mesh
    from PIL import Image

    ramp = np.tile(np.linspace(0, 255, 33), (33, 1)).astype(np.uint8)  # rises towards +x
    Image.fromarray(ramp).save(tmp_path / "ramp.png")
    slab = tmp_path / "slab.obj"
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (0, 0.1)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    slab.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join("f %d %d %d %d\n" % f for f in faces))
    world = ode_sim.World()
    hills = Collision("c", Pose(), Heightmap(str(tmp_path / "ramp.png"), size=(4, 4, 1)))
    table = Collision("c", Pose(), Mesh(str(slab)))
    world.spawn(Model("hills", Pose(), (Link("l", collisions=(hills,)),), static=True))
    world.spawn(Model("table", Pose((10, 0, 0)), (Link("l", collisions=(table,)),), static=True))
    assert not world.problems
    ranges, _ = world.cast_rays([(x, 0.3, 5) for x in (-1, 0, 1, 10)], [(0, 0, -1)] * 4, 10.0)
    assert 5 - ranges == pytest.approx([0.25, 0.5, 0.75, 0.1], abs=0.01)
    load = world.spawn(box(at=(10, 0, 0.2)))
    world.step(1000)
    assert load.pose.p[2] == pytest.approx(0.15, abs=1e-3)

"""Wheels and casters in ten layouts against statics: who carries what, and what dry friction holds at most."""

import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
import trimesh
from ode_sim.description.model import Axis, Box, Collision, Cylinder, Inertial, Joint, Link, Mesh, Model, Pose, Sphere, Surface
from ode_sim.math3 import quat_from_rpy
from physics_models import car_urdf, ground

G, RADIUS = 9.8, 0.1
BESIDE = ((0.0, 0.2), (0.0, -0.2))
# name: places of wheels, places of casters, centre of mass of the base (m)
LAYOUTS = {
    "one caster behind": (BESIDE, ((-0.2, 0.0),), (-0.04, 0.0, 0.05)),
    "casters before and behind": (BESIDE, ((-0.2, 0.0), (0.2, 0.0)), (0.0, 0.0, 0.05)),
    "the same, nose-heavy": (BESIDE, ((-0.2, 0.0), (0.2, 0.0)), (0.05, 0.0, 0.05)),
    "two casters behind": (BESIDE, ((-0.2, 0.1), (-0.2, -0.1)), (-0.05, 0.0, 0.05)),
    "four casters": (BESIDE, ((-0.2, 0.1), (-0.2, -0.1), (0.2, 0.1), (0.2, -0.1)), (0.0, 0.0, 0.05)),
    "tall": (BESIDE, ((-0.2, 0.0),), (-0.08, 0.0, 0.2)),
    "front drive": (((0.15, 0.2), (0.15, -0.2)), ((-0.2, 0.0),), (0.05, 0.0, 0.05)),
    "four wheels": (((0.15, 0.2), (0.15, -0.2), (-0.15, 0.2), (-0.15, -0.2)), (), (0.0, 0.0, 0.05)),
    "six wheels": (((0.2, 0.2), (0.2, -0.2), (0.0, 0.2), (0.0, -0.2), (-0.2, 0.2), (-0.2, -0.2)), (), (0.02, 0.0, 0.05)),
    "caster off the middle": (BESIDE, ((-0.2, 0.1),), (-0.04, 0.01, 0.05)),
}
BASE_MASS, WHEEL_MASS, CASTER_MU = 10.0, 1.0, 0.5


def rover(wheels, casters, com):
    balls = tuple(
        Collision(f"c{i}", Pose((x, y, 0.03 - RADIUS)), Sphere(0.03), Surface(mu=CASTER_MU, mu2=CASTER_MU))
        for i, (x, y) in enumerate(casters)
    )
    links = [Link("base", Pose((0, 0, RADIUS)), Inertial(BASE_MASS, Pose(com), 0.2, 0, 0, 0.3, 0, 0.4), balls)]
    joints = []
    tyre = Collision("tyre", Pose(q=quat_from_rpy(math.pi / 2, 0, 0)), Cylinder(RADIUS, 0.05))
    for i, (x, y) in enumerate(wheels):
        links.append(Link(f"w{i}", Pose((x, y, RADIUS)), Inertial(WHEEL_MASS, Pose(), 0.003, 0, 0, 0.005, 0, 0.003), (tyre,)))
        joints.append(Joint(f"w{i}", "revolute", "base", f"w{i}", axes=(Axis((0, 1, 0)),)))
    return Model("rover", Pose(), tuple(links), tuple(joints))


def built(name):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(rover(*LAYOUTS[name]))
    for link in model.links.values():
        for collision in link.collisions.values():
            world.watch_contacts(collision)
    return world, model


def forces(world):
    """{wheel or caster: (normal force, friction)}, N."""
    out = {}
    for contact in world.contacts():
        handle = world.collision(contact["collision2"])
        key = handle.name if handle.link.name == "base" else handle.link.name
        normal, friction = out.get(key, (0.0, 0.0))
        force = contact["force"]
        out[key] = (normal - force[2], friction + math.hypot(force[0], force[1]))
    return out


def shares(wheels, casters, com):
    """Loads of a stiff body on points that give way alike: a wheel has two (both edges of its tread), a caster one."""
    points = np.array([(1.0, x, y) for x, y in (*wheels, *casters)])
    stiffness = np.array([2.0] * len(wheels) + [1.0] * len(casters))
    weight = BASE_MASS * G * np.array((1.0, com[0], com[1])) + sum(WHEEL_MASS * G * np.array((1.0, x, y)) for x, y in wheels)
    plane = np.linalg.solve(points.T @ (stiffness[:, None] * points), weight)
    return stiffness * (points @ plane)


@pytest.mark.parametrize("name", LAYOUTS)
def test_standing_every_support_carries_its_share(name):
    world, _ = built(name)
    world.step(1000)
    wheels, casters, com = LAYOUTS[name]
    keys = [f"w{i}" for i in range(len(wheels))] + [f"c{i}" for i in range(len(casters))]
    loads = forces(world)
    weight = (BASE_MASS + WHEEL_MASS * len(wheels)) * G
    assert [loads[key][0] for key in keys] == pytest.approx(shares(wheels, casters, com), abs=0.04 * weight)


@pytest.mark.parametrize("name", LAYOUTS)
def test_driven_turned_and_braked_nobody_holds_more_than_friction_allows(name):
    world, model = built(name)
    world.step(500)
    over, count = [], 0
    for forward, turn in ((0.3, 0.0), (0.0, 1.0), (0.3, 1.0), (-0.3, 0.0), (0.0, 0.0)):
        for i, (_, y) in enumerate(LAYOUTS[name][0]):
            model.joints[f"w{i}"].set_motor((forward - turn * y) / RADIUS, 2.0)
        world.step(50)
        for _ in range(60):
            world.step(10)
            for key, (normal, friction) in forces(world).items():
                count += 1
                if friction > 1.1 * (CASTER_MU if key[0] == "c" else 1.0) * normal + 0.5:
                    over.append((key, round(normal, 1), round(friction, 1)))
    assert len(over) < 0.02 * count, over[:10]


def test_joints_that_the_file_makes_soft_do_not_carry_a_robot_down_a_slope():
    world = ode_sim.World()
    world.physics.cfm = 1e-3  # as curio's world file has it
    world.spawn(ground(pitch=0.1))
    robot = world.spawn(rover(*LAYOUTS["four wheels"]))
    for joint in robot.joints.values():
        joint.set_motor(0.0, 50.0)
    world.step(1000)
    before = robot.pose.p
    world.step(2000)
    assert math.dist(robot.pose.p, before) < 1e-6


def test_a_robot_whose_wheels_outpull_its_casters_drives_turns_and_drives_again():
    """Wheels with 2/3 of the load and 10 N m pull 100 N, the casters hold 82 N at most: 25 kg between two rigid balls."""
    balls = tuple(Collision(f"c{i}", Pose((x, 0, -0.05)), Sphere(0.05)) for i, x in enumerate((-0.15, 0.15)))
    links = [Link("base", Pose((0, 0, 0.1)), Inertial(15.1, Pose((0, 0, 0.1)), 0.1, 0, 0, 0.1, 0, 0.1), balls)]
    joints = []
    tyre = Collision("tyre", Pose(q=quat_from_rpy(0, 1.5707, 1.5707)), Cylinder(0.1, 0.05))
    for name, y in (("left", 0.15), ("right", -0.15)):
        links.append(Link(name, Pose((0, y, 0.1)), Inertial(5.0, Pose(), 0.1, 0, 0, 0.1, 0, 0.1), (tyre,)))
        joints.append(Joint(name, "revolute", "base", name, axes=(Axis((0, 1, 0)),)))
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(Model("mybot", Pose(), tuple(links), tuple(joints)))
    world.step(500)
    for forward, turn in ((0.3, 0.0), (0.0, 1.0), (0.3, 0.0)):
        for name, y in (("left", 0.15), ("right", -0.15)):
            model.joints[name].set_motor((forward - turn * y) / 0.1, 10.0)
        world.step(1500)
        assert math.hypot(*model.twist().linear[:2]) == pytest.approx(forward, abs=0.03)
        assert model.twist().angular[2] == pytest.approx(turn, abs=0.08)


@pytest.mark.parametrize("max_vel", [0.01, 100.0])
@pytest.mark.parametrize("depth", [0.03, 0.09])
def test_put_into_the_floor_it_comes_out_without_being_thrown(depth, max_vel):
    world = ode_sim.World()
    world.spawn(ground(surface=Surface(max_vel=100.0)))
    description = rover(*LAYOUTS["one caster behind"])
    links = tuple(
        replace(link, collisions=tuple(replace(c, surface=Surface(max_vel=max_vel)) for c in link.collisions)) for link in description.links
    )
    model = world.spawn(replace(description, links=links), pose=Pose((0, 0, -depth)))
    highest = fastest = 0.0
    for _ in range(400):
        world.step(5)
        highest = max(highest, model.pose.p[2])
        fastest = max(fastest, np.linalg.norm(model.twist().linear))
    assert highest < 0.02 and fastest < 1.5
    assert model.pose.p == pytest.approx((0, 0, 0), abs=5e-3) and np.linalg.norm(model.twist().linear) < 1e-3


def tilted(angle, floor=None):
    """Contact of a wheel whose description says an angle that is a little off: its place along the axle, m, and its load, N."""
    world = ode_sim.World()
    world.spawn(floor or ground())
    model = rover(((0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2)), (), (0.0, 0.0, 0.05))
    links = [
        replace(link, collisions=tuple(replace(c, pose=Pose(q=quat_from_rpy(math.pi / 2 + angle, 0, 0))) for c in link.collisions))
        if link.name == "w0"
        else link
        for link in model.links
    ]
    joints = [
        replace(joint, axes=(Axis((0.0, math.cos(angle), math.sin(angle))),)) if joint.name == "w0" else joint for joint in model.joints
    ]
    rover_ = world.spawn(replace(model, links=tuple(links), joints=tuple(joints)))
    for link in rover_.links.values():
        for collision in link.collisions.values():
            world.watch_contacts(collision)
    world.step(500)
    told = [c for c in world.contacts() if world.collision(c["collision2"]).link.name == "w0"]
    return [c["position"][1] - rover_.links["w0"].pose.p[1] for c in told], sum(-c["force"][2] for c in told)


@pytest.mark.parametrize("angle", (3.14 - math.pi, 1.57 - math.pi / 2, 0.003))
def test_a_wheel_that_is_tilted_by_rounding_stands_on_its_whole_tread(angle):
    (place,), load = tilted(angle)
    assert abs(place) < RADIUS * abs(angle) + 1e-4 and load == pytest.approx(14 * G / 4, rel=0.05)


def test_a_wheel_that_leans_or_hangs_over_an_edge_stands_on_what_touches():
    (place,), _ = tilted(0.02)
    assert abs(place) == pytest.approx(0.025 - RADIUS * 0.02, abs=1e-3)
    shelf = Collision("shelf", Pose((0.0, -0.01, -0.05)), Box((2.0, 0.4, 0.1)))  # its edge is at y = 0.19, the tyre from 0.175 to 0.225
    places, _ = tilted(0.003, Model("floor", Pose(), (Link("link", collisions=(shelf,)),), static=True))
    assert all(place < -0.009 for place in places)


def round_mesh(tmp_path, corners):
    """A prism about z, of radius RADIUS and as wide as the tyre."""
    mesh = trimesh.creation.cylinder(RADIUS, 0.05, sections=corners)
    mesh.export(tmp_path / "wheel.stl")
    return Mesh(str(tmp_path / "wheel.stl"), "wheel.stl")


def test_a_wheel_that_is_a_mesh_turns_about_the_middle_of_its_tread(tmp_path):
    model = rover(BESIDE, ((-0.2, 0.0),), (-0.04, 0.0, 0.05))
    shape = round_mesh(tmp_path, 48)
    links = tuple(
        replace(link, collisions=tuple(replace(c, geometry=shape, surface=Surface(mu=50.0, mu2=50.0)) for c in link.collisions))
        if link.name != "base"
        else link
        for link in model.links
    )
    world = ode_sim.World()
    world.spawn(ground())
    robot = world.spawn(replace(model, links=links))
    robot.joints["w0"].set_motor(-2.0, 50.0)
    robot.joints["w1"].set_motor(2.0, 50.0)
    world.step(2000)
    assert robot.twist().angular[2] == pytest.approx(2.0 * RADIUS / 0.2, rel=0.02)


def test_which_corners_of_a_mesh_are_lowest_does_not_move_what_a_wheel_stands_on(tmp_path):
    """Of three rings of corners, one of them half a corner further, two touch or one does: a robot turned about the middle of those."""
    corners = 40
    rings = [
        [(RADIUS * math.cos(a), RADIUS * math.sin(a), z) for a in (2 * math.pi * (i + shift) / corners for i in range(corners))]
        for z, shift in ((-0.025, 0.5), (0.0, 0.0), (0.025, 0.0))
    ]
    faces = []
    for first in (0, corners):
        for i, k in zip(range(corners), [*range(1, corners), 0]):
            faces += [(first + i, first + k, first + corners + i), (first + k, first + corners + k, first + corners + i)]
    trimesh.Trimesh(np.concatenate(rings), faces, process=False).export(tmp_path / "wheel.stl")
    shape = Mesh(str(tmp_path / "wheel.stl"), "wheel.stl")
    model = rover(BESIDE, ((-0.2, 0.0),), (-0.04, 0.0, 0.05))
    links = tuple(
        link if link.name == "base" else replace(link, collisions=tuple(replace(c, geometry=shape) for c in link.collisions))
        for link in model.links
    )
    world = ode_sim.World()
    world.spawn(ground())
    robot = world.spawn(replace(model, links=links))
    for turn in range(8):
        for name in ("w0", "w1"):
            robot.joints[name].set_position(turn * 2 * math.pi / corners / 8)
            robot.joints[name].set_motor(0.0, 10.0)
        world.step(300)
        sides = [contact["position"][1] for contact in world.contacts() if abs(contact["position"][1]) > 0.1]
        assert sorted(sides) == pytest.approx([-0.2, 0.2], abs=1e-4), turn


def test_corners_of_wheels_that_are_meshes_do_not_hold_a_turn_up(tmp_path):
    """Corners before and behind the axles would drag the wheels sideways, at a friction of 10 with more than a drive of 0.4 N m gives."""
    model = rover(BESIDE, ((-0.2, 0.0),), (-0.04, 0.0, 0.05))
    shape, rough = round_mesh(tmp_path, 40), Surface(mu=10.0, mu2=10.0)
    links = tuple(
        replace(link, collisions=tuple(replace(c, geometry=shape, surface=rough) for c in link.collisions))
        if link.name != "base"
        else replace(link, collisions=tuple(replace(c, surface=Surface(mu=0.01, mu2=0.01)) for c in link.collisions))
        for link in model.links
    )
    world = ode_sim.World()
    world.spawn(ground())
    robot = world.spawn(replace(model, links=links))
    robot.joints["w0"].set_motor(-0.05, 0.4)  # by the slower of the two the corners come out of step
    world.step(500)

    def control(_):
        for name, speed in (("w0", -2.0), ("w1", 2.0)):
            joint = robot.joints[name]
            joint.add_law(1.0 * (speed - joint.velocity()), 1.0, 0.4)

    robot.joints["w0"].set_motor(0.0, 0.0)
    world.before_step.append(control)
    world.step(1000)
    rate = np.mean([(world.step(10), robot.twist().angular[2])[1] for _ in range(200)])
    assert rate == pytest.approx(2.0 * RADIUS / 0.2, rel=0.04)


def steered_car(offset):
    """A car whose tyres stand `offset` outside of what they turn about when they are steered."""
    text = car_urdf(track=0.2, radius=0.05)
    tyre = '<collision><origin rpy="1.5707963 0 0"/>'
    for part in text.split("<link ")[1:]:
        if "_tyre" in part:
            out = offset if "left" in part else -offset
            text = text.replace(part, part.replace(tyre, tyre.replace("origin ", f'origin xyz="0 {out} 0" ')))
    return text


@pytest.mark.parametrize("step", [0.001, 0.00025])
def test_steering_gives_way_to_wheels_of_one_speed_as_statics_have_it(step):
    """All wheels follow one speed by a P gain. Rolling, the inner ones are held back and the outer ones drawn on, each by
    gain x rate x b / radius^2; that, beside the kingpin, turns a steering back which is held by a P gain as well."""
    told, speed, drive, hold, base, radius, offset, b = 0.2, 10.0, 0.5, 1.0, 0.5, 0.05, 0.0225, 0.1225
    world = ode_sim.World()
    world.physics.max_step_size = step
    world.spawn(ground())
    car = world.spawn_urdf(steered_car(offset), name="car", pose=Pose((0, 0, radius)))
    wheels = [joint for name, joint in car.joints.items() if name.endswith("_wheel")]
    knuckles = [joint for name, joint in car.joints.items() if name.endswith("_steer")]

    def control(_):
        for joint in wheels:
            joint.add_law(drive * (speed - joint.velocity()), drive)
        for joint in knuckles:
            joint.add_law(hold * (told - joint.position()) - 0.5 * joint.velocity(), 0.5 + hold * step)

    world.before_step.append(control)
    world.step(round(2 / step))
    rate = np.mean([(world.step(round(0.01 / step)), car.twist().angular[2])[1] for _ in range(100)])
    angle = told / (1 + offset * drive * b * speed / (hold * base * radius))
    assert rate == pytest.approx(speed * radius * math.tan(angle) / base, rel=0.03)
    assert np.mean([joint.position() for joint in knuckles]) == pytest.approx(angle, rel=0.03)

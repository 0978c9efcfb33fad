"""Islands of many joints: trees of them exactly, whatever the number of iterations."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Axis, Capsule, Collision, Cylinder, Inertial, Joint, Link, Model, Pose, Surface
from ode_sim.math3 import quat_from_rpy, quat_multiply, quat_rotate, quat_to_rpy
from physics_models import box_inertia, ground

ROLLERS, ROLLER, LENGTH, RING, HALF = 15, 0.0096, 0.038, 0.0666, 0.15
REACH = RING + ROLLER
CORNERS = ((HALF, HALF), (HALF, -HALF), (-HALF, HALF), (-HALF, -HALF))


def mecanum():
    """20 kg on four sprung wheels of 15 free rollers each, 0.012 kg, at 45 degrees: 68 joints."""
    links = [Link("base", Pose(), Inertial(20.0, Pose((0.01, 0.005, 0.05)), 0.3, 0, 0, 0.4, 0, 0.5))]
    joints, tread = [], Surface(mu=2.5, mu2=2.5, kp=5e4, kd=100)
    across, along = 0.012 * (ROLLER**2 / 4 + LENGTH**2 / 12), 0.012 * ROLLER**2 / 2
    upright = quat_from_rpy(-math.pi / 2, 0, 0)
    for i, (x, y) in enumerate(CORNERS):
        links.append(Link(f"s{i}", Pose((x, y, 0)), Inertial(0.01, Pose(), 1e-5, 0, 0, 1e-5, 0, 1e-5)))
        joints.append(Joint(f"s{i}", "prismatic", "base", f"s{i}", axes=(Axis((0, 0, 1), -0.02, 0.02),)))
        links.append(Link(f"w{i}", Pose((x, y, 0), upright), Inertial(0.3, Pose(), 3e-4, 0, 0, 3e-4, 0, 6e-4)))
        joints.append(Joint(f"w{i}", "revolute", f"s{i}", f"w{i}", axes=(Axis((0, 0, 1)),)))
        for k in range(ROLLERS):
            angle = 2 * math.pi * k / ROLLERS
            off = quat_rotate(upright, (math.cos(angle) * RING, math.sin(angle) * RING, 0))
            lean = quat_from_rpy(math.pi / 4 * (-1 if x * y > 0 else 1), 0, angle)
            name = f"r{i}_{k}"
            links.append(
                Link(
                    name,
                    Pose((x + off[0], y + off[1], off[2]), quat_multiply(upright, lean)),
                    Inertial(0.012, Pose(), across, 0, 0, across, 0, along),
                    (Collision("c", Pose(), Cylinder(ROLLER, LENGTH), tread),),
                )
            )
            joints.append(Joint(name, "revolute", f"w{i}", name, axes=(Axis((0, 0, 1), damping=1e-3),)))
    return Model("rover", Pose((0, 0, REACH + 0.001)), tuple(links), tuple(joints))


class Rover:
    """The base on its floor, its springs held by PD control and its wheels by motors."""

    def __init__(self):
        self.world = ode_sim.World()
        self.world.spawn(ground())
        self.model = self.world.spawn(mecanum())
        self.turn([0.0] * 4)
        self.world.before_step.append(self._hold)
        self.world.step(1000)

    def _hold(self, _world):
        for i in range(4):
            spring = self.model.joints[f"s{i}"]
            spring.add_force(-1e4 * spring.position() - 100 * spring.velocity())

    def turn(self, speeds):
        for i, speed in enumerate(speeds):
            self.model.joints[f"w{i}"].set_motor(speed, 50.0)

    def place(self):
        pose = self.model.pose
        return np.array([*pose.p[:2], quat_to_rpy(pose.q)[2]])


@pytest.mark.slow
def test_a_base_on_sixty_rollers_stands():
    rover = Rover()
    before = rover.place()
    rover.world.step(1500)
    assert np.abs(rover.place() - before) == pytest.approx([0, 0, 0], abs=5e-5)  # 0.01 m and 0.004 rad with fifty iterations for all
    assert rover.world.core.counters.trees > 0 and rover.world.core.counters.quick == 0 and not rover.world.messages


@pytest.mark.slow
@pytest.mark.parametrize(
    "speeds, motion",
    [((4, 4, 4, 4), (1, 0, 0)), ((-4, 4, 4, -4), (0, 1, 0)), ((-4, 4, -4, 4), (0, 0, 1 / (2 * HALF)))],
    ids=["ahead", "left", "round"],
)
def test_it_goes_where_its_wheels_take_it(speeds, motion):
    rover = Rover()
    rover.turn(speeds)
    rover.world.step(500)
    before = rover.place()
    rover.world.step(1000)
    went = rover.place() - before
    c, s = math.cos(before[2]), math.sin(before[2])
    along = np.array([c * went[0] + s * went[1], c * went[1] - s * went[0], went[2]])
    assert along == pytest.approx(np.array(motion) * 4 * REACH, abs=0.06 * 4 * REACH)  # treads of straight pieces


@pytest.mark.slow
def test_the_same_bits_again_and_from_a_snapshot():
    def run(rover):
        rover.world.step(200)
        return rover.world.link_poses.tobytes() + rover.world.joint_velocities.tobytes()

    first, second = Rover(), Rover()
    for rover in (first, second):
        rover.turn((3, 2, 1, 0))
    saved = first.world.save()
    once = run(first)
    assert once == run(second)
    first.world.restore(saved)
    assert once == run(first)


def centipede(legs):
    """A bar of 8 kg on many legs, each of two joints held by motors; more rows than the direct solver takes."""
    links = [Link("bar", Pose((0, 0, 0.3)), box_inertia(8.0, (legs * 0.1, 0.1, 0.05)))]
    joints = []
    for i in range(legs):
        for side in (-1, 1):
            x, y, name = 0.1 * (i - (legs - 1) / 2), side * 0.12, f"{'rl'[side > 0]}{i}"
            links += [
                Link(f"hip_{name}", Pose((x, y, 0.3)), Inertial(0.05, Pose(), 1e-4, 0, 0, 1e-4, 0, 1e-4)),
                Link(
                    f"leg_{name}", Pose((x, y, 0.15)), box_inertia(0.2, (0.02, 0.02, 0.28)), (Collision("c", Pose(), Capsule(0.02, 0.26)),)
                ),
            ]
            joints += [
                Joint(f"hip_{name}", "revolute", "bar", f"hip_{name}", axes=(Axis((1, 0, 0), -1, 1),)),
                Joint(f"leg_{name}", "revolute", f"hip_{name}", f"leg_{name}", Pose((0, 0, 0.15)), axes=(Axis((0, 1, 0), -1, 1),)),
            ]
    return Model("centipede", Pose(), tuple(links), tuple(joints))


def built(direct):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(centipede(8))
    world.core.direct_rows = 10000 if direct else 0
    for joint in model.joints.values():
        joint.set_motor(0.0, 30.0)
    floor = world.models["ground_plane"].links["link"].collisions["plane"]
    world.watch_contacts(floor)
    return world, model


@pytest.mark.slow
def test_as_the_direct_solver_has_it():
    """Thirty-two joints on sixteen feet: the same poses and joint loads as ODE's direct solver of all rows together."""
    results = []
    for direct in (True, False):
        world, model = built(direct)
        world.step(1500)
        carried = -sum(c["force"][2] for c in world.contacts())
        results.append((carried, np.array(model.links["bar"].pose.p), world.joint_positions.copy()))
        assert not world.messages
    (load, place, joints), (load2, place2, joints2) = results
    assert abs(load2) == pytest.approx((8 + 16 * 0.25) * 9.8, rel=2e-3) and abs(load) == pytest.approx(abs(load2), rel=2e-3)
    assert place2 == pytest.approx(place, abs=2e-4)
    assert joints2 == pytest.approx(joints, abs=1e-3)


@pytest.mark.parametrize("kind, axes", [("revolute", 1), ("prismatic", 1), ("universal", 2)])
def test_reset_poses_brings_back_what_hangs_on_the_world(kind, axes):
    """As in Gazebo 11.1: a model is where its first link is; what hangs on that one keeps its angle."""
    text = "".join(f"<axis{n}><xyz>{xyz}</xyz></axis{n}>" for n, xyz in (("", "0 1 0"), ("2", "1 0 0"))[:axes])
    world = ode_sim.World()
    pendulum = world.spawn_sdf(f"""<sdf version="1.7"><model name="p"><pose>1 2 3 0 0 0.4</pose><link name="a"/>
        <joint name="top" type="{kind}"><parent>world</parent><child>a</child>{text}</joint>
        <link name="b"><pose>0 0 -1 0 0 0</pose></link>
        <joint name="low" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis></joint></model></sdf>""")
    top, low = pendulum.joints["top"], pendulum.joints["low"]
    for axis in range(axes):
        top.set_position(0.3 + 0.1 * axis, axis)
    low.set_position(0.5)
    world.step(50)
    angle, place = low.position(), top.anchor()
    world.reset_poses()
    assert [top.position(axis) for axis in range(axes)] == pytest.approx([0.0] * axes, abs=1e-9)
    assert low.position() == pytest.approx(angle) and low.velocity() == 0.0
    assert pendulum.pose.p == pytest.approx((1, 2, 3)) and pendulum.links["a"].pose.q == pytest.approx(pendulum.initial_pose.q)
    if kind != "prismatic":  # the bolt is where it was
        assert top.anchor() == pytest.approx(place, abs=1e-6)

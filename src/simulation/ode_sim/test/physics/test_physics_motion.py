"""Free bodies and joints against what mechanics says."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Axis, Inertial, Joint, Link, Model, Pose
from ode_sim.math3 import compose, inverse, quat_to_rpy
from physics_models import arm, box, diff_drive, pendulum, sphere
from scipy.integrate import solve_ivp

G = 9.8


def test_free_fall_is_that_of_the_semi_implicit_rule():
    world = ode_sim.World()
    ball = world.spawn(sphere(at=(0, 0, 10)))
    world.step(1000)
    assert ball.pose.p[2] == pytest.approx(10 - G * 1e-6 * 1000 * 1001 / 2, abs=1e-9)
    assert ball.twist().linear[2] == pytest.approx(-G, abs=1e-9)
    assert world.time == pytest.approx(1.0) and world.iterations == 1000


def test_a_model_that_is_moved_as_one_keeps_the_speeds_of_its_joints():
    """Else motors that start its wheels anew in every step would turn the body the other way."""
    world = ode_sim.World()
    robot = world.spawn(diff_drive(at=(0, 0, 1.0)))
    world.gravity = (0.0, 0.0, 0.0)
    wheels = [joint for joint in robot.joints.values() if joint.axis_count]
    for joint in wheels:
        joint.set_motor(4.0, 100.0)
    for _ in range(500):
        robot.move_as_one((0.3, 0.0, 0.0), (0.0, 0.0, 0.5), robot.pose.p)
        world.step(1)
    roll, pitch, yaw = quat_to_rpy(robot.pose.q)
    assert (roll, pitch) == pytest.approx((0.0, 0.0), abs=0.01) and yaw == pytest.approx(0.25, abs=1e-3)
    assert [joint.velocity() for joint in wheels] == pytest.approx([4.0] * len(wheels), rel=1e-3)
    with pytest.raises(ValueError, match="twist of model robot"):
        robot.move_as_one((math.nan, 0, 0), (0, 0, 0), robot.pose.p)


def test_gravity_can_be_changed_and_switched_off_for_a_link():
    world = ode_sim.World()
    floating = world.spawn(sphere("floating", gravity=False))
    falling = world.spawn(sphere("falling", at=(1, 0, 1)))
    world.gravity = (0.0, 0.0, -1.0)
    world.step(100)
    assert floating.pose.p[2] == 1.0
    assert falling.twist().linear[2] == pytest.approx(-0.1)
    floating.links["link"].gravity = True
    world.step(100)
    assert floating.twist().linear[2] == pytest.approx(-0.1)


def test_velocity_decay_slows_a_body():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    ball = world.spawn(sphere(linear_decay=0.01))
    ball.set_twist((1, 0, 0), (0, 0, 0))
    world.step(100)
    assert ball.twist().linear[0] == pytest.approx(0.99**100, rel=1e-6)


def test_spinning_body_keeps_its_energy_and_angular_momentum():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    body = world.spawn(box(size=(0.1, 0.2, 0.4), at=(0, 0, 1)))
    body.set_twist((0, 0, 0), (0.1, 3.0, 0.1))
    moments = np.array([body.links["link"].inertia[i] for i in range(3)])

    def state():
        pose = body.pose
        w = np.array(compose(inverse(Pose(q=pose.q)), Pose(p=body.twist().angular)).p)
        return 0.5 * (moments * w * w).sum(), np.array(compose(Pose(q=pose.q), Pose(p=tuple(moments * w))).p)

    energy, momentum = state()
    world.step(3000)
    later, turned = state()
    assert later <= energy * 1.0001 and later == pytest.approx(energy, rel=0.02)
    assert np.linalg.norm(turned - momentum) < 0.02 * np.linalg.norm(momentum)


@pytest.mark.parametrize("start", [0.2, 1.0, 2.5])
def test_pendulum_against_the_accurate_solution(start):
    length, mass, inertia, seconds = 0.5, 1.0, 0.01, 5.0
    world = ode_sim.World()
    joint = world.spawn(pendulum(length, mass, inertia=inertia)).joints["hinge"]
    joint.set_position(start)
    q, energy = [], []
    for _ in range(int(seconds * 1000)):
        world.step()
        q.append(joint.position())
        energy.append(0.5 * (inertia + mass * length**2) * joint.velocity() ** 2 - mass * G * length * math.cos(q[-1]))
    k = mass * G * length / (inertia + mass * length**2)
    t = np.arange(1, len(q) + 1) * 1e-3
    truth = solve_ivp(lambda _, y: (y[1], -k * math.sin(y[0])), (0, seconds), (start, 0), rtol=1e-10, atol=1e-12, t_eval=t).y[0]

    def period(x):
        up = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
        return np.diff(t[up] - x[up] * 1e-3 / (x[up + 1] - x[up])).mean()

    q = np.array(q)
    assert period(q) == pytest.approx(period(truth), rel=1e-5)
    assert np.abs(q).max() <= start + 1e-5
    scale = mass * G * length * (1 - math.cos(start))
    first = -mass * G * length * math.cos(start)
    assert max(energy) - first < 3e-3 * scale  # the rule's own ripple, which does not build up:
    assert abs(max(energy[-2000:]) - max(energy[:2000])) < 1e-3 * scale


@pytest.mark.parametrize("damping, friction", [(0.05, 0.0), (0.0, 0.3), (5.0, 0.0), (1000.0, 0.0), (1.0, 0.2)])
def test_losses_only_ever_take_energy(damping, friction):
    length, mass, inertia = 0.5, 1.0, 0.01
    world = ode_sim.World()
    joint = world.spawn(pendulum(length, mass, damping, friction, inertia)).joints["hinge"]
    joint.set_position(2.0)
    best = [2.0]
    for _ in range(4000):
        world.step()
        best.append(abs(joint.position()))
    peaks = [b for a, b, c in zip(best, best[1:], best[2:]) if b > a and b > c]
    assert all(later < earlier for earlier, later in zip([2.0] + peaks, peaks))
    assert not world.messages


def test_viscous_damping_has_the_right_size():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    joint = world.spawn(pendulum(0.5, 1.0, damping=0.2)).joints["hinge"]
    joint.child.set_twist((-0.5, 0, 0), (0, 1.0, 0))  # turning about the hinge at 1 rad/s
    world.step(1000)
    assert joint.velocity() == pytest.approx(math.exp(-0.2 / 0.26), rel=2e-3)


def test_friction_holds_until_it_is_overcome():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    joint = world.spawn(pendulum(friction=1.0)).joints["hinge"]
    for _ in range(200):
        joint.add_force(0.9)
        world.step()
    assert joint.position() == pytest.approx(0.0, abs=1e-9)
    for _ in range(200):
        joint.add_force(1.5)
        world.step()
    assert joint.velocity() == pytest.approx(0.5 / 0.26 * 0.2, rel=1e-3)


@pytest.mark.parametrize("implicit", [False, True])
def test_spring_pulls_to_its_reference(implicit):
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    model = pendulum()
    axis = Axis((0, 1, 0), damping=1.0, spring_reference=0.4, spring_stiffness=20.0)
    model = Model(
        model.name, model.pose, model.links, (Joint("hinge", "revolute", "world", "bob", axes=(axis,), implicit_spring_damper=implicit),)
    )
    joint = world.spawn(model).joints["hinge"]
    world.step(5000)
    assert joint.position() == pytest.approx(0.4, abs=1e-3)


def test_angles_count_turns():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    joint = world.spawn(pendulum()).joints["hinge"]
    joint.set_motor(20.0, 1e5)
    world.step(5000)
    assert joint.position() == pytest.approx(100.0, abs=0.05)
    joint.set_motor(-20.0, 1e5)
    world.step(5000)
    assert joint.position() == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("limit", [1.0, math.pi, 3.5, 10.0])
def test_limits_stop_the_joint_also_beyond_a_turn(limit):
    world = ode_sim.World()
    joint = world.spawn(pendulum(lower=-limit, upper=limit)).joints["hinge"]
    joint.set_motor(5.0, 20.0)
    world.step(4000)
    assert joint.position() == pytest.approx(limit, abs=1e-8)
    joint.set_motor(-5.0, 20.0)
    world.step(8000)
    assert joint.position() == pytest.approx(-limit, abs=1e-8)


@pytest.mark.parametrize("limit", [1.0, math.pi])
def test_a_stop_that_is_hit_throws_nothing_back_faster(limit):
    world = ode_sim.World()
    joint = world.spawn(pendulum(lower=-limit, upper=limit)).joints["hinge"]
    joint.set_position(limit / 2)
    fastest = 0.0
    for _ in range(3000):
        joint.add_force(20.0)
        world.step()
        fastest = max(fastest, abs(joint.velocity()))
    assert 1 < fastest < 50 and joint.position() == pytest.approx(limit, abs=1e-8)


@pytest.mark.parametrize("lower, upper", [(1.0, 2.0), (-2.0, -1.0)])
def test_a_joint_that_begins_far_beyond_a_stop_comes_back_without_a_throw(lower, upper):
    """Legs and arms whose zero is not among their angles: at a fifth of the way in one step they would throw the robot."""
    world = ode_sim.World()
    joint = world.spawn(pendulum(lower=lower, upper=upper)).joints["hinge"]
    fastest = 0.0
    for _ in range(1000):
        world.step()
        fastest = max(fastest, abs(joint.velocity()))
    assert fastest < 11.0
    assert lower - 1e-6 <= joint.position() <= upper + 1e-6


def test_a_strongly_damped_light_joint_rests_at_its_stop():
    world = ode_sim.World()
    joint = world.spawn(pendulum(0.02, 0.05, damping=0.1, inertia=1e-5, lower=-1.0, upper=1.0)).joints["hinge"]
    for _ in range(4000):
        joint.add_force(0.05)
        world.step()
    assert joint.position() == pytest.approx(1.0, abs=1e-8) and not world.messages


def test_huge_limits_mean_none():
    world = ode_sim.World()
    joint = world.spawn(pendulum(lower=-1e9, upper=1e9)).joints["hinge"]
    assert joint.limits() == (-math.inf, math.inf)
    joint.set_motor(10.0, 1e5)
    world.step(2000)
    assert joint.position() == pytest.approx(20.0, abs=0.05)


def test_effort_and_velocity_limits_cut_added_forces():
    axis = Axis((0, 1, 0), effort=2.0, velocity=1.0)
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    plain = pendulum()
    joint = world.spawn(Model("m", Pose(), plain.links, (Joint("hinge", "revolute", "world", "bob", axes=(axis,)),))).joints["hinge"]
    joint.add_force(50.0)
    assert joint.effort() == 2.0
    world.step()
    assert joint.velocity() == pytest.approx(2.0 / 0.26 * 1e-3, rel=1e-6)
    for _ in range(1000):
        joint.add_force(2.0)
        world.step()
    assert 1.0 < joint.velocity() < 1.01
    joint.add_force(2.0)
    assert joint.effort() == 0.0
    world.step()
    joint.add_force(-2.0)
    assert joint.effort() == -2.0


def test_prismatic_joint_slides_and_reads_metres():
    link = Link("slide", Pose(), Inertial(2.0))
    joint = Joint("rail", "prismatic", "world", "slide", axes=(Axis((1, 0, 0), -0.5, 0.5),))
    world = ode_sim.World()
    rail = world.spawn(Model("m", Pose((0, 0, 1)), (link,), (joint,))).joints["rail"]
    for _ in range(200):
        rail.add_force(4.0)
        world.step()
    assert rail.velocity() == pytest.approx(0.4, rel=1e-6)
    assert rail.position() == pytest.approx(0.5 * 2.0 * 0.2**2, rel=1e-2)
    world.step(2000)
    assert rail.position() == pytest.approx(0.5, abs=1e-8)
    assert rail.child.pose.p[2] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_universal_joint_has_two_axes(kind):
    link = Link("bob", Pose(), Inertial(1.0, Pose((0, 0, -0.5)), 0.01, 0, 0, 0.01, 0, 0.01))
    joint = Joint("u", kind, "world", "bob", axes=(Axis((1, 0, 0), -0.6, 0.6), Axis((0, 1, 0))))
    world = ode_sim.World()
    u = world.spawn(Model("m", Pose((0, 0, 2)), (link,), (joint,))).joints["u"]
    assert u.axis_count == 2
    assert u.set_position(0.3, 0) and u.set_position(-0.4, 1)
    assert u.position(0) == pytest.approx(0.3) and u.position(1) == pytest.approx(-0.4)
    world.gravity = (0, 0, 0)
    u.set_motor(1.0, 1e4, 0)
    u.set_motor(-0.5, 1e4, 1)
    world.step(200)
    assert u.position(0) == pytest.approx(0.5, abs=1e-4) and u.position(1) == pytest.approx(-0.5, abs=1e-4)
    world.step(400)
    assert u.position(0) == pytest.approx(0.6, abs=0.01)
    assert world.joint_positions.shape == (2,)


def test_ball_joint_keeps_the_distance():
    link = Link("bob", Pose(), Inertial(1.0, Pose((0, 0, -0.5)), 0.01, 0, 0, 0.01, 0, 0.01))
    world = ode_sim.World()
    bob = world.spawn(Model("m", Pose((0, 0, 2)), (link,), (Joint("b", "ball", "world", "bob"),))).links["bob"]
    for _ in range(500):
        bob.add_force((3.0, 2.0, 0.0))
        world.step()
    assert np.linalg.norm(np.subtract(bob.pose.p, (0, 0, 2))) < 1e-9
    assert np.linalg.norm(np.subtract(bob.com(), (0, 0, 2))) == pytest.approx(0.5, abs=1e-9)
    assert bob.com()[0] > 0.05


def test_fixed_joint_makes_one_body_of_two():
    a, b = Link("a", Pose(), Inertial(1.0)), Link("b", Pose((0, 0, 1)), Inertial(3.0))
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    model = world.spawn(Model("m", Pose(), (a, b), (Joint("f", "fixed", "a", "b"),)))
    model.links["a"].add_force((4.0, 0, 0), (0, 0, 0.75))  # at the common centre of mass
    world.step()
    assert model.links["b"].linear_velocity() == pytest.approx((1e-3, 0, 0))
    assert model.links["a"].angular_velocity() == pytest.approx((0, 0, 0), abs=1e-12)


@pytest.mark.parametrize("kind", ["fixed", "revolute"])
def test_feedback_is_what_holds_the_child(kind):
    base = Link("base", Pose(), Inertial(1.0))
    tip = Link("tip", Pose((0.5, 0, 0)), Inertial(2.0, Pose((0.2, 0, 0))))
    joints = (
        Joint("bolt", "fixed", "world", "base"),
        Joint("j", kind, "base", "tip", axes=(Axis((0, 1, 0), 0.0, 0.0),), provide_feedback=True),
    )
    world = ode_sim.World()
    joint = world.spawn(Model("m", Pose((0, 0, 1)), (base, tip), joints)).joints["j"]
    world.step(300)
    force = joint.feedback()
    assert force.child_force == pytest.approx((0, 0, 2 * G), abs=1e-3)
    assert force.child_torque == pytest.approx((0, -0.2 * 2 * G, 0), abs=0.01)
    assert force.parent_force == pytest.approx((0, 0, -2 * G), abs=1e-3)


def test_motor_arm_holds_and_moves_against_gravity():
    world = ode_sim.World()
    model = world.spawn(arm(6, effort=300.0))
    joints = list(model.joints.values())[1:]
    for joint in joints:
        joint.set_motor(0.5, 1e5)
    world.step(1000)
    assert [j.position() for j in joints] == pytest.approx([0.5] * 6, abs=1e-6)
    assert not world.messages


def test_wrenches_last_one_step_and_set_overwrites():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    link = world.spawn(sphere(mass=2.0)).links["link"]
    link.add_force((1, 0, 0))
    link.add_force((1, 0, 0))
    assert link.force() == (2, 0, 0)
    link.set_force((4, 0, 0))
    assert link.force() == (4, 0, 0)
    world.step()
    assert link.linear_velocity() == pytest.approx((2e-3, 0, 0))
    assert link.force() == (0, 0, 0)
    world.step()
    assert link.linear_velocity() == pytest.approx((2e-3, 0, 0))


def test_force_at_a_point_turns_the_body():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    link = world.spawn(box(size=(0.2, 0.2, 0.2), at=(0, 0, 0))).links["link"]
    link.add_force((0, 0, 1.0), (0.1, 0, 0))
    world.step()
    assert link.angular_velocity()[1] == pytest.approx(-0.1 / link.inertia[1] * 1e-3, rel=1e-6)
    link.set_torque((0, 0.1, 0))
    world.step()
    assert link.angular_velocity()[1] == pytest.approx(0.0, abs=1e-9)


def test_four_bar_closed_loop_turns_without_falling_apart():
    up = Pose((0, 0, 0.2))
    links = (
        Link("crank", Pose(), Inertial(0.2, Pose((0, 0, 0.1)), 1e-3, 0, 0, 1e-3, 0, 1e-4)),
        Link("coupler", up, Inertial(0.2, Pose((0.2, 0, 0)), 1e-4, 0, 0, 1e-3, 0, 1e-3)),
        Link("rocker", Pose((0.4, 0, 0)), Inertial(0.2, Pose((0, 0, 0.1)), 1e-3, 0, 0, 1e-3, 0, 1e-4)),
    )
    axis = (Axis((0, 1, 0)),)
    joints = (
        Joint("a", "revolute", "world", "crank", axes=axis),
        Joint("b", "revolute", "crank", "coupler", axes=axis),
        Joint("c", "revolute", "coupler", "rocker", up, axis),
        Joint("d", "revolute", "world", "rocker", axes=axis),
    )
    world = ode_sim.World()
    model = world.spawn(Model("four_bar", Pose((0, 0, 1)), links, joints))
    model.joints["a"].set_motor(1.0, 50.0)
    world.step(800)
    a = model.joints["a"].position()
    assert a == pytest.approx(0.8, abs=0.01)
    assert model.joints["d"].position() == pytest.approx(a, abs=0.01)
    assert not model.joints["a"].set_position(0.0)  # a closed loop cannot be teleported
    assert not world.messages


# ------------------------------------------------------------------------------------------ centrifugal and Coriolis forces


def two_bars(second_axis, first=()):
    """Two bars of 1 kg, centres of mass 0.5 m below their joints, the second hinged at the first one's."""

    def bar(name, at):
        return Link(name, Pose((0, 0, at)), Inertial(1.0, Pose((0, 0, -0.5)), 0.01, 0, 0, 0.01, 0, 0.01))

    joint = Joint("second", "revolute", "a", "b", axes=(Axis(second_axis),))
    return Model("bars", Pose((0, 0, 2)), (bar("a", 0), bar("b", -0.5)), (*first, joint))


def energy_and_momentum(model, g=G):
    energy, momentum = 0.0, np.zeros(3)
    for link in model.links.values():
        v, w, p = (np.array(x) for x in (link.com_velocity(), link.angular_velocity(), link.com()))
        energy += 0.5 * link.mass * v @ v + 0.005 * w @ w + link.mass * g * p[2]
        momentum += link.mass * np.cross(p, v) + 0.01 * w
    return energy, momentum


def test_pendulum_on_a_turntable_against_the_accurate_solution():
    length, inertia, turns = 0.5, 1e-4, 6.0
    table = Link("table", Pose(), Inertial(5.0, Pose(), 1, 0, 0, 1, 0, 1))
    bob = Link("bob", Pose(), Inertial(1.0, Pose((0, 0, -length)), inertia, 0, 0, inertia, 0, inertia))
    joints = (
        Joint("turn", "revolute", "world", "table", axes=(Axis((0, 0, 1)),)),
        Joint("swing", "revolute", "table", "bob", axes=(Axis((0, 1, 0)),)),
    )
    world = ode_sim.World()
    model = world.spawn(Model("m", Pose((0, 0, 2)), (table, bob), joints))
    model.joints["swing"].set_position(0.5)
    model.joints["turn"].set_motor(turns, 1e6)
    q = []
    for _ in range(2000):
        world.step()
        q.append(model.joints["swing"].position())
    square, whole = length**2, length**2 + inertia
    truth = solve_ivp(
        lambda _, y: (y[1], (square * turns**2 * math.cos(y[0]) - G * length) * math.sin(y[0]) / whole),
        (0, 2),
        (0.5, 0),
        rtol=1e-10,
        t_eval=np.arange(1, 2001) * 1e-3,
    ).y[0]
    assert np.abs(q - truth).max() < 0.02


@pytest.mark.parametrize("second_axis", [(0, 1, 0), (1, 0, 0)])
def test_double_pendulum_keeps_its_energy(second_axis):
    world = ode_sim.World()
    model = world.spawn(two_bars(second_axis, (Joint("first", "revolute", "world", "a", axes=(Axis((0, 1, 0)),)),)))
    model.joints["first"].set_position(1.5)
    model.joints["second"].set_position(0.7)
    start = energy_and_momentum(model)[0]
    for _ in range(5):
        world.step(1000)
        assert energy_and_momentum(model)[0] == pytest.approx(start, abs=0.5)  # of 20 J that swing


def test_free_double_body_keeps_energy_and_angular_momentum():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    model = world.spawn(two_bars((1, 0, 0)))
    model.joints["second"].set_position(1.0)
    model.links["a"].set_twist((0, 0, 0), (1, 2, 3))
    world.step()
    energy, momentum = energy_and_momentum(model, 0)
    world.step(3000)
    later, turned = energy_and_momentum(model, 0)
    assert later == pytest.approx(energy, rel=0.01)
    assert np.linalg.norm(turned - momentum) < 0.01 * np.linalg.norm(momentum)


def test_feedback_holds_the_centripetal_force():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    arm_link = Link("arm", Pose(), Inertial(1.0))
    tip = Link("tip", Pose((0.5, 0, 0)), Inertial(2.0))
    joints = (
        Joint("turn", "revolute", "world", "arm", axes=(Axis((0, 0, 1)),)),
        Joint("hold", "revolute", "arm", "tip", axes=(Axis((0, 1, 0), 0.0, 0.0),), provide_feedback=True),
    )
    model = world.spawn(Model("m", Pose(), (arm_link, tip), joints))
    model.joints["turn"].set_motor(4.0, 1e5)
    world.step(500)
    force = model.joints["hold"].feedback().child_force
    assert math.hypot(*force) == pytest.approx(2.0 * 16.0 * 0.5, rel=0.01)
    assert np.dot(force, model.links["tip"].pose.p) < -7.9

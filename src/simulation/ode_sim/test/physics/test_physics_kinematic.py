"""Links that move as they are told, and what stands or hangs on them."""

import ode_sim
import pytest
from ode_sim.description.model import Axis, Collision, Inertial, Joint, Link, Model, Pose, Sphere, Surface
from physics_models import arm, box, box_inertia, ground, sphere

SLICK = Surface(mu=0.0, mu2=0.0)


def platform(**more):
    return box("platform", at=(0, 0, 1), size=(6, 6, 0.2), surface=Surface(mu=1.0, mu2=1.0), kinematic=True, **more)


def test_kinematic_link_moves_as_told_and_feels_nothing():
    world = ode_sim.World()
    lift = world.spawn(box("lift", at=(0, 0, 1), size=(1, 1, 0.1), kinematic=True))
    load = world.spawn(box("load", at=(0, 0, 1.1)))
    lift.set_twist((0, 0, 0.2), (0, 0, 0))
    world.step(1000)
    assert lift.pose.p[2] == pytest.approx(1.2, abs=1e-9)
    assert load.pose.p[2] == pytest.approx(1.3, abs=1e-3)


def test_what_moves_on_a_kinematic_link_is_stepped_once():
    """A ball on a frictionless platform keeps its speed, and covers the way of that speed."""
    world = ode_sim.World()
    deck = world.spawn(platform())
    ball, rider = world.spawn(sphere(at=(0, 0, 1.2), surface=SLICK)), world.spawn(box("rider", at=(0, -2, 1.15)))
    for i in range(12):
        world.spawn(box(f"b{i}", at=(0, 2, 1.15 + 0.1 * i)))  # a heap for the iterative solver
    ball.set_twist((1, 0, 0), (0, 0, 0))
    world.step(500)
    assert ball.pose.p[0] == pytest.approx(0.5, abs=1e-3)
    deck.set_twist((0, 0.4, 0), (0, 0, 0))
    ball.set_twist((1, 0, 0), (0, 0, 0))
    world.step(500)
    assert ball.pose.p[0] == pytest.approx(1.0, abs=1e-3) and ball.pose.p[1] == pytest.approx(0.0, abs=1e-6)
    assert deck.pose.p[1] == pytest.approx(0.2, abs=1e-9)
    assert rider.twist().linear[1] == pytest.approx(0.4, abs=1e-3)  # taken along
    assert not world.messages


@pytest.mark.parametrize("speed", [0.02, 0.5])
def test_what_sleeps_on_a_kinematic_link_wakes_when_that_starts(speed):
    world = ode_sim.World()
    deck, load = world.spawn(platform()), world.spawn(box("load", at=(0, 0, 1.15)))
    world.step(1200)
    assert load.asleep
    deck.set_twist((speed, 0, 0), (0, 0, 0))
    world.step(3000)
    assert deck.pose.p[0] == pytest.approx(3 * speed, abs=1e-9)
    assert load.pose.p[0] == pytest.approx(3 * speed, abs=0.02) and not load.asleep
    deck.set_twist((0, 0, 0), (0, 0, 0))
    world.step(1200)
    assert load.asleep


def hub(name, at, reach):
    """A kinematic link with two pendulums, the second of which has a foot ``reach`` below the hinge."""
    links, joints = [Link("hub", Pose(), Inertial(1.0), kinematic=True)], []
    for bob, y, foot in (("free", 0.0, ()), ("footed", 0.5, (Collision("foot", Pose((0, 0, -reach)), Sphere(0.05), SLICK),))):
        links.append(Link(bob, Pose((0, y, 0)), box_inertia(1.0, (0.1, 0.1, 0.1), Pose((0, 0, -0.5))), foot))
        joints.append(Joint(bob, "revolute", "hub", bob, axes=(Axis((0, 1, 0)),)))
    return Model(name, Pose(at), tuple(links), tuple(joints))


def test_neighbours_on_a_kinematic_link_are_stepped_once():
    """One swings freely, the other drags a foot over the ground: the first swings as where nothing touches."""
    world = ode_sim.World()
    world.spawn(ground())
    alone, together = world.spawn(hub("alone", (5, 0, 9), 0.5)), world.spawn(hub("together", (0, 0, 0.545), 0.5))
    for model in (alone, together):
        model.joints["free"].set_position(0.6)
        model.set_twist((0, 0, 0), (0, 0, 0))
    for _ in range(40):
        world.step(25)
        assert together.joints["free"].position() == pytest.approx(alone.joints["free"].position(), abs=1e-4)
    assert world.contacts().size


def test_an_attachment_to_a_position_driven_link_steps_nothing_twice():
    """What hangs by a joint on a link that is driven swings the same, whether or not the link holds what touches the ground."""
    world = ode_sim.World()
    world.spawn(ground())
    arms = [world.spawn(arm(3, at=(x, 0, 0)), name=f"arm{x}") for x in (0, 3)]
    for model in arms:
        model.joints["j0"].drive_to(0.0)
        model.joints["j1"].drive_to(0.5)
        model.joints["j2"].set_position(1.0)
    load = world.spawn(sphere("load", at=(0, 0.5, 0.0999), surface=SLICK))
    world.step(2)
    world.attach(arms[0].links["link1"], load.links["link"])
    for _ in range(40):
        world.step(10)
        assert arms[0].joints["j2"].position() == pytest.approx(arms[1].joints["j2"].position(), abs=1e-3)

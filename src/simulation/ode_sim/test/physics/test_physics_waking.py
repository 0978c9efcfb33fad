"""What sleeps wakes when what holds it, pushes it or pulls it changes."""

import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Axis, Collision, Heightmap, Joint, Link, Model, Physics, Pose, Surface
from ode_sim.math3 import quat_from_rpy
from physics_models import box, box_inertia, ground, sphere
from PIL import Image

G = 9.8
SIDE = 0.1  # m, of the boxes
SHELF = box("shelf", at=(0, 0, 1.95), size=(0.4, 0.4, 0.1), static=True)  # its upper side at 2 m
SECONDS = 0.2  # after what happened, for a look
FALLS = 0.5 * G * SECONDS**2


def asleep(world, count, dt):
    """``count`` boxes on each other, above what is in the world, and one far off on the ground; all asleep."""
    world.physics.max_step_size = dt
    world.spawn(ground())
    stack = [world.spawn(box(f"box{i}", at=(0, 0, 2 + SIDE * (i + 0.5)))) for i in range(count)]
    control = world.spawn(box("control", at=(5, 5, SIDE / 2)))
    for _ in range(100):
        world.step(round(0.1 / dt))
        if all(model.asleep for model in [*stack, control]):
            return stack, control
    raise AssertionError("they do not fall asleep")


def fallen(world, stack):
    """m, of each, in the next SECONDS."""
    before = [model.pose.p[2] for model in stack]
    world.step(round(SECONDS / world.dt))
    return [z - model.pose.p[2] for z, model in zip(before, stack)]


def falls_whole(world, stack, control):
    """Freely, all of them, and what had nothing to do with it sleeps on. Euler's steps are half a step ahead of the law."""
    expected = FALLS + 0.5 * G * SECONDS * world.dt
    assert fallen(world, stack) == pytest.approx([expected] * len(stack), abs=1e-3 + G * SECONDS * world.dt)
    assert control.asleep


def deleted(world):
    world.remove("shelf")


def set_elsewhere(world):
    world.models["shelf"].pose = Pose((0, 3, 1.95))


def set_lower(world):
    world.models["shelf"].pose = Pose((0, 0, 0.5))


def led_away(world):
    world.models["shelf"].core.lead([(0.0, 3.0, 1.95, 0.0, 0.0, 0.0, 1.0)], [-1], 0.001)


def let_through(world):
    world.models["shelf"].links["link"].collisions["box"].surface.collide_bitmask = 0


def made_a_sensor(world):
    world.models["shelf"].links["link"].collisions["box"].surface.collide_without_contact = True


@pytest.mark.parametrize("dt", [0.001, 0.01])
@pytest.mark.parametrize("act", [deleted, set_elsewhere, set_lower, led_away, let_through, made_a_sensor])
def test_a_stack_whose_support_goes_falls_whole(act, dt):
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 4, dt)
    act(world)
    falls_whole(world, stack, control)


def test_what_a_link_of_a_robot_held_falls():
    """Its base hangs from the world by a fixed joint; the joint to the shelf is teleported, and then the robot."""
    for act in (
        lambda robot: robot.joints["slide"].set_position(-0.8),
        lambda robot: setattr(robot, "pose", Pose((0, 0, -0.8))),
        lambda robot: robot.joints["slide"].drive_off(),
        lambda robot: robot.remove(),
    ):
        world = ode_sim.World()
        links = (Link("base", Pose((2, 0, 1.95)), box_inertia(1.0, (0.1, 0.1, 0.1))), replace(SHELF.links[0], pose=SHELF.pose))
        joints = (Joint("bolt", "fixed", "world", "base"), Joint("slide", "prismatic", "base", "link", axes=(Axis((0, 0, 1)),)))
        robot = world.spawn(Model("robot", Pose(), links, joints))
        robot.joints["slide"].drive_to(0.0)
        world.physics.max_step_size = 0.001
        stack, control = [world.spawn(box(f"box{i}", at=(0, 0, 2 + SIDE * (i + 0.5)))) for i in range(2)], world.spawn(ground())
        world.step(2500)
        act(robot)
        assert fallen(world, stack) == pytest.approx([FALLS] * 2, abs=5e-3)
        assert control.static


def test_what_rests_on_a_sleeper_falls_with_it():
    """The lowest of the stack is deleted, set elsewhere, loses its shape's contact; the others rest on it alone."""

    def away(model):
        model.pose = Pose((0, 3, 0.05))

    def thrown(model):
        model.set_twist((30.0, 0, 0), (0, 0, 0))

    for act in (lambda model: model.remove(), away, thrown):
        world = ode_sim.World()
        world.spawn(SHELF)
        stack, control = asleep(world, 4, 0.01)
        act(stack[0])
        heights = [model.pose.p[2] for model in stack[1:]]
        world.step(100)
        assert [model.pose.p[2] for model in stack[1:]] == pytest.approx([z - SIDE for z in heights], abs=0.02)
        assert control.asleep


def test_a_bridge_tips_when_one_of_its_piers_goes():
    world = ode_sim.World()
    world.spawn(ground())
    for side, name in ((-1, "left"), (1, "right")):
        world.spawn(box(name, at=(0.2 * side, 0, SIDE / 2)))
    deck = world.spawn(box("deck", at=(0, 0, 1.5 * SIDE), size=(0.6, 0.1, 0.1), mass=2.0))
    world.step(2500)
    assert deck.asleep
    world.remove("left")
    world.step(1000)
    assert deck.pose.p[2] < 1.3 * SIDE and deck.links["link"].pose.p[0] < 0.1


@pytest.mark.parametrize("way", ["gravity", "set_physics"])
def test_gravity_that_turns_lifts_all(way):
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 2, 0.001)
    if way == "gravity":
        world.gravity = (0, 0, 1.0)
    else:
        world.set_physics(Physics(), (0, 0, 1.0))
    assert fallen(world, [*stack, control]) == pytest.approx([-0.5 * SECONDS**2] * 3, abs=1e-3)


@pytest.mark.parametrize(
    "name, value",
    [
        ("max_step_size", 0.002),
        ("iters", 100),
        ("erp", 0.5),
        ("cfm", 1e-3),
        ("sor", 1.0),
        ("max_contacts", 3),
        ("contact_max_correcting_vel", 1.0),
        ("solver", "gazebo"),
    ],
)
def test_every_setting_of_the_physics_wakes_if_it_is_another(name, value):
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 2, 0.001)
    setattr(world.physics, name, getattr(world.physics, name))
    world.gravity = world.gravity
    world.set_physics(world.physics.record(), world.gravity)
    world.step()
    assert control.asleep and all(model.asleep for model in stack)
    setattr(world.physics, name, value)
    world.step()
    assert not control.asleep and not any(model.asleep for model in stack)


def on_a_slope(angle=0.2):
    """A box asleep on a slope that holds it by its friction."""
    world = ode_sim.World()
    plank = world.spawn(box("plank", size=(4, 1, 0.1), at=(0, 0, 2), rpy=(0, angle, 0), static=True))
    lies = 0.05 + SIDE / 2
    load = world.spawn(box("load", at=(lies * math.sin(angle), 0, 2 + lies * math.cos(angle)), rpy=(0, angle, 0)))
    world.step(2500)
    assert load.asleep
    return world, plank, load


@pytest.mark.parametrize("whose", ["plank", "load"])
def test_it_slides_when_the_friction_of_either_goes(whose):
    world, *_ = on_a_slope()
    load, surface = world.models["load"], world.models[whose].links["link"].collisions["box"].surface
    surface.mu = surface.mu2 = 0.0
    world.step(200)
    assert np.linalg.norm(load.twist().linear) == pytest.approx(G * math.sin(0.2) * 0.2, rel=0.02)


def test_a_slope_that_slips_lets_it_creep():
    world, plank, load = on_a_slope()
    plank.links["link"].collisions["box"].surface.slip1 = 1.0
    plank.links["link"].collisions["box"].surface.slip2 = 1.0
    before = load.pose.p[0]
    world.step(500)
    assert load.pose.p[0] > before + 0.01


def test_a_link_whose_gravity_or_inertia_changes_wakes_and_its_neighbours():
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 2, 0.001)
    stack[0].links["link"].set_inertial(box_inertia(5.0, (SIDE,) * 3))
    world.step()
    assert not any(model.asleep for model in stack) and control.asleep
    world.step(2000)
    assert all(model.asleep for model in stack)
    stack[1].links["link"].gravity = False
    stack[1].links["link"].add_force((0, 0, 1e-3))
    world.step()
    assert not any(model.asleep for model in stack)


def test_attachments_that_end_or_move_wake_both():
    """A box hangs by an attachment from one that sleeps on the shelf; beside it, touching nothing."""
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 1, 0.001)
    beside = world.spawn(box("beside", at=(0, 0.5, 2.05), mass=0.05))
    hold = world.attach(stack[0].links["link"], beside.links["link"])
    world.step(2500)
    assert beside.asleep and stack[0].asleep
    world.remove("shelf")
    assert fallen(world, [*stack, beside]) == pytest.approx([FALLS] * 2, abs=5e-3)
    world.step(3000)
    assert beside.asleep == stack[0].asleep
    assert hold.active and control.asleep


def test_what_an_attachment_held_falls_when_it_ends():
    for act in (lambda hold, world: hold.detach(), lambda hold, world: setattr(hold, "pose", Pose((0, 0, 1.5)))):
        world = ode_sim.World()
        world.spawn(SHELF)
        stack, control = asleep(world, 2, 0.001)
        hold = world.attach(None, stack[0].links["link"])
        world.step(2500)
        world.remove("shelf")
        world.step(2500)
        assert stack[1].pose.p[2] == pytest.approx(2.15, abs=2e-3)
        act(hold, world)
        world.step(200)
        assert all(model.pose.p[2] < z - 0.1 for model, z in zip(stack, (2.05, 2.15)))
        assert control.asleep


@pytest.mark.parametrize("dt", [0.001, 0.01])
def test_a_kinematic_lift_takes_a_sleeping_stack_down(dt):
    world = ode_sim.World()
    lift = world.spawn(box("lift", at=(0, 0, 1.95), size=(0.4, 0.4, 0.1), kinematic=True))
    stack, control = asleep(world, 4, dt)
    lift.set_twist((0, 0, -0.5), (0, 0, 0))
    assert fallen(world, stack) == pytest.approx([0.5 * SECONDS] * 4, abs=0.02)
    assert control.asleep
    lift.pose = Pose((0, 3, 1.95))
    lift.set_twist((0, 0, 0), (0, 0, 0))
    assert min(fallen(world, stack)) > 0.8 * FALLS


def test_a_belt_that_starts_takes_along_what_sleeps_on_it_and_lets_nothing_fall_asleep():
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 1, 0.001)
    belt = world.models["shelf"].links["link"]
    world.before_step.append(lambda w: belt.run_belt(-0.05, (0, 1, 0)))
    world.step(2500)
    assert stack[0].links["link"].pose.p[0] == pytest.approx(-0.05 * 2.5, abs=2e-3)
    assert not stack[0].asleep and control.asleep


def test_a_position_driven_lift_takes_a_sleeping_stack_down():
    world = ode_sim.World()
    links = (Link("base", Pose((1, 0, 1.95)), box_inertia(1.0, (0.1, 0.1, 0.1))), replace(SHELF.links[0], pose=SHELF.pose))
    joints = (
        Joint("bolt", "fixed", "world", "base"),
        Joint("lift", "prismatic", "base", "link", axes=(Axis((0, 0, 1), -2.0, 2.0, 1000.0, 5.0),)),
    )
    robot = world.spawn(Model("robot", Pose(), links, joints))
    robot.joints["lift"].drive_to(0.0)
    stack, control = asleep_or_still(world)
    start = [model.pose.p[2] for model in stack]
    for i in range(400):
        robot.joints["lift"].drive_to(-0.0005 * (i + 1))
        world.step()
    assert [z - model.pose.p[2] for model, z in zip(stack, start)] == pytest.approx([0.2] * 3, abs=0.01)
    assert control.asleep


def asleep_or_still(world):
    """As asleep(): on a link that a motor holds nothing needs to sleep."""
    world.spawn(ground())
    stack = [world.spawn(box(f"box{i}", at=(0, 0, 2 + SIDE * (i + 0.5)))) for i in range(3)]
    control = world.spawn(box("control", at=(5, 5, SIDE / 2)))
    world.step(3000)
    return stack, control


def test_what_sleeps_on_a_heightmap_falls_when_it_is_removed(tmp_path):
    Image.fromarray(np.zeros((17, 17), dtype=np.uint8)).save(tmp_path / "flat.png")
    link = Link("link", collisions=(Collision("c", Pose(), Heightmap(str(tmp_path / "flat.png"), size=(4.0, 4.0, 1.0))),))
    world = ode_sim.World()
    world.spawn(Model("hills", Pose((0, 0, 2)), (link,), static=True))
    stack, control = asleep(world, 2, 0.001)
    world.remove("hills")
    falls_whole(world, stack, control)


def test_what_is_spawned_into_a_sleeper_wakes_it():
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 2, 0.001)
    world.spawn(box("wedge", at=(0.0, 0.0, 2.09), size=(0.2, 0.2, 0.2), static=True))
    world.step()
    assert not any(model.asleep for model in stack) and control.asleep


def test_a_static_thing_that_is_set_onto_a_sleeper_pushes_it_out():
    world = ode_sim.World()
    world.spawn(ground())
    wall = world.spawn(box("wall", at=(3, 0, 0.1), size=(0.2, 0.2, 0.2), static=True))
    load = world.spawn(box("load"))
    world.step(2000)
    assert load.asleep
    wall.pose = Pose((0.14, 0, 0.1))  # a centimetre into it
    world.step(2000)
    assert load.pose.p[0] < -0.005


def test_the_lowest_that_is_pulled_out_by_a_force_lets_the_others_fall():
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 4, 0.01)
    for _ in range(100):
        stack[0].links["link"].add_force((2000.0, 0, 0))
        world.step()
    assert all(model.pose.p[2] < 2 + SIDE * (i + 0.7) for i, model in enumerate(stack[1:]))
    assert control.asleep


# ---------------------------------------------------------------------------------------------- snapshots, resets


def test_a_snapshot_keeps_who_sleeps_and_what_has_just_changed():
    def made():
        world = ode_sim.World()
        world.spawn(SHELF)
        return world, *asleep(world, 3, 0.001)

    def changed(world):
        world.models["shelf"].links["link"].collisions["box"].surface.collide_bitmask = 0
        world.models["control"].links["link"].collisions["box"].surface.mu = 0.5

    straight, *_ = made()
    changed(straight)
    straight.step(300)
    world, *_ = made()
    changed(world)
    saved = world.save()
    world.step(300)
    assert bytes(world.save()) == bytes(straight.save())
    world.restore(saved)
    world.step(300)
    assert bytes(world.save()) == bytes(straight.save())


def test_restored_sleepers_sleep_on_and_wake_as_before():
    world = ode_sim.World()
    shelf = world.spawn(SHELF)
    stack, control = asleep(world, 3, 0.001)
    saved = world.save()
    world.gravity = (0, 0, -3.0)
    shelf.pose = Pose((0, 3, 1.95))
    world.step(400)
    assert stack[0].pose.p[2] < 1.9
    world.restore(saved)
    world.step(500)
    assert all(model.asleep for model in [*stack, control])
    assert bytes(world.save())[-100:] != b"" and stack[2].pose.p[2] == pytest.approx(2.25, abs=1e-3)
    shelf.pose = Pose((0, 3, 1.95))
    falls_whole(world, stack, control)


def test_after_a_reset_nothing_hangs():
    """The shelf comes back below where the stack has fallen from; and what was spawned in the air falls again."""
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 2, 0.001)
    world.models["shelf"].pose = Pose((0, 0, 1.0))
    world.step(3000)
    assert stack[0].pose.p[2] == pytest.approx(1.1, abs=2e-3)
    for reset in (world.reset_poses, world.reset):
        ball = world.spawn(sphere(f"ball{reset.__name__}", at=(1, 1, 3)))
        world.step(3000)
        reset()
        world.step(100)
        assert ball.pose.p[2] == pytest.approx(3 - 0.5 * G * 0.01, abs=1e-3)
        assert stack[0].pose.p[2] == pytest.approx(2.05, abs=2e-3)
        world.step(2000)


def test_what_sleeps_costs_and_changes_nothing():
    """Far events leave sleepers asleep, to the last bit of where they are."""
    world = ode_sim.World()
    world.spawn(SHELF)
    stack, control = asleep(world, 3, 0.001)
    before = [model.pose for model in [*stack, control]]
    walker = world.spawn(box("walker", at=(2, 0, 1), static=True))
    for i in range(50):
        walker.pose = Pose((2, 0.01 * i, 1), quat_from_rpy(0, 0, 0.01 * i))
        world.step()
    world.spawn(sphere("passing", at=(1, 1, 1))).remove()
    walker.links["link"].collisions["box"].surface.mu = 0.1
    world.step(10)
    assert all(model.asleep for model in [*stack, control]) and [model.pose for model in [*stack, control]] == before


def test_the_surface_of_what_was_removed_can_still_be_written():
    world = ode_sim.World()
    surface = world.spawn(box("gone")).links["link"].collisions["box"].surface
    world.remove("gone")
    surface.mu = 0.3
    world.step()
    assert surface.mu == 0.3 and Surface().mu == 1.0

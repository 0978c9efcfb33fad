"""The world as a whole: same run same bits, snapshots, resets, spawning and removing, bad input."""

import math
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description import model as d
from ode_sim.description.model import Pose
from ode_sim.math3 import quat_from_rpy
from physics_determinism import busy_world, digest
from physics_models import arm, box, diff_drive, ground, pendulum, sphere

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


# ---------------------------------------------------------------------------------------------- determinism


@pytest.mark.slow
def test_two_processes_give_the_same_bits_one_of_them_under_load():
    run = [sys.executable, os.path.join(HERE, "physics_determinism.py"), "2000"]
    alone = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(3)]
    try:
        loaded = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    finally:
        for process in load:
            process.kill()
            process.wait()
    assert len(alone.strip()) == 64
    assert alone == loaded


def test_two_worlds_in_one_process_do_not_disturb_each_other():
    alone = busy_world()
    alone.step(600)
    first, second = busy_world(), busy_world()
    for _ in range(60):
        first.step(10)
        second.step(10)
    assert digest(first) == digest(second) == digest(alone)


def test_another_seed_gives_other_bits():
    first, second = busy_world(seed=1), busy_world(seed=2)
    first.step(10)
    second.step(10)
    assert digest(first) != digest(second)


def test_random_streams_depend_on_seed_and_name_alone():
    a, b = ode_sim.World(seed=5), ode_sim.World(seed=5)
    b.rng("other").normal(size=10)
    assert (a.rng("laser").normal(size=5) == b.rng("laser").normal(size=5)).all()
    assert ode_sim.World(seed=6).rng("laser").normal() != ode_sim.World(seed=5).rng("laser").normal()


@pytest.mark.slow
@pytest.mark.parametrize("moment", [50, 700, 1300])
def test_going_on_from_a_snapshot_gives_the_same_bits(moment):
    world = busy_world()
    world.step(moment)
    snapshot = world.save()
    world.rng("noise").normal()
    world.step(400)
    end = world.save()
    world.restore(snapshot)
    assert world.save() == snapshot
    assert world.time == pytest.approx(moment * 1e-3)
    world.rng("noise").normal()
    world.step(400)
    assert world.save() == end
    other = busy_world()  # into a fresh world of the same models
    other.restore(snapshot)
    other.rng("noise").normal()
    other.step(400)
    assert other.save() == end


def test_saving_does_not_change_the_run():
    watched, plain = busy_world(), busy_world()
    for _ in range(30):
        watched.step(20)
        watched.save()
    plain.step(600)
    assert watched.save() == plain.save()


def test_a_snapshot_of_other_models_is_refused():
    world = ode_sim.World()
    world.spawn(sphere())
    snapshot = world.save()
    world.spawn(sphere("second", at=(2, 0, 0)))
    with pytest.raises(ValueError, match="second"):
        world.restore(snapshot)


# ---------------------------------------------------------------------------------------------- callbacks, time


def test_callbacks_see_the_time_of_the_state_they_produce():
    world = ode_sim.World()
    seen = []
    world.before_step.append(lambda w: seen.append(("before", w.time_ns)))
    world.after_step.append(lambda w: seen.append(("after", w.time_ns)))
    world.step(2)
    assert seen == [("before", 1000000), ("after", 1000000), ("before", 2000000), ("after", 2000000)]


def test_physics_changes_at_run_time():
    world = ode_sim.World()
    world.physics.max_step_size = 0.002
    world.step(5)
    assert world.time == pytest.approx(0.01) and world.dt == 0.002
    world.physics.iters = 20.0
    assert world.physics.iters == 20
    for name, bad in (("max_step_size", 0.0), ("iters", -1), ("erp", math.nan)):
        with pytest.raises(ValueError, match=name):
            setattr(world.physics, name, bad)
    assert world.dt == 0.002


@pytest.mark.parametrize(
    "name,bad",
    [
        ("max_step_size", 1e300),
        ("max_step_size", 1e9),
        ("max_step_size", 1e-12),
        ("max_step_size", math.inf),
        ("real_time_update_rate", 1e-300),
        ("real_time_update_rate", -1.0),
        ("max_contacts", 0),
        ("max_contacts", -3),
        ("max_contacts", 1e150),
        ("max_contacts", 2**64),
        ("iters", 0),
        ("iters", 10_001),
        ("iters", 2**31),
        ("sor", 0.0),
        ("sor", "much"),
        ("cfm", -1.0),
        ("erp", math.nan),
        ("contact_surface_layer", None),
    ],
)
def test_physics_beyond_reason_is_refused_as_a_whole(name, bad):
    world = ode_sim.World()
    world.step()
    before, gravity = world.physics.record(), world.gravity
    with pytest.raises(ValueError, match=name) as error:
        world.set_physics(
            replace(before, max_step_size=0.01, **{name: bad}) if name != "max_step_size" else replace(before, iters=7, **{name: bad}),
            gravity=(0, 0, 1),
        )
    assert "\n" not in str(error.value) and len(str(error.value)) < 200
    with pytest.raises(ValueError, match=name):
        setattr(world.physics, name, bad)
    assert world.physics.record() == before and world.gravity == gravity and world.dt == 0.001
    world.step()
    loaded = ode_sim.World(d.World(physics=replace(d.Physics(), **{name: bad}), models=(sphere(),)))  # a file: limited, with one line
    assert [name in p.message for p in loaded.problems] == [True]
    loaded.step(3)
    assert loaded.time > 0.0 and np.isfinite(loaded.link_poses).all()


@pytest.mark.parametrize("gravity", [(0, 0, 1e300), (0, math.nan, 0), (0, 0), (0, 0, math.inf)])
def test_gravity_beyond_reason_changes_nothing(gravity):
    world = ode_sim.World()
    before = world.physics.record()
    for change in (lambda: setattr(world, "gravity", gravity), lambda: world.set_physics(replace(before, iters=7), gravity)):
        with pytest.raises(ValueError, match="gravity"):
            change()
    assert world.gravity == (0, 0, -9.8) and world.physics.record() == before
    assert ode_sim.World(d.World(gravity=gravity)).gravity == (0, 0, -9.8)


def test_physics_set_as_a_whole():
    world = ode_sim.World()
    world.set_physics(replace(world.physics.record(), max_step_size=0.002, iters=30, real_time_update_rate=0.0), gravity=(0, 0, -1.6))
    world.step()
    assert (world.dt, world.time_ns, world.physics.iters, world.physics.real_time_update_rate) == (0.002, 2000000, 30, 0.0)
    assert world.gravity == (0, 0, -1.6)
    with pytest.raises(AttributeError, match="no parameter 'itres'"):
        world.physics.itres = 5


# ---------------------------------------------------------------------------------------------- poses, resets


def test_model_pose_moves_everything_rigidly_bolts_included():
    world = ode_sim.World()
    model = world.spawn(arm(2))
    list(model.joints.values())[1].drive_to(0.4)
    world.step()
    tip = model.links["link1"].pose.p
    model.pose = Pose((1, 2, 0), quat_from_rpy(0, 0, math.pi / 2))
    assert model.pose.p == pytest.approx((1, 2, 0))
    assert model.links["link1"].pose.p == pytest.approx((1 - tip[1], 2 + tip[0], tip[2]))
    world.step(200)
    assert model.pose.p == pytest.approx((1, 2, 0), abs=1e-12)
    assert list(model.joints.values())[1].position() == 0.4


def test_set_twist_gives_every_link_the_same():
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    robot = world.spawn(diff_drive(at=(0, 0, 1)))
    robot.set_twist((1, 0, 0), (0, 0, 0.5))
    for link in robot.links.values():
        assert link.com_velocity() == pytest.approx((1, 0, 0))
        assert link.angular_velocity() == pytest.approx((0, 0, 0.5))
    assert robot.twist().linear == pytest.approx((1, 0, 0))


def test_moving_one_link_leaves_its_joint_to_mend_it():
    world = ode_sim.World()
    robot = world.spawn(diff_drive(at=(0, 0, 1)))
    robot.links["left"].pose = Pose((0, 0.3, 1.05))
    assert robot.links["left"].pose.p == pytest.approx((0, 0.3, 1.05))
    world.step(1)
    apart = np.subtract(robot.links["left"].pose.p, robot.links["base"].pose.p)
    assert np.linalg.norm(apart) == pytest.approx(math.hypot(0.15, 0.02), abs=1e-6)
    assert max(np.linalg.norm(link.com_velocity()) for link in robot.links.values()) < 1.0


def test_teleporting_a_joint_moves_what_is_beyond_and_stops_it():
    world = ode_sim.World()
    model = world.spawn(arm(3))
    joints = list(model.joints.values())[1:]
    assert joints[1].set_position(math.pi / 2)
    assert model.links["link2"].pose.p == pytest.approx((0.2, 0, 0.3))
    assert joints[1].position() == pytest.approx(math.pi / 2) and joints[1].velocity() == 0.0
    assert world.joint_positions[joints[1].index] == pytest.approx(math.pi / 2)
    joints[1].set_position(99.0)
    assert joints[1].position() == pytest.approx(3.0)


def falling_arm():
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(arm(2))
    free = world.spawn(box("free", at=(2, 0, 1)))
    list(model.joints.values())[2].set_position(0.5)
    world.step(300)
    return world, list(model.joints.values())[2], free


def test_reset_poses_keeps_joint_angles_and_time():
    world, joint, free = falling_arm()
    angle, time = joint.position(), world.time
    world.reset_poses()
    assert joint.position() == pytest.approx(angle) and joint.velocity() == 0.0 and world.time == time
    assert free.pose.p == pytest.approx((2, 0, 1)) and free.twist().linear == (0, 0, 0)


def test_reset_starts_again_with_the_same_bits():
    world = busy_world()
    fresh = busy_world()
    fresh.step(300)
    world.step(900)
    world.reset()
    assert world.time == 0.0 and world.iterations == 0
    for model in world.models.values():
        assert model.pose.p == pytest.approx(model.initial_pose.p, abs=1e-9)
        assert all(abs(j.position(a)) < 1e-9 for j in model.joints.values() for a in range(j.axis_count))
    world.step(300)
    assert world.models["mover"].joints["j0"].position() == pytest.approx(fresh.models["mover"].joints["j0"].position(), abs=1e-6)


def test_shared_arrays_are_views():
    world = ode_sim.World()
    model = world.spawn(pendulum())
    positions, poses = world.joint_positions, world.link_poses
    model.joints["hinge"].set_motor(1.0, 1e4)
    world.step(100)
    assert positions[model.joints["hinge"].index] == model.joints["hinge"].position() != 0.0
    assert tuple(poses[model.links["bob"].index]) == (*model.links["bob"].pose.p, *model.links["bob"].pose.q)


def test_what_is_spawned_is_in_the_shared_arrays_at_once():
    world = ode_sim.World()
    world.spawn(ground())
    world.step(10)
    for number in range(2):
        model = world.spawn(pendulum(), name=f"late{number}", pose=Pose((3.0 + number, -1.0, 2.0)))
        for link in model.links.values():
            assert tuple(world.link_poses[link.index]) == (*link.pose.p, *link.pose.q)
    poses = world.link_poses.copy()
    world.remove("late1")
    assert np.array_equal(world.link_poses, poses[: len(world.link_poses)])


# ---------------------------------------------------------------------------------------------- spawning


def test_spawn_and_remove_while_running():
    world = ode_sim.World()
    world.spawn(ground())
    events = []
    world.on_spawn.append(lambda m: events.append(("spawn", m.name)))
    world.on_remove.append(lambda m: events.append(("remove", m.name)))
    for round_ in range(20):
        robot = world.spawn(diff_drive(), name=f"robot{round_ % 3}", pose=Pose((round_, 0, 0)))
        robot.joints["left"].set_motor(5.0, 5.0)
        robot.joints["left"].drive_to(0.1) if round_ % 2 else None
        world.step(20)
        if round_ >= 2:
            world.remove(f"robot{(round_ - 2) % 3}")
            world.step(5)
    assert len(world.models) == 3 and len(events) == 38
    assert world.joint_positions.shape == (4,) and world.link_poses.shape == (7, 7)
    last = world.models["robot1"]
    assert [link.index for link in last.links.values()] == [4, 5, 6]
    last.remove()
    assert "robot1" not in world.models
    with pytest.raises(RuntimeError, match="no longer in the world"):
        last.joints["left"].drive_to(0.0)


def test_looking_up_names_scoped_or_not_first_hit_wins():
    world = ode_sim.World()
    first, second = world.spawn(diff_drive(), name="a"), world.spawn(diff_drive(at=(2, 0, 0)), name="b")
    assert world.find_link("base") is first.links["base"]
    assert world.find_link("b::base") is second.links["base"]
    assert world.find_joint("b::left") is second.joints["left"] and world.find_joint("left") is first.joints["left"]
    assert world.find_entity("b") is second and world.find_entity("a::base") is first.links["base"]
    assert world.find_entity("nothing") is None and world.find_link("b::nothing") is None


def test_a_saved_world_continues_where_it_was():
    state = d.WorldState(
        12.5,
        12500,
        (d.ModelState("box", Pose((1, 2, 3)), links=(d.LinkState("link", Pose((1, 2, 3)), (0.5, 0, 0), (0, 0, 1)),)),),
        deletions=("gone",),
    )
    world = ode_sim.World(d.World(models=(box(), box("gone", at=(5, 0, 0))), state=state))
    assert world.time == 12.5 and world.iterations == 12500
    assert list(world.models) == ["box"]
    model = world.models["box"]
    assert model.pose.p == (1, 2, 3) and model.twist().linear == (0.5, 0, 0) and model.twist().angular == (0, 0, 1)


def test_urdf_text_spawns():
    text = """<robot name="two"><link name="a"><inertial><mass value="1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <link name="b"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="j" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint></robot>"""
    world = ode_sim.World()
    model = world.spawn_urdf(text, name="robot", pose=Pose((0, 0, 2)))
    assert list(model.joints) == ["j"] and model.links["b"].pose.p == pytest.approx((0, 0, 3))
    assert model.joints["j"].limits() == (-math.inf, math.inf)

"""Input that cannot be simulated: one line, or left out by name; what goes wrong on the way is stopped alone."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description import model as d
from ode_sim.description.model import Box, Collision, Inertial, Joint, Link, Mesh, Model, Pose
from physics_models import box, gripper, ground, pendulum, sphere


def test_a_taken_name_is_refused_in_one_line():
    world = ode_sim.World()
    world.spawn(box())
    with pytest.raises(ode_sim.DescriptionError, match="'box' is in the world already") as error:
        world.spawn(box())
    assert "\n" not in str(error.value)
    assert len(world.models) == 1


@pytest.mark.parametrize(
    "inertial",
    [
        Inertial(0.0),
        Inertial(-1.0),
        Inertial(math.nan),
        Inertial(1.0, ixx=-1.0),
        Inertial(1.0, ixx=math.inf),
        Inertial(1.0, ixx=0.0, iyy=0.0, izz=0.0),
        Inertial(1.0, ixy=5.0),
        Inertial(1e-9),
        Inertial(1.0, ixx=1e30, iyy=1e-30, izz=1.0),
    ],
)
def test_impossible_masses_and_tensors_are_made_usable(inertial):
    link = Link("link", inertial=inertial, collisions=(Collision("c", Pose(), Box((0.1, 0.1, 0.1))),))
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(Model("odd", Pose((0, 0, 0.2)), (link,)))
    other = world.spawn(box("other", at=(3, 0, 0.05)))
    world.step(1000)
    assert np.isfinite(world.link_poses).all()
    assert 0.0 < model.pose.p[2] < 0.3
    assert other.pose.p == pytest.approx((3, 0, 0.05), abs=1e-4)
    assert all("odd" in str(p) for p in world.problems)


def test_a_missing_mesh_is_one_warning_in_all():
    mesh = '<{0}><geometry><mesh filename="package://gone/m.stl"/></geometry></{0}>'
    world = ode_sim.World()
    world.spawn_urdf(
        '<robot name="r"><link name="l"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" '
        'iyz="0" izz="1"/></inertial>' + mesh.format("visual") + mesh.format("collision") + "</link></robot>"
    )
    assert [p.severity for p in world.problems] == ["warning"]
    assert "package://gone/m.stl" in str(world.problems[0])


@pytest.mark.parametrize(
    "shape", [Box((0.1, -1, 0.1)), d.Sphere(0.0), d.Cylinder(0.1, math.nan), Mesh("/none/x.stl", "model://none/x.stl")]
)
def test_impossible_shapes_are_left_out_by_name(shape):
    link = Link("link", inertial=Inertial(), collisions=(Collision("bad", Pose(), shape),))
    world = ode_sim.World()
    model = world.spawn(Model("m", Pose(), (link,)))
    assert "collision 'bad' of link 'm::link' is left out" in str(world.problems[0])
    world.step(10)
    assert model.links["link"].collisions == {}


@pytest.mark.parametrize("kind", ["piston", "nonsense"])
def test_joints_that_are_not_simulated_are_named(kind):
    links = (Link("a"), Link("b", Pose((1, 0, 0))))
    world = ode_sim.World()
    world.spawn(Model("m", Pose(), links, (Joint("thread", kind, "a", "b"), Joint("lost", "revolute", "a", "none"))))
    assert "joint 'thread' of model 'm' is left out" in str(world.problems[0]) and kind in str(world.problems[0])
    assert "no child link 'none'" in str(world.problems[1])
    world.step(10)


def test_numbers_that_are_none_are_refused_with_the_name():
    world = ode_sim.World()
    model = world.spawn(pendulum())
    joint, link = model.joints["hinge"], model.links["bob"]
    for act, name in (
        (lambda: joint.add_force(math.nan), "pendulum::hinge"),
        (lambda: joint.set_motor(math.inf, 1), "pendulum::hinge"),
        (lambda: link.add_force((0, math.nan, 0)), "pendulum::bob"),
        (lambda: setattr(model, "pose", Pose((math.inf, 0, 0))), "pendulum"),
        (lambda: joint.set_position(math.nan), "pendulum::hinge"),
        (lambda: joint.set_limits(1, -1), "pendulum::hinge"),
    ):
        with pytest.raises(ValueError, match=name):
            act()
    world.step(10)
    assert np.isfinite(world.joint_positions).all()


def test_a_motion_that_blows_up_is_stopped_and_named_and_others_go_on():
    world = ode_sim.World()
    wild = world.spawn(sphere("wild", at=(0, 0, 5), mass=1.0))
    calm = world.spawn(sphere("calm", at=(3, 0, 5)))
    for _ in range(50):
        wild.links["link"].add_force((1e308, 0, 0))
        wild.links["link"].add_torque((0, 1e308, 1e308))
        world.step()
    assert np.isfinite(world.link_poses).all()
    assert calm.pose.p[2] == pytest.approx(5 - 9.8 * 1e-6 * 50 * 51 / 2)
    assert len(world.messages) == 1 and world.messages[0].startswith("wild: ")


def test_what_flies_off_the_map_is_stopped_and_others_go_on():
    world = ode_sim.World()
    world.spawn(ground())
    world.spawn(sphere("far", at=(0, 0, 5))).set_twist((3e9, 2e9, 4e9), (0, 0, 0))
    calm = world.spawn(box("calm", at=(3, 0, 0.05)))
    world.step(2000)
    assert np.isfinite(world.link_poses).all() and np.abs(world.link_poses[:, :3]).max() <= 1e8
    assert calm.pose.p[0] == pytest.approx(3, abs=1e-6)
    assert len(world.messages) == 1 and world.messages[0].startswith("far: ")


def test_deep_overlap_does_not_explode():
    world = ode_sim.World()
    world.spawn(ground())
    for i in range(4):
        world.spawn(box(f"b{i}", at=(0.01 * i, 0, 0.05)))
    fastest = 0.0
    for _ in range(1000):
        world.step()
        fastest = max(fastest, max(np.linalg.norm(m.twist().linear) for m in world.models.values()))
    assert fastest < 1.0
    assert np.abs(world.link_poses[:, :3]).max() < 1.0


def test_stepping_backwards_is_refused():
    with pytest.raises(ValueError):
        ode_sim.World().step(-1)


@pytest.mark.slow
def test_nothing_is_printed(capfd):
    world = ode_sim.World()
    world.spawn(ground())
    hand = world.spawn(gripper())
    for i in range(6):
        world.spawn(box(f"b{i}", at=(0, 0, 0.05 + 0.09 * i), mass=10.0 ** (i - 3)))
    hand.joints["left"].drive_to(0.1)
    world.step(500)
    out = capfd.readouterr()
    assert out.out == "" and out.err == ""

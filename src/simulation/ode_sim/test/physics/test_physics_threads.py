"""Screws and gearboxes: their laws on paper, what drives and stops them, and what the files say."""

import math
import pathlib
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description import model as d
from ode_sim.description.load import read_sdf_model, read_urdf
from ode_sim.description.model import Axis, DescriptionError, Inertial, Joint, Link, Model, Pose
from ode_sim.description.sdf_writer import model_text

G = 9.8
SOLVERS = ("quick", "gazebo")
GROUND = d.Collision("ground", Pose(), d.Plane())


def world_of(model: Model, solver: str = "quick", gravity: float = -G, pose: Pose = Pose()):
    world = ode_sim.World()
    world.physics.solver = solver
    world.gravity = (0.0, 0.0, gravity)
    return world, world.spawn(model, pose=pose)


def body(name: str, at=(0, 0, 0), mass=1.0, j=0.01, com=(0, 0, 0), collisions=()) -> Link:
    return Link(name, Pose(at), Inertial(mass, Pose(com), j, 0, 0, j, 0, j), collisions=collisions)


def nut(pitch: float, **axis) -> Model:
    return Model("n", links=(body("a"),), joints=(Joint("j", "screw", "world", "a", axes=(Axis(**axis),), thread_pitch=pitch),))


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("pitch", [20.0, -20.0, 300.0, 2.0])
def test_a_nut_goes_down_its_thread_as_its_turning_lets_it(solver, pitch):
    world, model = world_of(nut(pitch), solver, pose=Pose((0, 0, 3)))
    world.step(500)
    joint, fall = model.joints["j"], G / (1 + 0.01 * pitch**2)  # m g = (m + J p^2) a
    assert joint.velocity(1) == pytest.approx(-fall * 0.5, rel=1e-3)
    assert model.links["a"].pose.p[2] == pytest.approx(3 - fall * 0.125, abs=fall * 0.002)
    assert joint.position(1) == pytest.approx(model.links["a"].pose.p[2] - 3, abs=1e-12)
    assert joint.position(0) == pytest.approx(-pitch * joint.position(1), abs=1e-7)  # Gazebo's sign: a positive pitch is left-handed
    assert joint.velocity(0) == pytest.approx(-pitch * joint.velocity(1), rel=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_torque_lifts_a_nut(solver):
    world, model = world_of(nut(-200.0), solver)
    world.before_step.append(lambda _: model.joints["j"].add_force(0.2))
    world.step(400)
    # (J + m/p^2) alpha = tau + m g slides, slides = -1/p
    alpha = (0.2 - G / 200.0) / (0.01 + 1 / 200.0**2)
    assert model.joints["j"].velocity() == pytest.approx(alpha * 0.4, rel=2e-3)
    assert model.links["a"].pose.p[2] == pytest.approx(alpha * 0.08 / 200, rel=1e-2)


def test_a_pull_turns_a_nut():
    world, model = world_of(nut(10.0), gravity=0.0)
    world.before_step.append(lambda _: model.joints["j"].add_force(3.0, axis=1))
    world.step(200)
    assert model.joints["j"].velocity(1) == pytest.approx(3.0 / (1 + 0.01 * 100) * 0.2, rel=1e-3)


def test_two_links_on_a_thread_that_float_keep_their_momenta_and_their_energy():
    """With centres of mass beside the axis, which Gazebo's own screw does not bear."""
    links = (body("bolt", mass=2.0, j=0.05, com=(0.1, 0, 0)), body("nut", (0, 0, 0.3), 0.5, 0.02, com=(0, 0.2, 0)))
    world, model = world_of(Model("m", links=links, joints=(Joint("j", "screw", "bolt", "nut", thread_pitch=-30.0),)), gravity=0.0)
    world.physics.max_step_size = 2e-4
    world.before_step.append(lambda w: model.joints["j"].add_force(0.5 if w.time < 0.2 else 0.0))

    def momenta():
        p, spin, energy = np.zeros(3), np.zeros(3), 0.0
        for link in model.links.values():
            mass, v, w = link.mass, np.array(link.com_velocity()), np.array(link.angular_velocity())
            j = {"bolt": 0.05, "nut": 0.02}[link.name]
            p, spin = p + mass * v, spin + np.cross(link.com(), mass * v) + j * w
            energy += 0.5 * mass * v @ v + 0.5 * j * w @ w
        return p, spin, energy

    world.step(1000)
    driven = momenta()
    assert driven[2] > 0.1
    assert np.abs(driven[0]).max() < 1e-3 and np.abs(driven[1]).max() < 1e-3
    world.step(2500)
    later = momenta()
    assert np.abs(later[0]).max() < 2e-3 and np.abs(later[1]).max() < 2e-3
    assert later[2] == pytest.approx(driven[2], rel=0.02)
    joint = model.joints["j"]
    assert joint.position(1) == pytest.approx(joint.position(0) / 30.0, abs=1e-7) and abs(joint.position(0)) > 3.0


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_stops_of_a_screw_are_angles_of_many_turns(solver):
    world, model = world_of(nut(50.0, lower=-1.0, upper=15.0), solver)  # falls: the angle grows
    world.step(4000)
    assert model.joints["j"].position() == pytest.approx(15.0, abs=2e-3)
    assert model.joints["j"].position(1) == pytest.approx(-0.3, abs=1e-4)
    assert model.joints["j"].set_position(40.0) and model.joints["j"].position() == 15.0


def test_a_screw_is_driven_as_other_joints_are():
    world, model = world_of(nut(-100.0))
    joint = model.joints["j"]
    joint.drive_to(7.0)
    world.step(10)
    assert joint.position() == pytest.approx(7.0, abs=1e-9) and model.links["a"].pose.p[2] == pytest.approx(0.07, abs=1e-9)
    joint.drive_off()
    joint.set_motor(5.0, 100.0)
    world.step(1000)
    assert joint.velocity() == pytest.approx(5.0, rel=1e-4)
    assert model.links["a"].pose.p[2] == pytest.approx(0.12, abs=1e-4)
    assert joint.set_position(-0.5, 1)  # by its way
    assert joint.position() == pytest.approx(-50.0, abs=1e-9) and model.links["a"].pose.p[2] == pytest.approx(-0.5, abs=1e-9)


def test_a_nut_pushes_what_is_in_its_way():
    """Its thread turns the torque into a force on the floor: F = tau p, and it stands still."""
    smooth = d.Surface(mu=0.0, mu2=0.0)  # with friction it would jam
    links = (body("a", (0, 0, 0.1), collisions=(d.Collision("c", Pose(), d.Box((0.1, 0.1, 0.1)), smooth),)),)
    model = Model("n", links=links, joints=(Joint("j", "screw", "world", "a", axes=(Axis(),), thread_pitch=100.0),))
    world = ode_sim.World()
    world.spawn(Model("floor", static=True, links=(Link("l", collisions=(GROUND,)),)))
    handle = world.spawn(model)
    foot = handle.links["a"].collisions["c"]
    world.watch_contacts(foot)
    world.before_step.append(lambda _: handle.joints["j"].add_force(0.5))
    world.step(2000)
    pressed = -world.contacts()["force"][:, 2].sum() if len(world.contacts()) else 0.0
    assert abs(pressed) == pytest.approx(0.5 * 100 + G, rel=0.05)
    assert abs(handle.joints["j"].velocity()) < 0.05


def test_a_thread_is_changed_where_it_is():
    world, model = world_of(nut(10.0), gravity=0.0)
    joint = model.joints["j"]
    joint.set_position(5.0)
    joint.set_param("thread_pitch", -20.0)
    world.step(5)
    assert joint.position() == pytest.approx(5.0, abs=1e-9) and model.links["a"].pose.p[2] == pytest.approx(-0.5, abs=1e-9)
    with pytest.raises(ValueError, match="thread_pitch"):
        joint.set_param("thread_pitch", 0.0)


def gears(ratio=3.0, hold="world", axis2=(0, 1, 0), reference="frame") -> Model:
    links = (body("frame", mass=10, j=1), body("a", (0.2, 0, 0)), body("b", (-0.2, 0, 0)))
    joints = [
        Joint("ja", "revolute", "frame", "a", axes=(Axis(axis2),)),
        Joint("jb", "revolute", "frame", "b", axes=(Axis((0, 1, 0)),)),
        Joint("mesh", "gearbox", "a", "b", axes=(Axis((0, 1, 0)), Axis(axis2)), gearbox_ratio=ratio, gearbox_reference_body=reference),
    ]
    if hold:
        joints.append(Joint("hold", "revolute" if hold == "turn" else "fixed", "world", "frame", axes=(Axis((0, 1, 0)),)))
    return Model("g", links=links, joints=tuple(joints))


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("ratio", [3.0, -0.5])
@pytest.mark.parametrize("axis2", [(0, 1, 0), (1, 0, 0)])
def test_gears_turn_at_their_ratio(solver, ratio, axis2):
    world, model = world_of(gears(ratio, axis2=axis2), solver, gravity=0.0)
    world.before_step.append(lambda _: model.joints["ja"].add_force(0.1))
    world.step(1000)
    a, b = model.joints["ja"], model.joints["jb"]
    rate = 0.1 / (0.01 + 0.01 * ratio**2)  # the child turns at -ratio: J + J ratio^2 on the first
    assert a.velocity() == pytest.approx(rate, rel=1e-3)
    assert b.velocity() == pytest.approx(-ratio * rate, rel=1e-3)
    assert b.position() == pytest.approx(-ratio * a.position(), abs=1e-3 * rate)
    mesh = model.joints["mesh"]
    assert mesh.position(0) == pytest.approx(b.position(), abs=1e-9) and mesh.position(1) == pytest.approx(a.position(), abs=1e-9)


def test_gears_in_a_box_that_turns_keep_their_ratio_to_it():
    world, model = world_of(gears(2.0, hold="turn"), gravity=0.0)
    model.joints["hold"].set_motor(3.0, 1e4)
    model.joints["ja"].set_motor(1.0, 100.0)
    world.step(3000)
    assert model.joints["hold"].velocity() == pytest.approx(3.0, rel=1e-4)
    assert model.joints["ja"].velocity() == pytest.approx(1.0, rel=1e-3)
    assert model.joints["jb"].velocity() == pytest.approx(-2.0, rel=1e-3)
    assert model.joints["jb"].position() == pytest.approx(-2 * model.joints["ja"].position(), abs=1e-3)


def test_a_wheel_that_is_geared_to_what_the_world_holds_stands():
    links = (body("a"), body("b", (0.3, 0, 0)))
    joints = (
        Joint("bolt", "fixed", "world", "a"),
        Joint("jb", "revolute", "world", "b", axes=(Axis(),)),
        Joint("mesh", "gearbox", "a", "b", axes=(Axis(), Axis()), gearbox_reference_body="a"),
    )
    world, model = world_of(Model("g", links=links, joints=joints))
    world.before_step.append(lambda _: model.joints["jb"].add_force(1.0))
    world.step(500)
    assert abs(model.joints["jb"].position()) < 1e-4


def test_a_gear_follows_one_that_is_driven_by_position():
    world, model = world_of(gears(1.0), gravity=0.0)
    for k in range(1, 501):
        model.joints["ja"].drive_to(0.002 * k)
        world.step()
    world.step(300)
    assert model.joints["ja"].position() == pytest.approx(1.0, abs=1e-9)
    assert model.joints["jb"].position() == pytest.approx(-1.0, abs=5e-3)


def test_a_gear_put_elsewhere_takes_the_other_along_again():
    world, model = world_of(gears(1.0), gravity=0.0)
    assert model.joints["ja"].set_position(0.5)
    assert not model.joints["mesh"].set_position(0.5)
    model.joints["ja"].set_motor(0.0, 1e3)
    world.step(1000)
    assert model.joints["jb"].position() == pytest.approx(-0.5, abs=1e-3)


@pytest.mark.parametrize("model", [nut(20.0), gears()])
@pytest.mark.parametrize("solver", SOLVERS)
def test_snapshots_give_the_same_bits(model, solver):
    world, handle = world_of(model, solver)
    drive = next(iter(handle.joints.values()))
    world.before_step.append(lambda _: drive.add_force(0.1))
    world.step(700)
    kept = world.save()
    world.step(300)
    after = world.joint_positions.copy(), world.link_poses.copy()
    world.restore(kept)
    world.step(300)
    assert (world.joint_positions == after[0]).all() and (world.link_poses == after[1]).all()


def test_a_model_that_is_moved_keeps_its_zero():
    world, model = world_of(gears(reference="", hold=""), gravity=0.0)
    turned = Pose((1, 2, 3), (0.0, 0.0, math.sin(0.4), math.cos(0.4)))
    model.pose = turned
    world.step(200)
    assert abs(model.joints["jb"].position()) < 1e-6 and abs(model.joints["ja"].position()) < 1e-6


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_lead_screw_is_wheel_gears_thread_and_rail(solver):
    text = (pathlib.Path(__file__).parents[2] / "examples/lead_screw.sdf").read_text()
    model, problems = read_sdf_model(text)
    assert not problems
    world, handle = world_of(model, solver)
    handle.joints["hand"].set_motor(40.0, 10.0)
    world.step(2000)
    assert handle.joints["bearing"].velocity() == pytest.approx(-10.0, rel=1e-3)
    # 5 mm a turn, right-handed: the carriage does not turn, and so turns forwards on a spindle that turns backwards
    assert handle.joints["rail"].velocity() == pytest.approx(10.0 / (2 * math.pi) * 0.005, rel=2e-3)
    assert handle.joints["rail"].position() == pytest.approx(-handle.joints["bearing"].position() / 1256.637, abs=1e-5)


# ---------------------------------------------------------------------------------------------------------- files

SDF = """<sdf version='{version}'><model name='m'><link name='a'/><link name='b'/><link name='c'/>
<joint name='j' type='{kind}'><parent>a</parent><child>b</child>{inner}<axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"""


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.9"])
@pytest.mark.parametrize(
    "inner,pitch,told",
    [
        ("<thread_pitch>-10</thread_pitch>", -10.0, ""),
        ("<screw_thread_pitch>0.002</screw_thread_pitch>", -1000 * math.pi, ""),
        ("", 1.0, "thread_pitch"),
        ("<thread_pitch>0</thread_pitch>", 1.0, "cannot be 0"),
        ("<screw_thread_pitch>0</screw_thread_pitch>", 1.0, "cannot be 0"),
    ],
)
def test_the_pitch_of_a_file(version, inner, pitch, told):
    model, problems = read_sdf_model(SDF.format(version=version, kind="screw", inner=inner))
    assert model.joints[0].thread_pitch == pytest.approx(pitch)
    assert told in " ".join(str(p) for p in problems) and (told or not problems)


def test_a_gearbox_of_a_file():
    inner = "<gearbox_ratio>2.5</gearbox_ratio><gearbox_reference_body>c</gearbox_reference_body><axis2><xyz>1 0 0</xyz></axis2>"
    model, problems = read_sdf_model(SDF.format(version="1.6", kind="gearbox", inner=inner))
    joint = model.joints[0]
    assert (joint.gearbox_ratio, joint.gearbox_reference_body, joint.axes[1].xyz) == (2.5, "c", (1, 0, 0)) and not problems


@pytest.mark.parametrize("joint", [*nut(-7.0).joints, *gears(0.5).joints[2:3]])
def test_what_is_written_is_read_again(joint):
    model = nut(1.0) if joint.type == "screw" else gears()
    model = replace(model, joints=tuple(joint if old.name == joint.name else old for old in model.joints))
    again, problems = read_sdf_model(model_text(model))
    read = next(one for one in again.joints if one.name == joint.name)
    for name in ("type", "thread_pitch", "gearbox_ratio", "gearbox_reference_body"):
        assert getattr(read, name) == getattr(joint, name)
    assert len(read.axes) == len(joint.axes) and not problems


def test_the_reference_of_a_nested_gearbox_is_found():
    inner = "<gearbox_reference_body>c</gearbox_reference_body><axis2><xyz>0 0 1</xyz></axis2>"
    text = SDF.format(version="1.6", kind="gearbox", inner=inner).replace("<model name='m'>", "<model name='outer'><model name='m'>")
    model, problems = read_sdf_model(text.replace("</model>", "</model></model>"))
    assert model.joints[0].gearbox_reference_body == "m::c" and not problems


def test_a_gearbox_without_its_parts_is_told():
    model, problems = read_sdf_model(SDF.format(version="1.6", kind="gearbox", inner=""))
    world = ode_sim.World()
    handle = world.spawn(model)
    assert "axis2" in str(problems[0]) and "gearbox_reference_body" in " ".join(map(str, world.problems))
    world.step(10)
    assert handle.joints["j"].axis_count == 2


@pytest.mark.parametrize("kind", ["screw", "gearbox"])
def test_urdf_has_none_of_them(kind):
    joint = f"<joint name='j' type='{kind}'><parent link='a'/><child link='b'/></joint>"
    text = f"<robot name='r'><link name='a'/><link name='b'/>{joint}</robot>"
    with pytest.raises(DescriptionError, match=f"'{kind}' is of SDF alone"):
        read_urdf(text)

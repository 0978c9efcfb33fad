"""Numbers that no world can hold are refused or limited in one line; everything else runs on."""

import math
import random
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim import _core
from ode_sim.description import model as d
from ode_sim.description.model import Axis, Box, Collision, Inertial, Joint, Link, Mesh, Model, Pose, Sphere
from physics_checks import refused, runs_on
from physics_determinism import digest
from physics_models import arm, box, box_inertia, diff_drive, ground, pendulum, sphere

BEYOND = (1e7 + 1.0, 1e9, 4294967296.0, 1e12, 1e38, 1e300, math.inf, math.nan)


# ---------------------------------------------------------------------------------------------- places and sizes


def test_one_limit_for_all_places_and_sizes():
    assert _core.FARTHEST == d.FARTHEST


@pytest.mark.parametrize("far", BEYOND)
@pytest.mark.parametrize("static", [False, True])
def test_a_place_beyond_all_reason_is_refused(far, static):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(replace(arm(2), static=static))
    before = digest(world)
    link, joint = model.links["link1"], model.joints["j1"]
    assert "'far'" in refused(lambda: world.spawn(box("far", at=(0, far, 0), static=static)), ode_sim.DescriptionError)
    assert "arm" in refused(lambda: setattr(model, "pose", Pose((0, 0, far))))
    assert "link1" in refused(lambda: setattr(link, "pose", Pose((far, 0, 0))))
    refused(lambda: link.set_inertial(replace(link.description.inertial, pose=Pose((0, far, 0)))))
    if not math.isfinite(far):
        refused(lambda: link.add_force((1, 0, 0), (0, far, 0)))
        refused(lambda: joint.set_position(far))
        refused(lambda: joint.drive_to(far))
    assert digest(world) == before and list(world.models) == ["ground_plane", "arm"]
    runs_on(world)


def test_a_rigid_move_that_takes_a_part_too_far_is_refused():
    rail = Model(
        "rail", Pose(), (Link("base"), Link("car", Pose((9e6, 0, 0)))), (Joint("j", "prismatic", "base", "car", axes=(Axis((1, 0, 0)),)),)
    )
    world = ode_sim.World()
    model = world.spawn(rail)
    model.pose = Pose((5e6, 0, 0))
    before = digest(world)
    assert "2e+07" in refused(lambda: model.joints["j"].set_position(9e6))
    assert digest(world) == before
    model.joints["j"].drive_to(5e9)
    runs_on(world)
    world.reset()
    assert world.link_poses[:, 0].tolist() == pytest.approx([0.0, 9e6])


def test_a_reset_brings_back_what_has_flown_apart():
    world = ode_sim.World()
    model = world.spawn(Model("two", Pose((1e7, 0, 1)), (Link("a"), Link("b", Pose((0, 1, 0))))))
    model.links["a"].set_twist((1e9, 0, 0), (0, 0, 5))
    model.links["b"].set_twist((-1e9, 1e9, 0), (0, 3, 0))
    world.step(100)
    assert 1e7 < np.abs(world.link_poses[:, :2]).max() < 3e7
    world.reset()
    assert model.pose.p == pytest.approx((1e7, 0, 1)) and model.links["b"].pose.p == pytest.approx((1e7, 1, 1))
    runs_on(world)


def test_a_reset_puts_joints_back_that_have_flown_apart():
    world = ode_sim.World()
    robot = world.spawn(diff_drive(at=(1, 0, 0.5)))
    robot.joints["left"].drive_to(0.5)
    world.step(10)
    robot.set_twist((1e10, 1e10, 0), (0, 0, 1e10))
    world.step(10)
    assert robot.flown_apart
    world.reset()
    assert not robot.flown_apart and robot.joints["left"].position() == pytest.approx(0.0)
    for name, (x, y, z) in (("base", (1, 0, 0.57)), ("left", (1, 0.15, 0.55)), ("right", (1, -0.15, 0.55))):
        assert robot.links[name].pose.p == pytest.approx((x, y, z))
    runs_on(world)


@pytest.mark.parametrize("q", [(0, 0, 0, 0), (0, 0, 2e8, 3.0), (1e-200, 0, 0, 0), (1e300, -1e300, 0, 1.0)])
def test_quaternions_of_any_length(q):
    world = ode_sim.World()
    model = world.spawn(arm(2), pose=Pose((1, 2, 3), q))
    assert np.linalg.norm(model.pose.q) == pytest.approx(1.0)
    top = np.subtract(model.links["link1"].pose.p, model.pose.p)
    assert np.linalg.norm(top) == pytest.approx(0.3)
    world.reset()
    model.pose = Pose((0, 0, 0), q)
    assert np.subtract(model.links["link1"].pose.p, model.pose.p) == pytest.approx(top)


@pytest.mark.parametrize("far", BEYOND)
def test_a_shape_beyond_all_reason_is_left_out_and_the_rest_collides(far):
    good = Collision("good", Pose(), Box((0.1, 0.1, 0.1)))
    bad = [
        Collision("off", Pose((0, far, 0)), Box()),
        Collision("box", Pose(), Box((1, far, 1))),
        Collision("ball", Pose(), d.Sphere(far)),
        Collision("can", Pose(), d.Cylinder(0.1, far)),
        Collision("pill", Pose(), d.Capsule(far, 1.0)),
        Collision("floor", Pose((0, 0, far)), d.Plane()),
        Collision("prism", Pose(), d.Polyline(((0, 0), (1, 0), (far, 1)), 1.0)),
    ]
    link = Link("link", inertial=box_inertia(1.0, (0.1, 0.1, 0.1)), collisions=(*bad, good))
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(Model("m", Pose((0, 0, 0.3)), (link,)))
    assert list(model.links["link"].collisions) == ["good"]
    assert len(world.problems) == len(bad) and all("is left out" in p.message for p in world.problems)
    world.step(1000)
    assert model.pose.p[2] == pytest.approx(0.05, abs=1e-3)
    runs_on(world)


def test_a_model_of_a_world_file_that_lies_too_far_is_left_out():
    world = ode_sim.World(d.World(models=(box("far", at=(0, 0, 4e9), static=True), box("near"))))
    assert list(world.models) == ["near"]
    assert [p.severity for p in world.problems] == ["error"] and "'far'" in world.problems[0].message
    runs_on(world)


def test_a_saved_state_beyond_all_reason_is_named_and_left_alone():
    state = d.WorldState(
        1e300,
        -5,
        (d.ModelState("box", Pose((0, 0, 1e12))), d.ModelState("ball", None, links=(d.LinkState("link", Pose((0, math.nan, 0))),))),
    )
    world = ode_sim.World(d.World(models=(box(), sphere()), state=state))
    assert len(world.problems) == 3 and world.time == 0.0 and world.iterations == 0
    assert world.models["box"].pose.p == pytest.approx((0, 0, 0.05))
    runs_on(world)


def test_chains_of_sliders_that_lead_out_of_reach():
    """Each joint is within its bounds, all together lie where nothing can collide: no shape ends the world."""
    n = 30
    links = tuple(Link(f"l{i}", collisions=(Collision("c", Pose(), Box((0.1, 0.1, 0.1))),)) for i in range(n))
    joints = (Joint("bolt", "fixed", "world", "l0"),) + tuple(
        Joint(f"j{i}", "prismatic", f"l{i - 1}", f"l{i}", axes=(Axis((1, 0, 0)),)) for i in range(1, n)
    )
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(Model("m", Pose((0, 0, 1)), links, joints))
    for joint in list(model.joints.values())[1:]:
        joint.drive_to(1e7)
    world.step(5)
    assert model.links["l29"].pose.p[0] > 2e8
    world.spawn(box("falls", at=(0, 3, 0.3)))
    for joint in list(model.joints.values())[1:]:
        joint.drive_to(0.0)
    world.step(1000)
    assert world.models["falls"].pose.p[2] == pytest.approx(0.05, abs=1e-3)
    assert model.links["l29"].pose.p[0] == pytest.approx(0.0, abs=1e-6)
    ranges, hits = world.cast_rays(np.array([[0, 0, 3.0]]), np.array([[0, 0, -1.0]]), 5.0)  # and they collide again
    assert ranges[0] == pytest.approx(1.95, abs=1e-6) and world.collision(hits[0]).link.model is model


def test_a_kinematic_link_sent_off_the_map_is_stopped():
    world = ode_sim.World()
    model = world.spawn(box("pusher", at=(0, 0, 1), kinematic=True))
    model.set_twist((1e10, 0, 0), (0, 0, 0))
    world.step(100)
    assert abs(model.pose.p[0]) <= 2e7 and len(world.messages) == 1
    runs_on(world)


# ---------------------------------------------------------------------------------------------- numbers


@pytest.mark.parametrize(
    "inertial",
    [
        Inertial(1.0, Pose((math.nan, 0, 0))),
        Inertial(1.0, Pose((0, 0, -math.inf))),
        Inertial(1.0, Pose((0, 1e200, 0))),
        Inertial(math.nan),
        Inertial(math.inf),
        Inertial(-1.0),
        Inertial(1e300),
        Inertial(1.0, ixx=math.nan),
        Inertial(1.0, ixx=1e200, iyy=1e200, izz=1e200),
    ],
)
def test_inertials_that_no_body_has(inertial):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(box())
    before = digest(world)
    refused(lambda: model.links["link"].set_inertial(inertial))
    assert digest(world) == before
    odd = replace(box("odd", at=(1, 0, 0.2)).links[0], inertial=inertial)
    world.spawn(Model("odd", Pose((1, 0, 0.2)), (odd,)))
    assert len(world.problems) == 1 and "odd" in world.problems[0].message
    runs_on(world, 300)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300, -1e300])
def test_any_number_given_to_any_setter(bad):
    """Refused with ValueError or cut to what can be simulated."""
    world = ode_sim.World()
    world.spawn(ground())
    robot, arm_ = world.spawn(diff_drive()), world.spawn(arm(3, at=(2, 0, 0)))
    thing = world.spawn(box("thing", at=(2, 0, 0.8)))
    weld = world.attach(arm_.links["link2"], thing.links["link"])
    link, joint, driven = robot.links["base"], robot.joints["left"], arm_.joints["j1"]
    surface = next(iter(link.collisions.values())).surface
    calls = [
        lambda: link.add_force((bad, 0, 0)),
        lambda: link.add_force((0, 0, 0), (bad, 0, 0)),
        lambda: link.add_torque((0, bad, 0)),
        lambda: link.set_force((0, 0, bad)),
        lambda: link.set_torque((bad, 0, bad)),
        lambda: link.set_twist((bad, 0, 0), (0, 0, 0)),
        lambda: link.set_twist((0, 0, 0), (0, bad, 0)),
        lambda: robot.set_twist((0, 0, 0), (bad, bad, bad)),
        lambda: setattr(link, "pose", Pose((0, 0, 1), (bad, 0, 0, 1))),
        lambda: joint.add_force(bad),
        lambda: joint.set_motor(bad, 1.0),
        lambda: joint.set_motor(1.0, bad),
        lambda: driven.drive_to(bad),
        lambda: driven.set_position(bad),
        lambda: joint.set_limits(bad, bad),
        lambda: joint.set_limits(-1, bad),
        lambda: joint.set_limits(bad, 1),
        lambda: setattr(joint, "damping", bad),
        lambda: setattr(joint, "friction", bad),
        lambda: joint.follow(driven, bad, 0.0),
        lambda: joint.follow(driven, 1.0, bad),
        lambda: setattr(weld, "pose", Pose((bad, 0, 0))),
        lambda: setattr(world, "gravity", (0, bad, 0)),
    ]
    calls += [
        lambda name=name: joint.set_param(name, bad)
        for name in ("fmax", "vel", "hi_stop", "lo_stop", "stop_erp", "stop_cfm", "friction", "damping")
    ]
    calls += [
        lambda name=name: setattr(surface, name, bad)
        for name in ("mu", "mu2", "slip1", "slip2", "kp", "kd", "max_vel", "min_depth", "restitution", "bounce_threshold")
    ]
    calls += [lambda: setattr(surface, "fdir1", (bad, 0, 0))]
    for collision in link.collisions.values():
        world.watch_contacts(collision)
    for call in calls:
        try:
            call()
        except ValueError as error:
            assert "\n" not in str(error)
        runs_on(world, 3)


@pytest.mark.parametrize("axis", [-1, 2, 7, 2**31 - 1])
def test_an_axis_that_there_is_not(axis):
    joint = ode_sim.World().spawn(pendulum()).joints["hinge"]
    for call in (
        joint.position,
        joint.velocity,
        joint.effort,
        joint.motor,
        joint.limits,
        lambda a: joint.add_force(1.0, a),
        lambda a: joint.set_motor(1.0, 1.0, a),
        lambda a: joint.set_position(0.0, a),
        lambda a: joint.set_limits(0, 1, a),
    ):
        assert "no axis" in refused(lambda: call(axis))


@pytest.mark.parametrize(
    "field,bad",
    [
        (f, v)
        for f in ("lower", "upper", "effort", "velocity", "damping", "friction", "spring_reference", "spring_stiffness")
        for v in (math.nan, math.inf, -math.inf, 1e300)
    ],
)
def test_axes_with_numbers_that_are_none(field, bad):
    plain = pendulum()
    axis = replace(plain.joints[0].axes[0], **{field: bad})
    world = ode_sim.World()
    world.spawn(replace(plain, joints=(replace(plain.joints[0], axes=(axis,)),)))
    if math.isnan(bad):
        assert field in world.problems[0].message
    runs_on(world)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
def test_surfaces_with_numbers_that_are_none(bad):
    names = ("mu", "mu2", "slip1", "slip2", "kp", "kd", "max_vel", "min_depth", "restitution", "bounce_threshold")
    world = ode_sim.World()
    world.spawn(ground())
    for i, name in enumerate(names):
        model = world.spawn(box(f"b{i}", at=(i, 0, 0.049), surface=d.Surface(**{name: bad})))
        world.watch_contacts(model.links["link"].collisions["box"])
    world.spawn(box("odd", at=(0, 5, 0.049), surface=d.Surface(fdir1=(bad, 0, 0), mu2=0.5)))
    assert len(world.problems) == (11 if math.isnan(bad) else 0 if math.isfinite(bad) else 1)
    world.step(100)
    assert len(world.contacts()) > 0
    runs_on(world, 200)


@pytest.mark.parametrize("bad", [-3, 1e20, 4294967295, 1e300, math.inf, math.nan])
def test_contacts_per_collision_beyond_reason(bad):
    plain = box(at=(0, 0, 0.2))
    link = replace(plain.links[0], collisions=(replace(plain.links[0].collisions[0], max_contacts=bad),))
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(replace(plain, links=(link,)))
    assert "max_contacts" in world.problems[0].message
    world.step(1000)
    assert model.pose.p[2] == pytest.approx(0.05, abs=1e-3)


def test_infinite_friction_and_huge_gravity_give_no_nan_forces():
    world = ode_sim.World()
    floor = world.spawn(ground())
    for i, gravity in enumerate([(0, 1.7, 0), (0, 0, -9.8), (0, 0, 1e6), (1e6, 0, -1e6)]):
        ball, robot = world.spawn(sphere(f"ball{i}", at=(3 * i, 0, 0))), world.spawn(diff_drive(at=(3 * i, 3, 0)), name=f"robot{i}")
        for link in [*ball.links.values(), *robot.links.values(), *floor.links.values()]:
            for collision in link.collisions.values():
                world.watch_contacts(collision)
                collision.surface.mu = collision.surface.mu2 = math.inf
        world.gravity = gravity
        runs_on(world, 50)


def test_rays_from_and_to_anywhere():
    world = ode_sim.World()
    world.spawn(ground())
    world.spawn(box(at=(0, 0, 1)))
    far = [0.0, 1.0, -1e8, 1e12, 1e300, math.inf, math.nan]
    rng = random.Random(3)
    origins = np.array([[rng.choice(far) for _ in range(3)] for _ in range(200)])
    directions = np.array([[rng.choice(far) for _ in range(3)] for _ in range(200)])
    for most in (0.0, -1.0, 1e300, math.inf, math.nan, 10.0):
        ranges, hits = world.cast_rays(origins, directions, most)
        assert not np.isnan(ranges).any() and ((hits >= 0) == np.isfinite(ranges)).all()
    refused(lambda: world.core.cast_rays(np.zeros((4, 3)), np.zeros((2, 3)), 1.0, []))
    runs_on(world)


def test_meshes_that_name_corners_there_are_not():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    for vertices, triangles in (
        (corners, [[0, 1, 3]]),
        (corners, [[0, 1, 2**32 - 1]]),
        (corners * 1e9, [[0, 1, 2]]),
        (corners * math.nan, [[0, 1, 2]]),
        (np.zeros((0, 3)), np.zeros((0, 3))),
        (corners.ravel()[:8], [[0, 1, 2]]),
    ):
        refused(lambda: _core.MeshData(vertices, np.array(triangles)))


# ---------------------------------------------------------------------------------------------- many links


def many(n, parent, kind="revolute", **inertial):
    links = tuple(
        Link(
            f"l{i}",
            Pose((0, 0, 0.01 * i)),
            Inertial(1.0, **inertial) if i == n - 1 else Inertial(),
            (Collision("c", Pose(), d.Sphere(0.004)),),
        )
        for i in range(n)
    )
    joints = tuple(Joint(f"j{i}", kind, f"l{parent(i)}", f"l{i}", axes=(Axis((0, 1, 0)),)) for i in range(1, n))
    return Model("many", Pose(), links, joints)


def work(model):
    """Python and C++ calls cannot be counted alike: seconds of this process, the least of three."""
    import time

    times = []
    for _ in range(3):
        world = ode_sim.World()
        begin = time.process_time()
        world.spawn(model)
        times.append(time.process_time() - begin)
    return min(times)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["revolute", "fixed"])
@pytest.mark.parametrize("parent", [lambda i: i - 1, lambda i: (i - 1) // 2], ids=["chain", "tree"])
def test_spawning_takes_time_in_proportion_to_the_links(kind, parent):
    odd = dict(ixx=1e6, iyy=1e6, izz=1e6)  # as no real body has: what it hangs on is judged by it
    assert work(many(8000, parent, kind, **odd)) < 16 * work(many(1000, parent, kind, **odd))  # 8 times as many; quadratic: 64


def test_more_joints_than_the_direct_solver_can_take():
    world = ode_sim.World()
    world.spawn(many(3000, lambda i: i - 1))
    runs_on(world, 2)
    assert world.core.counters.direct == 0 and world.core.counters.trees > 0


def test_what_hangs_too_deep_to_be_solved_exactly_with_its_contacts():
    """A chain of 400 links, all of them on the floor, goes to the iterations, as before."""
    world = ode_sim.World()
    world.spawn(ground())
    ball = (Collision("c", Pose(), Sphere(0.05)),)
    links = tuple(Link(f"l{i}", Pose((0.2 * i, 0, 0.05)), Inertial(1.0, Pose(), 0.01, 0, 0, 0.01, 0, 0.01), ball) for i in range(400))
    joints = tuple(Joint(f"j{i}", "revolute", f"l{i - 1}", f"l{i}", axes=(Axis((0, 0, 1)),)) for i in range(1, 400))
    world.spawn(Model("chain", Pose(), links, joints))
    runs_on(world, 2)
    assert world.core.counters.trees == 0 and world.core.counters.quick > 0

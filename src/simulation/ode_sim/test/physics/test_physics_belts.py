"""Links whose surface runs round them, as a track's does."""

import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Box, Collision, Joint, Link, Model, Pose, Surface
from ode_sim.math3 import quat_from_rpy, quat_rotate, quat_to_rpy
from physics_models import box, box_inertia, ground

APART, LENGTH = 0.4, 0.5  # m, between the middles of the tracks; of a track on the ground


def vehicle(surface=Surface(mu=0.8, mu2=0.8)):
    links = [Link("body", Pose((0, 0, 0.15)), box_inertia(20.0, (0.5, 0.3, 0.1)))]
    joints = []
    for name, y in (("left", APART / 2), ("right", -APART / 2)):
        track = Collision("c", Pose(), Box((LENGTH, 0.02, 0.1)), surface)
        links.append(Link(name, Pose((0, y, 0.05)), box_inertia(5.0, (LENGTH, 0.02, 0.1)), (track,)))
        joints.append(Joint(name, "fixed", "body", name))
    return Model("tank", Pose((0, 0, 1e-5)), tuple(links), tuple(joints))


class Tank:
    def __init__(self, surface=Surface(mu=0.8, mu2=0.8), solver="quick", slope=0.0):
        self.world = ode_sim.World()
        self.world.physics.solver = solver
        self.world.spawn(ground(pitch=slope))
        model = vehicle(surface)
        self.model = self.world.spawn(replace(model, pose=Pose(model.pose.p, quat_from_rpy(0, slope, 0))))
        self.left = self.right = 0.0
        self.meant_spin = 0.0
        self.world.before_step.append(self._run)
        self.world.step(300)

    def _run(self, _world):
        q = self.model.pose.q
        for name, side, speed in (("left", 1, self.left), ("right", -1, self.right)):
            meant = quat_rotate(q, (-side * self.meant_spin * APART / 2, 0, 0)), quat_rotate(q, (0, 0, self.meant_spin))
            self.model.links[name].run_belt(speed, quat_rotate(q, (0, 1, 0)), *meant)

    def goes(self, left, right, steps=1000):
        """Metres ahead and to the left, and radians, of the last ``steps`` after half a second."""
        self.left, self.right = left, right
        self.world.step(500)
        before, yaw = self.model.pose, quat_to_rpy(self.model.pose.q)[2]
        self.world.step(steps)
        after = self.model.pose
        dx, dy = np.subtract(after.p, before.p)[:2]
        turned = (quat_to_rpy(after.q)[2] - yaw + math.pi) % (2 * math.pi) - math.pi
        return dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw), turned


@pytest.mark.parametrize("solver", ["quick", "gazebo"])
def test_it_goes_as_fast_as_its_tracks(solver):
    ahead, aside, turned = Tank(solver=solver).goes(0.5, 0.5)
    assert (ahead, aside, turned) == pytest.approx((0.5, 0, 0), abs=2e-3)
    ahead, _, _ = Tank(solver=solver).goes(-0.3, -0.3)
    assert ahead == pytest.approx(-0.3, abs=2e-3)


def test_it_turns_on_the_spot_as_statics_have_it():
    """Loads at the ends of the tracks, friction against the slip: of the tracks' speeds 1 / (1 + (length / apart)^2) is left."""
    _, _, turned = Tank().goes(-0.2, 0.2)
    assert turned == pytest.approx(2 * 0.2 / APART / (1 + (LENGTH / APART) ** 2), rel=0.03)


def test_it_stands_when_they_do_and_on_a_slope():
    assert Tank().goes(0, 0, 3000) == pytest.approx((0, 0, 0), abs=1e-5)
    assert Tank(slope=0.2).goes(0, 0, 2000) == pytest.approx((0, 0, 0), abs=1e-4)


def test_friction_of_two_coefficients_is_along_what_is_meant():
    """Friction that holds along the way that is meant and hardly across it makes the vehicle go that way."""
    tank = Tank(Surface(mu=2.0, mu2=0.05))
    tank.meant_spin = 0.4
    _, _, turned = tank.goes(-0.2, 0.2)
    # Along the circle round the middle, a track's end is told its share of the track's speed: statics again, with friction along it.
    assert turned == pytest.approx(2 * 0.2 / APART / (1 + (LENGTH / APART) ** 2), rel=0.05)


def test_what_lies_on_a_belt_goes_with_it():
    world = ode_sim.World()
    belt = world.spawn(box("belt", at=(0, 0, 0.05), size=(2.0, 0.5, 0.1), static=True))
    thing = world.spawn(box("thing", at=(-0.5, 0, 0.15), size=(0.1, 0.1, 0.1)))
    world.before_step.append(lambda w: belt.links["link"].run_belt(-0.4, (0, 1, 0)))  # its upper side, so the other way round
    world.step(1000)
    assert thing.links["link"].linear_velocity() == pytest.approx((-0.4, 0, 0), abs=1e-3)


def test_a_belt_runs_for_one_step():
    tank = Tank()
    tank.goes(0.5, 0.5)
    tank.world.before_step.clear()
    tank.world.step(1000)
    assert np.linalg.norm(tank.model.links["body"].linear_velocity()) < 1e-4


@pytest.mark.parametrize(
    "arguments", [(math.nan, (0, 1, 0)), (1.0, (0, 0, 0)), (1.0, (0, math.nan, 0)), (1.0, (0, 1, 0), (math.inf, 0, 0))]
)
def test_numbers_that_are_none_are_refused(arguments):
    tank = Tank()
    with pytest.raises(ValueError):
        tank.model.links["left"].run_belt(*arguments)
    tank.world.step(10)
    assert not tank.world.messages

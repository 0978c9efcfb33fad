"""Bumpers, cliffs and dropped wheels against a simulated room, without ROS."""

import math

import ode_sim
import pytest
from kobuki_base.senses import Bumper, Cliffs, OnFloor, bumper_side, named_sensor, reading
from plugin_loader import PluginError
from robot import sdf

_TABLE = """<sdf version="1.6"><world name="w"><model name="table"><static>1</static><link name="l"><collision name="c">
  <pose>0 0 -0.5 0 0 0</pose><geometry><box><size>2 2 1</size></box></geometry>
  </collision></link></model></world></sdf>"""
_POST = """<sdf version="1.6"><model name="post"><static>1</static><link name="l"><collision name="c">
  <pose>0 0 0.2 0 0 0</pose><geometry><cylinder><radius>0.05</radius><length>0.4</length></cylinder></geometry>
  </collision></link></model></sdf>"""
_RAYS = {"left": "cliff_left", "center": "cliff_front", "right": "cliff_right"}


def place(x=0.0, y=0.0, z=0.0, yaw=0.0):
    world = ode_sim.World.load(_TABLE)
    model = world.spawn_sdf(sdf(), pose=ode_sim.Pose((x, y, z), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))))
    return world, model


@pytest.mark.parametrize(
    "angle, side", [(0, "center"), (0.5, "center"), (0.55, "left"), (-0.55, "right"), (1.6, ""), (math.pi, ""), (2 * math.pi - 1, "right")]
)
def test_each_bumper_covers_sixty_degrees(angle, side):
    assert bumper_side(angle) == side


@pytest.mark.parametrize("yaw, side", [(0.0, "center"), (-1.0, "left"), (1.0, "right"), (math.pi, None)])
def test_a_post_pushes_the_bumper_on_its_side(yaw, side):
    world, model = place(yaw=yaw)
    bumper = Bumper(world, model, [model.links["wheel_left_link"], model.links["wheel_right_link"]])
    world.step(20)
    assert bumper.pressed() == set()
    world.spawn_sdf(_POST, pose=ode_sim.Pose((0.225, 0.0, 0.0)))
    world.step(1)
    assert bumper.pressed() == ({side} if side else set())


def test_the_edge_of_a_table_is_a_cliff():
    world, model = place(x=0.9)
    cliffs = Cliffs(world, model, _RAYS, 0.04)
    world.step(1)
    found = cliffs.distances()
    assert found["left"] == pytest.approx(0.015, abs=1e-3) and not cliffs.is_cliff(found["left"])
    assert math.isinf(found["center"]) and cliffs.is_cliff(found["center"])
    assert all(0 <= reading(distance) <= 0xFFFF for distance in found.values())


def test_wheels_in_the_air_are_dropped():
    world, model = place(z=0.2)
    on_floor = OnFloor(world, model.links["wheel_left_link"])
    world.step(1)
    assert not on_floor()
    world.step(1000)
    assert on_floor()


def test_a_sensor_that_is_not_there_is_named():
    _, model = place()
    with pytest.raises(PluginError, match="no sensor 'gyro' of type imu; it has cliff_left .ray.*, imu .imu."):
        named_sensor(model, "gyro", ("imu",))

"""The plane coordinates against known points, and the robot's world on them."""

import numpy as np
import pytest
from state_estimation.anchoring import Anchor, Datum
from state_estimation.earth import Tangent, Utm, Zone, zone_named, zone_of
from state_estimation.motion import rotation
from state_estimation.sensors import IDENTITY, Transform

MUNICH = (48.1, 11.6)
METRE = 1 / 111_195.0  # degrees of latitude there


@pytest.mark.parametrize(
    "latitude, longitude, zone",
    [
        (48.1, 11.6, (32, True)),
        (-33.9, 18.4, (34, False)),
        (60, 4, (32, True)),
        (60, 2.9, (31, True)),
        (75, 8.9, (31, True)),
        (75, 9, (33, True)),
        (75, 35, (37, True)),
        (71.9, 8, (32, True)),
        (0, 180, (1, True)),
        (0, -180, (1, True)),
        (-80.1, 0, (0, False)),
        (84, 0, (0, True)),
    ],
)
def test_zones(latitude, longitude, zone):
    assert zone_of(latitude, longitude) == zone


@pytest.mark.parametrize("name, zone", [("31U", (31, True)), ("19h", (19, False)), ("1N", (1, True)), ("Z", (0, True)), ("B", (0, False))])
def test_zone_names(name, zone):
    assert zone_named(name) == zone


@pytest.mark.parametrize("name", ["", "61U", "0U", "31", "U", "31A", "31I", "31 UU", "north"])
def test_wrong_zone_names(name):
    with pytest.raises(ValueError, match="as in 31U"):
        zone_named(name)


def test_known_points_of_the_grid():
    arc = 4_984_944.378  # m, of the meridian
    assert Utm(Zone(31, True)).plane(45, 3, 0) == pytest.approx((500_000, 0.9996 * arc), abs=1e-3)
    assert Utm(Zone(34, False)).plane(0, 21, 0) == pytest.approx((500_000, 10_000_000), abs=1e-6)
    assert Utm(Zone(0, True)).plane(90, 0, 0) == pytest.approx((2_000_000, 2_000_000), abs=1e-6)


@pytest.mark.parametrize("plane", [Utm(zone_of(*MUNICH)), Utm(Zone(31, True)), Tangent(*MUNICH)])
def test_there_and_back(plane):
    near = 1e-9 if isinstance(plane, Utm) else 1e-5
    assert plane.point(*plane.plane(48.2, 11.5, 0.0)) == pytest.approx((48.2, 11.5), abs=near)


def test_convergence_is_the_way_of_a_meridian():
    plane = Utm(zone_of(*MUNICH))
    (east, north), (further_east, further_north) = plane.plane(*MUNICH, 0), plane.plane(MUNICH[0] + 1e-3, MUNICH[1], 0)
    assert plane.convergence(*MUNICH) == pytest.approx(np.arctan2(east - further_east, further_north - north), abs=1e-6)
    assert plane.convergence(*MUNICH) > 0.03
    assert Tangent(*MUNICH).convergence(*MUNICH) == 0


def test_no_jump_at_the_equator():
    plane = Utm(Zone(31, True))
    assert plane.plane(1e-5, 3, 0)[1] - plane.plane(-1e-5, 3, 0)[1] == pytest.approx(2.211, abs=0.001)


@pytest.mark.parametrize("place", [(91, 0, 0), (np.nan, 0, 0), (0, np.inf, 0), (0, 0, np.nan)])
@pytest.mark.parametrize("plane", [Utm(Zone(31, True)), Tangent(0, 0)])
def test_no_such_place(plane, place):
    with pytest.raises(ValueError, match="no point on the earth"):
        plane.plane(*place)


@pytest.mark.parametrize("local", [True, False])
def test_the_world_of_a_robot_that_looks_north(local):
    datum = Datum(*MUNICH, 500.0, local)
    world_base = Transform(rotation(np.array([0.1, -0.1, 0.5])), np.array([3.0, 4.0, 0.0]))  # it has driven, and leans
    anchor = Anchor(datum, world_base, np.array([0.0, 0.0, np.pi / 2]), offset=np.array([2.0, 0.0, 1.0]))
    # The receiver is 2 m in front of the robot and 1 m above it, in the direction that the world calls 0.5 rad.
    receiver = np.array([3 + 2 * np.cos(0.5), 4 + 2 * np.sin(0.5), 1.0])
    np.testing.assert_allclose(anchor.to_map(*MUNICH, 500.0), receiver, atol=1e-6)
    ahead = anchor.to_map(MUNICH[0] + 100 * METRE, MUNICH[1], 500.0) - receiver
    np.testing.assert_allclose(ahead, [100 * np.cos(0.5), 100 * np.sin(0.5), 0], atol=0.1)
    np.testing.assert_allclose(anchor.to_earth(receiver), (*MUNICH, 500.0), atol=1e-9)


def test_covariances_turn():
    anchor = Anchor(Datum(0.0, 3.0, 0.0), IDENTITY, np.array([0.0, 0.0, np.pi / 2]))  # the world's x is north
    np.testing.assert_allclose(anchor.covariance_in_map(np.diag([1.0, 2.0, 3.0])), np.diag([2.0, 1.0, 3.0]), atol=1e-9)
    back = anchor.covariance_on_earth(np.diag([2.0, 1.0, 3.0]))
    np.testing.assert_allclose(back, np.diag([1.0, 2.0, 3.0]), atol=1e-9)

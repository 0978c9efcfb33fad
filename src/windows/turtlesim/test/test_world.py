"""How turtles move, spawn, draw and refuse."""

import math
from types import SimpleNamespace

import pytest
from turtlesim.draw_square import SquareDriver
from turtlesim.world import SIZE, Line, Pen, World, WorldError

DT = 0.016


@pytest.fixture
def world():
    return World()


@pytest.fixture
def turtle(world):
    return world.spawn("", SIZE / 2, SIZE / 2, 0.0)


def drive(turtle, ahead, left, turn, seconds):
    lines = []
    for tick in range(round(seconds / DT)):
        turtle.drive(ahead, left, turn, tick * DT)
        lines += turtle.step(DT, tick * DT)[0]
    return lines


def test_size_and_first_pose_print_as_in_tutorials(turtle):
    assert "%f %f" % (SIZE, turtle.x) == "11.088889 5.544445"
    assert turtle.name == "turtle1"


def test_names(world):
    assert [world.spawn(name, 1, 1, 0).name for name in ("", "turtle2", "", "zoe", "ada")] == [
        "turtle1",
        "turtle2",
        "turtle3",
        "zoe",
        "ada",
    ]
    assert list(world.turtles) == ["ada", "turtle1", "turtle2", "turtle3", "zoe"]
    with pytest.raises(WorldError, match=r"A turtled named \[zoe\] already exists"):
        world.spawn("zoe", 1, 1, 0)
    world.kill("turtle2")
    with pytest.raises(WorldError, match=r"Tried to kill turtle \[turtle2\], which does not exist"):
        world.kill("turtle2")
    assert world.spawn("", 1, 1, 0).name == "turtle4"
    world.reset()
    assert not world.turtles and world.spawn("", 1, 1, 0).name == "turtle1"


def test_ahead_left_and_round(turtle):
    x = turtle.x
    drive(turtle, 1.0, 0, 0, 1.6)
    assert (turtle.x, turtle.y) == pytest.approx((x + 1.6, x))
    drive(turtle, 0, 0.5, 0, 1.6)
    assert (turtle.x, turtle.y) == pytest.approx((x + 1.6, x + 0.8))
    drive(turtle, 0, 0, 1.0, 3.2)
    assert turtle.theta == pytest.approx(3.2 - 2 * math.pi)


def test_a_command_counts_for_a_second(turtle):
    turtle.drive(1.0, 0, 0, now=10.0)
    x = turtle.x
    turtle.step(DT, 11.0)
    assert turtle.x == pytest.approx(x + DT) and turtle.speed == 1.0
    turtle.step(DT, 11.01)
    assert turtle.x == pytest.approx(x + DT) and turtle.speed == 0.0


def test_wall(turtle):
    turtle.drive(0, 1000.0, 0, now=0.0)
    lines, beyond = turtle.step(DT, 0.0)
    assert beyond == pytest.approx((SIZE / 2, SIZE / 2 + 16)) and turtle.y == SIZE
    assert lines == [Line((SIZE / 2, SIZE / 2), (SIZE / 2, SIZE), Pen())]


def test_pen(turtle):
    assert len(drive(turtle, 1, 0, 0, 0.16)) == 10
    turtle.set_pen((1, 2, 3), 0, off=False)
    assert {line.pen for line in drive(turtle, 1, 0, 0, 0.16)} == {Pen((1, 2, 3), 1)}
    turtle.set_pen((9, 9, 9), 9, off=True)
    assert drive(turtle, 1, 0, 0, 0.16) == []
    turtle.set_pen((9, 9, 9), 9, off=False)
    start = (turtle.x, turtle.y)
    assert turtle.teleport(1, 2, 3) == [Line(start, (1, 2), Pen((9, 9, 9), 9))]


def test_teleports(turtle):
    start = (turtle.x, turtle.y)
    assert turtle.teleport(1, 2, math.pi / 2) == [Line(start, (1, 2), Pen())]
    turtle.teleport_relative(3, math.pi / 2)  # turns first
    assert (turtle.x, turtle.y, turtle.theta) == pytest.approx((-2, 2, math.pi))
    _, beyond = turtle.step(DT, 0.0)
    assert beyond[0] == pytest.approx(-2) and turtle.x == 0


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
def test_numbers_that_lose_a_turtle_are_refused(world, turtle, bad):
    before = vars(turtle).copy()
    for request in (
        lambda: turtle.drive(bad, 0, 0, 0),
        lambda: turtle.drive(0, 0, bad, 0),
        lambda: turtle.teleport(0, bad, 0),
        lambda: turtle.teleport_relative(0, bad),
        lambda: world.spawn("x", 0, 0, bad),
    ):
        with pytest.raises(WorldError, match="not finite"):
            request()
    assert vars(turtle) == before and list(world.turtles) == ["turtle1"]


def test_square(turtle):
    """Two squares through, the turtle is back where it began, as far as the driver's tolerances let it."""
    said, corners = [], []
    driver = SquareDriver(said.append)
    for tick in range(6000):
        now = tick * DT
        command = driver.twist(
            SimpleNamespace(x=turtle.x, y=turtle.y, theta=turtle.theta, linear_velocity=turtle.speed, angular_velocity=turtle.command[2])
        )
        if command:
            turtle.drive(command[0], 0, command[1], now)
        else:
            corners.append((turtle.x, turtle.y))
            if len(corners) == 16:
                break
        turtle.step(DT, now)
    assert len(corners) == 16 and said[0] == "New goal [%f %f, 0.000000]" % (SIZE / 2 + 2, SIZE / 2)
    assert said[1:3] == ["Reached goal", "New goal [%f %f, 1.570796]" % corners[0]]
    sides = [math.dist(corners[i], corners[i + 2]) for i in range(0, 14, 2)]
    assert all(1.88 < side < 1.93 for side in sides)
    assert math.dist(corners[-1], (SIZE / 2, SIZE / 2)) < 0.35

"""Keys to velocities: directions, ramps, speeds, stopping."""

import pytest
from keyboard_teleop.driving import ANGULAR_RAMP, DIRECTIONS, HELP, LINEAR_RAMP, Driver


def held(key, turns, driver=None):
    driver = driver or Driver()
    for _ in range(turns):
        driver.turn(key)
    return driver


@pytest.mark.parametrize(
    "key, linear, angular",
    [("i", 0.2, 0), ("o", 0.2, -1), ("j", 0, 1), ("l", 0, -1), ("u", 0.2, 1), (",", -0.2, 0), (".", -0.2, 1), ("m", -0.2, -1)],
)
def test_directions(key, linear, angular):
    driver = held(key, 20)
    assert (driver.linear, driver.angular) == pytest.approx((linear, angular))


def test_eight_directions():
    assert sorted(DIRECTIONS) == sorted("uiojlm,.")


def test_ramps():
    driver = held("u", 1)
    assert (driver.linear, driver.angular) == (LINEAR_RAMP, ANGULAR_RAMP)
    held("m", 1, driver)
    assert (driver.linear, driver.angular) == (0, 0)


def test_stop_is_immediate():
    for key in " k":
        driver = held("u", 20)
        driver.turn(key)
        assert driver.at_rest()


def test_rolls_to_a_stop_after_the_fifth_idle_turn():
    driver = held("", 4, held("i", 20))
    assert driver.linear == pytest.approx(0.2)
    driver.turn("")
    assert driver.linear == pytest.approx(0.18)
    held("?", 10, driver)
    assert driver.at_rest()


@pytest.mark.parametrize("key, speed, turn", [("q", 1.1, 1.1), ("z", 0.9, 0.9), ("w", 1.1, 1), ("x", 0.9, 1), ("e", 1, 1.1), ("c", 1, 0.9)])
def test_speed_keys(key, speed, turn):
    driver = Driver()
    assert driver.turn(key) == driver.status()
    assert (driver.speed, driver.turn_rate) == pytest.approx((0.2 * speed, turn))


def test_status_line():
    assert Driver().status() == "currently:\tspeed 0.2\tturn 1 "


def test_help_comes_back():
    driver = Driver()
    texts = [driver.turn("qz"[index % 2]) for index in range(30)]
    assert [index for index, text in enumerate(texts, 1) if HELP in text] == [15, 30]

"""Which key does what."""

import pytest
from twist_keyboard.driving import DIRECTIONS, HELP, Driver


def test_every_key_of_the_help_is_known():
    assert sorted(DIRECTIONS) == sorted("uiojlm,.UIOJLM<>tb")


@pytest.mark.parametrize(
    "key, linear, angular",
    [
        ("i", (0.5, 0, 0), 0),
        ("o", (0.5, 0, 0), -1),
        ("j", (0, 0, 0), 1),
        ("l", (0, 0, 0), -1),
        ("u", (0.5, 0, 0), 1),
        (",", (-0.5, 0, 0), 0),
        (".", (-0.5, 0, 0), 1),
        ("m", (-0.5, 0, 0), -1),
        ("O", (0.5, -0.5, 0), 0),
        ("J", (0, 0.5, 0), 0),
        ("L", (0, -0.5, 0), 0),
        ("U", (0.5, 0.5, 0), 0),
        ("<", (-0.5, 0, 0), 0),
        (">", (-0.5, -0.5, 0), 0),
        ("M", (-0.5, 0.5, 0), 0),
        ("t", (0, 0, 0.5), 0),
        ("b", (0, 0, -0.5), 0),
        ("k", (0, 0, 0), 0),
        (" ", (0, 0, 0), 0),
    ],
)
def test_directions(key, linear, angular):
    driver = Driver()
    assert driver.press(key) == (True, "")
    assert (driver.linear, driver.angular) == (linear, angular)


def test_a_time_without_a_key_stops_once():
    driver = Driver()
    assert driver.press("") == (False, "")
    driver.press("i")
    assert driver.press("") == (True, "") and driver.linear == (0, 0, 0)
    assert driver.press("") == (False, "")


def test_speeds_change_while_driving():
    driver = Driver(1.0, 2.0)
    driver.press("u")
    assert driver.press("q") == (True, "currently:\tspeed 1.1\tturn 2.2 ")
    assert (driver.linear[0], driver.angular) == (1.1, 2.2)
    driver.press("x"), driver.press("c")
    assert (driver.speed, driver.turn) == pytest.approx((0.99, 1.98))


def test_limits():
    driver = Driver(1.0, 1.0, speed_limit=1.05, turn_limit=1.05)
    assert driver.press("q")[1].splitlines()[:2] == ["Linear speed limit reached!", "Angular speed limit reached!"]
    assert (driver.speed, driver.turn) == (1.05, 1.05)


def test_help_comes_back():
    driver = Driver()
    texts = [driver.press("qz"[index % 2])[1] for index in range(30)]
    assert [index for index, text in enumerate(texts, 1) if HELP in text] == [15, 30]

"""Message authentication codes, made by hand: SHA-512 of secret, client, dest, rand, t, level, end."""

import hashlib

import pytest
import rospy
from rosauth.node import good
from rosauth.srv import AuthenticationRequest

SECRET = "abcdefghijklmnop"
CODE = hashlib.sha512(b"abcdefghijklmnop1.1.1.12.2.2.2random1000user2000").hexdigest()


def request(**fields):
    return AuthenticationRequest(
        **{
            "mac": CODE,
            "client": "1.1.1.1",
            "dest": "2.2.2.2",
            "rand": "random",
            "t": rospy.Time(1000),
            "level": "user",
            "end": rospy.Time(2000),
            **fields,
        }
    )


def test_the_right_code():
    assert good(SECRET, request(), rospy.Time(1000), 5)


@pytest.mark.parametrize(
    "fields",
    [
        {"mac": ""},
        {"mac": CODE[:-1]},
        {"mac": CODE.upper()},
        {"mac": "ü"},
        {"client": "1.1.1.2"},
        {"dest": ""},
        {"rand": "x"},
        {"level": "admin"},
        {"t": rospy.Time(1001)},
        {"end": rospy.Time(2001)},
    ],
)
def test_any_other(fields):
    assert not good(SECRET, request(**fields), rospy.Time(1000), 5)
    assert not good("another secret..", request(), rospy.Time(1000), 5)


@pytest.mark.parametrize(
    "now, delta, expected", [(1004, 5, True), (996, 5, True), (1005, 5, False), (995, 5, False), (2001, 5000, False), (2001, -1, True)]
)
def test_times(now, delta, expected):
    assert good(SECRET, request(), rospy.Time(now), delta) == expected
